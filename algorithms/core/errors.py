"""The two ways in which a computation of this package ends early."""

from __future__ import annotations

import unicodedata


class BareEarthError(Exception):
    """Something the user can mend; the text says in a sentence what is wrong and what to do."""

    def __init__(self, text: object = "") -> None:
        # Names of files and what stands in them may hold anything.
        super().__init__(printable(str(text)))


class Cancelled(Exception):
    """The user asked to stop. Whoever catches it leaves nothing half written behind."""


def printable(text: str) -> str:
    r"""Return a text as one line that any terminal, log or page can show.

    Line breaks, the characters that steer terminals, and the bytes of file names that are not UTF-8
    become escapes.

    Examples
    --------
    >>> print(printable("a\nb\udcff.laz"))
    a\nb\xff.laz
    """
    if text.isprintable():
        return text
    return "".join(map(_shown, text))


def _shown(character: str) -> str:
    if character.isprintable() or unicodedata.category(character) == "Zs":
        return character
    if "\udc80" <= character <= "\udcff":  # how Python keeps a byte that is not UTF-8
        return f"\\x{ord(character) - 0xDC00:02x}"
    return character.encode("unicode_escape").decode()
