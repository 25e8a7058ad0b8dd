"""What QGIS, plugins.qgis.org and pip read of the package."""

import configparser
import posixpath
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import site_check

import bare_earth

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def metadata():
    parser = configparser.ConfigParser(interpolation=None)
    parser.optionxform = str
    parser.read(ROOT / "metadata.txt", encoding="utf-8")
    return parser["general"]


def leads_somewhere(link):
    """Return whether a file of the repository is there, and has the heading that a link names."""
    address, _, anchor = link.partition("#")
    file = ROOT / address.partition("/blob/main/")[2]
    if not anchor:
        return file.is_file()
    headings = re.findall(r"(?m)^#+ (.*)$", file.read_text(encoding="utf-8"))
    return anchor in {re.sub(r"[^\w -]", "", text.lower()).replace(" ", "-") for text in headings}


def make_package(folder):
    """Run what `make package` runs; return the zip, and what was said."""
    done = subprocess.run(
        [sys.executable, ROOT / "tools" / "package.py", folder], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    (file,) = folder.iterdir()
    return file, done.stdout


@pytest.fixture(scope="module")
def package(tmp_path_factory):
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("this is no git checkout, or there is no git")
    return make_package(tmp_path_factory.mktemp("package"))


@pytest.fixture(scope="module")
def names(package):
    return zipfile.ZipFile(package[0]).namelist()


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


def test_the_versions_agree(metadata):
    assert metadata["version"] == bare_earth.__version__
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.search(r"(?m)^## ([\d.]+) - \d{4}-\d\d-\d\d$", changelog)[1] == metadata["version"]
    assert metadata["changelog"].startswith(bare_earth.__version__)


def test_the_packages_that_qgis_lacks_agree(metadata):
    lines = (ROOT / "requirements.txt").read_text(encoding="utf-8").splitlines()
    asked = {re.match(r"\w+", line).group() for line in lines if line and line[0] != "#"}
    assert asked == set(metadata["external_deps"].split(","))
    # Pip would replace those of QGIS, and break it.
    assert not asked & {"numpy", "scipy", "gdal", "GDAL"}


def test_the_recipe_for_conda_asks_for_what_pip_asks_for(metadata):
    recipe = (ROOT / "conda" / "recipe.yaml").read_text(encoding="utf-8")
    asked = set(re.findall(r"^    - ([a-z-]+ >=[\d.]+)$", recipe.split("  run:")[1], re.M))
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    listed = re.search(r"^dependencies = \[(.*?)\]", text, re.S | re.M).group(1)
    of_pip = {f"{name} {least}" for name, least in re.findall(r'"(\w+)(>=[\d.]+)"', listed)}
    assert {one.replace("lazrs-python", "lazrs") for one in asked} == of_pip
    assert f'python_min: "{re.search(r"requires-python = .>=([0-9.]+)", text).group(1)}"' in recipe
    assert re.search(r"setuptools ?>=(\d+)", recipe).group(1) == re.search(
        r"setuptools>=(\d+)", text
    ).group(1)


@pytest.mark.rest
def test_the_zip_holds_one_folder_with_what_qgis_needs(names, package):
    needed = (
        "__init__.py metadata.txt LICENSE README.md requirements.txt plugin/plugin.py"
        " algorithms/engine/run.py packages/laspy/__init__.py help/index.html"
        " algorithms/tools/check/words.ini"
        " plugin/i18n/bare_earth_de.qm plugin/i18n/bare_earth_fr.qm"
        " plugin/models/terrain_contours.model3 plugin/models/cloud_heights.model3"
        " plugin/models/two_methods.model3"
    )
    for name in needed.split():
        assert f"bare_earth/{name}" in names, name
    # The installer of QGIS takes the name of the plugin from the first.
    assert names[0] == "bare_earth/"


@pytest.mark.rest
def test_the_zip_holds_nothing_else_and_the_site_takes_it(names, package):
    top = {name.split("/")[1] for name in names if name.count("/") > 1}
    assert top <= {"algorithms", "plugin", "help", "packages"}
    assert site_check.problems(package[0]) == []


@pytest.mark.rest
def test_laspy_travels_in_the_version_that_is_pinned_with_its_licence(names, package):
    pinned = re.search(r"laspy==([\d.]+)", (ROOT / "bundled.txt").read_text()).group(1)
    folder = f"bare_earth/packages/laspy-{pinned}.dist-info"
    archive = zipfile.ZipFile(package[0])
    assert b"Redistribution and use" in archive.read(f"{folder}/licenses/LICENSE.txt")
    metadata = archive.read(f"{folder}/METADATA").decode()
    # It runs in all that the plugin promises, and needs nothing that QGIS lacks.
    assert "Requires-Python: >=3.9\n" in metadata
    needs = [line for line in metadata.splitlines() if line.startswith("Requires-Dist")]
    assert [line for line in needs if "extra ==" not in line] == ["Requires-Dist: numpy"]


@pytest.mark.rest
def test_the_help_is_whole_and_needs_nothing_else(names, package, metadata):
    archive, pages = zipfile.ZipFile(package[0]), {}
    for name in names:
        if name.startswith("bare_earth/help/") and name.endswith(".html"):
            pages[name[len("bare_earth/help/") :]] = archive.read(name).decode()
    assert {"index.html", "tin-densification.html", "terrain-model.html"} <= set(pages)
    for page, text in pages.items():
        assert "<h1" in text, page
        for link in re.findall(r'(?:href|src)="([^"]*)"', text):
            file, _, anchor = link.partition("#")
            if not link.startswith("https://"):
                to = posixpath.normpath(posixpath.join(posixpath.dirname(page), file))
                to = to if file else page
                assert f"bare_earth/help/{to}" in names, (page, link)
                assert not anchor or f'id="{anchor}"' in pages[to], (page, link)
            elif link.startswith(metadata["repository"]):
                assert leads_somewhere(link), (page, link)
        # Nothing is left as it is written.
        prose = re.sub("(?s)<pre>.*?</pre>", "", text)
        assert not re.search(r"\]\(|^\| |^#+ |```", prose, re.M), page
    assert pages["terrain-model.html"].count("<table>") >= 3


@pytest.mark.rest
def test_the_links_of_the_readme_in_the_zip_lead_somewhere(names, package, metadata):
    archive = zipfile.ZipFile(package[0])
    text = archive.read("bare_earth/README.md").decode()
    links = re.findall(r"\]\(([^)]*)\)", text)
    there = re.findall(r"\]\(([^)]*)\)", (ROOT / "README.md").read_text(encoding="utf-8"))
    assert len(links) == len(there) > 20
    elsewhere = {link for link in links if link.startswith(metadata["repository"])}
    for link in set(links) - elsewhere:
        file, _, anchor = link.partition("#")
        assert f"bare_earth/{file}" in names, link
        if anchor:
            assert f'id="{anchor}"' in archive.read(f"bare_earth/{file}").decode(), link
    for link in elsewhere:
        assert leads_somewhere(link), link
    # What is for users is in the zip.
    assert {"help/tutorial.html", "help/images/before-after.png", "LICENSE"} <= set(links)
    assert len(elsewhere) < 5


def test_addresses_that_are_to_be_set_stand_in_one_place(metadata):
    known = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
    for name in known.stdout.splitlines():
        if name != "metadata.txt" and not name.endswith((".png", ".laz")):
            text = (ROOT / name).read_text(encoding="utf-8")
            for key in ("email", "homepage", "repository", "tracker"):
                assert metadata[key] not in text, (name, key)


@pytest.mark.rest
@pytest.mark.long
def test_the_zip_has_the_same_bytes_each_time(package, tmp_path):
    assert make_package(tmp_path)[0].read_bytes() == package[0].read_bytes()


@pytest.mark.rest
def test_what_is_to_be_set_before_publishing_is_told(package, metadata):
    file, said = package
    assert file.name == f"bare_earth-{metadata['version']}.zip"
    assert str(file) in said
    for key in ("email", "homepage", "repository", "tracker"):
        assert f"{key}={metadata[key]}" in said
