"""The version of the package, which is also in `metadata.txt` and the changelog."""

__version__ = "0.1.0"
