"""Pictures of the relief of a terrain model. Knows no files."""
