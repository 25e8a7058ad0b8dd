"""The exceptions that end a computation of this package early."""

from __future__ import annotations

import re
import unicodedata

# An address; its user, password and query may be secret.
_ADDRESS = re.compile(
    r"\b([a-z][a-z0-9+.-]+:/{1,2})(?:[^\s/?#@]*@)?([^\s?#]*)(?:[?#]\S*[\w=])?", re.IGNORECASE
)


class BareEarthError(Exception):
    """An error that the user can solve; the text says what is wrong and what to do."""

    def __init__(self, text: object = "") -> None:
        # Names and contents of files can contain any character.
        super().__init__(_ADDRESS.sub(r"\1\2", printable(str(text))))


class NoGround(BareEarthError):
    """No point of a place can be ground, such as where all points lie on a roof."""


class OutputInUse(BareEarthError):
    """An old output cannot be replaced, since another program has it open or it is read-only."""


class UsageError(BareEarthError):
    """The command line, or a call of a function, contains a value that is not allowed."""


class Cancelled(Exception):
    """The user asked to stop. Code that catches it must remove incomplete files."""


class FinishedFilesStay(Cancelled):
    """The user stopped a run on many files, which can be continued: the finished ones stay."""


def printable(text: str) -> str:
    r"""Return a text as one line that any terminal, log or page can show, other characters as
    escapes.
    """
    # Line breaks, control characters, and bytes of file names that are not UTF-8.
    if text.isprintable():
        return text
    return "".join(map(_shown, text))


def _shown(character: str) -> str:
    if character.isprintable() or unicodedata.category(character) == "Zs":
        return character
    if "\udc80" <= character <= "\udcff":  # how Python keeps a byte that is not UTF-8
        return f"\\x{ord(character) - 0xDC00:02x}"
    return character.encode("unicode_escape").decode()
