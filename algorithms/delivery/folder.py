"""The folder of a delivery: it holds a whole delivery, or what it held before."""

from __future__ import annotations

import contextlib
import json
import os
from pathlib import Path
from typing import Any, Sequence

from ..core.errors import BareEarthError, OutputInUse
from ..core.files import (
    MARKS,
    check_free,
    check_lengths,
    check_output,
    free_path,
    new_folder,
    rename,
    replacing,
    temporary_folder,
    write_errors_told,
)
from ..core.temporary import patiently, remove
from ..engine.manifest import folders_of
from ..survey.files import is_cloud

POINTS = "points"
QUALITY = "quality"
PAGE = "index.html"
RECORD = "delivery.json"
# Folder of what tools made of the classified files, in folders with the names of the tools.
_WAITING = ".waiting"
# The lock in the folder of records, see `alone_in`.
_LOCK = "lock"


class DeliveryFolder:
    """The folder of a delivery, which is made if it is missing."""

    def __init__(self, path: Path) -> None:
        self.path = Path(path)

    @property
    def points(self) -> Path:
        """The folder of the classified files."""
        return self.path / POINTS

    @property
    def waiting(self) -> Path:
        """The folder of changed files that further steps will read."""
        return self.path / _WAITING

    @property
    def _places_of_records(self) -> tuple[Path, Path]:
        """Where a run has the records of many files, and where a finished delivery has them, since
        who receives the points has no use for these.
        """
        during = folders_of(self.points)[1]
        return during, self.path / during.name

    @property
    def _record(self) -> dict[str, Any] | None:
        """The record of the delivery that the folder holds; None if it holds none."""
        try:
            record = json.loads((self.path / RECORD).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        is_whole = isinstance(record, dict) and isinstance(record.get("files"), list)
        return record if is_whole else None

    def check(self, sources: Sequence[Path]) -> None:
        """Refuse, before any work, a folder with files of the user, or that cannot be made."""
        check_lengths(self.path, [f"{MARKS}/{QUALITY}/strip_differences.tif"])
        if not self.path.exists():
            check_output(self.path)
            return
        if not self.path.is_dir():
            raise BareEarthError(f"Cannot write into {self.path}: it is a file. Give a folder.")
        here = self.path.resolve()
        for source in map(Path, sources):
            if here == source.resolve() or here in source.resolve().parents:
                raise BareEarthError(
                    f"The input {source} is in the folder of the delivery, {self.path}. Choose"
                    " another folder."
                )
        seen = [name for name in os.listdir(self.path) if not name.startswith(".")]
        if seen and self._record is None:
            raise BareEarthError(
                f"The folder {self.path} holds other files, such as {min(seen)}. Choose an empty"
                " folder, a new one, or that of an earlier delivery, which is replaced."
            )
        check_output(self.path / RECORD)
        for name in self._files:
            check_free(self.path / name)

    def begin(self, delivery: str) -> None:
        """Make the folder for files that are finished one by one, and say that more will follow."""
        files = self._files
        during, after = self._places_of_records
        with write_errors_told(self.path):
            self.path.mkdir(exist_ok=True)
            remove(self.path / PAGE)
            if after.is_dir() and not during.exists():
                self.points.mkdir(exist_ok=True)
                patiently(os.replace, after, during)
        _write_record(
            self.path / RECORD, {"delivery": delivery, "is_finished": False, "files": files}
        )

    def leave(self) -> bool:
        """Remove what is not finished; return whether finished files stay."""
        folders = [folder for folder in (self.points, self.waiting) if folder.is_dir()]
        if any(is_cloud(path) for folder in folders for path in folder.rglob("*")):
            return True
        for folder in folders:
            remove(folder)
        with contextlib.suppress(OSError):  # it may hold files of the user
            if not self._files:
                (self.path / RECORD).unlink(missing_ok=True)
            self.path.rmdir()
        return False

    def replace(self, working: Path, changed: Sequence[Path], record: dict[str, Any]) -> None:
        """Put a finished delivery from a temporary folder on the same disk here in place of an
        earlier one: all of it, or nothing, and its record with the names of the files.
        """
        # The changed files are in folders of tools, and replace those with the same names among the
        # points. `OutputInUse` says, if an old file is open, where the new delivery is.
        old = self._files
        names = [
            path.relative_to(working).as_posix() for path in working.rglob("*") if path.is_file()
        ]
        kept = {*names, *record["files"]}
        _write_record(working / RECORD, {**record, "is_finished": True, "files": sorted(kept)})
        # The records of many files first, which tell whether a file was changed; the page last.
        moves = [
            (path, self.points.joinpath(*path.relative_to(self.waiting).parts[1:]))
            for path in changed
        ]
        moves.sort(key=lambda move: -len(move[1].parts))
        names.sort(key=lambda name: (name == PAGE, name))
        moves += [(working / name, self.path / name) for name in (*names, RECORD)]
        outdated = [self.path / name for name in set(old) - kept]
        is_one = (working / POINTS).is_dir()
        try:
            with new_folder(self.path), temporary_folder(self.path) as aside:
                exchange(moves, outdated, aside)
        except OutputInUse as error:
            content = "delivery" if is_one else "delivery, all but its points,"
            kept_in = free_path(self.path)
            patiently(os.rename, working, kept_in)
            raise OutputInUse(f"{error} The new {content} is kept in {kept_in}.") from error
        remove(self.waiting)
        with write_errors_told(self.path):
            self._put_records_away(is_one)
            for folder in {(self.path / name).parent for name in old} - {self.path}:
                if folder.is_dir() and not any(folder.iterdir()):
                    folder.rmdir()

    def _put_records_away(self, is_one: bool) -> None:
        """Move the records of many files out of the points, and remove those of other files."""
        during, after = self._places_of_records
        remove(after)
        if is_one:
            remove(during)
        elif during.is_dir():
            remove(during / _LOCK)
            patiently(os.replace, during, after)

    @property
    def _files(self) -> list[str]:
        """The files of the delivery that the folder holds, if they are in it."""
        record, here = self._record or {"files": []}, self.path.resolve()
        named = (name for name in record["files"] if isinstance(name, str))
        return [name for name in named if here in (self.path / name).resolve().parents]


def _write_record(path: Path, record: dict[str, object]) -> None:
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def exchange(moves: Sequence[tuple[Path, Path]], outdated: Sequence[Path], aside: Path) -> None:
    """Move files to their places and remove others, all or, after an error such as `OutputInUse`,
    none; `aside` is a temporary folder on the same disk, for the old files.
    """
    targets = [*(target for _, target in moves), *outdated]
    for path in targets:
        check_free(path)
    done: list[tuple[Path, Path]] = []
    try:
        for number, target in enumerate(targets):
            with write_errors_told(target):
                old = aside / str(number)
                if os.path.lexists(target):
                    _set_aside(target, old)
                    done.append((old, target))
                if number < len(moves):
                    target.parent.mkdir(parents=True, exist_ok=True)
                    rename(moves[number][0], target)
                    done.append((target, moves[number][0]))
                elif os.path.lexists(target):
                    patiently(os.unlink, target)
    except BaseException:
        for now, before in reversed(done):
            with contextlib.suppress(OSError):  # the first error is the one to tell
                if not (before.exists() and os.path.samefile(now, before)):
                    patiently(os.replace, now, before)
        raise


def _set_aside(path: Path, old: Path) -> None:
    """Keep an old file under another name; where the disk can do so, also under its own."""
    try:
        os.link(path, old)
    except OSError:
        rename(path, old)
