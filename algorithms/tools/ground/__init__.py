"""Classify the ground: the parameters of all filters, the step of a run, and its labels."""
