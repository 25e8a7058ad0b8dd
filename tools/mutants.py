"""Tells how many small faults in the code the core tests see: mutation testing.

`make mutants` runs this in a copy below build/, never on the sources: first the core suite, to
learn which test runs which line, then a sample of faults that cosmic-ray makes (`<` for `<=`, `+`
for `-`, `and` for `or`, 4 for 3), one at a time, each against the tests that run its line. It takes
an hour or two. Once it has run, by `tools/environment python tools/mutants.py`:

    --known --count 20 --seed 3 --only classes    other faults, with what is known of the tests
    --again                                       those that no test saw, with the tests of now
"""

from __future__ import annotations

import argparse
import ast
import importlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path
from typing import Iterator, NamedTuple

import numpy as np

REPOSITORY = Path(__file__).parents[1]
PLACE = REPOSITORY / "build" / "mutants"
COPY = PLACE / "bare_earth"  # the tests import the package by this name
RESULTS, COVERAGE, TIMES = (PLACE / name for name in ("results.json", "coverage", "times.txt"))

# What is tried, and how many faults of a hundred.
GROUPS = {
    "filters": (22, "filters/*.py"),
    "stages": (24, "filters/stages/*.py"),
    "grids": (24, "grids/*.py"),
    "classes": (14, " ".join(f"survey/{module}.py" for module in (
        "selection", "point_counts", "corrections", "ground_classes", "point_chooser",
    ))),
    "las": (10, "las/writing.py las/records.py las/edits.py las/header_edits.py"),
    "rasters": (6, "rasters/geotiff.py rasters/writing.py"),
}  # fmt: skip
# cosmic-ray could also make `a << b` of `a + b`: any run would see that.
OPERATORS = [
    *(f"ReplaceComparisonOperator_{kind}" for kind in (
        "Lt_LtE", "LtE_Lt", "Gt_GtE", "GtE_Gt", "Lt_Gt", "Gt_Lt", "LtE_GtE", "GtE_LtE", "Eq_NotEq",
        "NotEq_Eq", "Is_IsNot", "IsNot_Is",
    )),
    *(f"ReplaceBinaryOperator_{kind}" for kind in (
        "Add_Sub", "Sub_Add", "Mul_Div", "Div_Mul", "FloorDiv_Mul", "Mod_FloorDiv", "BitAnd_BitOr",
        "BitOr_BitAnd", "BitXor_BitOr",
    )),
    *(f"ReplaceUnaryOperator_{kind}" for kind in ("Delete_USub", "Delete_Invert", "Delete_Not")),
    "AddNot", "ReplaceAndWithOr", "ReplaceOrWithAnd", "ReplaceTrueWithFalse",
    "ReplaceFalseWithTrue", "ReplaceBreakWithContinue", "ReplaceContinueWithBreak",
    "NumberReplacer", "ZeroIterationForLoop",
]  # fmt: skip


class Mutant(NamedTuple):
    """One fault: which operator of cosmic-ray, and which of the places where it could act."""

    group: str
    path: str
    line: int
    operator: str
    occurrence: int


def _operator(name):
    from cosmic_ray.plugins import get_operator

    return get_operator(f"core/{name}")()


def _places(group: str, path: Path) -> Iterator[tuple[tuple, Mutant]]:
    """Yield where a file can be changed, with each change."""
    from cosmic_ray.ast import ast_nodes, get_ast

    source = path.read_text(encoding="utf-8")
    nodes, name = list(ast_nodes(get_ast(source))), str(path.relative_to(COPY))
    for operator in OPERATORS:
        positions = (
            place for node in nodes for place in _operator(operator).mutation_positions(node)
        )
        for number, (start, _) in enumerate(positions):
            yield (name, start), Mutant(group, name, start[0], operator, number)


def _annotations(path: Path) -> list[tuple[tuple, tuple]]:
    """Return where types stand: what is wrong there no run can see."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        for hint in (getattr(node, "annotation", None), getattr(node, "returns", None)):
            if hint is not None:
                ends = (hint.lineno, hint.col_offset), (hint.end_lineno, hint.end_col_offset)
                found.append(ends)
    return found


def sample(count: int, seed: int, only: list[str]) -> list[Mutant]:
    """Return faults at so many places, one each, by chance but the same for the same seed."""
    chosen = []
    for number, (group, (share, patterns)) in enumerate(GROUPS.items()):
        if only and group not in only:
            continue
        random = np.random.default_rng((seed, number))
        files = {path for mask in patterns.split() for path in (COPY / "algorithms").glob(mask)}
        places: dict[tuple, list[Mutant]] = {}
        for path in sorted(files):
            types = _annotations(path)
            for place, mutant in _places(group, path):
                if not any(start <= place[1] < end for start, end in types):
                    places.setdefault(place, []).append(mutant)
        among = list(places.values())
        for index in random.permutation(len(among))[: round(count * share / 100)]:
            chosen.append(among[index][random.integers(len(among[index]))])
    return chosen


def copy_sources() -> None:
    """Copy what git knows, as it is now: faults are made there."""
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    found = subprocess.run(listed, cwd=REPOSITORY, check=True, capture_output=True, text=True)
    shutil.rmtree(COPY, ignore_errors=True)
    for name in filter(None, found.stdout.split("\0")):
        if (REPOSITORY / name).is_file():
            (COPY / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(REPOSITORY / name, COPY / name)


def _in_copy() -> dict[str, str]:
    """Return the environment in which the package is the copy."""
    path = [str(PLACE), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, path))}


def learn_lines(processes: str) -> None:
    """Run the core suite, and keep which test runs which line, and how long it takes."""
    words = ["-m", "pytest", "tests/core", "-q", "-n", processes, "-p", "no:cacheprovider"]
    words += ["--cov=algorithms", "--cov-context=test", "--cov-report=", "-vv", "--durations=0"]
    done = subprocess.run(
        [sys.executable, *words, "--durations-min=0"],
        cwd=COPY, env=_in_copy(), capture_output=True, text=True,
    )  # fmt: skip
    TIMES.write_text(done.stdout)
    if done.returncode:
        sys.exit(f"Tests fail without a fault:\n{done.stdout[-2000:]}")
    shutil.move(COPY / "build" / "coverage", COVERAGE)


class Tests:
    """Knows which tests run a line."""

    def __init__(self) -> None:
        from coverage import CoverageData

        self._data = CoverageData(str(COVERAGE))
        self._data.read()
        self._files = {path.split("/algorithms/")[-1]: path for path in self._data.measured_files()}
        self._seconds: Counter = Counter()
        for found in re.finditer(r"^([\d.]+)s \w+ +(tests/.*)$", TIMES.read_text(), re.MULTILINE):
            self._seconds[found[2].strip()] += float(found[1])

    def of(self, mutant: Mutant, seconds: float) -> list[str]:
        """Return the tests that run its statement, the quickest first, up to a time."""
        name = self._files[mutant.path.partition("algorithms/")[2]]
        contexts = self._data.contexts_by_lineno(name)
        lines = _statement(COPY / mutant.path, mutant.line)
        tests = {test.split("|")[0] for line in lines for test in contexts.get(line, ()) if test}
        if not tests and any("" in contexts.get(line, ()) for line in lines):
            # Run when the module is imported: whoever uses anything of it may see the fault.
            tests = {test.split("|")[0] for found in contexts.values() for test in found if test}
        chosen, total = [], 0.0
        for test in sorted(tests, key=lambda test: (self._seconds[test], test)):
            total += self._seconds[test] + 0.02
            if chosen and total > seconds:
                break
            chosen.append(test)
        return chosen


def _statement(path: Path, line: int) -> range:
    """Return the lines of the innermost statement, without the body that it may have."""
    found = range(line, line + 1)
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.stmt) and node.lineno <= line <= node.end_lineno:
            body = getattr(node, "body", None)
            last = body[0].lineno - 1 if body else node.end_lineno
            if line <= last or not body:
                found = range(node.lineno, max(last, line) + 1)
    return found


def see(tests: list[str], seconds: float) -> tuple[bool, str]:
    """Return whether a test fails, or takes too long, and the end of what is said."""
    log = PLACE / "log.txt"
    child = os.fork()  # numpy and scipy are loaded already
    if not child:
        os.setsid()
        with open(log, "w") as out:
            os.dup2(out.fileno(), 1)
            os.dup2(out.fileno(), 2)
        import pytest

        os._exit(pytest.main(["-x", "-q", "-rN", "--tb=line", "-p", "no:cacheprovider", *tests]))
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            said = log.read_text(errors="replace").strip().splitlines()
            why = [line for line in said if "Error" in line or line.startswith("E ")]
            return status != 0, (why or said or [""])[-1 if not why else 0][:160]
        time.sleep(0.05)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return True, f"no end in {seconds:.0f} s"


def try_out(mutant: Mutant, tests: list[str], number: int, seconds: float) -> dict:
    """Make one fault in the copy, run the tests, and take it back."""
    from cosmic_ray.mutating import mutate_code

    path, result = COPY / mutant.path, mutant._asdict()
    sound = path.read_text(encoding="utf-8")
    wrong = mutate_code(sound, _operator(mutant.operator), mutant.occurrence)
    lines = sound.splitlines(), wrong.splitlines()
    changed = next((old, new) for old, new in zip(*lines) if old != new)
    result["was"], result["is"] = (line.strip() for line in changed)
    began = time.monotonic()
    try:
        _write(path, wrong, number)
        result["seen"], result["why"] = see(tests, seconds) if tests else (False, "no test")
    finally:
        _write(path, sound, number + 1)
    return {**result, "tests": len(tests), "seconds": round(time.monotonic() - began, 1)}


def _write(path: Path, source: str, number: int) -> None:
    """Write a source of which Python cannot hold old bytecode to be up to date."""
    path.write_text(source, encoding="utf-8")
    os.utime(path, (number, number))


def tell(results: list[dict]) -> None:
    """Print what no test saw, and the score."""
    for row in results:
        if not row["seen"]:
            print(f"\n{row['path']}:{row['line']} {row['operator']} ({row['tests']} tests)")
            print(f"  - {row['was']}\n  + {row['is']}")
    print(f"\n{'group':10} {'faults':>6} {'seen':>6}")
    for group in dict.fromkeys(row["group"] for row in results):
        seen = [row["seen"] for row in results if row["group"] == group]
        print(f"{group:10} {len(seen):6} {sum(seen):6}")
    print(f"{'all':10} {len(results):6} {sum(row['seen'] for row in results):6}")


def main() -> None:
    """Do what is asked for on the command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=200, help="how many faults")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other faults")
    parser.add_argument("--only", nargs="*", default=[], choices=GROUPS, help="parts of the code")
    parser.add_argument("--seconds", type=float, default=40, help="tests run up to so long each")
    parser.add_argument("--processes", default="auto", help="in which the suite is run")
    parser.add_argument("--known", action="store_true", help="which test runs what is known")
    parser.add_argument("--again", action="store_true", help="try those again that no test saw")
    asked = parser.parse_args()
    PLACE.mkdir(parents=True, exist_ok=True)
    copy_sources()
    if not asked.known:
        learn_lines(asked.processes)
    os.chdir(COPY)
    os.environ.update(_in_copy())
    sys.path.insert(0, str(PLACE))
    for module in ("laspy", "lazrs", "pytest", "rasterio", "scipy.ndimage", "scipy.spatial"):
        importlib.import_module(module)  # once, not in each process of tests

    known, kept, again = Tests(), [], []
    mutants = sample(asked.count, asked.seed, asked.only)
    if asked.again:
        for row in json.loads(RESULTS.read_text()):
            if row["seen"] or (asked.only and row["group"] not in asked.only):
                kept.append(row)
            else:
                again.append(Mutant(*(row[name] for name in Mutant._fields)))
        mutants = again
    results: list[dict] = []
    for number, mutant in enumerate(mutants):
        tests = known.of(mutant, asked.seconds)
        if number % 20 == 0 and see(tests, 5 * asked.seconds)[0]:
            sys.exit(f"Tests of {mutant.path}:{mutant.line} fail without a fault.")
        results.append(try_out(mutant, tests, 2 * number + 1, 3 * asked.seconds + 20))
        RESULTS.write_text(json.dumps(kept + results, indent=1))
        print(number, *list(results[-1].values()), flush=True)
    tell(kept + results)


if __name__ == "__main__":
    main()
