"""What pip and conda get: built, checked, and installed with one extra at a time."""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import laspy
import pytest
import release
from surveys import strip, write

import bare_earth

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
LISTED = TEXT.partition("[project.optional-dependencies]")[2].partition("\n[")[0]
EXTRAS = re.findall(r"^(\w+) = \[", LISTED, re.M)
# Those that are for the development of the package.
OURS = {"docs", "test"}
BEGIN = "import bare_earth; from bare_earth import arrays; import numpy as np, laspy\n"
CHECKPOINTS = "laspy.read('ground.laz').xyz[::100]"
# What each extra makes possible, in the folder of the files.
USES = {
    "": "done = bare_earth.classify('tile.laz', 'out.laz'); assert done.ground_count\n"
    "assert arrays.ground(laspy.read('tile.laz')).sum() == done.ground_count\n"
    "assert arrays.terrain(laspy.read('ground.laz'))['dtm'].values.any()",
    "raster": "assert bare_earth.terrain('ground.laz', dtm='dtm.tif', crs='EPSG:25832').rows\n"
    "assert arrays.terrain(laspy.read('ground.laz'), crs=25832)['dtm'].crs",
    "vector": f"bare_earth.check('ground.laz', checkpoints={CHECKPOINTS}, residuals='errors.gpkg')",
    "progress": "from tqdm import tqdm\n"
    "with tqdm() as bar: arrays.ground(laspy.read('tile.laz'), progress=bar); assert bar.n == 1",
    "cluster": "from distributed import LocalCluster\n"
    "if __name__ == '__main__':\n"
    "    with LocalCluster(n_workers=1, dashboard_address=None) as cluster:\n"
    "        bare_earth.classify('tile.laz', 'done', scheduler=cluster.scheduler_address)",
    "xarray": "dtm = arrays.terrain(laspy.read('ground.laz'))['dtm'].to_xarray()\n"
    "assert dtm.dims == ('y', 'x')",
    "remote": "import s3fs, fsspec\n"
    "from fsspec.implementations.memory import MemoryFileSystem\n"
    "fsspec.register_implementation('s3', MemoryFileSystem, clobber=True)\n"
    "fsspec.filesystem('s3').pipe('s3://a/tile.copc.laz', open('tile.copc.laz', 'rb').read())\n"
    "assert bare_earth.fetch('s3://a/tile.copc.laz', 'part.laz').point_count",
    "geopandas": "dtm = arrays.terrain(laspy.read('ground.laz'))['dtm']\n"
    "assert arrays.contours(dtm).to_geopandas().ELEV.min() > 0",
    "all": "bare_earth.terrain('ground.laz', contours='lines.gpkg', crs='EPSG:25832')",
}
pytestmark = pytest.mark.long


def run(*words, cwd=None):
    """Run a command; return what it says."""
    # The package is that of the environment, not this folder.
    named = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run(
        [*map(str, words)], cwd=cwd, env=named, capture_output=True, text=True, errors="replace"
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return done.stdout + done.stderr


def environment(folder, *packages):
    """Make an environment with some packages; return its Python."""
    run(sys.executable, "-m", "venv", folder)
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    if packages:
        run(python, "-m", "pip", "install", "--quiet", *packages)
    return python


@pytest.fixture(scope="module")
def tools(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tools")
    return environment(folder, "build", "twine", "py-rattler-build>=0.70; python_version >= '3.10'")


@pytest.fixture(scope="module")
def built(tools, tmp_path_factory):
    return release.distributions(tmp_path_factory.mktemp("built"), tools)


@pytest.fixture(scope="module")
def work(tmp_path_factory):
    folder = tmp_path_factory.mktemp("work")
    las = laspy.read(str(write(folder / "tile.laz", strip(count=4000, width=200.0, depth=80.0))))
    las.classification[:] = 2
    las.write(str(folder / "ground.laz"))
    bare_earth.classify(folder / "tile.laz", folder / "tile.copc.laz")
    return folder


def test_every_extra_is_used_here():
    assert {*USES} == {"", *EXTRAS} - OURS


def test_wheel_and_sdist_are_as_pypi_wants_them(built, tools):
    assert "deprecat" not in built.said.replace("deprecation_", "").lower(), built.said
    release.check_distributions(built, tools)
    names = zipfile.ZipFile(built.wheel).namelist()
    made = ("py.typed", "metadata.txt", "__init__.pyi", "arrays.pyi")
    there = run("git", "ls-files", "algorithms", cwd=ROOT).split()
    for name in (*made, *there):
        assert f"bare_earth/{name}" in names
    # PyPI has no other file: links and pictures of README lead to the repository.
    (metadata,) = (name for name in names if name.endswith(".dist-info/METADATA"))
    links = re.findall(r"\]\(([^)]*)\)", zipfile.ZipFile(built.wheel).read(metadata).decode())
    assert len(links) > 20 and all(link.startswith("https://") for link in links)


@pytest.mark.parametrize("extra", USES)
def test_an_extra_works_alone(extra, built, work, tmp_path):
    wheel = built.wheel
    python = environment(tmp_path / "venv", f"{wheel}[{extra}]" if extra else wheel)
    script = tmp_path / "script.py"
    script.write_text(BEGIN + USES[extra])
    run(python, script, cwd=work)
    command = python.with_name("bare-earth.exe" if os.name == "nt" else "bare-earth")
    assert "points" in run(command, "info", work / "tile.laz")
    if extra:
        return
    lines = run(python, "-m", "pip", "list", "--format=freeze").splitlines()
    there = {line.partition("==")[0].lower() for line in lines if "==" in line}
    assert there - {"pip", "setuptools"} == {"bare-earth", "numpy", "scipy", "laspy", "lazrs"}
    # Of the processor, so that other work on the machine does not count.
    timed = (
        "import time; start = time.process_time(); import bare_earth, bare_earth.arrays;"
        "print(time.process_time() - start)"
    )
    assert min(float(run(python, "-c", timed)) for _ in range(3)) <= 0.15


def test_the_recipe_for_conda_is_one(built, tools):
    """The parser of rattler-build refuses what no recipe may have."""
    if sys.version_info < (3, 10):
        pytest.skip("rattler-build needs Python 3.10")
    recipe = release.write_recipe(built.sdist, bare_earth.__version__)
    assert release.check_recipe(recipe, tools) == f"bare-earth {bare_earth.__version__}"
