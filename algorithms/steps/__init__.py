"""Steps: what a run can compute from the points of a survey."""
