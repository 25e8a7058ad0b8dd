"""The files of a run as one survey: which files, which points, which area."""
