"""Numbers in sentences."""

from __future__ import annotations


def counted(count: int, one: str, more: str = "") -> str:
    """Return a number of things in words, such as "1 file" and "2 files"; without `more` an "s" is
    added to `one`.
    """
    return f"{count:,} {one if count == 1 else more or one + 's'}"
