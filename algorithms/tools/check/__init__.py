"""Comparison of ground points and a terrain model with points that were surveyed."""
