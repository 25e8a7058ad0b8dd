"""Terrain as arrays: cells, morphology, filling. Knows no files."""
