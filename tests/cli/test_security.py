"""What comes from others does no harm: names, lists, links, archives; and nothing is fetched."""

import ast
import contextlib
import html.parser
import http.server
import json
import os
import struct
import sys
import threading
import warnings
import zipfile
from pathlib import Path

import lazrs
import numpy as np
import pytest
from las_files import make_records
from runs import said
from shipped import name_of, nodes
from wheels import PACKAGE, make_wheel

from bare_earth import BareEarthError
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.survey.vpc import read_vpc, write_vpc
from bare_earth.plugin.libraries import wheels
from bare_earth.plugin.libraries.build import Build

pytestmark = pytest.mark.processes

UNIX = pytest.mark.skipif(os.name == "nt", reason="Windows has no such names")
MORE = [UNIX, pytest.mark.long]
NAMES = [
    "Gr\u00fc\u00dfe '\u5730\u9762' \U0001f30d e\u0301 \u201e",
    *(
        pytest.param(name, marks=pytest.mark.long)
        for name in ("with spaces  in it", "-rf", "100%s %n {0} $(id) `id` ; & #", "[a-c]{1,2}")
    ),
    pytest.param('double " and \\ back', marks=MORE),
    pytest.param("not \udcff UTF-8", marks=UNIX),
    pytest.param("two\nlines\r \x1b[31mred\x07\x9b", marks=MORE),
    pytest.param("<script>alert(1)<\u2215script>&amp;<!--", marks=MORE),
    pytest.param("*?|:", marks=MORE),
    pytest.param("x" * 251, marks=MORE),
    pytest.param("\u00e9" * 125, marks=MORE),
]


def is_plain(text):
    return all(line.isprintable() for line in text.splitlines()) and "\r" not in text


class Page(html.parser.HTMLParser):
    """Collects the tags of a page."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.comments = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)

    def handle_comment(self, data):
        self.comments.append(data)


def tags_of(path):
    page = Page(path.read_text(encoding="utf-8"))
    return sorted(page.tags), page.comments


def outputs(folder, source, name):
    """Run every command over a file of this name, with outputs of this name."""
    out = folder / "out" / name
    out.parent.mkdir()
    box = ("--extent", "399980", "4999990", "400010", "5000010")
    rasters = ("--dtm", out.with_name(f"{name}.tif"), "--dtm-cell-size", "5")
    classified = out.with_name(f"{name}.las")
    return {
        "info": ("info", source),
        # The classes of the points are random numbers.
        "classify": ("classify", source, classified, "--method", "slope", *rasters,
                     "--from-classes", "all"),
        "height": ("height", classified, out.with_name(f"{name}.laz")),
        "key-points": ("key-points", classified, out.with_name(f"{name}.laz")),
        "terrain": ("terrain", classified, *rasters),
        "assess": ("assess", classified, classified, "--report", out.with_name(f"{name}.html")),
        "compare-settings": ("compare-settings", source, out.with_name(f"{name}.html"), *box,
                             "--settings", "slope:automatic", "slope:town"),
        "classify many": ("classify", source.parent, folder / "out" / "tiles",
                          "--method", "slope", "--vpc", out.with_name(f"{name}.vpc")),
        "remove-off-terrain-objects": ("remove-off-terrain-objects",
                                       out.with_name(f"{name}.tif"), out.with_name(f"{name}.tiff")),
    }  # fmt: skip


@pytest.mark.rest
@pytest.mark.parametrize("name", NAMES)
def test_names_of_any_kind_go_through_every_command(las, tmp_path, request, name):
    if "\udcff" not in name:  # which is the one that processes could be unable to send
        request.getfixturevalue("threads_for_processes")
    place = tmp_path / "in"
    place.mkdir()
    source = place / f"{name}.las"
    cut = name
    while len(os.fsencode(f"{cut}.tiff")) > 255:
        cut = cut[:-1]
    data = bytearray(las.bytes(version=4, point_format=6, count=300))
    struct.pack_into("<6d", data, 179, 400_008, 399_990, 5_000_017, 5_000_000, 110, 90)
    source.write_bytes(data)
    suffixes = {".las", ".laz", ".tif", ".tiff", ".html", ".vpc"}
    for command, words in outputs(tmp_path, source, cut).items():
        code, out, errors = said(*words)
        assert is_plain(out) and is_plain(errors)
        if command == "remove-off-terrain-objects" and "\udcff" in name:
            assert code == 1 and "UTF-8" in errors
            suffixes.remove(".tiff")
            continue
        errors = [line for line in errors.splitlines() if not line.startswith("Warning: ")]
        assert (code, errors) == (0, []), command
    made = tmp_path / "out"
    names = {path.name for path in made.iterdir()}
    assert names == {"tiles", *(f"{cut}{suffix}" for suffix in suffixes)}
    (listed,) = read_vpc(made / f"{cut}.vpc")
    assert listed.read_bytes() == (made / "tiles" / f"{name}.las").read_bytes()
    pages = [made / f"{cut}.html", tmp_path / "plain.htm"]
    plain = tmp_path / "plain.las"
    plain.write_bytes((made / f"{cut}.las").read_bytes())
    assert said("assess", plain, plain, "--report", pages[1])[0] == 0
    assert said("assess", made / f"{cut}.las", plain, "--report", pages[0])[0] == 0
    assert tags_of(pages[0]) == tags_of(pages[1])


@pytest.mark.parametrize("name", ["-rf.las", "--help.las", "-.las"])
def test_a_name_with_a_leading_dash_is_no_option(las, tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    Path(name).write_bytes(las.bytes(version=4, point_format=6, count=300))
    assert said("classify", "--method", "slope", "--", name, "-out.las")[0] == 0
    assert said("info", f"./{name}")[0] == 0
    assert Path("-out.las").is_file()


# Nothing is fetched


@pytest.fixture
def server():
    """Yield the address of a server on this computer, and what it is asked for."""
    asked = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            asked.append(self.path)
            self.send_error(404)

        do_HEAD = do_GET

        def log_message(self, *words):
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as listening:
        thread = threading.Thread(target=listening.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{listening.server_port}", asked
        listening.shutdown()
        thread.join()


VRT = """<VRTDataset rasterXSize="9" rasterYSize="9"><VRTRasterBand dataType="Float32" band="1">
<SimpleSource><SourceFilename>{}</SourceFilename><SourceBand>1</SourceBand></SimpleSource>
</VRTRasterBand></VRTDataset>"""


@pytest.mark.parametrize("form", ["{}/a{}", "/vsicurl/{}/a{}", "/vsicurl_streaming/{}/a{}"])
def test_no_command_fetches_what_is_named(las, tmp_path, server, form):
    address, asked = server
    sound = las.make("sound.las", version=4, point_format=6, count=300)
    url, raster = form.format(address, ".las"), form.format(address, ".tif")
    vrt, listed, vpc = tmp_path / "a.vrt", tmp_path / "a.txt", tmp_path / "a.vpc"
    vrt.write_text(VRT.format(raster))
    listed.write_text(f"{url}\n")
    item = {"properties": {}, "assets": {"data": {"href": url}}}
    vpc.write_text(json.dumps({"type": "FeatureCollection", "features": [item]}))
    out = tmp_path / "out.las"
    box = ("--extent", "0", "0", "100", "100")
    # The address of a point cloud is asked for, since the user names it.
    points = [
        ("info", url),
        ("classify", url, out),
        ("height", url, out),
        ("key-points", url, out),
        ("terrain", url, "--dtm", tmp_path / "out.tif"),
        ("assess", url, sound),
        ("compare-settings", url, tmp_path / "page.html", *box),
    ]
    for words in (
        *(points if form.startswith("/") else ()),
        ("classify", vpc, tmp_path / "out"),
        ("classify", listed, tmp_path / "out"),
        ("classify", sound, out, "--boundary", form.format(address, ".geojson")),
        ("terrain", sound, "--dtm", tmp_path / "out.tif", "--water", form.format(address, ".gpkg")),
        ("remove-off-terrain-objects", raster, tmp_path / "out.tif"),
        ("remove-off-terrain-objects", vrt, tmp_path / "out.tif"),
        ("remove-off-terrain-objects", VRT.format(raster), tmp_path / "out.tif"),
    ):
        code, _, errors = said(*words)
        assert code == 1 and errors.count("\n") == 1, (words, errors)
    assert asked == []
    assert not list(tmp_path.glob("out*")) and not list(tmp_path.glob("page*"))


def test_the_server_would_hear_what_is_fetched(server):
    """The test above could see a request."""
    rasterio = pytest.importorskip("rasterio")
    address, asked = server
    with contextlib.suppress(rasterio.errors.RasterioError):
        rasterio.open(f"{address}/a.tif")
    assert asked


# What code may do


def calls():
    """Yield where something is called, its name with its modules, and the words given."""
    for path, node in nodes():
        if isinstance(node, ast.Call):
            words = {keyword.arg: keyword.value for keyword in node.keywords}
            yield f"{name_of(path)}:{node.lineno}", ast.unparse(node.func), words


DANGEROUS = {
    "eval", "exec", "compile", "__import__", "os.system", "os.popen", "tempfile.mktemp",
    "input", "breakpoint",
}  # fmt: skip
UNPICKLING = {"pickle", "marshal", "shelve", "dill", "cloudpickle", "joblib", "yaml"}


def test_shipped_code_reads_no_pickle():
    for path, node in nodes():
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            names = {name.name.split(".")[0] for name in node.names}
            module = (getattr(node, "module", None) or "").split(".")[0]
            assert not (names | {module}) & UNPICKLING, path


def test_shipped_code_runs_no_text_and_no_shell():
    for where, name, words in calls():
        assert name not in DANGEROUS, where
        shell, allowed = words.get("shell"), words.get("allow_pickle")
        assert not isinstance(shell, ast.Constant) or shell.value is False, where
        if name.endswith(("np.load", "numpy.load")):
            assert isinstance(allowed, ast.Constant) and allowed.value is False, where


# Archives and points that grow when they are unpacked


def identical(path, count=3_000_000):
    """Write many points that are all the same, which take next to no bytes; return their file."""
    records = np.repeat(make_records(6, 1), 1_000_000, axis=0)
    header = bytearray(375)
    laszip = lazrs.LazVlr.new_for_compression(6, 0)
    record = bytes(laszip.record_data())
    vlr = struct.pack("<H16sHH32s", 0, b"laszip encoded", 22204, len(record), b"") + record
    header[:4] = b"LASF"
    struct.pack_into("<BB", header, 24, 1, 4)
    struct.pack_into("<HII", header, 94, 375, 375 + len(vlr), 1)
    struct.pack_into("<BH", header, 104, 0x86, 30)
    struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 0, 0, 0)
    struct.pack_into("<Q", header, 247, count)
    with open(path, "w+b") as file:
        file.write(header + vlr)
        compressor = lazrs.LasZipCompressor(file, laszip)
        for _ in range(count // len(records)):
            compressor.compress_many(records.reshape(-1))
        compressor.done()
    return path


@pytest.mark.rest
def test_points_of_next_to_no_bytes_are_read_and_more_than_that_refused(tmp_path):
    path = identical(tmp_path / "bomb.laz")
    assert path.stat().st_size < 40_000
    assert open_las(path).count == 3_000_000
    data = bytearray(path.read_bytes())
    for count in (10**9, 10**12, 2**62):
        struct.pack_into("<Q", data, 247, count)
        path.write_bytes(data)
        code, _, errors = said("info", path)
        assert code == 1 and "damaged or cut off" in errors


def test_a_raster_of_more_cells_than_memory_is_refused(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    path = tmp_path / "bomb.tif"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with rasterio.open(path, "w", driver="GTiff", width=300_000, height=300_000, count=1,
                           dtype="float32", SPARSE_OK=True, TILED=True, BLOCKXSIZE=4096,
                           BLOCKYSIZE=4096, BIGTIFF="YES"):  # fmt: skip
            pass
    assert path.stat().st_size < 1_000_000
    code, _, errors = said("remove-off-terrain-objects", path, tmp_path / "out.tif")
    assert code == 1 and "300,000 x 300,000 cells" in errors


def unpack(path, folder):
    wheels.unpack(path, folder, PACKAGE, Build.here())


@pytest.mark.rest
@pytest.mark.parametrize("zeros", [80_000_000, pytest.param(200_000_000, marks=pytest.mark.long)])
def test_a_wheel_that_grows_beyond_any_is_refused_before_it_is_unpacked(tmp_path, zeros):
    path = tmp_path / "bomb.whl"
    files = {f"{PACKAGE}/__init__.py": "0" * zeros}
    make_wheel(path, files, compression=zipfile.ZIP_DEFLATED)
    assert path.stat().st_size < 1_000_000
    with pytest.raises(BareEarthError, match="larger than any"):
        unpack(path, tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_a_wheel_that_lies_about_its_lengths_is_refused(tmp_path):
    path = tmp_path / "bomb.whl"
    files = {f"{PACKAGE}/__init__.py": "0" * 8_000_000}
    make_wheel(path, files, compression=zipfile.ZIP_DEFLATED)
    data = path.read_bytes().replace(struct.pack("<I", 8_000_000), struct.pack("<I", 10))
    path.write_bytes(data)
    with pytest.raises(BareEarthError, match="damaged"):
        unpack(path, tmp_path / "new")
    found = list((tmp_path / "new").rglob("*.py"))
    assert all(path.stat().st_size <= 10 for path in found)


@pytest.mark.parametrize(
    "name", ["/etc/x.py", "~/x.py", "tinylaz/../../x.py", "tinylaz\\..\\x.py", "C:x.py", "x.pth"]
)
def test_no_name_in_a_wheel_leads_out_of_its_folder(tmp_path, name):
    path = make_wheel(tmp_path / "a.whl", {f"{PACKAGE}/__init__.py": "", name: "x"})
    with pytest.raises(BareEarthError, match="does not belong"):
        unpack(path, tmp_path / "new")
    assert sorted(tmp_path.iterdir()) == [path]


@pytest.mark.skipif(sys.platform == "win32", reason="links need a privilege there")
def test_a_virtual_point_cloud_is_not_written_through_a_link(las, tmp_path):
    secret, target = tmp_path / "secret", tmp_path / "all.vpc"
    secret.write_text("old")
    target.symlink_to(secret)
    write_vpc(target, [las.make()])
    assert secret.read_text() == "old" and not target.is_symlink()
