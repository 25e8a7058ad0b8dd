"""Files with some wrong bytes, worked on by `python mutants.py FOLDER SEED COUNT`.

It prints the number of a mutant before it is worked on, and what is no sentence after it. The
process ends when one takes too long or asks for too much memory.
"""

import functools
import os
import signal
import struct
import sys
from pathlib import Path

import numpy as np
from conftest import las_bytes, vlr

from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.extrabytes import ExtraDimension
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.reading import inspect, read_cloud
from bare_earth.algorithms.las.writing import write_changed, write_classified
from bare_earth.algorithms.survey.collection import open_collection
from bare_earth.algorithms.survey.vpc import write_vpc
from bare_earth.algorithms.survey.window import read_window

MEMORY, SECONDS = 4 << 30, 10
WKT = b'PROJCS["p",GEOGCS["g",UNIT["degree",0.01745]],UNIT["metre",1],AUTHORITY["EPSG","25832"]]'
KEYS = struct.pack("<12H", 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 25832)
EXTRA = struct.pack("<2xBB32s156x", 3, 0, b"amount")
# What a counter, a length, a place or a coordinate may be at its worst.
NUMBERS = {
    "<B": (0, 1, 0x7F, 0x80, 0xFF),
    "<H": (0, 1, 0x7FFF, 0xFFFF),
    "<I": (0, 1, 0x7FFFFFFF, 0xFFFFFFFF, 10**6, 10**9),
    "<Q": (0, 1, 1 << 31, 1 << 40, (1 << 63) - 1, 1 << 63, (1 << 64) - 1),
    "<d": (0.0, -1.0, 1e-300, 1e300, float("inf"), float("nan"), 1e6, 1e12, -1e12),
}


def originals(folder):
    """Return sound files of all kinds, as bytes by their suffix."""
    records = [vlr(b"LASF_Projection", 2112, WKT), vlr(b"LASF_Projection", 34735, KEYS)]
    extra = vlr(b"LASF_Spec", 4, EXTRA)
    found = []
    for point_format in (1, 3, 6, 7):
        for compressed in (False, True):
            content = las_bytes(
                version=4 if point_format > 5 else 2,
                point_format=point_format,
                compressed=compressed,
                extra=2,
                vlrs=[*records, extra],
                encoding=0x10 if point_format > 5 else 0,
            )
            found.append((".laz" if compressed else ".las", content))
    plain, copc = folder / "plain.las", folder / "plain.copc.laz"
    plain.write_bytes(las_bytes(version=4, point_format=6, vlrs=records, count=2000))
    write_classified(plain, copc, np.zeros(2000, np.uint8))
    return [*found, (".copc.laz", copc.read_bytes()), (".copc.laz", copc.read_bytes())]


def mutant(originals, random):
    """Return the suffix and the bytes of a file of which up to four numbers are wrong."""
    suffix, content = originals[random.integers(len(originals))]
    data = bytearray(content)
    start = struct.unpack_from("<I", data, 96)[0]
    for _ in range(random.integers(1, 5)):
        # Header and records, then the table of the chunks and what else is behind the points.
        parts = ((0, 375), (227, start + 60), (len(data) - 400, len(data)), (0, len(data)))
        low, high = parts[random.choice(4, p=(0.4, 0.3, 0.2, 0.1))]
        at = int(random.integers(max(low, 0), min(high, len(data)) - 8))
        kind = list(NUMBERS)[random.integers(len(NUMBERS))]
        value = NUMBERS[kind][random.integers(len(NUMBERS[kind]))]
        struct.pack_into(kind, data, at, value)
    if random.random() < 0.1:
        del data[int(random.integers(len(data))) :]
    return suffix, bytes(data)


def actions(source):
    """Yield what may be done with a file, one after the other."""
    yield lambda: inspect(source).lines()
    count = open_las(source).count
    classes = np.arange(count, dtype=np.int64).astype(np.uint8) % 5
    for suffix in (".las", ".laz", ".copc.laz"):
        target = source.with_name(f"out{suffix}")
        yield functools.partial(write_classified, source, target, classes)
    values = np.zeros(count, np.float32)
    extra = Edits(extra=ExtraDimension("height", "of it", values), kept=classes > 1)
    yield lambda: write_changed(source, source.with_name("out.las"), extra)
    yield lambda: read_cloud(source).points(slice(None))
    yield lambda: read_window(source, (4e5, 5e6, 4e5 + 3, 5e6 + 3))
    yield lambda: write_vpc(source.with_name("all.vpc"), [source])
    yield lambda: open_collection([source])


def work_on(source):
    """Do all of it; only a `BareEarthError` may come of it, and no second line of it."""
    following = actions(source)
    while True:
        try:
            action = next(following, None)
            if action is None:
                return
            action()
        except BareEarthError as error:
            if "\n" in str(error):
                raise ValueError("two lines") from error


def main(folder, seed, count):
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    before = originals(folder)
    for number in range(count):
        random = np.random.default_rng([seed, number])
        suffix, data = mutant(before, random)
        source = folder / f"mutant{suffix}"
        source.write_bytes(data)
        print(number, flush=True)
        signal.alarm(SECONDS)
        try:
            work_on(source)
        except Exception as error:
            where = error.__traceback__
            while where.tb_next is not None:
                where = where.tb_next
            place = f"{Path(where.tb_frame.f_code.co_filename).name}:{where.tb_lineno}"
            print(f"mutant {number}: {type(error).__name__} at {place}: {error}", flush=True)
        signal.alarm(0)
        for each in folder.glob("out.*"):
            os.unlink(each)


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
