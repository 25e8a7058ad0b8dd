"""Which packages a run imports, and when."""

import subprocess
import sys
import threading

import numpy as np
import pytest
from runs import environment
from surveys import write_points

from bare_earth.algorithms.core.imports import import_early

pytestmark = pytest.mark.processes

# Packages, and modules that are imported if they are: `sys.modules` has some packages before.
_NEVER = {
    "boto3": "boto3.session",
    "geopandas": "geopandas",
    "laszip": "laszip",
    "numpy.f2py": "numpy.f2py.crackfortran",
    "numpy.testing": "numpy.testing._private",
    "pandas": "pandas",
    "processes": "concurrent.futures.process",
    "pyproj": "pyproj._crs",
    "requests": "requests",
}
_SELDOM = {
    "HTML": "html.entities",
    "rasterio": "rasterio",
    "scipy.sparse": "scipy.sparse",
    "scipy.spatial": "scipy.spatial",
    "scipy.special": "scipy.special._ufuncs",
}
_RUN = """
import sys
from bare_earth.algorithms.cli import main
failed = main()
print(failed, *sys.modules)
"""


def _imported(*arguments):
    done = subprocess.run(
        [sys.executable, "-c", _RUN, *map(str, arguments)],
        capture_output=True, text=True, check=True, env=environment(),
    )  # fmt: skip
    failed, *modules = done.stdout.splitlines()[-1].split()
    assert failed == "0", done.stderr
    return set(modules)


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    x, y = np.random.default_rng(1).uniform(0.0, 30.0, (2, 4_000))
    return write_points(tmp_path_factory.mktemp("imports") / "a.laz", x, y, 0.05 * x)


@pytest.mark.rest
@pytest.mark.parametrize(
    ("outputs", "unneeded"), [((), {**_NEVER, **_SELDOM}), (("--dtm", "--contours"), _NEVER)]
)
def test_a_run_imports_only_what_it_needs(outputs, unneeded, source, tmp_path):
    files = {"--dtm": tmp_path / "dtm.tif", "--contours": tmp_path / "contours.gpkg"}
    options = [word for output in outputs for word in (output, files[output])]
    modules = _imported("classify", source, tmp_path / "b.laz", *options)
    assert {"laspy.header", "lazrs", "numpy", "scipy.ndimage"} <= modules
    assert not {package for package, inner in unneeded.items() if inner in modules}


def test_modules_are_imported_early_and_missing_ones_are_left_alone(monkeypatch):
    asked, done = [], threading.Event()

    def load(name):
        asked.append(name)
        if name == "missing":
            done.set()
            raise ImportError(name)

    monkeypatch.setattr("importlib.import_module", load)
    failed = []
    monkeypatch.setattr(threading, "excepthook", failed.append)
    import_early("present", "missing", "never")
    assert done.wait(10.0)
    for thread in threading.enumerate():
        if thread.name == "imports":
            thread.join(10.0)
    assert asked == ["present", "missing"] and not failed


@pytest.mark.rest
def test_what_waits_for_its_import_can_be_used_as_always():
    code = (
        "from bare_earth.algorithms.core import imports\n"
        "imports.own_this_process()\n"
        "imports.import_only_what_runs_need()\n"
        "import numpy, scipy.special as early\n"
        "from scipy import special\n"
        "from scipy.special import gamma\n"
        "import scipy.special._basic, sys\n"
        "assert gamma(5.0) == special.gamma(5.0) == early.gamma(5.0) == 24.0\n"
        "assert numpy.testing.assert_allclose is sys.modules['numpy.testing'].assert_allclose\n"
        "import importlib.util, laspy, pyproj\n"
        "assert importlib.util.find_spec('laspy') and laspy.LasHeader().point_count == 0\n"
        "assert pyproj.CRS.from_epsg(25832).to_epsg() == 25832\n"
        "assert not hasattr(numpy.f2py, 'no_such_name') and numpy.f2py.__file__\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False,
        env=environment(),
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
