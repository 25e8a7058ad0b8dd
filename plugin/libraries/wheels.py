"""Checks and unpacks wheels that the user chooses, without pip."""

from __future__ import annotations

import base64
import csv
import hashlib
import stat
import zipfile
import zlib
from pathlib import Path, PurePosixPath

from ...algorithms.core.errors import BareEarthError
from ..i18n import tr
from .build import Build

_MOST_BYTES = 1 << 26  # unzipped; lazrs has 2 MB
# Errors of zipfile for files that are not zip files, damaged or encrypted.
_UNREADABLE = (
    zipfile.BadZipFile, zlib.error, EOFError, KeyError, RuntimeError, UnicodeDecodeError
)  # fmt: skip


def unpack(wheel: Path, folder: Path, package: str, build: Build) -> None:
    """Unpack a wheel into a folder, whose files stay, if it contains the package, fits the build,
    and would not write outside of the folder.
    """
    # Only the contents are trusted, not the name of the file, since browsers can change it.
    try:
        with zipfile.ZipFile(wheel) as archive:
            info = _info_folder(archive, wheel, package)
            members = [member for member in archive.infolist() if not member.is_dir()]
            _check_places(members, wheel, (package, f"{package}.libs", info))
            _check_tags(archive.read(f"{info}/WHEEL").decode(), wheel, build)
            hashes = _hashes(archive.read(f"{info}/RECORD").decode())
            for member in members:
                content = archive.read(member)
                if member.filename != f"{info}/RECORD":
                    _check_content(content, hashes.get(member.filename), wheel)
                target = folder / member.filename
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
    except _UNREADABLE as error:
        raise BareEarthError(
            tr("{} is not a wheel, or is damaged. Download it again.").format(wheel.name)
        ) from error
    except OSError as error:
        raise BareEarthError(
            tr("{file} could not be unzipped: {error}.").format(file=wheel.name, error=error)
        ) from error


def _info_folder(archive: zipfile.ZipFile, wheel: Path, package: str) -> str:
    """Return the folder that describes the wheel."""
    found = {
        name.partition("/")[0]
        for name in archive.namelist()
        if name.partition("/")[0].endswith(".dist-info")
    }
    if len(found) != 1:
        raise BareEarthError(
            tr("{} is not a wheel: choose a file with the ending .whl.").format(wheel.name)
        )
    info = found.pop()
    held = info.partition("-")[0]
    if held != package:
        raise BareEarthError(
            tr("{file} holds {held}; a wheel of {package} is needed.").format(
                file=wheel.name, held=held, package=package
            )
        )
    return info


def _check_tags(text: str, wheel: Path, build: Build) -> None:
    tags = [line.partition(":")[2].strip() for line in text.splitlines() if line[:4] == "Tag:"]
    if not any(build.takes(tag) for tag in tags):
        raise BareEarthError(
            tr(
                "{file} is for another Python or system ({tag}); this QGIS needs one for {needed}."
            ).format(file=wheel.name, tag=", ".join(tags[:1]), needed=build.wheels)
        )


def _check_places(
    members: list[zipfile.ZipInfo], wheel: Path, folders: tuple[str, str, str]
) -> None:
    """Refuse names that lead out of the folder, links, and too large contents."""
    for member in members:
        parts = PurePosixPath(member.filename).parts
        odd = "\\" in member.filename or ":" in member.filename or ".." in parts
        if odd or parts[0] not in folders or stat.S_ISLNK(member.external_attr >> 16):
            raise BareEarthError(
                tr(
                    "{file} holds {member}, which does not belong in a wheel of {package}."
                    " Download it again."
                ).format(file=wheel.name, member=member.filename, package=folders[0])
            )
    if sum(member.file_size for member in members) > _MOST_BYTES:
        raise BareEarthError(
            tr("{file} is larger than any wheel of {package}.").format(
                file=wheel.name, package=folders[0]
            )
        )


def _hashes(record: str) -> dict[str, str]:
    """Return the hashes ("kind=value") of files, by name, from a file RECORD."""
    return {row[0]: row[1] for row in csv.reader(record.splitlines()) if len(row) > 1}


def _check_content(content: bytes, expected: str | None, wheel: Path) -> None:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    if expected != f"sha256={digest}":
        raise BareEarthError(
            tr("{} is damaged: a file differs from its list. Download it again.").format(wheel.name)
        )
