"""Packs the last commit as a zip to install in QGIS, with all that is made or got for it.

That is the Python packages that travel along, the help pages and the translations.

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

import qm
from help_pages import help_pages, packed_readme

ROOT = Path(__file__).parents[1]
README = "README.md"
BUNDLED = ROOT / "bundled.txt"
# safe.directory: a clone may belong to another user than the one who packs it.
GIT = ["git", "-c", f"safe.directory={ROOT}", "-C", str(ROOT)]
# The line of metadata.txt that names the addresses which are not ours yet.
UNSET = "# To be set before publishing:"


def main(folder: Path = ROOT / "dist") -> Path:
    """Pack, say what is to be done before the zip is published, and return the zip."""
    metadata = configparser.ConfigParser(interpolation=None)
    text = _git("show", "HEAD:metadata.txt").decode()
    metadata.read_string(text)
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / f"bare_earth-{metadata['general']['version']}.zip"
    if _git("status", "--porcelain"):
        print("Changes that are not committed are left out.")
    # README.md is packed with other links: most of what it leads to is elsewhere in the zip.
    _git(
        "archive", "--format=zip", "--prefix=bare_earth/", f"--output={target.resolve()}", "HEAD",
        ".", f":(exclude){README}",
    )  # fmt: skip
    with zipfile.ZipFile(target) as archive:
        packed = {name.partition("/")[2] for name in archive.namelist()}
    files = {**_packages(), **_help(metadata["general"]["repository"], packed), **_translations()}
    with zipfile.ZipFile(target, "a", zipfile.ZIP_DEFLATED) as archive:
        # With the date of the commit, so that the bytes stay the same.
        date = archive.infolist()[0].date_time
        for name, content in sorted(files.items()):
            entry = zipfile.ZipInfo(f"bare_earth/{name}", date)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    print(f"{target} ({target.stat().st_size / 1e6:.1f} MB)")
    for key in re.findall(r"\w+", "".join(re.findall(f"^{UNSET}(.*)$", text, re.M))):
        print(f"To be set in metadata.txt before publishing: {key}={metadata['general'][key]}")
    return target


def _git(*arguments: str) -> bytes:
    return subprocess.run([*GIT, *arguments], check=True, stdout=subprocess.PIPE).stdout


def _packages() -> dict[str, bytes]:
    """Get the wheels from the package index; pip refuses one with another hash."""
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--require-hashes",
             "--only-binary", ":all:", "--requirement", str(BUNDLED), "--dest", folder],
            check=True,
        )  # fmt: skip
        for wheel in Path(folder).iterdir():
            with zipfile.ZipFile(wheel) as packed:
                found.update((f"packages/{name}", packed.read(name)) for name in packed.namelist())
    return found


def _help(repository: str, packed: set[str]) -> dict[str, bytes]:
    """Make the pages that the Help button opens, and README.md with links to them."""
    docs = {name[len("docs/") :]: content for name, content in _committed("docs").items()}
    pages = {f"help/{name}": content for name, content in help_pages(docs, repository).items()}
    readme = _git("show", f"HEAD:{README}")
    return {**pages, **packed_readme(readme, docs, packed | set(pages), repository)}


def _translations() -> dict[str, bytes]:
    """Make what Qt reads of the translations."""
    files = {name: text for name, text in _committed("plugin/i18n").items() if name[-3:] == ".ts"}
    return {f"{name[:-3]}.qm": qm.compiled(qm.read_ts(content)) for name, content in files.items()}


def _committed(folder: str) -> dict[str, bytes]:
    """Return the files of a folder as they were committed."""
    names = _git("ls-tree", "-r", "--name-only", "HEAD", f"{folder}/").decode().splitlines()
    return {name: _git("show", f"HEAD:{name}") for name in names}


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
