"""Classify a tile, or a scene whose truth is known, as a user would, and draw what came out.

The command line classifies, or with `--qgis` the plugin in the installed QGIS, by qgis_process.
"""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Sequence

from bare_earth.algorithms.tools.assess import AssessmentOptions, assess_files

from .jobs import JOBS, write_job
from .land import LANDS, write_unclassified
from .picture import Truth, draw
from .scene import GROUND_CLASSES, write_scene

_OUTPUT = Path("demo-output")
_ENVIRONMENT = Path(__file__).parent.parent / "tools" / "environment"
_ALGORITHM = "bareearth:tindensification"
# Cuts the scene's stream, bank, large building and wood.
_SCENE_NORTHING = 5_931_196.0


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the demo; return its exit code."""
    parser = argparse.ArgumentParser(prog="make demo", description=__doc__)
    parser.add_argument("cloud", type=Path, nargs="?", help="a tile; a generated scene without it")
    parser.add_argument("--truth", type=Path, help="the same points with their true classes")
    parser.add_argument("--land", choices=list(LANDS), help="a tile of real land")
    parser.add_argument("--qgis", action="store_true", help="by qgis_process of an installed QGIS")
    jobs = [*JOBS, "change"]
    parser.add_argument("--job", choices=jobs, help="only write the data of a tutorial")
    options = parser.parse_args(arguments)
    if options.job == "change":
        from .change import write_change  # and benchmarks with it, which no other job needs

        print("Put into new.laz:", *write_change(_OUTPUT / "change"), sep="\n")
    elif options.job is not None:
        write_job(options.job, _OUTPUT / options.job)
    if options.job is not None:
        print(f"Wrote the data of the tutorial to {_OUTPUT / options.job}")
        return 0
    if options.truth is not None and options.cloud is None:
        parser.error("a truth belongs to a tile: give both")
    if options.land is not None and options.cloud is not None:
        parser.error("give a tile or --land, not both")
    for path in filter(None, (options.cloud, options.truth)):
        if not path.is_file():
            return _fail(f"There is no file {path}.")
    _OUTPUT.mkdir(exist_ok=True)
    cloud, truth, northing = options.cloud, options.truth, None
    assessing = AssessmentOptions()
    if options.land is not None:
        cloud, truth = _OUTPUT / f"{options.land}.laz", _OUTPUT / "truth.laz"
        count = write_unclassified(shutil.copy(LANDS[options.land].path, truth), cloud)
        assessing = AssessmentOptions(ignored_classes=LANDS[options.land].unlabelled)
        print(f"{LANDS[options.land].title}, {count:,} points: {cloud} (true classes: {truth})")
    elif cloud is None:
        cloud, truth = _OUTPUT / "scene.laz", _OUTPUT / "truth.laz"
        count = write_scene(cloud, truth, checkpoints=_OUTPUT / "checkpoints.csv")
        assessing, northing = AssessmentOptions(ground_classes=GROUND_CLASSES), _SCENE_NORTHING
        print(f"Generated a scene of {count:,} points: {cloud} (true classes: {truth})")
    results = [_OUTPUT / name for name in ("classified.laz", "dtm.tif", "hillshade.tif")]
    picture, errors = _OUTPUT / "picture.png", _OUTPUT / "errors.txt"
    # Those of an earlier run must not pass for new ones.
    for result in (*results, picture, errors):
        result.unlink(missing_ok=True)

    start = time.monotonic()
    by = _by_qgis(cloud, *results) if options.qgis else _by_command(cloud, *results)
    if by is None or not all(result.is_file() for result in results):
        return _fail("The classification failed; what it said is above.")
    print(f"Classified by {by} in {time.monotonic() - start:.1f} s")

    if truth is not None:
        assessment = assess_files(results[0], truth, options=assessing)
        lines = assessment.lines()
        errors.write_text("\n".join(lines) + "\n", encoding="utf-8")
        print("\nAgainst the truth:", *lines, sep="\n  ")
    title = LANDS[options.land].title if options.land else cloud.name
    title = "Generated scene" if cloud.name == "scene.laz" else title
    known = Truth(truth, assessing.ground_classes, assessing.ignored_classes) if truth else None
    draw(*results, picture, known, northing, f"{title}: ground by {by}")
    print("\nTo look at:", picture, *results, sep="\n  ")
    return 0


def _by_command(cloud: Path, classified: Path, dtm: Path, hillshade: Path) -> str | None:
    """Classify by the command line, and return what did it, or None if that failed."""
    command = [sys.executable, "-m", "bare_earth.algorithms", "classify", cloud, classified]
    command += ["--dtm", dtm, "--hillshade", hillshade, "--verbose"]
    return "the command line" if _run(*command) else None


def _by_qgis(cloud: Path, classified: Path, dtm: Path, hillshade: Path) -> str | None:
    """Classify by the plugin in QGIS, and return what did it, or None if that failed."""
    # In Debian 12 the wrapper of this name adds an option that it then does not know.
    qgis_process = "qgis_process.bin" if shutil.which("qgis_process.bin") else "qgis_process"
    # It fails where the plugin is enabled already; if it is not, the next command fails.
    _run(_ENVIRONMENT, "qgis", qgis_process, "plugins", "enable", "bare_earth")
    # The working folder of QGIS may be another.
    files = {"INPUT": cloud, "OUTPUT": classified, "DTM": dtm, "HILLSHADE": hillshade}
    values = [f"{name}={path.resolve()}" for name, path in files.items()]
    done = _run(_ENVIRONMENT, "qgis", qgis_process, "run", _ALGORITHM, "--", *values)
    return "qgis_process" if done else None


def _run(*command: str | os.PathLike) -> bool:
    words = [os.fspath(word) for word in command]
    print("$", shlex.join(words), flush=True)
    return subprocess.run(words, check=False).returncode == 0


def _fail(text: str) -> int:
    print(f"make demo: {text}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
