"""Builds what is published of the last commit, and checks it as the places where it goes do.

It goes into dist/, or into another folder that is named: the zip for plugins.qgis.org, sdist and
wheel for PyPI, and the recipe for conda-forge.
"""

from __future__ import annotations

import configparser
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
_TILE = ROOT / "tests" / "data" / "real" / "rock_mountain.laz"
_ADDRESSES = "homepage", "repository"
# Run by an environment that has py-rattler-build: its parser refuses what no recipe may have.
_READ_RECIPE = (
    "import sys; from pathlib import Path; from rattler_build import Stage0Recipe;"
    "(variant,) = Stage0Recipe.from_file(Path(sys.argv[1])).render();"
    "print(variant.recipe.package.name, variant.recipe.package.version)"
)


class Distributions(NamedTuple):
    """What PyPI gets."""

    sdist: Path
    wheel: Path  # made from the sdist
    said: str  # by what built them


def main(folder: Path = ROOT / "dist") -> None:
    """Build and check all, and say what was checked."""
    # What these need is installed for a release only.
    import package
    import site_check

    folder = folder.resolve()
    version = check_version()
    zipped = package.main(folder)
    found = site_check.problems(zipped)
    if found:
        raise SystemExit("\n".join(["plugins.qgis.org would refuse the zip:", *found]))
    print("  plugins.qgis.org: metadata, files, bandit, detect-secrets and flake8 find nothing")
    made = distributions(folder)
    check_distributions(made)
    print(f"{made.sdist}\n{made.wheel}\n  PyPI: twine finds nothing")
    print(f"  installed in an environment of its own: {check_installed(made.wheel)}")
    recipe = write_recipe(made.sdist, version)
    print(f"{recipe}\n  conda: rattler-build reads it: {check_recipe(recipe)}")


def check_version() -> str:
    """Return the version, if changelog and tag of the last commit have it, too."""
    metadata = _metadata()
    version = metadata["version"]
    changelog = _git("show", "HEAD:CHANGELOG.md")
    if not re.search(rf"^## {re.escape(version)} - \d{{4}}-\d\d-\d\d$", changelog, re.M):
        raise SystemExit(f"CHANGELOG.md has no heading '## {version} - YYYY-MM-DD': write one.")
    tags = [tag for tag in _git("tag", "--points-at", "HEAD").split() if tag.startswith("v")]
    if tags and f"v{version}" not in tags:
        raise SystemExit(f"metadata.txt has version {version}, the tag is {tags[0]}: change one.")
    return version


def distributions(folder: Path, python: str | Path = sys.executable) -> Distributions:
    """Build the sdist from a fresh clone, and the wheel from it, by a Python that has `build`."""
    with tempfile.TemporaryDirectory() as name:
        source, made = Path(name, "source"), Path(name, "made")
        _git("clone", "--quiet", str(ROOT), str(source))
        said = _run(python, "-m", "build", "--outdir", made, source)
        folder.mkdir(parents=True, exist_ok=True)
        sdist, wheel = (
            Path(shutil.copy(file, folder))
            for end in ("gz", "whl")
            for file in made.glob(f"*.{end}")
        )
    return Distributions(sdist, wheel, said)


def check_distributions(made: Distributions, python: str | Path = sys.executable) -> None:
    """Refuse what PyPI refuses, and a wheel with files that are not of the library."""
    _run(python, "-m", "twine", "check", "--strict", made.sdist, made.wheel)
    names = zipfile.ZipFile(made.wheel).namelist()
    strange = [
        name for name in names
        if not re.match(r"bare_earth(-[\d.]+\.dist-info)?/", name) or "/tests/" in name
        or name.startswith("bare_earth/plugin/")
    ]  # fmt: skip
    if strange:
        raise SystemExit(f"The wheel has files that are not of the library: {', '.join(strange)}")


def check_installed(wheel: Path) -> str:
    """Install the wheel into a new environment, and return what it makes of a tile."""
    with tempfile.TemporaryDirectory() as name:
        _run(sys.executable, "-m", "venv", name)
        programs = Path(name, "Scripts" if os.name == "nt" else "bin")
        _run(programs / "python", "-m", "pip", "install", "--quiet", wheel)
        _run(programs / "python", "-m", "pip", "check")
        command, output = programs / "bare-earth", Path(name, "ground.laz")
        said = _run(command, "--version").strip()
        _run(command, "classify", _TILE, output)
        counts = re.search(r"^classes .*$", _run(command, "info", output), re.M)
    return f"{said}; {_TILE.name}: {counts.group()}" if counts else said


def write_recipe(sdist: Path, version: str) -> Path:
    """Write the recipe beside an sdist, and with it."""
    metadata, sha256 = _metadata(), hashlib.sha256(sdist.read_bytes()).hexdigest()
    text = _git("show", "HEAD:conda/recipe.yaml").partition("schema_version")
    filled = {
        'version: "0"': f'version: "{version}"',
        "path: ..": f"path: {sdist.name}  # where it is published\n  sha256: {sha256}",
        "about:": "\n  ".join(["about:", *(f"{key}: {metadata[key]}" for key in _ADDRESSES)]),
    }
    content = text[1] + text[2]
    for before, after in filled.items():
        if content.count(before) != 1:
            raise SystemExit(f"conda/recipe.yaml must have '{before}' once.")
        content = content.replace(before, after)
    recipe = sdist.with_name("recipe.yaml")
    recipe.write_text(content, encoding="utf-8")
    return recipe


def check_recipe(recipe: Path, python: str | Path = sys.executable) -> str:
    """Return name and version that rattler-build reads in a recipe, or that it is not there."""
    if "rattler" not in _run(python, "-m", "pip", "list"):
        return "NOT CHECKED, py-rattler-build needs Python 3.10"
    return _run(python, "-c", _READ_RECIPE, recipe).strip()


def _metadata() -> configparser.SectionProxy:
    parser = configparser.ConfigParser()
    parser.optionxform = str
    parser.read_string(_git("show", "HEAD:metadata.txt"))
    return parser["general"]


def _git(*words: str) -> str:
    # safe.directory: a clone may belong to another user than the one who releases it.
    return _run("git", "-c", "safe.directory=*", "-C", ROOT, *words)


def _run(*words: str | Path) -> str:
    # The package is that of an environment, never this folder.
    named = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [*map(str, words)], env=named, capture_output=True, text=True, errors="replace"
    )
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, words))}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout + done.stderr


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:]))
