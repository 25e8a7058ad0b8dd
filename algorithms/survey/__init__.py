"""A survey: its files, and the area of a run."""
