"""Labelled clouds are downloaded from public sources, rebuilt and checked."""

import base64
import dataclasses
import json
from pathlib import Path

import laspy
import numpy as np
import pytest
from realdata import real
from remote_server import serving

from bare_earth.algorithms.core.progress import SILENT
from benchmarks import data
from benchmarks.data import __main__ as command
from benchmarks.data import manifest, rebuilding
from benchmarks.data.fetching import Fetching
from benchmarks.data.manifest import Entry, Source, sha256

STATED = {"licence": "CC0", "data_licence": "CC0", "land": "", "good_for": "", "bytes": 0}


@pytest.fixture
def server():
    with serving() as running:
        yield running


def points(count=50, seed=1):
    generator = np.random.default_rng(seed)
    header = laspy.LasHeader(point_format=1, version="1.2")
    header.scales, header.offsets = np.full(3, 0.01), np.zeros(3)
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = generator.uniform(0, 20, (3, count))
    cloud.classification = generator.choice([1, 2], count).astype(np.uint8)
    cloud.return_number = np.ones(count, np.uint8)
    cloud.number_of_returns = np.ones(count, np.uint8)
    cloud.gps_time = generator.permutation(count).astype(np.float64)
    return cloud


def las_bytes(tmp_path, cloud, name="source.las"):
    cloud.write(tmp_path / name)
    return (tmp_path / name).read_bytes()


def entry_of(server, name, sources, steps, expected, **more):
    """Return an entry whose sources a server gives; `expected` is a file with its points."""
    given = []
    for number, content in enumerate(sources):
        address = server.add(f"{name}/{number}.bin", content)
        given.append(Source(address, len(content), sha256(content)))
    known = rebuilding.digests(expected)
    return Entry(
        f"real/{name}.laz", name, sources=tuple(given), steps=steps, **STATED, **known, **more
    )


def written(path, cloud, chosen):
    part = laspy.LasData(cloud.header, cloud.points[chosen])
    part.write(path)
    return path


def test_a_file_is_copied_or_compressed(server, tmp_path):
    cloud = points()
    content = las_bytes(tmp_path, cloud)
    copied = entry_of(server, "copied", [content], (("copy",),), tmp_path / "source.las")
    packed = entry_of(server, "packed", [content], (("to_laz",),), tmp_path / "source.las")
    assert Fetching(tmp_path / "data", SILENT).run([copied, packed]) == []
    assert (tmp_path / "data/real/copied.laz").read_bytes() == content
    assert np.array_equal(laspy.read(tmp_path / "data/real/packed.laz").X, cloud.X)
    assert not (tmp_path / "data/sources").exists()


def test_several_files_are_joined_cropped_and_sorted(server, tmp_path):
    cloud = points(200)
    halves = [
        laspy.LasData(cloud.header, cloud.points[part]) for part in (slice(90), slice(90, 200))
    ]
    sources = [las_bytes(tmp_path, half, f"{n}.las") for n, half in enumerate(halves)]
    inside = np.flatnonzero((cloud.x >= 5.005) & (cloud.y < 12.005))
    order = inside[np.lexsort([cloud.X[inside], cloud.Y[inside] // 500])]
    expected = written(tmp_path / "expected.las", cloud, order)
    steps = (
        ("read", "las"), ("crop", {"xmin": 5.005, "ymax": 12.005}), ("grid", 0.01),
        ("sort", {"strip": 5.0, "by": "X"}), ("write", {"point_format": 1, "keep": "all"}),
    )  # fmt: skip
    entry = entry_of(server, "joined", sources, steps, expected, offsets=(0.0, 0.0, 0.0))
    assert Fetching(tmp_path / "data", SILENT).run([entry]) == []
    times = laspy.read(tmp_path / "data/real/joined.laz").gps_time
    assert np.array_equal(times, cloud.gps_time[order])


@pytest.mark.parametrize("kind", ["text", "ply"])
def test_classes_are_made_of_labels_and_repeats_dropped(server, tmp_path, kind):
    rows = [(1.0, 2.0, 3.0, 0), (4.0, 5.0, 6.0, 1), (1.001, 2.0, 3.0, 0)]
    if kind == "text":
        content = "\n".join(" ".join(map(str, row)) for row in rows).encode()
        read = ("read", {"as": "text", "columns": ["x", "y", "z", "label"]})
    else:
        types = [("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("label", "<i4")]
        names = "".join(f"property {'int' if n == 'label' else 'double'} {n}\n" for n, _ in types)
        head = f"ply\nformat binary_little_endian 1.0\nelement vertex 3\n{names}end_header\n"
        content = head.encode() + np.array(rows, types).tobytes()
        read = ("read", "ply")
    header = laspy.LasHeader(point_format=0, version="1.2")
    header.scales, header.offsets = np.full(3, 0.01), np.zeros(3)
    cloud = laspy.LasData(header)
    cloud.X, cloud.Y, cloud.Z = np.array([[100, 400], [200, 500], [300, 600]])
    cloud.classification, cloud.return_number = np.array([2, 1]), np.ones(2, np.uint8)
    cloud.number_of_returns = np.ones(2, np.uint8)
    cloud.write(tmp_path / "expected.las")
    steps = (
        read, ("remap", {"from": "label", "to": {"0": 2, "1": 1}}), ("grid", 0.01), ("unique",),
        ("write", {"point_format": 0, "keep": ["classification"],
                   "set": {"return_number": 1, "number_of_returns": 1}}),
    )  # fmt: skip
    entry = entry_of(
        server, kind, [content], steps, tmp_path / "expected.las", offsets=(0.0, 0.0, 0.0)
    )
    assert Fetching(tmp_path / "data", SILENT).run([entry]) == []


def test_a_missing_source_is_one_sentence_and_the_others_go_on(server, tmp_path):
    content = las_bytes(tmp_path, points())
    gone, good = (
        entry_of(server, name, [content], (("copy",),), tmp_path / "source.las")
        for name in ("gone", "good")
    )
    del server.files["gone/0.bin"]
    (failed,) = Fetching(tmp_path / "data", SILENT).run([gone, good])
    assert failed.startswith("gone: ") and "404" in failed
    assert (tmp_path / "data/real/good.laz").exists()
    assert not (tmp_path / "data/real/gone.laz").exists()


@pytest.mark.parametrize("change", [b"", b"more"])
def test_a_changed_source_is_refused(server, tmp_path, change):
    content = las_bytes(tmp_path, points())
    entry = entry_of(server, "changed", [content], (("copy",),), tmp_path / "source.las")
    server.add(
        "changed/0.bin", (change or content[:-1] + b"?") + content[: 0 if not change else None]
    )
    (failed,) = Fetching(tmp_path / "data", SILENT).run([entry])
    assert "another version" in failed and not (tmp_path / "data/real").exists()
    server.add("changed/0.bin", content)
    assert Fetching(tmp_path / "data", SILENT).run([entry]) == []


def test_a_stopped_download_goes_on_where_it_was(server, tmp_path, monkeypatch):
    content = las_bytes(tmp_path, points(400))
    monkeypatch.setattr("benchmarks.data.fetching._PIECE", 1000)
    entry = entry_of(server, "long", [content], (("copy",),), tmp_path / "source.las")
    server.fault = lambda number, path: "403" if number >= 6 else ""
    assert len(Fetching(tmp_path / "data", SILENT).run([entry])) == 1
    parts = tmp_path / "data/sources/long" / f"{entry.sources[0].sha256[:12]}-0.bin.parts"
    kept = {path.name for path in parts.iterdir()} - {"about.json"}
    before = len(server.asked)
    server.fault = lambda number, path: ""
    assert len(kept) >= 4 and Fetching(tmp_path / "data", SILENT).run([entry]) == []
    # As ranges: a request of the stopped run may arrive late.
    asked = {ranges for _, ranges, *_ in server.asked[before:]}
    assert len(asked) == -(-len(content) // 1000) - len(kept)


def test_other_points_than_measured_are_refused_and_not_replaced(server, tmp_path):
    content = las_bytes(tmp_path, points())
    entry = entry_of(server, "tile", [content], (("copy",),), tmp_path / "source.las")
    wrong = dataclasses.replace(entry, points_sha256="?")
    (failed,) = Fetching(tmp_path / "data", SILENT).run([wrong])
    assert "differs" in failed
    assert not (tmp_path / "data/real/tile.laz").exists()
    (tmp_path / "data/real").mkdir(exist_ok=True)
    points(seed=2).write(tmp_path / "data/real/tile.laz")
    (failed,) = Fetching(tmp_path / "data", SILENT).run([entry])
    assert "holds other points" in failed


def test_a_server_that_fails_twice_is_not_asked_for_the_others(server, tmp_path, monkeypatch):
    content = las_bytes(tmp_path, points())
    entries = [
        entry_of(server, f"tile-{n}", [content], (("copy",),), tmp_path / "source.las")
        for n in range(4)
    ]
    server.fault = lambda number, path: "407"
    failed = Fetching(tmp_path / "data", SILENT).run(entries)
    assert len(failed) == 3 and failed[-1].startswith("2 clouds more were not tried")


def test_the_manifest_has_all_clouds_and_is_compact():
    path = Path(manifest.__file__).with_name("manifest.json")
    known = {entry.file: entry for entry in manifest.entries()}
    assert path.stat().st_size <= 60_000 and len(known) == 37
    assert {f"real/{tile.name}" for tile in data.REAL} <= {*known}
    samples = [file for file in known if file.startswith("isprs/")]
    assert len(samples) == 9 and known[samples[1]].steps == known[samples[0]].steps
    for entry in known.values():
        assert entry.licence and entry.data_licence and entry.good_for
        for source in entry.sources:
            assert (
                "*" not in source.address
                and len(base64.urlsafe_b64decode(f"{source.sha256}=")) == 32
            )


def test_clouds_are_listed(monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["data", "list", "rock_mountain"])
    assert command.main() == 0
    shown = capsys.readouterr().out
    assert "BSD-3-Clause" in shown and "38,367 points" in shown


def test_the_public_sources_that_are_here_give_the_measured_points(server, tmp_path):
    folder = real("sources.json").parent / "sources"
    entries = []
    for entry in manifest.chosen(["samp54", "rock_mountain", "city_court", "campus_terraces"]):
        given = []
        for source in entry.sources:
            digest = base64.urlsafe_b64decode(f"{source.sha256}=").hex()
            address = server.add(digest, (folder / digest).read_bytes())
            given.append(dataclasses.replace(source, address=address))
        entries.append(dataclasses.replace(entry, sources=tuple(given)))
    assert Fetching(tmp_path, SILENT).run(entries) == []


def test_digests_of_a_file_are_printed(monkeypatch, capsys, tmp_path):
    las_bytes(tmp_path, points())
    monkeypatch.setattr("sys.argv", ["data", "digest", str(tmp_path / "source.las")])
    assert command.main() == 0
    assert json.loads(capsys.readouterr().out)["points"] == 50
