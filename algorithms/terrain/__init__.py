"""What the filters and the products stand on: grids, morphology, TIN and terrain models."""
