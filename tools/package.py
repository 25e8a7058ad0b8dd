"""Packs the last commit, with the Python packages that travel along, as a zip to install in QGIS.

It is dist/bare_earth-X.Y.Z.zip, or in another folder that is named.
"""

from __future__ import annotations

import configparser
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
BUNDLED = ROOT / "bundled.txt"
# safe.directory: a clone may belong to another user than the one who packs it.
GIT = ["git", "-c", f"safe.directory={ROOT}", "-C", str(ROOT)]
# The line of metadata.txt that names the addresses which are not ours yet.
UNSET = "# To be set before publishing:"


def main(folder: Path = ROOT / "dist") -> None:
    """Pack, and say what is to be done before the zip is published."""
    metadata = configparser.ConfigParser(interpolation=None)
    text = _git("show", "HEAD:metadata.txt").decode()
    metadata.read_string(text)
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"bare_earth-{metadata['general']['version']}.zip"
    if _git("status", "--porcelain"):
        print("Changes that are not committed are left out.")
    _git("archive", "--format=zip", "--prefix=bare_earth/", f"--output={target.resolve()}", "HEAD")
    with tempfile.TemporaryDirectory() as name:
        _download(Path(name))
        with zipfile.ZipFile(target, "a", zipfile.ZIP_DEFLATED) as archive:
            for wheel in sorted(Path(name).iterdir()):
                _add(archive, wheel)
    print(f"{target} ({target.stat().st_size / 1e6:.1f} MB)")
    for key in re.findall(r"\w+", "".join(re.findall(f"^{UNSET}(.*)$", text, re.M))):
        print(f"To be set in metadata.txt before publishing: {key}={metadata['general'][key]}")


def _git(*arguments: str) -> bytes:
    return subprocess.run([*GIT, *arguments], check=True, stdout=subprocess.PIPE).stdout


def _download(folder: Path) -> None:
    """Get the wheels from the package index; pip refuses one with another hash."""
    subprocess.run(
        [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes",
         "--only-binary", ":all:", "--requirement", str(BUNDLED), "--dest", str(folder)],
        check=True,
    )  # fmt: skip


def _add(archive: zipfile.ZipFile, wheel: Path) -> None:
    """Add all that a wheel holds with the date of the commit, so that the bytes stay the same."""
    date = archive.infolist()[0].date_time
    with zipfile.ZipFile(wheel) as packed:
        for member in sorted(packed.namelist()):
            entry = zipfile.ZipInfo(f"bare_earth/packages/{member}", date)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, packed.read(member))


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
