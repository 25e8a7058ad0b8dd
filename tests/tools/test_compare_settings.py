import base64
import json
import re
import shlex

import numpy as np
import pytest
from html_tags import Tags
from runs import CancelAt, Heard
from surveys import classes_of, write_points

from bare_earth import BareEarthError, Cancelled, classify, compare_settings
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.errors import NoGround
from bare_earth.algorithms.tools.compare_settings.settings import SETTINGS, TrialOptions
from bare_earth.algorithms.tools.ground.step import LabelGround

ORIGIN = (500_000.0, 5_700_000.0)
SIDE = 120.0
# A hall 30 m wide on a plane: a filter that looks 2 m far takes its roof for ground.
HALL = (40.0, 70.0, 50.0, 80.0)
WINDOW = (*(start + 20 for start in ORIGIN), *(start + 100 for start in ORIGIN))
BOTH = "tin-densification:automatic", "slope:whitebox"
FOOT = 0.3048
ONE = ("grid-minimum:automatic",)


def scene():
    """Return x, y, z in metres from the origin, and which points are on the roof."""
    random = np.random.default_rng(7)
    x, y = random.uniform(0, SIDE, (2, 12_000))
    roof = (x > HALL[0]) & (x < HALL[1]) & (y > HALL[2]) & (y < HALL[3])
    z = 100 + 0.03 * x + np.where(roof, 9.0, 0.0) + random.normal(0, 0.02, len(x))
    return *(np.round(column, 3) for column in (x, y, z)), roof


def write(path, which=slice(None), epsg=25832, unit=1.0):
    x, y, z, _ = (column[which] for column in scene())
    return write_points(
        path, x / unit, y / unit, z / unit, offset=(*ORIGIN, 0.0), crs=epsg and f"EPSG:{epsg}"
    )


def inside(x, y, box=(20, 20, 100, 100)):
    return (x >= box[0]) & (x <= box[2]) & (y >= box[1]) & (y <= box[3])


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    return write(tmp_path_factory.mktemp("trial") / "tile.laz")


@pytest.fixture(scope="module")
def made(source):
    """The summary of two settings, and the text of their page."""
    page = source.with_name("page.html")
    summary = compare_settings([source], page, extent=WINDOW, settings=BOTH)
    return summary, page.read_text(encoding="utf-8")


@pytest.mark.rest
def test_each_setting_finds_what_it_finds_on_the_whole_file(source, made, tmp_path):
    x, y, _, _ = scene()
    for setting in made[0].settings:
        command = shlex.split(setting["shell"])
        command[command.index(str(source)) + 1] = str(tmp_path / "all.laz")
        assert main(command[1:]) == 0
        ground = classes_of(tmp_path / "all.laz") == 2
        assert setting["ground_count"] == np.count_nonzero(ground & inside(x, y))
        assert setting["ground_share"] == pytest.approx(100 * ground[inside(x, y)].mean())


def test_the_others_are_compared_with_the_first(made):
    x, y, _, roof = scene()
    first, other = made[0].settings
    assert (first["gained"], first["lost"], first["terrain_difference"]) == (0, 0, 0.0)
    assert made[0].point_count == first["point_count"] == np.count_nonzero(inside(x, y))
    # Of the roof the inner part is ground for a filter that looks 2 m far, and 9 m too high.
    assert 0.5 * roof.sum() < other["gained"] <= roof.sum()
    share = (HALL[1] - HALL[0]) * (HALL[3] - HALL[2]) / 80**2
    assert other["terrain_difference"] == pytest.approx(9 * share, rel=0.2)
    assert 0.01 < first["expected_rmse"] < 0.5


def test_the_page_needs_no_other_file_and_shows_all_settings(made):
    summary, page = made
    tags = Tags(page)
    assert tags.open == []
    pictures = re.findall(r'(?:src|href)="([^"]*)"', page)
    # Of each setting terrain and differences.
    assert len(pictures) == 2 * len(summary.settings)
    for picture in pictures:
        kind, _, data = picture.partition(",")
        assert kind == "data:image/png;base64" and base64.b64decode(data)[:4] == b"\x89PNG"
    assert "http" not in page.replace("http://www.w3.org", "")
    for setting in summary.settings:
        assert setting["label"] in tags.texts
        assert setting["shell"] in tags.texts and setting["qgis"] in tags.texts
    assert "processing.run('bareearth:slopefilter', {" in summary.settings[1]["qgis"]


def figures(summary):
    return [
        {name: value for name, value in setting.items() if name not in ("shell", "qgis")}
        for setting in summary.settings
    ]


@pytest.mark.rest
def test_a_survey_of_tiles_and_a_copc_file_give_the_same(source, made, tmp_path):
    x, *_ = scene()
    (tmp_path / "tiles").mkdir()
    write(tmp_path / "tiles" / "west.laz", x < 61.3)
    write(tmp_path / "tiles" / "east.las", x >= 61.3)
    tiles = compare_settings(
        [tmp_path / "tiles"], tmp_path / "t.html", extent=WINDOW, settings=BOTH
    )
    copc = tmp_path / "tile.copc.laz"
    classify(source, copc, method="slope", to_class=1)
    nodes = compare_settings([copc], tmp_path / "c.html", extent=WINDOW, settings=BOTH)
    for one, other, whole in zip(figures(tiles), figures(nodes), figures(made[0])):
        assert one == pytest.approx(whole) and other == pytest.approx(whole)
    # What only single files take is not offered for many.
    assert tiles.settings[1]["qgis"] == ""
    assert "bareearth:classifytiles" in tiles.settings[0]["qgis"]
    assert tiles.settings[0]["shell"].split()[3].endswith("tiles_tin-densification_automatic")


@pytest.mark.rest
def test_feet_are_converted(made, tmp_path):
    source = write(tmp_path / "feet.laz", epsg=2222, unit=FOOT)  # Arizona East, feet
    box = [start + metres / FOOT for metres in (20, 100) for start in ORIGIN]
    summary = compare_settings([source], tmp_path / "feet.html", extent=box, settings=BOTH)
    page = (tmp_path / "feet.html").read_text(encoding="utf-8")
    # The page speaks in the unit of the survey, and its figures are in metres.
    assert "(262 x 262 ft, 80 x 80 m)" in page and "164 ft (50 m) round" in page
    assert f"{summary.settings[1]['terrain_difference'] / FOOT:.2f} ft" in page
    assert not re.search(r"\d m</div>|</div>\d+ m", page)
    for one, other in zip(figures(summary), figures(made[0])):
        # Coordinates are rounded otherwise.
        assert one["ground_count"] == pytest.approx(other["ground_count"], rel=0.005)
        assert one["terrain_difference"] == pytest.approx(other["terrain_difference"], abs=0.05)


@pytest.mark.rest
def test_the_context_is_told_and_can_be_chosen(source, made, tmp_path):
    assert made[0].context == 50.0
    assert "50 m round the window" in made[1] and "up to 180 m" in made[1]
    page = tmp_path / "p.html"
    near = {"extent": WINDOW, "settings": ("slope:whitebox",), "context": 5}
    summary = compare_settings(source, page, **near)
    x, y, *_ = scene()
    assert summary.read_count == np.count_nonzero(inside(x, y, (15, 15, 105, 105)))
    wide = compare_settings(source, page, extent=WINDOW, context=300)
    assert wide.read_count == len(x)
    assert "look up to" not in page.read_text(encoding="utf-8")


def test_a_setting_without_ground_is_shown_as_such(source, tmp_path, monkeypatch):
    def none(*arguments):
        raise NoGround("No ground was found.")

    monkeypatch.setattr(LabelGround, "in_block", none)
    progress, how = Heard(), {"extent": WINDOW, "settings": BOTH}
    summary = compare_settings(source, tmp_path / "p.html", progress=progress, **how)
    assert [setting["ground_count"] for setting in summary.settings] == [0, 0]
    assert summary.settings[1]["terrain_difference"] is None
    assert "Slope filter, Whitebox" in progress.warnings[-1]


@pytest.mark.parametrize(
    ("window", "says"),
    [
        ((0, 0, 100, 100), "No point .* window .* points lie in x 5"),
        ((4e5, 57e5, 5e5, 58e5), "100,000 m wide"),
        ((2, 0, 1, 1), "XMIN below XMAX"),
    ],
)
def test_a_window_that_does_not_do_is_refused(source, tmp_path, window, says):
    with pytest.raises(BareEarthError, match=says):
        compare_settings(source, tmp_path / "p.html", extent=window)
    assert not list(tmp_path.iterdir())


def test_values_that_do_not_do_are_refused(source, tmp_path):
    for wrong, says in (
        ({"settings": ("slope:moon",)}, "Settings .* one of"),
        ({"settings": ()}, "choose at least one"),
    ):
        with pytest.raises(BareEarthError, match=says):
            compare_settings(source, tmp_path / "p.html", extent=WINDOW, **wrong)
    assert TrialOptions(("slope:town", "slope:town")).settings == ("slope:town",)
    with pytest.raises(BareEarthError, match=r"name it \.html"):
        compare_settings([source], tmp_path / "page.png", extent=WINDOW)
    with pytest.raises(BareEarthError, match="tile"):
        compare_settings(source, source, extent=WINDOW)


def test_a_cancel_leaves_nothing(source, tmp_path):
    with pytest.raises(Cancelled):
        page = tmp_path / "p.html"
        compare_settings(source, page, extent=WINDOW, settings=BOTH, progress=CancelAt(0.5))
    assert not list(tmp_path.iterdir())


@pytest.mark.rest
def test_without_a_window_the_middle_is_taken(source, tmp_path, capsys):
    x, *_ = scene()
    page, progress = tmp_path / "p.html", Heard()
    summary = compare_settings(source, page, settings=ONE, progress=progress)
    # The scene is smaller than 250 m.
    assert summary.point_count == len(x)
    assert any("middle of the points, x 5" in text for text in progress.infos)
    first = page.read_bytes()
    words = ["compare-settings", str(source), str(page), "--settings", *ONE]
    assert main(words) == 0 and page.read_bytes() == first
    assert main([*words, "--extent", *map(repr, summary.window)]) == 0
    assert page.read_bytes() == first


@pytest.mark.rest
def test_the_middle_of_a_wide_survey_is_250_m_wide(tmp_path):
    source = tmp_path / "wide.laz"
    rows = np.arange(0.0, 800.0, 4.0)
    x, y = (axis.ravel() for axis in np.meshgrid(rows, rows))
    write_places(source, x, y)
    summary = compare_settings([source], tmp_path / "p.html", settings=ONE)
    corner = ORIGIN[0] + 398 - 125, ORIGIN[1] + 398 - 125
    assert summary.window == (*corner, corner[0] + 250, corner[1] + 250)


@pytest.mark.rest(but="True")
@pytest.mark.parametrize("as_tiles", [False, True])
def test_in_a_gap_the_nearest_points_are_taken(tmp_path, as_tiles):
    rows = np.arange(0.0, 1000.0, 4.0)
    x, y = (axis.ravel() for axis in np.meshgrid(rows, rows))
    # An L: the middle of the extent is empty, and the nearest point lies west of it.
    strip = (x < 100) | (y < 60)
    if as_tiles:
        (tmp_path / "in").mkdir()
        write_places(tmp_path / "in" / "north.laz", x[strip & (y > 90)], y[strip & (y > 90)])
        write_places(tmp_path / "in" / "south.laz", x[strip & (y <= 90)], y[strip & (y <= 90)])
        sources = [tmp_path / "in"]
    else:
        write_places(tmp_path / "in.laz", x[strip], y[strip])
        sources = [tmp_path / "in.laz"]
    progress = Heard()
    summary = compare_settings(sources, tmp_path / "p.html", settings=ONE, progress=progress)
    assert any(text.startswith("window round the point that is nearest") for text in progress.infos)
    west, south, east, north = summary.window
    place = ORIGIN[0] + 96, ORIGIN[1] + 496
    assert (east, south, north) == (place[0] + 125, place[1] - 125, place[1] + 125)
    assert west == pytest.approx(ORIGIN[0], abs=0.01)
    assert summary.point_count == np.count_nonzero(
        strip & (y >= south - ORIGIN[1]) & (y <= north - ORIGIN[1])
    )


def write_places(path, x, y):
    """Write a plane with points at some places."""
    write_points(path, x, y, 100 + 0.03 * x, 0, offset=(*ORIGIN, 0.0), crs="EPSG:25832")


def test_the_command(source, made, tmp_path, capsys):
    words = ["compare-settings", str(source), str(tmp_path / "page.html"), "--json"]
    words += ["--extent", *map(str, WINDOW), "--settings", *BOTH]
    assert main(words) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["settings"] == made[0].settings
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == made[1]
    assert main([*words[:-1], "slope:moon"]) == 2
    assert "slope:moon" in capsys.readouterr().err


def test_every_preset_of_every_method_is_a_setting():
    assert {"tin-densification:lidar360", "grid-minimum:paper", "slope:whitebox"} < set(SETTINGS)
    for name, setting in SETTINGS.items():
        assert setting.parameters.preset == setting.preset
        assert name == f"{setting.method.name}:{setting.preset}"
