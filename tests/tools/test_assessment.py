import base64
import io
import json
import re
import struct
import zlib

import numpy as np
import pytest
from html_tags import Tags
from surveys import write_points

from bare_earth import BareEarthError
from bare_earth import assess as assess_files
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.report.pictures import Relief, png, rgb
from bare_earth.algorithms.tools import assess
from bare_earth.algorithms.tools.assess import AssessmentOptions, compare


def test_the_four_figures_of_a_known_confusion():
    # Sithole & Vosselman's cross matrix: a = 40, b = 10, c = 5, d = 45.
    reference = np.repeat([2, 2, 1, 1], [40, 10, 5, 45])
    ground = np.repeat([True, False, True, False], [40, 10, 5, 45])
    result = compare(ground, reference)
    assert result.type_1_error == pytest.approx(20.0)
    assert result.type_2_error == pytest.approx(10.0)
    assert result.total_error == pytest.approx(15.0)
    assert result.kappa == pytest.approx(70.0)
    assert result.classes == {1: {"points": 50, "ground": 5}, 2: {"points": 50, "ground": 40}}


def test_chance_agreement_has_a_kappa_of_zero():
    reference = np.tile([2, 2, 1, 1], 10)
    ground = np.tile([True, False, True, False], 10)
    assert compare(ground, reference).kappa == pytest.approx(0.0)


def test_classes_may_count_as_ground_or_not_at_all():
    reference = np.array([2, 9, 7, 1])
    ground = np.array([True, True, True, False])
    options = AssessmentOptions(ground_classes=(2, 9), ignored_classes=(7,))
    assert compare(ground, reference, options).total_error == 0.0
    assert compare(ground, reference).total_error == pytest.approx(50.0)


def test_a_figure_without_points_is_none_in_json():
    figures = compare(np.array([True]), np.array([2])).as_dict()
    assert figures["type_2_error"] is None
    assert figures["total_error"] == 0.0


# A square of 40 x 40 m, of which the south-west corner is rejected ground (type I) and the
# north-east corner accepted as ground (type II).
SIDE = np.arange(0.5, 40.0)
X, Y = (axis.ravel() for axis in np.meshgrid(SIDE, SIDE))
TRUTH = np.where(X < 20, 2, 6)
TYPE_1, TYPE_2 = (X < 5) & (Y < 5), (X > 35) & (Y > 35)
FOUND = np.where(((TRUTH == 2) & ~TYPE_1) | TYPE_2, 2, 1)


def write(path, classes, order=slice(None)):
    x, y = X[order], Y[order]
    return write_points(path, x, y, 50 + 0.1 * x, classes[order], offset=(1000.0, 2000.0, 0.0))


@pytest.fixture
def files(tmp_path):
    return write(tmp_path / "found.las", FOUND), write(tmp_path / "truth.las", TRUTH)


def picture_of(page):
    """Decode the PNG in a page without a library that could be lenient."""
    data = base64.b64decode(re.search('base64,([^"]+)"', page).group(1))
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    chunks, start = {}, 8
    while start < len(data):
        length, kind = struct.unpack_from(">I4s", data, start)
        body = data[start + 8 : start + 8 + length]
        (check,) = struct.unpack_from(">I", data, start + 8 + length)
        assert check == zlib.crc32(kind + body)
        chunks[kind], start = body, start + 12 + length
    columns, rows, *kind = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert kind == [8, 2, 0, 0, 0]
    lines = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(rows, -1)
    assert not lines[:, 0].any()
    return lines[:, 1:].reshape(rows, columns, 3).astype(int)


def test_the_report_is_one_page_with_all_figures(files, tmp_path):
    result = assess_files(*files, report=tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    tags = Tags(page)
    assert not tags.open
    assert all(link.startswith("data:image/png;base64,") for link in tags.links)
    assert "http" not in re.sub('base64,[^"]*', "", page)
    for text in (f"{result.type_1_error:.2f} %", f"{result.kappa:.2f} %", "1,600", "building"):
        assert text in tags.texts
    assert {f"{count:,}" for count in (775, 25)} <= set(tags.texts)
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "found.las", "report.html", "truth.las",
    ]  # fmt: skip


def test_the_picture_shows_the_errors_where_they_are(files, tmp_path):
    assess_files(*files, report=tmp_path / "report.html")
    pixels = picture_of((tmp_path / "report.html").read_text(encoding="utf-8"))
    assert 30 < pixels.shape[0] == pixels.shape[1] <= 41
    # North is up: type I below on the left, type II above on the right, nothing elsewhere.
    part = pixels.shape[0] // 10
    assert (pixels[-part:, :part] == rgb(assess.TYPE_1)).all()
    assert (pixels[:part, -part:] == rgb(assess.TYPE_2)).all()
    coloured = np.ptp(pixels, axis=2) > 0
    assert coloured[-2 * part :, : 2 * part].sum() + coloured[: 2 * part, -2 * part :].sum() == (
        coloured.sum()
    )


def test_names_and_texts_are_escaped(tmp_path):
    found = write(tmp_path / "<b>&found.las", FOUND)
    truth = write(tmp_path / "truth.las", TRUTH)
    assess_files(found, truth, report=tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "<b>" not in page and "&lt;b&gt;&amp;found.las" in page
    assert not Tags(page).open


def test_the_order_of_the_points_does_not_matter(files, tmp_path):
    order = np.random.default_rng(3).permutation(len(X))
    mixed = write(tmp_path / "mixed.las", FOUND, order)
    one = assess_files(*files, report=tmp_path / "one.html")
    other = assess_files(mixed, files[1], report=tmp_path / "other.html")
    assert one == other
    one, other = (
        picture_of((tmp_path / name).read_text(encoding="utf-8"))
        for name in ("one.html", "other.html")
    )
    assert np.array_equal(one, other)


def test_the_error_map_holds_the_share_of_wrong_points(files, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    assess_files(*files, map_cell_size=10.0, error_map=tmp_path / "errors.tif")
    with rasterio.open(tmp_path / "errors.tif") as raster:
        share = raster.read(1)
        assert raster.transform[:6] == (10.0, 0.0, 1000.0, 0.0, -10.0, 2040.0)
    expected = np.zeros((4, 4))
    expected[3, 0] = expected[0, 3] = 0.25
    assert np.array_equal(share, expected.astype(np.float32))


def test_ignored_classes_are_no_errors_anywhere(files, tmp_path):
    result = assess_files(*files, ignored_classes=(6,), report=tmp_path / "report.html")
    assert (result.point_count, result.other_as_ground) == (800, 0)
    pixels = picture_of((tmp_path / "report.html").read_text(encoding="utf-8"))
    assert np.ptp(pixels[:20, 20:], axis=2).max() == 0
    with pytest.raises(BareEarthError, match="nothing to assess"):
        assess_files(*files, ignored_classes=(2, 6))


@pytest.mark.parametrize(
    ("name", "words"),
    [("report.pdf", r"report\.pdf: .*\.html"), ("missing/report.html", "does not exist")],
)
def test_a_report_that_cannot_be_written_is_refused_at_once(files, tmp_path, name, words):
    with pytest.raises(BareEarthError, match=words):
        assess_files(*files, report=tmp_path / name)


@pytest.mark.parametrize("count", [1, 2])
def test_a_report_of_hardly_any_points(tmp_path, count):
    names = ("found.las", FOUND), ("truth.las", TRUTH)
    files = [write(tmp_path / name, classes, np.arange(count)) for name, classes in names]
    assess_files(*files, report=tmp_path / "report.html")
    assert picture_of((tmp_path / "report.html").read_text(encoding="utf-8")).size


def test_a_large_survey_has_a_picture_of_bounded_size():
    x = np.linspace(0.0, 50_000.0, 3_000_000)
    wrong = np.zeros(len(x), bool)
    picture = Relief.of(Points(x, x / 7, x)).marked(wrong, wrong, (assess.TYPE_1, assess.TYPE_2))
    assert max(picture.pixels.shape) <= 901


def test_the_png_can_be_read_by_others():
    image = pytest.importorskip("matplotlib.image")
    pixels = np.random.default_rng(1).integers(0, 256, (5, 7, 3)).astype(np.uint8)
    read = image.imread(io.BytesIO(png(pixels)), format="png")
    assert np.array_equal(np.rint(read * 255).astype(np.uint8)[..., :3], pixels)


def test_the_command(files, tmp_path, capsys):
    words = ["assess", *map(str, files), "--report", str(tmp_path / "report.html")]
    assert main([*words, "--json", "--ground-classes", "2", "--ignored-classes", "7", "18"]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert figures["type_1_error"] == pytest.approx(100 * 25 / 800)
    assert "7, 18" in (tmp_path / "report.html").read_text(encoding="utf-8")
    assert main(words) == 0
    assert "total error" in capsys.readouterr().out
