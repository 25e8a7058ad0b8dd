"""Works on mutants, in children with little memory and time.

    python tests/core/campaign.py FOLDER SEED COUNT [FIRST]

It prints what is no sentence and no right output: a process that ended by a signal (an abort, a
hang), an error that is no `BareEarthError`, a word on stderr, too much memory. The mutants that
did it are kept in the folder. At the end it prints how many of each kind there were.
"""

import collections
import contextlib
import functools
import gc
import importlib
import os
import pickle
import pkgutil
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

# Before numpy: a process with threads of its own is no good to be forked.
os.environ["OPENBLAS_NUM_THREADS"] = "1"

import numpy as np
from mutants import Original, mutant
from surveys import write_classified

import bare_earth.algorithms as package
from bare_earth import BareEarthError, classify, heights, info, key_points, terrain
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.extrabytes import ExtraDimension
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.las.writing import write_changed
from bare_earth.algorithms.survey.files import open_survey
from bare_earth.algorithms.survey.vector_files import read_boundary, read_lines
from bare_earth.algorithms.survey.vpc import read_vpc, write_vpc
from bare_earth.algorithms.survey.window import read_window

# Of how many sound ones a whole run is made: that takes longest.
RUNS = 0.1
RIGHT = "done", "refused", "told, and a panic printed"
# Mutants that a child works on: to begin one takes as long as some mutants.
A_CHILD = 40
# Bytes that may be asked for, and that may be used (sound files take 0.1 GB); seconds that it may
# work, and that it may take.
ASKED, USED, SECONDS, WAITED = 4 << 30, 1 << 30, 20, 300
METHOD = {"method": "slope", "preset": "whitebox"}


def cloud_actions(source, random):
    """Yield what may be done with a point cloud: the first always, of the others three."""
    yield lambda: "\n".join(info(source).lines()).encode("utf-8", "replace")
    layout = open_las(source)
    if layout.count > 10**6:  # many points of few bytes: that takes as long as it takes
        return
    classes = np.arange(layout.count, dtype=np.int64).astype(np.uint8) % 5
    values = np.zeros(layout.count, np.float32)
    extra = Edits(extra=ExtraDimension("height", "of it", values), kept=classes > 1)
    out = {suffix: source.with_name(f"out{suffix}") for suffix in (".las", ".laz", ".copc.laz")}
    others = [
        *(functools.partial(write_classified, source, path, classes) for path in out.values()),
        lambda: write_changed(source, out[".las"], extra),
        lambda: read_cloud(source).points(slice(None)),
        lambda: write_vpc(source.with_name("out.vpc"), [source]),
        lambda: read_window(source, (4e5, 5e6, 4e5 + 3, 5e6 + 3)),
    ]
    for number in random.choice(len(others), 3, replace=False):
        yield others[number]
    if random.random() < RUNS:
        yield a_run(source, random)


def a_run(source, random):
    """Return a whole run over a point cloud, one of several."""
    out = source.with_name("out.laz")
    dtm = source.with_name("out.tif")
    runs = (
        lambda: classify(source, out, dtm=dtm, **METHOD),
        lambda: classify(source, out, dtm=dtm, threads=1, memory=0.001, **METHOD),
        lambda: heights(source, out),
        lambda: key_points(source, out),
        lambda: terrain(source, dtm=dtm),
    )
    return runs[random.integers(len(runs))]


def vpc_actions(source):
    """Yield what may be done with a list of files."""
    yield lambda: read_vpc(source)
    yield lambda: open_survey([source])
    yield lambda: classify(source, source.with_name("out"), **METHOD)


def actions(source, random):
    """Yield what may be done with a file, one after the other."""
    if source.suffix == ".vpc":
        yield from vpc_actions(source)
    elif source.suffix in (".las", ".laz"):
        yield from cloud_actions(source, random)
    else:
        yield lambda: read_boundary(source)
        yield lambda: read_lines(source)


def work_on(source, random):
    """Do all of it; only a `BareEarthError` may come of it. Return whether anything was done."""
    following, done = actions(source, random), 0
    while True:
        try:
            action = next(following, None)
            if action is None:
                return done
            action()
            done += 1
        except BareEarthError as error:
            if "\n" in str(error) or not str(error).endswith("."):
                raise ValueError(f"no sentence: {error}") from error


def came_of(source, random):
    """Return what came of a file: "done", "refused", or what is wrong."""
    start = os.fstat(2).st_size
    try:
        answer = "done" if work_on(source, random) else "refused"
    except BaseException as error:
        where = error.__traceback__
        while where.tb_next is not None:
            where = where.tb_next
        place = f"{Path(where.tb_frame.f_code.co_filename).name}:{where.tb_lineno}"
        answer = f"{type(error).__name__} at {place}: {error}"
    said = os.pread(2, 300, start).decode("utf-8", "replace")
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss << 10
    if used > USED:
        answer += f"; {used >> 20} MB used"
    if said.lstrip().startswith("thread ") and " panicked " in said and answer in RIGHT:
        # The decompressor found at the last moment what no length tells, and says so by itself.
        return "told, and a panic printed"
    return f"{answer}; stderr: {said}" if said else answer


def work_through(numbers, make, work, answers):
    """Work on mutants one after the other, and answer what came of each; it does not come back."""
    try:
        resource.setrlimit(resource.RLIMIT_AS, (ASKED, ASKED))
        warnings.simplefilter("error")
        for number in numbers:
            source, random = make(number)
            # Of work, which others do not slow down; and of waiting, for what hangs.
            signal.setitimer(signal.ITIMER_PROF, SECONDS)
            signal.alarm(WAITED)
            answer = came_of(source, random)
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.alarm(0)
            os.write(answers, f"{' '.join(answer.split())[:400]}\n".encode("utf-8", "replace"))
            clean(work)
            if "MB used" in answer:
                break
    finally:
        os._exit(0)


def answers_of(numbers, make, work):
    """Yield what came of each mutant; one that ends the child begins the next one behind it."""
    numbers = list(numbers)
    while numbers:
        mine, its = os.pipe()
        with tempfile.TemporaryFile() as errors:
            child = os.fork()
            if child == 0:
                os.dup2(errors.fileno(), 2)
                work_through(numbers, make, work, its)
            os.close(its)
            with os.fdopen(mine, encoding="utf-8") as pipe:
                lines = pipe.read().splitlines()
            _, status = os.waitpid(child, 0)
        if os.WIFSIGNALED(status):
            lines.append(f"ended by {signal.Signals(os.WTERMSIG(status)).name}")
            clean(work)
        if not lines:
            raise SystemExit(f"nothing came of {numbers[0]}")
        yield from zip(numbers, lines)
        del numbers[: len(lines)]


def clean(folder):
    """Remove what a mutant left."""
    for path in folder.iterdir():
        if path.name.startswith(("out", "mutant", ".")):
            with contextlib.suppress(OSError):
                shutil.rmtree(path) if path.is_dir() else path.unlink()


def load_all():
    """Import what the work needs, and let PROJ read its tables: a child need not."""
    from pyproj import Transformer
    from rasterio.crs import CRS

    for module in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
    for name in ("laspy", "lazrs", "scipy.spatial", "scipy.ndimage", "scipy.sparse.linalg",
                 "scipy.interpolate", "rasterio.shutil", "rasterio.io"):  # fmt: skip
        importlib.import_module(name)
    CRS.from_epsg(25832)
    Transformer.from_crs("EPSG:25832", "EPSG:4326", always_xy=True)
    gc.freeze()


def main(folder, seed, count, first=0):
    """Try mutants; return how many of them came to no good end."""
    here = Path(__file__).with_name("mutants.py")
    subprocess.run([sys.executable, str(here), str(folder)], check=True)
    before = [Original(*fields) for fields in pickle.loads((folder / "originals").read_bytes())]
    work = Path(tempfile.mkdtemp(dir=folder))
    for name, suffix in (("a.las", ".las"), ("b.laz", ".laz")):
        sound = next(path for path in before if path.suffix == suffix)
        (work / name).write_bytes(sound.content)
    load_all()
    ends, parts, begun = collections.Counter(), collections.Counter(), time.monotonic()

    def make(number):
        suffix, data, _ = mutant(before, seed, number)
        source = work / f"mutant{suffix}"
        source.write_bytes(data)
        return source, np.random.default_rng([seed, number, 1])

    try:
        for start in range(first, first + count, A_CHILD):
            numbers = range(start, min(start + A_CHILD, first + count))
            for number, answer in answers_of(numbers, make, work):
                suffix, data, done = mutant(before, seed, number)
                is_right = answer in RIGHT
                ends[answer if is_right else "wrong"] += 1
                parts.update({suffix, *done})
                if not is_right:
                    (folder / f"{seed}-{number}{suffix}").write_bytes(data)
                    print(f"mutant {seed} {number} {suffix} {done}: {answer}", flush=True)
            if start % 1000 == 0:
                print(f"{start} {dict(ends)} {time.monotonic() - begun:.0f} s", flush=True)
    finally:  # whoever ends it early sees how far it came
        said = f"{dict(ends)}; of them with {dict(sorted(parts.items()))}"
        print(f"tried {sum(ends.values())}: {said}", flush=True)
        shutil.rmtree(work, ignore_errors=True)
    return ends["wrong"]


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    sys.exit(1 if main(Path(sys.argv[1]), *map(int, sys.argv[2:])) else 0)
