"""The minimum-Z grid filter."""
