"""Numbers in sentences."""

from __future__ import annotations


def counted(count: int, one: str, more: str = "") -> str:
    """Return a number of things in words, such as "1 file" and "2 files".

    Parameters
    ----------
    count : int
        How many.
    one, more : str
        The words for one and for more than one, such as "file is" and "files are"; without `more`
        an "s" is added.
    """
    return f"{count:,} {one if count == 1 else more or one + 's'}"
