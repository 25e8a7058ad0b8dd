"""Deliveries: everything that a job hands over, made from raw points in one run."""
