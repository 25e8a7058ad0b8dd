"""Command lines for a shell."""

from __future__ import annotations

import os
import shlex
from typing import Sequence


def shell_line(words: Sequence[str]) -> str:
    """Return a command and its arguments as one line that can be pasted into a shell.

    Parameters
    ----------
    words : sequence of str
        The command, then its arguments.
    """
    if os.name == "nt":
        # Windows only has double quotes, and file names there cannot contain them.
        return " ".join(f'"{word}"' if " " in word else word for word in words)
    return shlex.join(words)
