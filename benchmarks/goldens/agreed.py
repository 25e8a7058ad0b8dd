"""The digests that were agreed, and what differs from them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Iterator

from .digests import Digests

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
        elif agreed[name] != found[name]:
            before = agreed[name].split(", ")
            parts = [part for part in found[name].split(", ") if part not in before]
            names = ", ".join(part.split()[0] for part in parts if " " in part)
            yield f"changed  {name}: {names}" if names else f"changed  {name}"
