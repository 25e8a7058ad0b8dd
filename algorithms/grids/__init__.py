"""Terrain as arrays: cells, morphology, filling, triangulation. Knows no files."""
