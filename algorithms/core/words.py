"""Numbers in sentences."""

from __future__ import annotations


def counted(count: int, single: str, several: str = "") -> str:
    """Return a number of things in words, such as "1 file" and "2 files"; without `several` an "s"
    is added to `single`.
    """
    return f"{count:,} {single if count == 1 else several or single + 's'}"
