"""Triangulations of points, and the surfaces that they make. Knows no files."""
