"""Rasters of the terrain and of what stands on it: what they are, and how they are made."""
