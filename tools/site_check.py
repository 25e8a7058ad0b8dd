"""Checks a zip as plugins.qgis.org does when it is uploaded.

These are the rules of its validator and of its security scanner, except that no address is opened.

    tools/environment python tools/site_check.py dist/bare_earth-X.Y.Z.zip
"""

from __future__ import annotations

import configparser
import json
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Iterator
from urllib.parse import urlsplit

_MOST_BYTES = 25_000_000
_REQUIRED = (
    "name", "description", "version", "qgisMinimumVersion", "author", "email", "about", "tracker",
    "repository",
)  # fmt: skip
_ADDRESSES = "tracker", "repository", "homepage"
_FOLDERS = "__MACOSX", ".git", "__pycache__"
_BINARIES = ".exe", ".dll", ".so", ".dylib", ".bat", ".sh", ".ps1", ".cmd", ".pyc"
# The scanner reads its settings there.
_HIDDEN = ".bandit", ".gitignore", ".gitattributes"
_SETTINGS = Path(__file__).parents[1] / ".flake8"


def problems(path: Path) -> list[str]:
    """Return what the validator and the scanner find in a zip; nothing if they accept it."""
    size = path.stat().st_size
    found = [f"{size:,} bytes, {_MOST_BYTES:,} at most"] if size > _MOST_BYTES else []
    if not zipfile.is_zipfile(path):
        return [*found, "no zip"]
    with zipfile.ZipFile(path) as archive:
        damaged = archive.testzip()
        if damaged:
            return [*found, f"{damaged}: damaged"]
        found += [*_names(archive), *_metadata(archive)]
        with tempfile.TemporaryDirectory() as folder:
            # Nothing is unpacked whose name leads elsewhere.
            if not found:
                archive.extractall(folder)
                found += [*_bandit(folder), *_secrets(folder), *_style(folder)]
    return found


def _names(archive: zipfile.ZipFile) -> Iterator[str]:
    names = archive.namelist()
    tops = sorted({name.split("/")[0] for name in names})
    if len(tops) != 1 or not tops[0].isidentifier():
        yield f"{', '.join(tops)}: one folder is due, with the name of a Python package"
    for name in ("__init__.py", "metadata.txt", "LICENSE"):
        if f"{tops[0]}/{name}" not in names:
            yield f"{name}: missing"
    for entry in archive.infolist():
        name = entry.filename
        parts = name.rstrip("/").split("/")
        if ".." in name or name.startswith("/"):
            yield f"{name}: leads elsewhere"
        if set(parts) & set(_FOLDERS):
            yield f"{name}: a folder that is refused"
        if parts[-1].startswith(".") and parts[-1] not in _HIDDEN:
            yield f"{name}: hidden"
        if name.lower().endswith(_BINARIES):
            yield f"{name}: a program"
        if name.endswith(".py") and entry.external_attr >> 16 & 0o111:
            yield f"{name}: executable"


def _metadata(archive: zipfile.ZipFile) -> Iterator[str]:
    names = archive.namelist()
    top = names[0].split("/")[0]
    if f"{top}/metadata.txt" not in names:
        return
    # With the interpolation of configparser, as the site: a single per cent sign is an error there.
    parser = configparser.ConfigParser()
    parser.optionxform = str
    try:
        parser.read_string(archive.read(f"{top}/metadata.txt").decode("utf-8"))
        general = dict(parser["general"])
    except (configparser.Error, UnicodeDecodeError, KeyError) as error:
        yield f"metadata.txt: {error}"
        return
    for key in _REQUIRED:
        if not general.get(key, "").strip():
            yield f"metadata.txt: {key} is missing"
    for key in _ADDRESSES:
        address = urlsplit(general.get(key, ""))
        if not (address.scheme in ("http", "https") and address.netloc):
            yield f"metadata.txt: {key} is no address"
    if not re.fullmatch(r"\d+\.\d+\.\d+", general.get("version", "")):
        yield "metadata.txt: version is not MAJOR.MINOR.PATCH"
    if "/" in general.get("author", ""):
        yield "metadata.txt: author has a slash"
    if "plugin" in general.get("name", "").lower():
        yield "metadata.txt: the name has the word plugin"
    if "supportsQt6" in general:
        yield "metadata.txt: supportsQt6 is deprecated; qgisMaximumVersion says it"
    if f"{top}/{general.get('icon', '')}" not in names:
        yield "metadata.txt: icon is not in the zip"


def _run(*arguments: str | Path, folder: str) -> str:
    done = subprocess.run(
        [sys.executable, "-m", *map(str, arguments)], cwd=folder, capture_output=True, text=True
    )
    # Each of these says by 0 or 1 whether it found something; by more, that it did not run.
    if done.returncode > 1:
        raise SystemExit(f"{arguments[0]} did not run: {done.stderr}")
    return done.stdout


def _bandit(folder: str) -> Iterator[str]:
    report = json.loads(_run("bandit", "--quiet", "-r", ".", "-f", "json", folder=folder))
    for one in report["results"]:
        yield f"{one['filename']}:{one['line_number']}: {one['test_id']} {one['issue_text']}"
    for one in report["errors"]:
        yield f"{one['filename']}: {one['reason']}"


def _secrets(folder: str) -> Iterator[str]:
    said = _run(
        "detect_secrets", "scan", "--all-files", "--exclude-files", r"metadata\.txt", ".",
        folder=folder,
    )  # fmt: skip
    for name, secrets in json.loads(said)["results"].items():
        for one in secrets:
            yield f"{name}:{one['line_number']}: {one['type']}"


def _style(folder: str) -> Iterator[str]:
    """What flake8 finds in what is ours."""
    said = _run("flake8", "--config", _SETTINGS, "--exclude", "packages", ".", folder=folder)
    yield from said.splitlines()


def main(*paths: str) -> int:
    """Print what is wrong with zips; return 1 if anything is."""
    found = [f"{path}: {problem}" for path in paths for problem in problems(Path(path))]
    print(*(found or ["nothing that plugins.qgis.org refuses"]), sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
