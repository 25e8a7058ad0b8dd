"""Runs the commands of a page of the docs, as its reader would, and keeps what they print."""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
from pathlib import Path
from typing import Iterator, NamedTuple

from bare_earth.algorithms.cli import main as bare_earth

from .__main__ import main as demo

_FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)


class Block(NamedTuple):
    """A block of code on a page.

    Attributes
    ----------
    kind : str
        What is written behind the fence: "sh" for commands, "text" for lines of a page that a
        command made, empty for what a command prints.
    text : str
        What is in the block.
    behind : str
        What the page says behind the block, up to the next one.
    """

    kind: str
    text: str
    behind: str


class Step(NamedTuple):
    """A block, and what was printed by the commands that were run last."""

    block: Block
    printed: str


def blocks_of(page: str) -> list[Block]:
    """Return the blocks of code of a page, in order."""
    _, *parts = _FENCE.split(page)
    return [Block(*fields) for fields in zip(parts[::3], parts[1::3], parts[2::3])]


def commands_of(block: Block) -> list[list[str]]:
    """Return the commands of a block as lists of words, without comments."""
    lines = block.text.replace("\\\n", " ").splitlines()
    return [words for line in lines if (words := shlex.split(line, comments=True))]


def steps(page: str, folder: Path) -> Iterator[Step]:
    """Run the commands of a page in a folder.

    Parameters
    ----------
    page : str
        The page, as Markdown.
    folder : Path
        Where its reader starts.

    Yields
    ------
    Step
        Each block, after its commands have been run. The working folder is that of the reader.

    Raises
    ------
    RuntimeError
        If a command fails, or is none that a page may have.
    """
    printed = ""
    before = Path.cwd()
    os.chdir(folder)
    try:
        for block in blocks_of(page):
            if block.kind == "sh":
                printed = "".join(map(_run, commands_of(block)))
            yield Step(block, printed)
    finally:
        os.chdir(before)


def _run(words: list[str]) -> str:
    """Run a command in this process, and return what it prints."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        code = _code(words)
    if code:
        raise RuntimeError(f"{shlex.join(words)} failed ({code}): {said.getvalue()}")
    return said.getvalue()


def _code(words: list[str]) -> int:
    if words[0] == "bare-earth":
        return bare_earth(words[1:])
    if words[:2] == ["make", "demo"]:
        return demo([f"--{word}".replace("JOB", "job") for word in words[2:]])
    if words[0] == "cd":
        os.chdir(words[1])
        return 0
    raise RuntimeError(f"A page has a command that is not known: {shlex.join(words)}")
