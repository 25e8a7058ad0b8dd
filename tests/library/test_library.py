"""The library as users see it: its names, signatures and documentation, and what it refuses."""

import inspect
import pydoc
import re
import subprocess
import sys
from pathlib import Path

import pytest
import stub

import bare_earth
from bare_earth.algorithms.library import names

ROOT = Path(__file__).parents[2]


def test_there_are_few_names_and_all_are_listed():
    public = [name for name in dir(bare_earth) if not name.startswith("_")]
    assert set(bare_earth.__all__) - {"__version__"} <= set(public)
    assert len(public) <= 30
    assert set(names()) <= set(bare_earth.__all__)


def test_the_package_is_imported_fast_and_alone():
    code = (
        "import time; start = time.perf_counter(); import bare_earth, sys;"
        "print(time.perf_counter() - start);"
        "print(*{'numpy', 'scipy', 'laspy', 'qgis'} & {*sys.modules})"
    )
    runs = [
        subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        for _ in range(3)
    ]
    seconds, *others = zip(*(run.stdout.split() for run in runs))
    assert not others and min(map(float, seconds)) < 0.15


@pytest.mark.parametrize("name", names())
def test_a_function_documents_its_parameters_in_order(name):
    function = getattr(bare_earth, name)
    assert function.__module__ == "bare_earth" and function.__name__ == name
    lines = inspect.getdoc(function).split("Parameters\n----------\n")[1].split("\n\nR")[0]
    documented = re.findall(r"^(\w+) : \S", lines, re.M)
    assert documented == list(inspect.signature(function).parameters)
    assert f"{name}(" in pydoc.plain(pydoc.render_doc(function))


def test_a_wrong_name_is_refused_with_the_nearest_ones():
    with pytest.raises(TypeError, match=r"heights\(\) .* outputas\b.* output_as"):
        bare_earth.heights("a.laz", "b.laz", outputas="z")
    with pytest.raises(TypeError, match=r"classify\(\): .*'output'"):
        bare_earth.classify("a.laz")
    words = "min_neighbours .* method='grid-minimum'"
    with pytest.raises(TypeError, match=words):
        bare_earth.classify("a.laz", "b.laz", method="grid-minimum", min_neighbours=3)


def test_a_wrong_value_is_refused_as_by_the_command():
    with pytest.raises(bare_earth.BareEarthError, match="one of tin-densification"):
        bare_earth.classify("a.laz", "b.laz", method="magic")
    with pytest.raises(bare_earth.BareEarthError, match="at least 0 m, not -1"):
        bare_earth.water_classes("a.laz", "b.laz", water="automatic", shore_distance=-1)
    with pytest.raises(bare_earth.BareEarthError, match="classified points"):
        bare_earth.classify("a.laz", "b.laz", dtm="dtm.tif", water="automatic")


@pytest.mark.rest
def test_mypy_reads_the_stubs(tmp_path):
    right, wrong = tmp_path / "right.py", tmp_path / "wrong.py"
    right.write_text(
        "import bare_earth\n"
        "done = bare_earth.classify('a.laz', 'b.laz', method='slope', dtm='dtm.tif')\n"
        "print(done.ground_count, bare_earth.__version__)\n"
        "bare_earth.heights(['a.laz'], 'b.laz', output_as='z', progress=print)\n"
        "bare_earth.relief('dtm.tif', 'relief.tif', kind='vat')\n"
    )
    wrong.write_text("import bare_earth\nbare_earth.heights('a.laz', 'b.laz', outputas='z')\n")
    package = tmp_path / "bare_earth"
    package.mkdir()
    (package / "algorithms").symlink_to(ROOT / "algorithms", target_is_directory=True)
    stub.write(package)
    (tmp_path / "mypy.ini").write_text(
        f"[mypy]\nstrict = True\nfollow_imports = silent\nignore_missing_imports = True\n"
        f"mypy_path = {tmp_path}\ncache_dir = {ROOT / 'build' / 'mypy-user'}\n"
    )
    command = [sys.executable, "-m", "mypy", "--config-file", tmp_path / "mypy.ini"]
    done = subprocess.run([*command, right, wrong], capture_output=True, text=True, cwd=tmp_path)
    (line,) = (line for line in done.stdout.splitlines() if ": error: " in line)
    assert line.startswith("wrong.py:2") and 'Unexpected keyword argument "outputas"' in line


def test_the_page_of_the_library_has_all_names():
    page = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    shown = re.findall(r"^::: bare_earth\.(\w+)$", page, re.MULTILINE)
    assert sorted(shown) == sorted({*bare_earth.__all__} - {"__version__"})
