"""A survey: its files, and the points and the area of a run."""
