"""Styles of the layers of a run: colours, legends, names and order in the layer tree."""
