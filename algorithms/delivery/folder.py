"""The folder of a delivery: it gets a complete delivery, or stays as it was."""

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
# Folder of files that tools have changed, in folders with the names of the tools.
_WAITING = ".waiting"
# The lock in the folder of records, see `alone_in`.
_LOCK = "lock"


class DeliveryFolder:
    """The folder of a delivery, which need not exist yet."""

    def __init__(self, path: Path) -> None:
        self.path = Path(path)
        # Whether the folder gets files one by one, before the whole delivery is finished.
        self.has_begun = False

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
        """The folders of the records of many files: during a run beside the points, and afterwards
        in the folder of the delivery, since clients do not need them among the points.
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
        """Refuse, before any work, a folder with other files, or one that cannot be made."""
        with write_errors_told(self.path):
            check_lengths(self.path, [f"{MARKS}/{QUALITY}/strip_differences.tif"])
        if not self.path.exists():
            check_output(self.path)
            return
        if not self.path.is_dir():
            raise BareEarthError(f"Cannot write into {self.path}: it is a file. Give a folder.")
        folder = self.path.resolve()
        for source in map(Path, sources):
            if folder == source.resolve() or folder in source.resolve().parents:
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
        """Make the folder for files that are finished one by one, with an unfinished record."""
        self.has_begun, files = True, self._files
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
        """Remove unfinished files; return whether finished files stay."""
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
        """Move a finished delivery from a temporary folder on the same disk into this one, in place
        of an earlier delivery: all of its files or none; write its record with their names.
        """
        # The changed files are in folders of tools, and replace points with the same names. If an
        # old file is open, `OutputInUse` says where the new delivery is.
        old = self._files
        names = [
            path.relative_to(working).as_posix() for path in working.rglob("*") if path.is_file()
        ]
        kept = {*names, *record["files"]}
        _write_record(working / RECORD, {**record, "is_finished": True, "files": sorted(kept)})
        # First the records of many files, which say whether a file was changed, and last the page.
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
        record, folder = self._record or {"files": []}, self.path.resolve()
        named = (name for name in record["files"] if isinstance(name, str))
        return [name for name in named if folder in (self.path / name).resolve().parents]


def _write_record(path: Path, record: dict[str, object]) -> None:
    with replacing(path) as temporary:
        temporary.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def exchange(moves: Sequence[tuple[Path, Path]], outdated: Sequence[Path], aside: Path) -> None:
    """Move files to their places, and remove outdated ones, all or, after an error, none; `aside`
    is a temporary folder on the same disk for the old files.
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
    """Keep an old file under another name, and if the disk has hard links also under its own."""
    try:
        os.link(path, old)
    except OSError:
        rename(path, old)
