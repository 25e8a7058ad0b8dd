"""A zip that plugins.qgis.org would refuse is refused before."""

import zipfile

import pytest
import site_check

METADATA = """[general]
name=Hills
description=Finds hills
version=1.2.3
qgisMinimumVersion=3.22
author=A. Surveyor
email=a@example.org
about=Finds hills in rasters
tracker=https://example.org/issues
repository=https://example.org/hills
homepage=https://example.org
icon=icon.svg
"""
FILES = {"__init__.py": "", "metadata.txt": METADATA, "LICENSE": "GPL", "icon.svg": "<svg/>"}


def written(path, files, top="hills"):
    """Write a zip with files in a folder; None leaves one out."""
    with zipfile.ZipFile(path, "w") as archive:
        archive.mkdir(top) if hasattr(archive, "mkdir") else archive.writestr(f"{top}/", "")
        for name, content in {**FILES, **files}.items():
            if content is not None:
                archive.writestr(f"{top}/{name}", content)
    return path


def changed(old, new):
    assert METADATA.count(old) == 1
    return {"metadata.txt": METADATA.replace(old, new)}


@pytest.mark.parametrize(
    "files, problem",
    [
        ({"LICENSE": None}, "LICENSE: missing"),
        ({"__init__.py": None}, "__init__.py: missing"),
        ({"lib/fast.DLL": ""}, "hills/lib/fast.DLL: a program"),
        ({"a.pyc": ""}, "hills/a.pyc: a program"),
        ({".env": ""}, "hills/.env: hidden"),
        ({"__pycache__/a.txt": ""}, "hills/__pycache__/a.txt: a folder that is refused"),
        ({"../a.py": ""}, "hills/../a.py: leads elsewhere"),
        (changed("email=a@example.org\n", ""), "metadata.txt: email is missing"),
        (changed("=https://example.org/issues", "=issues"), "metadata.txt: tracker is no address"),
        (changed("1.2.3", "1.2"), "metadata.txt: version is not MAJOR.MINOR.PATCH"),
        (changed("A. Surveyor", "A/B"), "metadata.txt: author has a slash"),
        (changed("=Hills", "=Hills plugin"), "metadata.txt: the name has the word plugin"),
        (changed("icon.svg", "hill.svg"), "metadata.txt: icon is not in the zip"),
        (changed("in rasters", "in 98 % of rasters"), "metadata.txt: '%' must be followed by"),
        (changed("[general]", "[all]"), "metadata.txt: 'general'"),
    ],
)
def test_what_the_validator_refuses_is_named(files, problem, tmp_path):
    (found,) = site_check.problems(written(tmp_path / "hills.zip", files))
    assert found.startswith(problem)


def test_a_folder_that_is_no_package_and_a_file_that_is_no_zip(tmp_path):
    (found,) = site_check.problems(written(tmp_path / "hills.zip", {}, top="my-hills"))
    assert found.startswith("my-hills: one folder is due")
    (tmp_path / "text.zip").write_text("text")
    assert site_check.problems(tmp_path / "text.zip") == ["no zip"]


@pytest.mark.rest
def test_what_the_scanner_finds_is_named(tmp_path, capsys):
    files = {"run.py": "import os\n\nassert os.name\nkey = 'AKIAIOSFODNN7EXAMPLX'  # pragma\n"}
    path = written(tmp_path / "hills.zip", files)
    assert site_check.main(str(path)) == 1
    said = capsys.readouterr().out
    assert "run.py:3: B101" in said and "run.py:4: AWS Access Key" in said
    assert site_check.main(str(written(tmp_path / "good.zip", {}))) == 0
