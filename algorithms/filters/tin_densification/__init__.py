"""Progressive TIN densification."""
