"""What is measured: each contestant is the command of a whole process, from file to file."""

from __future__ import annotations

import functools
import importlib.util
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Callable

from bare_earth.algorithms.filters import METHODS

from .process import ROOT

FLOOR = "floor"
OURS = tuple(METHODS)
# Our classic slope filter, and the one of Whitebox with the same radius; then the radius that
# finds buildings, which is the default of ours.
SAME_RADIUS = (("slope-classic", "whitebox"), ("slope", "whitebox-wide"))
OUT_OF_CORE = "out-of-core"
QGIS, BESIDE_QGIS = "qgis", "beside-qgis"
_MEMORY = "1"  # GB
_QGIS_METHOD = "slope"


@dataclass(frozen=True)
class Contestant:
    """One line of the tables.

    Attributes
    ----------
    name, label : str
        On the command line, and in the tables.
    command : callable
        Returns the command that reads one file and writes another.
    is_peer : bool
        Whether it is somebody else's.
    note : str
        What is to know of it.
    missing : str
        What it lacks here; empty if it can run.
    writes_points : bool
        Whether it writes all points, not a raster alone.
    needs_classes : bool
        Whether it takes what our first method has classified.
    """

    name: str
    label: str
    command: Callable[[Path, Path], list[str]]
    is_peer: bool = False
    note: str = ""
    missing: str = ""
    writes_points: bool = True
    needs_classes: bool = False


def contestants(qgis: str = "") -> list[Contestant]:
    """Return all contestants, those that cannot run here, too.

    Parameters
    ----------
    qgis : str
        The command that runs others beside a QGIS; empty for that of the repository.
    """
    beside = shlex.split(qgis) or [str(ROOT / "tools" / "environment"), "qgis"]
    return [
        Contestant(FLOOR, "Reading and writing", _script("floor"), note="laspy with lazrs"),
        *(_ours(name, METHODS[name].label, "--method", name) for name in METHODS),
        _ours(
            "slope-classic", "Slope filter, preset Whitebox", "--method", "slope",
            "--preset", "whitebox", note="radius 2 m, 45 degrees, 1 m",
        ),
        _ours(
            OUT_OF_CORE, "TIN densification, out of core", "--memory", _MEMORY,
            note=f"with --memory {_MEMORY} (GB)", missing=_without_memory(),
        ),
        _peer("cloth", "CSF", "CSF", "cloth-simulation-filter", "its defaults, all its threads"),
        _peer("morphological", "pysmrf", "pysmrf", "pysmrf", "its defaults"),
        *(
            _peer(
                name, f"Whitebox slope filter, {radius} m", "whitebox_workflows",
                "whitebox-workflows==1.3.5", f"its defaults but for the radius of {radius} m",
                script="whitebox", option=radius,
            )
            for name, radius in (("whitebox", "2"), ("whitebox-wide", "18"))
        ),
        _peer_program(
            "pdal", "PDAL, SMRF", "pdal", "PDAL",
            lambda source, target: [
                "pdal", "translate", str(source), str(target), "smrf",
                "--writers.las.forward=all", "--writers.las.extra_dims=all",
            ],
        ),
        _peer_program("lasr", "lasR, PTD", "Rscript", "R with its package lasR", _lasr),
        *_beside_qgis(beside),
        *_products(),
    ]  # fmt: skip


def _products() -> list[Contestant]:
    """Return what is made besides, or of a file that has classes already."""
    label = METHODS[OURS[0]].label

    def classify(*options: str) -> Callable[[Path, Path], list[str]]:
        start = [sys.executable, "-m", "bare_earth.algorithms", "classify"]
        return lambda source, target: [
            *start, str(source), str(target), "--dtm", str(target.with_suffix(".dtm.tif")),
            *(option.format(target) for option in options),
        ]  # fmt: skip

    def terrain(source: Path, target: Path) -> list[str]:
        rasters = (("--dtm", "dtm"), ("--dsm", "dsm"), ("--chm", "chm"))
        words = [(name, str(target.with_suffix(f".{ending}.tif"))) for name, ending in rasters]
        start = [sys.executable, "-m", "bare_earth.algorithms", "terrain", str(source)]
        return [*start, *(word for pair in words for word in pair)]

    def command(name: str) -> Callable[[Path, Path], list[str]]:
        start = [sys.executable, "-m", "bare_earth.algorithms", name]
        return lambda source, target: [*start, str(source), str(target)]

    whitebox = "whitebox_workflows", "whitebox-workflows==1.3.5"
    return [
        Contestant("dtm", f"{label} and DTM, 1 m", classify()),
        Contestant("dtm-half", f"{label} and DTM, 0.5 m", classify("--dtm-cell-size", "0.5")),
        Contestant(
            "all", f"{label}, DTM, hillshade and heights",
            classify("--hillshade", "{}.shade.tif", "--height-above-ground"),
        ),
        *(
            replace(contestant, needs_classes=True)
            for contestant in (
                Contestant("terrain", "DTM, DSM and canopy height", terrain, writes_points=False),
                Contestant("height", "Heights above ground", command("height")),
                Contestant("key-points", "Model key points", command("key-points")),
                replace(
                    _peer(
                        "whitebox-tin", "Whitebox, TIN raster of 1 m", *whitebox,
                        "lidar_tin_gridding", script="whitebox_tin",
                    ),
                    writes_points=False,
                ),
                _peer(
                    "whitebox-height", "Whitebox, heights above ground", *whitebox,
                    "height_above_ground", script="whitebox_height",
                ),
            )
        ),
    ]  # fmt: skip


def _script(name: str, *more: str) -> Callable[[Path, Path], list[str]]:
    return lambda source, target: [
        *(sys.executable, "-m", "benchmarks.speed.scripts", name, str(source), str(target)), *more
    ]  # fmt: skip


def _classify(python: list[str], *options: str) -> Callable[[Path, Path], list[str]]:
    start = [*python, "-m", "bare_earth.algorithms", "classify", *options]
    return lambda source, target: [*start, str(source), str(target)]


def _ours(name: str, label: str, *options: str, note: str = "", missing: str = "") -> Contestant:
    return Contestant(
        name, label, _classify([sys.executable], *options), note=note, missing=missing
    )


def _peer(
    name: str, label: str, module: str, package: str, note: str, script: str = "", option: str = ""
) -> Contestant:
    missing = "" if importlib.util.find_spec(module) else f"pip install {package}"
    command = _script(script or name, *filter(None, [option]))
    return Contestant(name, label, command, True, note, missing)


def _peer_program(
    name: str, label: str, program: str, package: str, command: Callable[[Path, Path], list[str]]
) -> Contestant:
    missing = "" if shutil.which(program) else package
    if name == "lasr" and not missing and not _has_lasr():
        missing = package
    return Contestant(name, label, command, True, "its defaults", missing)


def _lasr(source: Path, target: Path) -> list[str]:
    """Return the command that lets lasR classify by its progressive TIN densification."""
    code = (
        "given <- commandArgs(TRUE);"
        " lasR::exec(lasR::classify_with_ptd() + lasR::write_las(given[2]), on = given[1])"
    )
    return ["Rscript", "-e", code, str(source), str(target)]


@functools.cache
def _has_lasr() -> bool:
    code = "quit(status = !requireNamespace('lasR', quietly = TRUE))"
    return not subprocess.run(["Rscript", "-e", code], check=False, capture_output=True).returncode


def _beside_qgis(beside: list[str]) -> list[Contestant]:
    """Return the same filter by QGIS and by the command, both with the Python of QGIS."""
    program = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
    missing = "" if program else "a QGIS with qgis_process"
    method = METHODS[_QGIS_METHOD]
    algorithm = f"bareearth:{_QGIS_METHOD}filter"

    def in_qgis(source: Path, target: Path) -> list[str]:
        _enable(tuple(beside), program or "")
        run = [*beside, program or "", "run", algorithm, "--"]
        return [*run, f"INPUT={source}", f"OUTPUT={target}"]

    def beside_qgis(source: Path, target: Path) -> list[str]:
        _enable(tuple(beside), program or "")  # which makes the environment if there is none
        python = [*beside, "/usr/bin/python3"]
        return _classify(python, "--method", _QGIS_METHOD)(source, target)

    return [
        Contestant(
            BESIDE_QGIS, f"{method.label}, Python of QGIS", beside_qgis, missing=missing,
            note="the command, beside QGIS",
        ),
        Contestant(
            QGIS, f"{method.label}, in QGIS", in_qgis, note="qgis_process", missing=missing
        ),
    ]  # fmt: skip


@functools.cache
def _enable(beside: tuple[str, ...], program: str) -> None:
    """Tell QGIS once to load the plugin."""
    subprocess.run(
        [*beside, program, "plugins", "enable", "bare_earth"],
        cwd=ROOT, check=False, capture_output=True,
    )  # fmt: skip


@functools.cache
def _without_memory() -> str:
    """Return what is missing for work out of core: the option is younger than the benchmark."""
    asked = _classify([sys.executable], "--help")(Path(), Path())[:-2]
    said = subprocess.run(asked, cwd=ROOT, check=False, capture_output=True, text=True).stdout
    return "" if "--memory" in said else "an option --memory of the command"
