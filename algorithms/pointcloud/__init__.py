"""LAS, LAZ and COPC in and out, the selection of points and the units of their CRS."""
