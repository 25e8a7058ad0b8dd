"""What `manifest.json` says of the labelled point clouds: public sources, licences, digests."""

from __future__ import annotations

import base64
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable

_MANIFEST = Path(__file__).with_name("manifest.json")


@dataclass(frozen=True)
class Source:
    """A file on a server."""

    address: str
    size: int  # bytes
    sha256: str

    @property
    def name(self) -> str:
        """The file name."""
        return self.address.rsplit("/", 1)[-1]


@dataclass(frozen=True)
class Entry:
    """A cloud, and how it is rebuilt from its sources."""

    file: str  # path in the data folder
    title: str
    land: str
    licence: str  # of the repository that has the sources
    data_licence: str
    good_for: str
    sources: tuple[Source, ...]
    steps: tuple[tuple[Any, ...], ...]  # see `rebuilding.py`
    points: int
    bytes: int  # of the file as it was measured
    points_sha256: str
    returns_sha256: str
    offsets: tuple[float, ...] = ()  # of the coordinates in a file that is written anew
    note: str = ""

    @property
    def name(self) -> str:
        """The file name without its ending."""
        return Path(self.file).stem

    @property
    def download_size(self) -> int:
        """Bytes of all sources."""
        return sum(source.size for source in self.sources)


def entries(path: Path = _MANIFEST) -> list[Entry]:
    """Return the entries of a manifest."""
    found: dict[str, dict[str, Any]] = {}
    for stated in json.loads(path.read_text(encoding="utf-8")):
        found[stated["file"]] = {**found.get(stated.pop("like", ""), {}), **stated}
    return [_entry(dict(values)) for values in found.values()]


def _entry(values: dict[str, Any]) -> Entry:
    pattern, rows = values.pop("from"), values.pop("sources")
    return Entry(
        sources=tuple(_source(pattern, row) for row in rows),
        steps=tuple(tuple(step) for step in values.pop("steps")),
        offsets=tuple(values.pop("offsets", ())),
        **values,
    )


def _source(pattern: str, row: str) -> Source:
    name, size, digest = row.rsplit(" ", 2)
    return Source(pattern.replace("*", name), int(size), digest)


def sha256(data: bytes) -> str:
    """Return the digest of bytes as the manifest writes it: URL-safe base64 without padding."""
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")


def chosen(names: Iterable[str], path: Path = _MANIFEST) -> list[Entry]:
    """Return the entries with some names, or all without names."""
    known = {entry.name: entry for entry in entries(path)}
    wanted = [Path(name).stem for name in names] or list(known)
    unknown = [name for name in wanted if name not in known]
    if unknown:
        raise SystemExit(f"Unknown: {', '.join(unknown)}. Known are: {', '.join(known)}.")
    return [known[name] for name in wanted]
