"""The digests that were agreed, and what differs from them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Iterator

from .digests import Digests
from .numbers import difference

ROOT = Path(__file__).parents[2]
AGREED, AGREED_IN_QGIS = ROOT / "tests/project/goldens.json", ROOT / "tests/qgis/goldens.json"


def read(path: Path) -> Digests:
    """Return the digests of a file, or none if there is no file."""
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}


def write(path: Path, digests: Digests) -> None:
    """Write digests, one output in a line, so that a diff shows which outputs changed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(dict(sorted(digests.items())), indent=0)
    path.write_bytes(f"{text}\n".encode())


def differences(agreed: Digests, found: Digests) -> Iterator[str]:
    """Yield a line for each output that is not as agreed, with the parts of it that changed."""
    for name in sorted({*agreed, *found}):
        if name not in found:
            yield f"missing  {name}"
        elif name not in agreed:
            yield f"new      {name}"
        else:
            parts = [*_changed(_parts(agreed[name]), _parts(found[name]))]
            if parts:
                yield f"changed  {name}: {', '.join(filter(None, parts))}".rstrip(": ")


def _changed(agreed: dict[str, str], found: dict[str, str]) -> Iterator[str]:
    """Yield the name of each part that is not as agreed, and what differs."""
    for part in [*found, *(part for part in agreed if part not in found)]:
        wrong = difference(agreed.get(part, ""), found.get(part, ""))
        if wrong is not None:
            yield f"{part} ({wrong})".lstrip() if wrong else part


def _parts(digest: str) -> dict[str, str]:
    """Return the parts of a digest by their names; what has no parts has one without a name."""
    named = [part if " " in part else f" {part}" for part in digest.split(", ")]
    return dict(part.split(" ", 1) for part in named)
