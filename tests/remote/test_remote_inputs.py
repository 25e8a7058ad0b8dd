"""Point clouds given by their addresses: the same results as of files, fetched once."""

import json
import re
import sys
import threading
from pathlib import Path

import laspy
import numpy as np
import pytest
from remote_server import serving
from runs import FAST_WORDS, said
from surveys import ORIGIN, strip, write, write_classified, write_points

import bare_earth
from bare_earth import BareEarthError, arrays
from bare_earth.algorithms.las import copc_octree
from bare_earth.algorithms.library.remote_points import margin_of
from bare_earth.algorithms.remote import files, whole
from bare_earth.algorithms.remote.cache import cache_of
from bare_earth.algorithms.remote.parts import Parts, remove_parts
from bare_earth.algorithms.tools.ground.method import TileMethod

WEST, SOUTH = ORIGIN[:2]
BOX = (WEST + 100, SOUTH + 20, WEST + 180, SOUTH + 90)
EXTENT = ("--extent", *BOX)
# Looks only a few metres round the area, so that a part of the file is enough.
NEAR = {"method": "slope", "preset": "whitebox", "search_radius": 3.0}
SECRET = "sig=s3cr3t"


@pytest.fixture
def server(monkeypatch, tmp_path):
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path / "cache"))
    with serving() as running:
        yield running


@pytest.fixture(scope="module")
def tiles(tmp_path_factory):
    """Return two COPC files of many nodes, side by side."""
    folder = tmp_path_factory.mktemp("tiles")
    integers = strip(60_000, 600.0)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(copc_octree, "_LEAF_POINTS", 300)
        patch.setattr(copc_octree, "_SMALL_NODE", 20)
        for name, inside in (("west", integers[:, 0] < 30_000), ("east", integers[:, 0] >= 30_000)):
            write(folder / "plain.las", integers[inside])
            classes = np.full(np.count_nonzero(inside), 2, np.uint8)
            write_classified(folder / "plain.las", folder / f"{name}.copc.laz", classes)
    return folder / "west.copc.laz", folder / "east.copc.laz"


def labels_in(path, box=BOX):
    """Return coordinates and classes of the points of a file in a box, in order."""
    las = laspy.read(path)
    inside = (las.x >= box[0]) & (las.x <= box[2]) & (las.y >= box[1]) & (las.y <= box[3])
    rows = np.column_stack((las.X, las.Y, las.Z, las.classification))[inside]
    return rows[np.lexsort(rows.T)]


def add(server, path):
    return f"{server.add(path.name, path.read_bytes())}?{SECRET}"


def cached(tmp_path):
    return sorted((tmp_path / "cache").rglob("*.laz"))


@pytest.mark.rest
def test_a_part_gives_the_labels_of_the_whole_file(server, tiles, tmp_path):
    here, remote = tmp_path / "here.laz", tmp_path / "remote.laz"
    bare_earth.classify(tiles[0], here, extent=BOX, **NEAR)
    bare_earth.classify(add(server, tiles[0]), remote, extent=BOX, **NEAR)
    assert np.array_equal(labels_in(here), labels_in(remote)) and len(labels_in(here)) > 500
    assert laspy.read(remote).header.point_count < laspy.read(here).header.point_count / 2


@pytest.mark.rest
@pytest.mark.parametrize(
    "crs, metre, rasters, margin",
    [
        ("EPSG:25832", 1.0, (), 180),
        ("EPSG:2230", 3937 / 1200, (), 180),
        ("EPSG:2230", 3937 / 1200, ("dtm",), 400),
    ],
)
def test_the_margin_is_in_units_of_the_points(server, tmp_path, crs, metre, rasters, margin):
    x, y = np.random.default_rng(1).uniform(0, 4000, (2, 20_000))
    plain, source = tmp_path / "plain.las", tmp_path / "feet.copc.laz"
    write_points(plain, x, y, 0.01 * x, crs=crs)
    write_classified(plain, source, np.full(len(x), 1, np.uint8))
    box = (WEST + 1900, SOUTH + 1900, WEST + 2100, SOUTH + 2100)
    written = {name: tmp_path / f"{name}.tif" for name in rasters}
    bare_earth.classify(add(server, source), tmp_path / "out.laz", extent=box, **written)
    header = laspy.read(cached(tmp_path)[0]).header
    sides = (header.maxs - header.mins)[:2]
    assert np.all(sides <= 200 + 2 * margin * metre) and np.all(sides > 120 + 2 * margin * metre)
    here = tmp_path / "here.laz"
    bare_earth.classify(source, here, extent=box, **written)
    assert np.array_equal(labels_in(here, box), labels_in(tmp_path / "out.laz", box))


@pytest.mark.rest
def test_a_delivery_is_made_of_an_address(server, tiles, tmp_path):
    pytest.importorskip("rasterio")
    code, _, errors = said("deliver", "survey", add(server, tiles[0]), tmp_path / "out", *EXTENT)
    assert code == 0, errors
    assert any("west" in path.name for path in (tmp_path / "out").rglob("*.laz"))


@pytest.mark.rest
def test_a_raster_is_that_of_the_file(server, tiles, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    rasters = []
    for name, source in (("here.tif", tiles[0]), ("remote.tif", add(server, tiles[0]))):
        bare_earth.terrain(source, dtm=tmp_path / name, extent=BOX)
        with rasterio.open(tmp_path / name) as raster:
            rasters.append((raster.read(1), raster.transform))
    assert np.array_equal(rasters[0][0], rasters[1][0]) and rasters[0][1] == rasters[1][1]


def test_the_second_run_makes_one_request_with_any_signature(server, tiles, tmp_path):
    address = add(server, tiles[0])
    words = ("--method", "slope", "--preset", "whitebox", *EXTENT)
    assert said("classify", address, tmp_path / "a.laz", *words)[0] == 0
    server.asked.clear()
    again = address.replace("s3cr3t", "0ther")
    assert said("classify", again, tmp_path / "b.laz", *words)[0] == 0
    assert len(server.asked) == 1
    assert (tmp_path / "a.laz").read_bytes() == (tmp_path / "b.laz").read_bytes()
    assert [path.name for path in cached(tmp_path)] == ["west.copc.laz"]


def test_a_changed_object_is_fetched_anew(server, tiles, tmp_path):
    address = add(server, tiles[0])
    before = bare_earth.info(address)
    server.etags[tiles[0].name] = '"another"'
    server.files[tiles[0].name] = tiles[1].read_bytes()
    after = bare_earth.info(address)
    assert before.point_count == laspy.read(tiles[0]).header.point_count
    assert after.point_count == laspy.read(tiles[1]).header.point_count
    assert before != after


def test_too_much_without_an_area_is_refused(server, tiles, tmp_path):
    address = add(server, tiles[0])
    code, _, errors = said("classify", address, tmp_path / "out.laz", "--limit", "0.00001")
    assert code == 1 and "limit of 10.0 kB" in errors
    assert re.search("--extent or --boundary.* --limit 0.1", errors)
    assert not cached(tmp_path) and not (tmp_path / "out.laz").exists()
    with pytest.raises(BareEarthError, match=r"with bare_earth\.fetch"):
        bare_earth.info(address, limit=0.00001)
    assert said("key-points", address, tmp_path / "out.laz")[0] == 0


@pytest.mark.rest
def test_two_addresses_are_one_survey(server, tiles, tmp_path):
    box = (WEST + 250, SOUTH + 20, WEST + 350, SOUTH + 90)
    done = bare_earth.classify(tiles, tmp_path / "here", extent=box, **NEAR)
    addresses = [add(server, path) for path in tiles]
    again = bare_earth.classify(addresses, tmp_path / "remote", extent=box, **NEAR)
    assert done.tile_count == again.tile_count == 2
    for path in tiles:
        pair = [labels_in(tmp_path / folder / path.name, box) for folder in ("here", "remote")]
        assert np.array_equal(*pair) and len(pair[0])
    # The files stay those of an earlier run, whatever the signature.
    other = [address.replace("s3cr3t", "0ther") for address in addresses]
    last = bare_earth.classify(other, tmp_path / "remote", extent=box, resume=True, **NEAR)
    assert last.kept_count == 2


def test_a_list_is_a_survey_of_what_lies_in_the_area(server, tiles, tmp_path):
    items = []
    for path, west in zip(tiles, (WEST, WEST + 300)):
        server.add(path.name, path.read_bytes())
        box = [west, SOUTH, west + 300, SOUTH + 130]
        about = {"proj:bbox": box, "proj:epsg": 25832}
        items.append({
            "type": "Feature", "properties": about, "assets": {"data": {"href": f"./{path.name}"}}
        })  # fmt: skip
    content = json.dumps({"type": "FeatureCollection", "features": items}).encode()
    address = server.add("all.vpc", content)
    done = bare_earth.classify(address, tmp_path / "out", extent=BOX, **NEAR)
    assert done.tile_count == 1 and (tmp_path / "out" / tiles[0].name).is_file()
    assert {path for path, *_ in server.asked} == {"all.vpc", tiles[0].name}


def test_secrets_are_nowhere(server, tiles, tmp_path):
    address, said_all = add(server, tiles[0]), ""
    table = tmp_path / "dtm.tif"
    for words in (
        ("classify", address, tmp_path / "out.laz", *EXTENT, *FAST_WORDS),
        ("terrain", address, "--dtm", table, *EXTENT),
        ("info", address),
        ("info", address, "--json"),
        ("quality", address, "--page", tmp_path / "page.html"),
        ("classify", address, tmp_path / "out", *EXTENT, *FAST_WORDS),
        ("classify", address, tmp_path / "out.laz", "--limit", "0", "--cache", tmp_path / "new"),
    ):
        code, *texts = said(*words, "--verbose")
        said_all += "".join(texts)
        assert code == ("--limit" in words), texts
    assert "127.0.0.1" in said_all and "s3cr3t" not in said_all
    for path in tmp_path.rglob("*"):
        assert "s3cr3t" not in str(path)
        assert path.is_dir() or b"s3cr3t" not in path.read_bytes()


def test_the_method_of_many_files_needs_what_it_looks_at():
    filters = [(TileMethod(method="slope", preset="city"), 300.0), (TileMethod(), 180.0)]
    assert [margin_of([values], True) for values, _ in filters] == [far for _, far in filters]


@pytest.mark.rest
def test_the_tutorial_runs(server, tiles, tmp_path, monkeypatch):
    pytest.importorskip("rasterio")
    page = (Path(__file__).parents[2] / "docs" / "fetch.md").read_text(encoding="utf-8")
    page = page.replace("https://data.example.org/tile.copc.laz", add(server, tiles[0]))
    page = page.replace("568100 5931100 568200 5931200", " ".join(map(str, BOX)))
    monkeypatch.chdir(tmp_path)
    lines = page.partition("```sh\n")[2].partition("```")[0].splitlines()
    for line in lines:
        code, text, errors = said(*line.split()[1:])
        assert code == 0, errors
    assert "kB were removed" in text and " 0.0 kB" not in text
    made = ("overview.copc.laz", "ground.laz", "dtm.tif", "hillshade.tif")
    assert len(lines) == 5 and all((tmp_path / name).exists() for name in made)


def test_the_cache_is_cleared_and_nothing_else(server, tiles, tmp_path):
    bare_earth.info(add(server, tiles[0]))
    other = tmp_path / "cache" / "mine.txt"
    other.write_text("mine")
    code, text, _ = said("clear-cache")
    assert code == 0 and "kB were removed" in text and " 0.0 kB" not in text
    assert list((tmp_path / "cache").iterdir()) == [other]
    assert "0.0 kB were removed" in said("clear-cache", "--cache", tmp_path / "none")[1]


def test_outputs_in_the_cache_cannot_replace_what_is_read(server, tiles, tmp_path):
    address = add(server, tiles[0])
    bare_earth.info(address)
    with pytest.raises(BareEarthError, match=r"Input .*same file"):
        bare_earth.classify(address, cached(tmp_path)[0])


@pytest.mark.parametrize(
    "system, variable", [("win32", "LOCALAPPDATA"), ("linux", "XDG_CACHE_HOME")]
)
def test_the_cache_is_where_the_system_has_caches(monkeypatch, tmp_path, system, variable):
    monkeypatch.delenv("BARE_EARTH_CACHE", raising=False)
    monkeypatch.setattr(sys, "platform", system)
    monkeypatch.setenv(variable, str(tmp_path))
    assert cache_of(None) == tmp_path / "bare-earth"


def test_errors_name_the_address(server, tiles, tmp_path):
    extent = WEST + 120.001, SOUTH + 20.001, WEST + 120.002, SOUTH + 20.002
    with pytest.raises(BareEarthError) as told:
        bare_earth.classify(add(server, tiles[0]), tmp_path / "out.laz", extent=extent)
    assert f"No point of {server.address(tiles[0].name)} " in str(told.value)


def test_an_interrupted_run_goes_on(server, tiles, tmp_path):
    address = add(server, tiles[0])
    server.fault = lambda number, path: "403" if number > 1 else ""
    with pytest.raises(BareEarthError, match="refuses"):
        bare_earth.info(address)
    server.fault = lambda number, path: ""
    server.asked.clear()
    assert bare_earth.info(address).point_count == laspy.read(tiles[0]).header.point_count
    assert not cached(tmp_path)[0].with_name("parts").exists()


def test_a_limit_is_a_number(server, tiles):
    with pytest.raises(BareEarthError, match="gigabytes, not nan"):
        bare_earth.info(add(server, tiles[0]), limit=float("nan"))
    assert not server.asked


def test_what_has_no_version_is_fetched_each_time(server, tiles, tmp_path):
    address = add(server, tiles[0])
    server.etags[tiles[0].name] = 'W/"1"'
    for _ in range(2):
        server.asked.clear()
        bare_earth.info(address)
        assert len(server.asked) > 1


@pytest.mark.rest
@pytest.mark.parametrize("ending", ["laz", "las"])
def test_all_of_a_plain_file_is_fetched_once_for_all_areas(server, tmp_path, ending):
    plain = write(tmp_path / f"plain.{ending}", strip(60_000, 600.0))
    address = add(server, plain)
    for box in (BOX, (BOX[0] - 50, *BOX[1:])):
        here, remote = tmp_path / "here.laz", tmp_path / "remote.laz"
        words = "--method", "slope", "--preset", "whitebox", "--extent", *box, "--verbose"
        bare_earth.classify(plain, here, extent=box, method="slope", preset="whitebox")
        code, _, errors = said("classify", address, remote, *words)
        assert code == 0 and remote.read_bytes() == here.read_bytes()
        is_first = box is BOX
        assert ("plain." + ending + " is not COPC, so that no part" in errors) == is_first
        assert ("Downloads " in errors) == is_first
        if not is_first:
            assert len(server.asked) == 1
        server.asked.clear()
    assert [path.read_bytes() for path in cached(tmp_path)] == [plain.read_bytes()] * (
        ending == "laz"
    )
    assert not list((tmp_path / "cache").rglob("parts"))


def test_a_plain_file_obeys_the_limit_and_the_area(server, tmp_path):
    plain = write(tmp_path / "plain.laz", strip(60_000, 600.0))
    address = add(server, plain)
    code, _, errors = said("classify", address, tmp_path / "a.laz", "--limit", "0.0001", *EXTENT)
    assert code == 1 and "plain.laz is not COPC" in errors and "raise the limit" in errors
    far = "--extent", WEST + 9000, SOUTH, WEST + 9100, SOUTH + 100
    assert said("classify", address, tmp_path / "a.laz", *far)[0] == 1
    assert server.sent < plain.stat().st_size and not cached(tmp_path)
    with pytest.raises(BareEarthError, match=r"bare_earth\.classify"):
        bare_earth.fetch(address, tmp_path / "a.laz")


@pytest.mark.rest(but="10-cut")
@pytest.mark.parametrize("fault", ["cut", "short", "no ranges"])
@pytest.mark.parametrize("every", [1, 10])
def test_a_plain_file_is_whole_or_one_sentence(server, tmp_path, fault, every, monkeypatch):
    monkeypatch.setattr(whole, "_PIECE", 20_000)
    plain = write(tmp_path / "plain.laz", strip())
    address = add(server, plain)
    server.fault = lambda number, path: fault if number % every == every - 1 else ""
    code, _, errors = said("info", address)
    if code:
        assert errors.count("\n") == 1 and not cached(tmp_path)
        server.fault = lambda number, path: ""
        assert said("info", address)[0] == 0
    assert cached(tmp_path)[0].read_bytes() == plain.read_bytes()


# What each command needs besides the address: what stands before it, and behind it.
COMMANDS = {
    "classify": ((), ("out.laz",)),
    "deliver": (("survey",), ("out",)),
    "check": ((), ("--checkpoints", "points.csv")),
    "quality": ((), ("--page", "page.html")),
    "height": ((), ("out.laz",)),
    "above-ground": ((), ("out.laz",)),
    "key-points": ((), ("out.laz",)),
    "terrain": ((), ("--dtm", "dtm.tif")),
    "water": ((), ("water.gpkg",)),
    "water-classes": ((), ("out.laz", "--water", "water.geojson")),
    "compare-settings": ((), ("out.html",)),
}


@pytest.fixture(scope="module")
def mercator(tmp_path_factory):
    """Return a cloud in Web Mercator, at a latitude of 46 degrees."""
    folder = tmp_path_factory.mktemp("mercator")
    x, y = np.random.default_rng(1).uniform(0, 300, (2, 20_000))
    write_points(folder / "plain.las", x, y, 0.01 * x, classes=2, crs="EPSG:3857")
    write_classified(folder / "plain.las", folder / "usa.copc.laz", np.full(len(x), 2, np.uint8))
    return folder / "usa.copc.laz"


@pytest.mark.parametrize("command", COMMANDS)
def test_web_mercator_is_refused_before_it_is_downloaded(
    server, mercator, tmp_path, command, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(files, "_FIRST", 2000)
    (tmp_path / "points.csv").write_text("x,y,z\n500100,5700100,1\n")
    ring = [[WEST, SOUTH], [WEST + 9, SOUTH], [WEST, SOUTH + 9], [WEST, SOUTH]]
    (tmp_path / "water.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}))
    before, behind = COMMANDS[command]
    here = sorted(tmp_path.rglob("*"))
    code, _, errors = said(command, *before, add(server, mercator), *behind)
    assert code == 1 and "in a Mercator projection" in errors, errors
    assert "1.43 times too long" in errors and "'bare-earth fetch'" in errors
    assert "pdal translate" in errors and server.sent < mercator.stat().st_size / 2
    assert [path for path in here if not path.exists()] == [] == cached(tmp_path)


@pytest.mark.rest
def test_a_file_in_web_mercator_is_described(server, mercator, tmp_path):
    code, text, _ = said("info", add(server, mercator), "--json")
    assert code == 0 and json.loads(text)["point_count"] == 20_000
    # Whoever states the right CRS in place of a wrong one is not stopped.
    words = "classify", add(server, mercator), tmp_path / "out.laz", "--crs", "EPSG:25832"
    assert said(*words)[0] == 0


def test_a_clip_needs_no_surroundings_and_may_be_in_web_mercator(
    server, tiles, mercator, tmp_path, monkeypatch
):
    monkeypatch.setattr(files, "_FIRST", 2_000)
    monkeypatch.setattr(files, "_WIDEST_GAP", 0)
    bare_earth.clip(tiles[0], tmp_path / "here.laz", extent=BOX)
    bare_earth.clip(add(server, tiles[0]), tmp_path / "out.laz", extent=BOX)
    header = laspy.read(tmp_path / "out.laz").header
    assert header.point_count == len(labels_in(tmp_path / "here.laz")) > 500
    assert np.array_equal(labels_in(tmp_path / "here.laz"), labels_in(tmp_path / "out.laz"))
    assert laspy.read(cached(tmp_path)[0]).header.point_count == header.point_count
    extent = WEST + 100, SOUTH + 100, WEST + 200, SOUTH + 200
    bare_earth.clip(add(server, mercator), tmp_path / "usa.laz", extent=extent)
    whole, part = laspy.read(mercator), laspy.read(tmp_path / "usa.laz")
    assert part.header.point_count == len(labels_in(mercator, extent)) > 1_000
    assert whole.header.parse_crs() == part.header.parse_crs()


def test_every_command_with_addresses_is_tried():
    names = re.findall(r"^    ([a-z-]+)", said("--help")[1], re.MULTILINE)
    with_cache = {name for name in names if "--cache" in said(name, "--help")[1]}
    assert {*COMMANDS, "info", "assess", "clip", "clear-cache"} == with_cache


@pytest.mark.rest
def test_a_moved_area_needs_only_what_is_not_here(server, tiles, tmp_path, monkeypatch):
    monkeypatch.setattr(files, "_FIRST", 2_000)
    monkeypatch.setattr(files, "_WIDEST_GAP", 0)
    address, sent = add(server, tiles[0]), []
    moved = (BOX[0] + 10, *BOX[1:2], BOX[2] + 10, BOX[3])
    for box in (BOX, moved):
        server.sent = 0
        bare_earth.classify(address, tmp_path / "out.laz", extent=box, **NEAR)
        sent.append(server.sent)
    assert sent[1] < sent[0] / 2
    here = tmp_path / "here.laz"
    bare_earth.classify(tiles[0], here, extent=moved, **NEAR)
    assert np.array_equal(labels_in(here, moved), labels_in(tmp_path / "out.laz", moved))


@pytest.mark.parametrize("content", ["part", "whole"])
def test_a_copy_that_is_damaged_mends_itself(server, tiles, tmp_path, content):
    plain = tiles[0] if content == "part" else write(tmp_path / "plain.laz", strip())
    address = add(server, plain)
    before = bare_earth.info(address)
    (copy,) = (path for path in cached(tmp_path) if "parts" not in path.parts)
    data = bytearray(copy.read_bytes())
    data[len(data) // 2] ^= 1
    copy.write_bytes(bytes(data))
    code, out, errors = said("info", address, "--json")
    assert code == 0 and json.loads(out)["point_count"] == before.point_count
    assert "in the cache is damaged" in errors and "bare-earth clear-cache" in errors
    assert "damaged" not in said("info", address)[2]


@pytest.mark.parametrize("plain", [False, True])
def test_a_wrong_answer_is_asked_for_once_more(server, tiles, tmp_path, plain, monkeypatch):
    monkeypatch.setattr(files, "_FIRST", 2_000)
    source = write(tmp_path / "plain.laz", strip()) if plain else tiles[0]
    address, wrong = add(server, source), {2}
    server.fault = lambda number, path: "wrong" if number in wrong else ""
    count = laspy.read(source).header.point_count
    assert bare_earth.info(address).point_count == count
    # The next run does not suffer from a server that was wrong for a whole run.
    wrong, server.etags[source.name] = range(1, 1000), '"another"'
    server.asked.clear()
    with pytest.raises(BareEarthError):
        bare_earth.info(address)
    wrong = ()
    assert bare_earth.info(address).point_count == count


@pytest.mark.rest
def test_two_runs_at_once_share_an_empty_cache(server, tiles, tmp_path):
    server.latency, address, errors = 0.05, add(server, tiles[0]), []

    def work(number):
        try:
            bare_earth.classify(address, tmp_path / f"{number}.laz", extent=BOX, **NEAR)
        except BareEarthError as error:
            errors.append(error)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not errors
    assert len({(tmp_path / f"{number}.laz").read_bytes() for number in range(3)}) == 1


def test_parts_are_kept_though_another_run_that_ended_has_removed_their_folder(tmp_path):
    parts = Parts(tmp_path / "parts", "https://example.org/a.copc.laz")
    parts.begin({"size": 9}, True)
    remove_parts(tmp_path / "parts")
    parts.add(2, b"abc")
    assert parts.read(2, 5) == b"abc"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has other permissions")
def test_the_cache_is_for_its_owner_only(server, tiles, tmp_path):
    (tmp_path / "cache").mkdir(mode=0o755)
    bare_earth.info(add(server, tiles[0]))
    for folder in (tmp_path / "cache").iterdir():
        assert folder.stat().st_mode & 0o777 == 0o700


def test_blocks_show_no_signature(server, tiles):
    blocks = arrays.blocks([add(server, tiles[0])], classified=True)
    assert blocks[0].sources == (server.address(tiles[0].name),)
    assert "s3cr3t" not in repr(blocks[0]) + repr(blocks[0].work)
    assert sum(len(block()["X"]) for block in blocks)


@pytest.mark.parametrize(
    "address",
    [
        "http:/user:s3cr3t@127.0.0.1/a.copc.laz",
        "user:s3cr3t@127.0.0.1/a.copc.laz",
        "user:s3cr3t@127.0.0.1:80/a.copc.laz",
        "https://user:s3/s3cr3t@127.0.0.1/a.copc.laz",
        "https://user:s3@x/s3cr3t@127.0.0.1/a.copc.laz",
        "https://user:s3?s3cr3t@127.0.0.1/a.copc.laz",
        "https://user:s3cr3t@[::1/a.copc.laz",
        "ftp://user:s3cr3t@127.0.0.1/a.copc.laz",
    ],
)
def test_a_mistyped_address_keeps_its_secret(server, tmp_path, address):
    for words in (("info",), ("fetch",), ("classify",), ("terrain",)):
        target = {"info": (), "terrain": ("--dtm", tmp_path / "a.tif")}
        code, out, errors = said(*words, address, *target.get(words[0], (tmp_path / "a.laz",)))
        assert code and errors.count("\n") == 1 and "s3cr3t" not in out + errors, errors
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "words",
    [
        ("height", "{cloud}", "o.laz", "--dtm", "{address}"),
        ("classify", "{cloud}", "o.laz", "--boundary", "{address}"),
        ("check", "{cloud}", "--checkpoints", "{address}"),
        ("contours", "{address}", "o.gpkg"),
    ],
)
def test_the_address_of_another_input_keeps_its_secret(tiles, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    address = "http://user:s3cr3t@127.0.0.1:9/a.tif?sig=s3cr3t"
    code, out, errors = said(*(word.format(cloud=tiles[0], address=address) for word in words))
    assert code == 1 and "127.0.0.1:9/a.tif" in errors and "s3cr3t" not in out + errors
