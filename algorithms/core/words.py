"""Numbers in sentences."""

from __future__ import annotations


def counted(count: int, noun: str) -> str:
    """Return a number of things in words, such as "1 file" and "2 files"."""
    return f"{count:,} {noun}" + "s" * (count != 1)
