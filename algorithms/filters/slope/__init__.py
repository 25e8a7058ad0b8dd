"""The slope-based filter."""
