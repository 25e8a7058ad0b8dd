"""Downloads the sources of labelled point clouds, and rebuilds the clouds of them."""

from __future__ import annotations

from pathlib import Path
from typing import Sequence

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.core.files import replacing, write_errors_told
from bare_earth.algorithms.core.progress import Progress
from bare_earth.algorithms.core.words import counted
from bare_earth.algorithms.remote.answers import Missing
from bare_earth.algorithms.remote.parts import Parts, remove_parts
from bare_earth.algorithms.remote.transfers import Transfers

from .manifest import Entry, Source, sha256
from .rebuilding import Rebuilding, is_as_measured

_WAITING = "sources"  # the folder of what was downloaded and not yet used
_PIECE = 1 << 20  # bytes of a request
_MOST_FAILURES = 2  # clouds in a row that a server fails to give, before the others are given up


class Fetching:
    """Brings clouds into a folder; what came before an error or a stop is not requested again."""

    def __init__(self, folder: Path, progress: Progress) -> None:
        self._folder, self._progress = folder.absolute(), progress

    def run(self, wanted: Sequence[Entry]) -> list[str]:
        """Fetch clouds, and return a sentence for each that failed."""
        failed, in_a_row = [], 0
        for number, entry in enumerate(wanted, start=1):
            if in_a_row == _MOST_FAILURES:
                failed.append(
                    f"{counted(len(wanted) - number + 1, 'cloud')} more were not tried. Run it"
                    " again when the server can be reached; what has come stays."
                )
                break
            is_server, sentence = False, ""
            try:
                result = self._fetch(entry)
            except Missing as error:
                sentence = str(error)
            except BareEarthError as error:
                is_server, sentence = True, str(error)
            in_a_row = in_a_row + 1 if is_server else 0
            if sentence:
                failed.append(f"{entry.name}: {sentence}")
                result = f"failed: {sentence}"
            print(f"[{number}/{len(wanted)}] {entry.name}: {result}", flush=True)
        return failed

    def _fetch(self, entry: Entry) -> str:
        """Fetch one cloud if it is not here, and return what was done."""
        target = self._folder / entry.file
        if target.exists():
            if is_as_measured(target, entry):
                return "is here"
            raise BareEarthError(f"{target} holds other points. Move it away, and run it again.")
        waiting = self._folder / _WAITING / entry.name
        with write_errors_told(waiting):
            waiting.mkdir(parents=True, exist_ok=True)
        self._download(entry, waiting)
        with write_errors_told(target):
            target.parent.mkdir(parents=True, exist_ok=True)
        with replacing(target) as temporary:
            Rebuilding(entry, [waiting / _name(one) for one in entry.sources], temporary).run()
            if not is_as_measured(temporary, entry):
                raise BareEarthError(
                    f"{entry.name}: what was rebuilt from the sources differs from what was"
                    " measured. Report it with the versions of laspy and NumPy."
                )
        for source in entry.sources:
            (waiting / _name(source)).unlink()
        _remove_empty(waiting)
        return f"{entry.points:,} points, {target.stat().st_size / 1e6:.1f} MB"

    def _download(self, entry: Entry, waiting: Path) -> None:
        """Download the sources of a cloud that are not here yet."""
        missing = [one for one in entry.sources if not (waiting / _name(one)).exists()]
        with Transfers(self._progress) as transfers:
            requests, parts = [], []
            for source in missing:
                kept = Parts(waiting / f"{_name(source)}.parts", source.address)
                kept.begin({"sha256": source.sha256}, True)
                parts.append(kept)
                requests += [
                    (kept, source, first, min(first + _PIECE, stop))
                    for start, stop in kept.missing(0, source.size)
                    for first in range(start, stop, _PIECE)
                ]

            def bring(kept: Parts, source: Source, start: int, stop: int) -> None:
                data, state = transfers.read(source.address, start, stop, None)
                if state.size != source.size:
                    raise Missing(
                        f"{source.address} has {state.size:,} bytes in place of"
                        f" {source.size:,}: the server has another version now."
                    )
                kept.add(start, data)

            tasks = [lambda request=request: bring(*request) for request in requests]
            size = sum(stop - start for *_, start, stop in requests)
            transfers.run(tasks, self._progress, size)
        for source, kept in zip(missing, parts):
            _join(kept, source, waiting)


def _join(kept: Parts, source: Source, waiting: Path) -> None:
    """Write a source from its parts, if its digest is right; drop the parts."""
    data = kept.read(0, source.size)
    is_right = data is not None and sha256(data) == source.sha256
    if is_right:
        with replacing(waiting / _name(source)) as temporary:
            temporary.write_bytes(data or b"")
    remove_parts(waiting / f"{_name(source)}.parts")
    if not is_right:
        raise Missing(
            f"{source.address} has other bytes than those that were measured (its SHA-256"
            " differs): the server has another version now, or something on the way changed it."
        )


def _name(source: Source) -> str:
    """Return the name of a downloaded source: equal names of different folders don't meet."""
    return f"{source.sha256[:12]}-{source.name}"


def _remove_empty(folder: Path) -> None:
    """Remove a folder and the one above it, if nothing is in them."""
    for one in (folder, folder.parent):
        if not any(one.iterdir()):
            one.rmdir()
