"""Classes of points: which take part, which are ground, and which change."""
