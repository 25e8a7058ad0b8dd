"""Command lines for a shell."""

from __future__ import annotations

import os
import re
import shlex
from typing import Sequence

# Words that need no quotes in Windows.
_PLAIN = re.compile(r"[\w.:\\/=-]+")


def shell_line(words: Sequence[str]) -> str:
    """Return a command and its arguments as one line that can be pasted into a shell."""
    if os.name == "nt":
        return " ".join(word if _PLAIN.fullmatch(word) else _quoted(word) for word in words)
    return shlex.join(words)


def _quoted(word: str) -> str:
    """Return a word in the only quotes of Windows, which names of files cannot contain."""
    end = len(word) - len(word.rstrip("\\"))
    return f'"{word}{word[len(word) - end :]}"'  # a backslash before the quote is written twice
