"""Measures what the pages of figures say, part by part: `python -m benchmarks.evidence`.

Without an option it lists the parts: the page of each, when and at which commit it was measured,
and whether the code that it speaks of has changed since. `--run` measures the parts whose page is
older than the code, or those that are named (`--run plain accuracy`), after it has fetched the data
that are missing. Each part writes its page, which gets a line of when, where and at which code it
was measured; so a run that was stopped goes on with the parts that are left, and within a part with
what is kept in the cache. What a part prints goes to build/evidence/. `make evidence` runs it,
`make evidence PART=plain` a part.

`--mark` measures nothing: it lets each page say whether the code has changed since. A test fails if
what a page says about itself is wrong. Tables of README and the manual that stand between marks are
written from the pages.
"""

from __future__ import annotations

import argparse
import datetime
import hashlib
import io
import os
import platform
import re
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path
from typing import Iterable, NamedTuple, Sequence

from . import data, manual, tables

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "benchmarks" / "results"
LOGS = ROOT / "build" / "evidence"
# What labels and the TIN of them depend on: of grids, the modules that these import.
_OF_GRIDS = ("cells", "gradient", "inpaint", "morphology", "planes")
LABELS = ("filters", "tin", *(f"grids/{name}.py" for name in _OF_GRIDS))
_GROUND = ("filters", "grids", "tin")
# What git calls a change of figures in a table.
_FIGURES = "-G^[|] .*[0-9]"
_CHANGED = "This code has changed since."


class Part(NamedTuple):
    """A page of figures, and the commands that measure it."""

    name: str
    rooms: tuple[str, ...]  # folders and files of algorithms/ whose code the page speaks of
    commands: tuple[str, ...]  # modules of benchmarks and arguments; empty if written by hand
    page: str = ""  # file in results/; usually the name

    @property
    def path(self) -> Path:
        """The page."""
        return RESULTS / f"{self.page or self.name}.md"


# In the order in which they are measured: the short ones first.
PARTS = (
    Part("plain", LABELS, ("plain --peers --write",)),
    Part(
        "expected_error",
        (*_GROUND, "rasters"),
        ("expected_error --write", "expected_error --places --write"),
    ),
    Part("above_ground", (*_GROUND, "tools"), ("above_ground --write",)),
    Part("values", LABELS, ("rule_values --write",), "rules_comments"),
    Part("accuracy", LABELS, ("accuracy --isprs --real --peers --write",)),
    Part("scenes", LABELS, ("accuracy --scenes --sensitivity --write",)),
    Part("rules", LABELS, ("ablation --quick --write",)),
    Part("memory", ("",), ("memory --write",)),
    Part(
        "performance",
        ("",),
        ("speed --sizes 1 10 --rounds 2 --peer-rounds 1 --timeout 120 --profile --write",),
    ),
    Part("water", (*_GROUND, "tools"), ()),
    Part("reliability", ("",), ()),
)


class Stamp(NamedTuple):
    """What a page says about itself."""

    date: str
    commit: str
    machine: str
    rooms: str
    digest: str
    has_changed: bool

    def line(self) -> str:
        """Return the line of the page."""
        told = f"Measured on {self.date} at {self.commit}, {self.machine}"
        told += f"; code of {self.rooms}: {self.digest}."
        return f"*{told} {_CHANGED}*" if self.has_changed else f"*{told}*"


_LINE = re.compile(
    r"^\*Measured on (\S+) at (\w+), (.*); code of ([\w, ]+): (\w+)\.( "
    + re.escape(_CHANGED)
    + r")?\*$",
    re.M,
)


def stamp_of(page: Path) -> Stamp | None:
    """Return what a page says about itself; None if it says nothing."""
    found = _LINE.search(page.read_text("utf-8")) if page.exists() else None
    return Stamp(*found.groups()[:5], has_changed=bool(found[6])) if found else None


def write_stamp(page: Path, stamp: Stamp) -> None:
    """Write what a page says about itself below its title."""
    text = page.read_text("utf-8")
    if _LINE.search(text):
        text = _LINE.sub(lambda _: stamp.line(), text)
    else:
        title, _, rest = text.partition("\n")
        text = f"{title}\n\n{stamp.line()}\n{rest}"
    page.write_text(text, "utf-8")


def digest(rooms: Iterable[str], folder: Path = ROOT) -> str:
    """Return what tells apart the code of some folders and files of algorithms/."""
    own = hashlib.sha256()
    for room in rooms:
        there = folder / "algorithms" / room
        for path in sorted(there.rglob("*.py")) if there.is_dir() else [there]:
            own.update(path.relative_to(folder).as_posix().encode())
            own.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return own.hexdigest()[:12]


def _git(*arguments: str) -> bytes:
    return subprocess.run(
        ["git", "-C", str(ROOT), *arguments], capture_output=True, check=True
    ).stdout


def _digest_at(commit: str, rooms: Sequence[str]) -> str:
    """Return the digest of the code of a commit."""
    with tempfile.TemporaryDirectory(prefix="evidence-") as folder:
        with tarfile.open(fileobj=io.BytesIO(_git("archive", commit, "algorithms"))) as archive:
            archive.extractall(folder)
        return digest(rooms, Path(folder))


def machine() -> str:
    """Return the processor and its number of cores."""
    name = ""
    if Path("/proc/cpuinfo").exists():
        named = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text("utf-8"), re.M)
        name = named[1].split(",")[0] if named else ""
    return f"{name or platform.machine()} with {os.cpu_count()} processors"


def _rooms(part: Part) -> str:
    if part.rooms == LABELS:
        return "filters, tin and of grids " + ", ".join(_OF_GRIDS)
    return ", ".join(part.rooms) if part.rooms != ("",) else "algorithms"


def stamped(part: Part) -> Stamp:
    """Return what the page of a part says that was measured now."""
    today = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
    commit = _git("rev-parse", "--short=8", "HEAD").decode().strip()
    return Stamp(today, commit, machine(), _rooms(part), digest(part.rooms), False)


def _from_history(part: Part) -> Stamp:
    """Return when the figures of a page changed, which does not say when it was measured."""
    page = str(part.path)
    if _git("diff", "HEAD", "--name-only", _FIGURES, "--", page):
        return stamped(part)
    form = "--follow", "-1", "--abbrev=8", "--format=%h %cs"
    told = _git("log", *form, _FIGURES, "--", page).decode().split()
    if not told:
        return stamped(part)
    commit, date = told
    then = _digest_at(commit, part.rooms)
    return Stamp(date, commit, "2 processors", _rooms(part), then, then != digest(part.rooms))


def mark(part: Part) -> None:
    """Let the page of a part say whether the code has changed since it was measured."""
    known = stamp_of(part.path) or _from_history(part)
    write_stamp(part.path, known._replace(has_changed=known.digest != digest(part.rooms)))


def is_current(part: Part) -> bool:
    """Return whether a page was measured with the code as it is."""
    known = stamp_of(part.path)
    return known is not None and known.digest == digest(part.rooms)


def listed() -> list[str]:
    """Return the parts with their age, as a table."""
    lines = []
    for part in PARTS:
        known = stamp_of(part.path)
        age = (
            ("not measured", "", "") if known is None else (known.date, known.commit, _rooms(part))
        )
        state = "current" if is_current(part) else "older than the code"
        lines.append([part.name, *age, state, "; ".join(part.commands) or "by hand"])
    return tables.table(("Part", "measured", "at", "code of", "page", "command"), lines)


def run(part: Part) -> bool:
    """Measure a part, and return whether it was done; what it prints goes to its log."""
    LOGS.mkdir(parents=True, exist_ok=True)
    log = LOGS / f"{part.name}.log"
    begun = stamped(part)
    for command in part.commands:
        print(f"{part.name}: python -m benchmarks.{command} ...", flush=True)
        with log.open("ab") as file:
            done = subprocess.run(
                [sys.executable, "-m", *f"benchmarks.{command}".split()],
                cwd=ROOT, stdout=file, stderr=subprocess.STDOUT, check=False,
            )  # fmt: skip
        if done.returncode:
            print(f"{part.name} failed with {done.returncode}; see {log}.", flush=True)
            return False
    write_stamp(part.path, begun)
    manual.write(with_speeds=part.path == manual.PERFORMANCE)
    print(f"{part.name}: {part.path.name} is written.", flush=True)
    return True


def fetch() -> None:
    """Bring the data that are not here."""
    missing = [tile.name for tile in data.REAL if not data.real(tile.name).exists()]
    if missing or not data.isprs():
        # What a server no longer has is told there, and the others go on.
        subprocess.run([sys.executable, "-m", "benchmarks.data", "fetch"], cwd=ROOT, check=False)


def main(arguments: Sequence[str] | None = None) -> int:
    """List, measure or mark the parts; return 1 if one fails."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.evidence",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    names = [part.name for part in PARTS if part.commands]
    parser.add_argument("--run", nargs="*", choices=names, metavar="PART", help="measure")
    parser.add_argument("--mark", action="store_true", help="say which pages are older")
    options = parser.parse_args(arguments)
    if options.mark:
        for part in PARTS:
            if part.path.exists():
                mark(part)
        manual.write()
    if options.run is not None:
        chosen = [part for part in PARTS if part.name in (options.run or names)]
        todo = [part for part in chosen if options.run or not is_current(part)]
        if todo:
            fetch()
        if not all([run(part) for part in todo]):
            return 1
    print(*listed(), sep="\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
