"""The folder of a delivery: it holds a whole delivery, or what it held before."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
from pathlib import Path
from typing import Any, Sequence

from ..core.errors import BareEarthError
from ..core.files import check_output, replacing, write_errors_told
from ..engine.manifest import folders_of
from ..survey.files import is_cloud

POINTS, QUALITY = "points", "quality"
PAGE, RECORD = "index.html", "delivery.json"
# Folder of files that further steps will read.
_WAITING = ".waiting"
# Folders in it, of classified files that a step changed.
CHANGES = WATER, KEY_POINTS = "water", "key-points"
# The lock in the folder of records, see `alone_in`.
_LOCK = "lock"


class DeliveryFolder:
    """The folder of a delivery.

    Parameters
    ----------
    path : Path
        The folder. It is made if it is missing.
    """

    def __init__(self, path: Path) -> None:
        self.path = Path(path)

    @property
    def points(self) -> Path:
        """The folder of the classified files."""
        return self.path / POINTS

    @property
    def waiting(self) -> Path:
        """The folder of files that further steps will read."""
        return self.path / _WAITING

    @property
    def _places_of_records(self) -> tuple[Path, Path]:
        """Where a run has the records of many files, and where a finished delivery has them.

        Whoever receives the points has no use for these.
        """
        during = folders_of(self.points)[1]
        return during, self.path / during.name

    @property
    def record(self) -> dict[str, Any] | None:
        """The record of the delivery that the folder holds; None if it holds none."""
        try:
            found = json.loads((self.path / RECORD).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
        return found if isinstance(found, dict) and isinstance(found.get("files"), list) else None

    def check(self, sources: Sequence[Path]) -> None:
        """Refuse, before any work is done, a folder that is unsuitable.

        Raises
        ------
        BareEarthError
            If it cannot be made, holds files of the user, or holds an input.
        """
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
        seen = [each for each in os.listdir(self.path) if not each.startswith(".")]
        if seen and self.record is None:
            raise BareEarthError(
                f"The folder {self.path} holds other files, such as {min(seen)}. Choose an empty"
                " folder, a new one, or that of an earlier delivery, which is replaced."
            )
        check_output(self.path / RECORD)

    def begin(self, delivery: str) -> None:
        """Make the folder for files that are finished one by one, and say that more will follow."""
        files = self._files
        during, after = self._places_of_records
        with write_errors_told(self.path):
            self.path.mkdir(exist_ok=True)
            (self.path / PAGE).unlink(missing_ok=True)
            if after.is_dir() and not during.exists():
                self.points.mkdir(exist_ok=True)
                os.replace(after, during)
        self._write({"delivery": delivery, "is_finished": False, "files": files})

    def settle(self, made: Sequence[Path]) -> None:
        """Move files that wait to the classified files, and remove what else waits.

        Parameters
        ----------
        made : sequence of Path
            Files in a folder of `CHANGES`, which replace those of the same names in `points`.

        Raises
        ------
        BareEarthError
            If the operating system refuses to write.
        """
        with write_errors_told(self.points):
            # The records first: after a crash, no changed file has the record of an unchanged one.
            for each in sorted(made, key=lambda path: len(path.parts), reverse=True):
                _, *parts = each.relative_to(self.waiting).parts
                target = self.points.joinpath(*parts)
                target.parent.mkdir(parents=True, exist_ok=True)
                os.replace(each, target)
        shutil.rmtree(self.waiting, ignore_errors=True)

    def leave(self) -> bool:
        """Remove what is not finished; return whether finished files stay."""
        folders = [each for each in (self.points, self.waiting) if each.is_dir()]
        if any(is_cloud(each) for folder in folders for each in folder.rglob("*")):
            return True
        for each in folders:
            shutil.rmtree(each, ignore_errors=True)
        with contextlib.suppress(OSError):  # it may hold files of the user
            if not self._files:
                (self.path / RECORD).unlink(missing_ok=True)
            self.path.rmdir()
        return False

    def take(self, made: Path, record: dict[str, Any]) -> None:
        """Move a finished delivery here, and remove what is left of an earlier one.

        Parameters
        ----------
        made : Path
            A folder on the same disk, with the files and folders of the delivery.
        record : dict
            What is said of it; the names of the files are added.

        Raises
        ------
        BareEarthError
            If the operating system refuses to write.
        """
        old = self._files
        new = [each for each in sorted(made.rglob("*")) if each.is_file()]
        names = [each.relative_to(made).as_posix() for each in new]
        with write_errors_told(self.path):
            self.path.mkdir(exist_ok=True)
            # The page last, since it says that the others are there.
            for name in sorted(names, key=lambda each: each == PAGE):
                target = self.path / name
                target.parent.mkdir(parents=True, exist_ok=True)
                os.replace(made / name, target)
            kept = {*names, *record.get("files", ())}
            for name in set(old) - kept:
                (self.path / name).unlink(missing_ok=True)
            self._put_records_away(is_one=(made / POINTS).is_dir())
            self._remove_empty({Path(name).parent for name in old})
        self._write({**record, "is_finished": True, "files": sorted(kept)})

    def _put_records_away(self, is_one: bool) -> None:
        """Move the records of many files out of the points, and remove those of other files."""
        during, after = self._places_of_records
        shutil.rmtree(after, ignore_errors=True)
        if is_one:
            shutil.rmtree(during, ignore_errors=True)
        elif during.is_dir():
            (during / _LOCK).unlink(missing_ok=True)
            os.replace(during, after)

    @property
    def _files(self) -> list[str]:
        """The files of the delivery that the folder holds, if they are in it."""
        record, here = self.record or {"files": []}, self.path.resolve()
        named = (each for each in record["files"] if isinstance(each, str))
        return [each for each in named if here in (self.path / each).resolve().parents]

    def _remove_empty(self, folders: set[Path]) -> None:
        for each in folders - {Path(".")}:
            folder = self.path / each
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()

    def _write(self, record: dict[str, Any]) -> None:
        with replacing(self.path / RECORD) as temporary:
            temporary.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
