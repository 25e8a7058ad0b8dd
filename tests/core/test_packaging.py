"""What QGIS, plugins.qgis.org and pip read of the package."""

import configparser
import io
import re
import subprocess
import zipfile
from pathlib import Path

import pytest

import bare_earth

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def metadata():
    parser = configparser.ConfigParser(interpolation=None)
    parser.optionxform = str
    parser.read(ROOT / "metadata.txt", encoding="utf-8")
    return parser["general"]


@pytest.fixture(scope="module")
def names():
    """Return the names in the zip that `make zip` makes of the last commit."""
    # safe.directory: a clone may belong to another user than the one who runs the tests.
    command = ["git", "-c", f"safe.directory={ROOT}", "-C", str(ROOT), "archive"]
    try:
        done = subprocess.run(
            [*command, "--format=zip", "--prefix=bare_earth/", "HEAD"],
            capture_output=True,
            check=False,
        )
    except FileNotFoundError:
        pytest.skip("there is no git")
    if not (ROOT / ".git").exists():
        pytest.skip("this is no git checkout")
    assert done.returncode == 0, done.stderr.decode()
    return zipfile.ZipFile(io.BytesIO(done.stdout)).namelist()


def test_metadata_has_what_qgis_and_its_plugin_site_require(metadata):
    required = (
        "name qgisMinimumVersion description about version author email repository homepage"
        " tracker license hasProcessingProvider icon tags external_deps"
    )
    for key in required.split():
        assert metadata.get(key, "").strip(), key
    assert metadata["hasProcessingProvider"] == "yes"
    assert metadata["qgisMinimumVersion"] == "3.22"
    assert metadata["qgisMaximumVersion"] == "4.99"
    assert metadata["license"] == "GPL-2.0-or-later"
    assert (ROOT / metadata["icon"]).is_file()
    # The site refuses these.
    assert "plugin" not in metadata["name"].lower()
    assert "supportsQt6" not in metadata
    assert re.fullmatch(r"\d+\.\d+\.\d+", metadata["version"])


def test_the_versions_agree(metadata):
    assert metadata["version"] == bare_earth.__version__
    assert f"## {bare_earth.__version__}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert metadata["changelog"].startswith(bare_earth.__version__)


def test_the_packages_that_qgis_lacks_agree(metadata):
    lines = (ROOT / "requirements.txt").read_text(encoding="utf-8").splitlines()
    asked = {re.match(r"\w+", line).group() for line in lines if line and line[0] != "#"}
    assert asked == set(metadata["external_deps"].split(","))
    # Pip would replace those of QGIS, and break it.
    assert not asked & {"numpy", "scipy", "gdal", "GDAL"}


def test_pip_gets_every_package_of_the_classifier():
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    listed = set(re.findall(r'"([\w.]+)"', re.search(r"packages = \[(.*?)\]", text, re.S).group(1)))
    there = {
        ".".join(("bare_earth", *path.parent.relative_to(ROOT).parts))
        for path in (ROOT / "algorithms").rglob("__init__.py")
    }
    assert listed == there | {"bare_earth"}


def test_the_zip_holds_one_folder_with_what_qgis_needs(names):
    assert {name.split("/")[0] for name in names} == {"bare_earth"}
    needed = "__init__.py metadata.txt LICENSE README.md requirements.txt plugin/plugin.py"
    for name in needed.split():
        assert f"bare_earth/{name}" in names, name
    assert "bare_earth/algorithms/engine/runs.py" in names


def test_the_zip_holds_nothing_else(names):
    top = {name.split("/")[1] for name in names if name.count("/") > 1}
    assert top <= {"algorithms", "plugin", "docs"}
    for name in names:
        # The site refuses hidden files, caches and compiled code.
        assert not re.search(r"(^|/)(\.|__MACOSX|__pycache__)|\.(pyc|so|dll|exe|ui~)$", name), name
