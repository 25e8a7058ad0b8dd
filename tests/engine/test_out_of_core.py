import gc
import os
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import laspy
import numpy as np
import pytest
from fulldisks import TELLS, become_full
from matrices import covering
from realdata import real
from runs import FAST, CancelAt, Heard, environment
from surveys import write_points

import bare_earth
from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.core import disk_arrays
from bare_earth.algorithms.engine import disk_store
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.las import copc, copc_octree, copc_points, reading
from bare_earth.algorithms.tools.ground import step

# The methods, with the preset of few rules: those that are all the same in memory and on disk.
METHODS = {"tin-densification": "lidar360", "grid-minimum": "paper", "slope": "whitebox"}
# The least that can be given: 8,000 points do not fit.
LITTLE = {"threads": 2, "memory": 0.001}
MUCH = {"threads": 2, "memory": 4.0}
SIZES = {"much": MUCH, "little": LITTLE}
EAST, NORTH = 500_000.0, 5_700_000.0
LONG = pytest.mark.long


@pytest.fixture
def small(monkeypatch):
    """Make parts and blocks small, so that a small file has many."""
    monkeypatch.setattr(reading, "_CHUNK", 1700)
    monkeypatch.setattr(disk_store, "_GAP", 50)
    blocks = Blocks(80.0, 30.0, most_points=2500)
    monkeypatch.setattr(step, "blocks_of", lambda parameters: blocks)


@pytest.fixture
def small_nodes(monkeypatch):
    """Let an octree have many nodes; return a list of those whose points wait on disk."""
    made = []

    def noting(branch, *rest):
        made.append(branch)
        return waiting_points(branch, *rest)

    waiting_points = copc.WaitingPoints
    monkeypatch.setattr(copc, "WaitingPoints", noting)
    monkeypatch.setattr(copc_octree, "_LEAF_POINTS", 1500)
    monkeypatch.setattr(copc_octree, "_BYTES_TO_SORT", 1000)
    monkeypatch.setattr(copc_points, "_MOST_AT_ONCE", 700)
    return made


def write(path, count=9000, east=EAST, stray=(), seed=3, shape=(160.0, 90.0), first=0.0):
    """Write a strip with houses and trees, its points in no order, of several classes."""
    random = np.random.default_rng(seed)
    x, y = (random.uniform(0, side, count) for side in shape)
    z = 0.06 * x + 2 * np.sin(y / 25) + random.normal(0, 0.03, count)
    z[(x % 45 < 12) & (y % 35 < 10)] += 6.0
    z[random.choice(count, 8, replace=False)] -= 15.0
    x[0] = first
    x[1 : 1 + len(stray)] = stray
    classes = random.choice([1, 2, 5, 7, 9], count, p=[0.5, 0.3, 0.1, 0.05, 0.05])
    returns = random.integers(1, 4, count)
    return write_points(
        path, x, y, z + 100, classes, offset=(east, NORTH, 0.0), scale=0.01,
        number_of_returns=returns, return_number=random.integers(1, returns + 1),
        withheld=random.random(count) < 0.01,
    )  # fmt: skip


def run(source, folder, method, resources, rasters=(), **options):
    """Classify a file; return the summary and the bytes of all outputs by their names."""
    folder.mkdir()
    files = {name: folder / f"{name}.tif" for name in rasters}
    summary = bare_earth.classify(
        source, folder / "out.laz", method=method, preset=METHODS[method], **resources, **files,
        **options,
    )  # fmt: skip
    return summary, {path.name: path.read_bytes() for path in folder.iterdir()}


def same_in_memory_and_on_disk(source, folder, method, **options):
    """Return the summary of runs with much and with little memory, whose outputs are the same."""
    much, little = (
        run(source, folder / name, method, resources, **options)
        for name, resources in SIZES.items()
    )
    assert much == little
    return much[0]


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize(
    ("method", "options"),
    [
        # The methods by themselves are left to the long tests where another line has them.
        ("tin-densification", {"low_noise_class": True}),
        pytest.param("grid-minimum", {"low_noise_class": True}, marks=LONG),
        pytest.param("slope", {"low_noise_class": True}, marks=LONG),
        ("slope", {"seed_classes": (9,), "returns": "all", "others": "unclassified"}),
        pytest.param("slope", {"seed_classes": (9,), "from_classes": (1, 2, 7)}, marks=LONG),
        ("grid-minimum", {"extent": (EAST + 20, NORTH + 10, EAST + 110, NORTH + 60)}),
    ],
)
def test_the_same_bytes_in_memory_and_on_disk(small, tmp_path, method, options):
    source = write(tmp_path / "in.las", 8000, shape=(130.0, 70.0))
    progress = much, little = Heard(), Heard()
    results = [
        run(
            source, tmp_path / name, method, SIZES[name], ("dtm", "hillshade"), dtm_cell_size=2.0,
            progress=told, **options,
        )
        for name, told in zip(SIZES, progress)
    ]  # fmt: skip
    assert results[0] == results[1]
    assert results[0][0].ground_count > 500 and len(results[0][1]) == 3
    assert not any("read twice" in text for text in much.infos)
    infos = [text for text in little.infos if "read twice" not in text]
    assert infos == much.infos and len(infos) == len(little.infos) - 1
    assert much.warnings == little.warnings
    assert little.fractions[-1] == 1.0 and little.fractions == sorted(little.fractions)


@pytest.mark.rest
@pytest.mark.parametrize("name", [pytest.param("isprs/samp52.laz", marks=LONG), "real/ign_pf8.las"])
def test_real_points_give_the_same_bytes_in_memory_and_on_disk(name, tmp_path):
    same_in_memory_and_on_disk(real(name), tmp_path, "grid-minimum", rasters=("dtm",))


@pytest.mark.rest
def test_ground_points_only_in_memory_and_on_disk(small, tmp_path):
    source = write(tmp_path / "in.las", 8000, shape=(130.0, 70.0))
    summary = same_in_memory_and_on_disk(source, tmp_path, "grid-minimum", ground_only=True)
    assert summary.class_counts == {2: summary.ground_count}


@pytest.mark.rest
@pytest.mark.parametrize(
    ("name", "free"),
    [*(pytest.param(name, 0, marks=LONG) for name in ("in.las", "in.laz")), ("in.laz", 1 << 40)],
)
def test_heights_above_ground_in_memory_and_on_disk(small, tmp_path, monkeypatch, name, free):
    # A compressed file is kept on a disk with room, so that it is decompressed once.
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=free))
    source = write(tmp_path / name, 8000, shape=(130.0, 70.0))
    same_in_memory_and_on_disk(source, tmp_path, "grid-minimum", height_above_ground=True)
    for form in ("z", "dimension"):
        for size, resources in SIZES.items():
            classified, target = tmp_path / "much" / "out.laz", tmp_path / f"{size}.las"
            bare_earth.heights(classified, target, output_as=form, **resources)
        assert (tmp_path / "much.las").read_bytes() == (tmp_path / "little.las").read_bytes()


# Stray points


@pytest.mark.rest(but="tin-densification")
@pytest.mark.parametrize(("method", "size"), covering(list(METHODS), list(SIZES)))
def test_a_stray_point_far_away_stops_nothing(method, size, tmp_path):
    source = write(tmp_path / "in.las", 8000, stray=(1e6, 1e6, 1e6))
    summary, _ = run(source, tmp_path / "out", method, SIZES[size])
    assert 1000 < summary.ground_count < 7900
    if method != "slope":
        return  # a raster knows no method
    _, files = run(source, tmp_path / "dtm", method, SIZES[size], rasters=("dtm",))
    assert len(files["dtm.tif"]) < 10_000_000  # land without points takes no room


# Limits


@pytest.mark.rest
@pytest.mark.parametrize("kind", [pytest.param("las", marks=LONG), "laz"])
def test_a_copc_file_is_made_of_points_that_do_not_fit(small, small_nodes, kind, tmp_path):
    source, sorted_on_disk = write(tmp_path / f"in.{kind}"), []
    for size, resources in SIZES.items():
        copc_file = tmp_path / f"{size}.copc.laz"
        bare_earth.classify(source, copc_file, method="grid-minimum", preset="paper", **resources)
        bare_earth.heights(copc_file, tmp_path / f"height-{copc_file.name}", **resources)
        sorted_on_disk.append(len(small_nodes))
    assert sorted_on_disk[0] == 0 < sorted_on_disk[1]
    for name in ("", "height-"):
        much, little = (tmp_path / f"{name}{size}.copc.laz" for size in SIZES)
        assert much.read_bytes() == little.read_bytes()
        assert bare_earth.info(little).encoding == "COPC"
    with laspy.CopcReader.open(little) as reader:
        assert len(reader.query()) == 9000 > len(reader.query(level=0))
    assert len(os.listdir(tmp_path)) == 5


def test_a_copc_file_stays_one_though_it_does_not_fit(tmp_path):
    plain, source = write(tmp_path / "in.las", 8000), tmp_path / "in.copc.laz"
    bare_earth.classify(plain, source, **FAST)
    for size, resources in SIZES.items():
        bare_earth.classify(source, tmp_path / f"{size}.copc.laz", **FAST, **resources)
    much, little = (tmp_path / f"{size}.copc.laz" for size in SIZES)
    assert much.read_bytes() == little.read_bytes()
    assert bare_earth.info(little).encoding == "COPC"
    assert 1000 < bare_earth.info(little).classes[2] < 7900


@TELLS
@pytest.mark.parametrize("spared", [0, 1])  # the points, or their labels alone
def test_a_full_disk_is_told_in_a_sentence(tmp_path, monkeypatch, small, tells, spared):
    source = write(tmp_path / "in.las")
    become_full(monkeypatch, 0, tells, spared)
    with pytest.raises(BareEarthError, match=r"out\.laz: .*disk.* full"):
        run(source, tmp_path / "out", "slope", LITTLE, returns="all")
    assert not list((tmp_path / "out").iterdir())


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"from_classes": (64,)}, r"only the classes 1, 2, 5, 7, 9\b"),
        ({"to_class": 255, "extent": (0, 0, 1, 1)}, "points lie in x 500000 to"),
    ],
)
def test_the_same_errors_on_disk(options, words, tmp_path):
    with pytest.raises(BareEarthError, match=words):
        run(write(tmp_path / "in.las", 8000), tmp_path / "out", "slope", LITTLE, **options)


# Ends


@pytest.mark.rest(but="0.3-much")
@pytest.mark.parametrize(("fraction", "size"), covering((0.3, 0.6, 0.95), list(SIZES)))
def test_a_cancel_leaves_nothing(small, fraction, size, tmp_path):
    source = write(tmp_path / "in.las", 8000, shape=(130.0, 70.0))
    progress = CancelAt(fraction)
    with pytest.raises(Cancelled):
        run(source, tmp_path / "out", "grid-minimum", SIZES[size], ("dtm",), progress=progress)
    assert os.listdir(tmp_path / "out") == [] and progress.last >= fraction


_RUN = """
import sys
from pathlib import Path
import numpy as np
from bare_earth.algorithms import cli
import bare_earth.algorithms.{module} as module
def late(*arguments, **options):
    print("begun", flush=True)
    {wait}
module.{name} = late
sys.exit(cli.main(sys.argv[1:]))
"""


@pytest.mark.rest
@pytest.mark.skipif(os.name == "nt", reason="Windows ends a process without telling it")
@pytest.mark.parametrize(
    ("module", "number"),
    [("tools.ground.labelling", signal.SIGTERM), ("engine.file_run", signal.SIGKILL)],
)
def test_a_killed_run_leaves_nothing_beside_the_output(module, number, tmp_path):
    # In the middle of the blocks, and when they are about to begin.
    name = "_labels" if module == "tools.ground.labelling" else "visited"
    wait = "import time; [time.sleep(0.1) or arguments[-1](0.5) for _ in range(300)]"
    if module == "engine.file_run":
        wait = "import time; time.sleep(30)"
    source, out = write(tmp_path / "in.las", 9000), tmp_path / "out"
    out.mkdir()
    process = subprocess.Popen(
        [
            sys.executable, "-c", _RUN.format(module=module, name=name, wait=wait), "classify",
            str(source), str(out / "out.laz"), "--method", "slope", "--memory", "0.001",
        ],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env=environment(),
    )  # fmt: skip
    assert process.stdout.readline() == "begun\n"
    process.send_signal(number)
    _, said = process.communicate(timeout=20)  # what it works on would take longer
    assert process.returncode != 0
    assert os.listdir(out) == []
    if number == signal.SIGTERM:
        assert process.returncode == 1 and "nothing was written" in said


def test_a_block_without_cells_is_read_from_disk(tmp_path):
    # Blocks are cut where memory is short, and some then have points only round them.
    np.savez(tmp_path / "block.npz", none=np.zeros((3, 0)), some=np.arange(6).reshape(3, 2))
    rows = disk_arrays.rows_in(tmp_path / "block.npz")
    assert rows["none"][:, :].shape == (3, 0)
    assert rows["some"][1:3, :].tolist() == [[2, 3], [4, 5]]


def test_threads_read_the_arrays_of_blocks_at_once(tmp_path):
    # Threads that hand over while they parse, as they may when garbage is collected.
    np.savez(tmp_path / "block.npz", **{str(number): np.zeros(5) for number in range(30)})

    def hand_over(*_):
        time.sleep(0)

    before, switching = gc.get_threshold(), sys.getswitchinterval()
    gc.callbacks.append(hand_over)
    gc.set_threshold(20)
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(8) as pool:
            paths = [tmp_path / "block.npz"] * 300
            found = list(pool.map(lambda path: len(disk_arrays.rows_in(path)), paths))
    finally:
        gc.callbacks.remove(hand_over)
        gc.set_threshold(*before)
        sys.setswitchinterval(switching)
    assert found == [30] * 300
