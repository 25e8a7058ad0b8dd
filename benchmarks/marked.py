"""Tables between marks in a page, which a command writes: `<!-- name -->` and `<!-- end -->`."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Sequence


def _block(name: str) -> re.Pattern[str]:
    return re.compile(rf"(<!-- {re.escape(name)} -->\n).*?(?=<!-- end -->)", re.DOTALL)


def fill(page: Path, name: str, lines: Sequence[str]) -> None:
    """Write lines between the marks of a page; KeyError if it has no marks of this name."""
    text = page.read_text("utf-8")
    if not _block(name).search(text):
        raise KeyError(f"{page.name} has no <!-- {name} -->.")
    block = "\n".join(lines)
    page.write_text(_block(name).sub(lambda found: f"{found[1]}{block}\n", text), "utf-8")


def held(page: Path, name: str) -> list[str]:
    """Return the lines between the marks of a page."""
    found = _block(name).search(page.read_text("utf-8"))
    return found[0].splitlines()[1:] if found else []
