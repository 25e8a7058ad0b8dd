"""The version of the package; `metadata.txt` and the changelog state the same."""

__version__ = "0.1.0"
