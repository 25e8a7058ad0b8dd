"""Compares settings of the filters in a window of a survey."""
