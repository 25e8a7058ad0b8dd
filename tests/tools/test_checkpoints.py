"""Checkpoints, on land whose true heights are known."""

import csv
import json

import numpy as np
import pytest
from checkpoints import CORNER, EAST, NORTH, SIZE, check, cloud, height, places, write
from html_tags import Tags
from matrices import quick
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.classes.ground_classes import GroundClasses
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.tools.check import survey_ground
from bare_earth.algorithms.tools.check.accuracy import Accuracy, Figures, statement
from bare_earth.algorithms.tools.check.checking import CheckOptions
from bare_earth.algorithms.tools.check.checkpoints import Checkpoints
from bare_earth.algorithms.tools.check.reading import read_checkpoints

pyproj = pytest.importorskip("pyproj")


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    return write(tmp_path_factory.mktemp("survey") / "in.laz", *cloud())


def points(xy, errors=0.0, covers=None, names=None):
    """Return checkpoints of which the ground is too high by some errors."""
    x, y = xy.T
    rows = np.column_stack((x + EAST, y + NORTH, height(x, y) - errors))
    return Checkpoints.of(rows, names, covers)


def tin(x, y, z, classes):
    from scipy.interpolate import LinearNDInterpolator

    ground = classes == 2
    return LinearNDInterpolator(np.column_stack((x, y))[ground], z[ground])


@pytest.mark.rest
def test_heights_are_those_of_an_independent_triangulation(survey):
    xy = places(80)
    independent = tin(*cloud())(xy)
    given = Checkpoints.of(np.column_stack((xy + CORNER, independent)))
    done = check([survey], given)
    assert done.counted == 80
    assert max(abs(done.nva.minimum), abs(done.nva.maximum)) < 0.001


@pytest.mark.rest
@pytest.mark.parametrize("rounds", quick([(32, 64), (32,), (8_000,)], (32, 64)))
def test_with_few_points_at_first_others_are_looked_at_again(survey, monkeypatch, rounds):
    xy = places(40)
    heights = tin(*cloud())(xy)
    monkeypatch.setattr(survey_ground, "_ROUNDS", rounds)
    ground = survey_ground.SurveyGround.of([survey], GroundClasses())
    found = ground.heights(xy + CORNER, 20.0).heights
    assert np.abs(found - heights).max() < 0.001


def test_a_checkpoint_on_a_point_and_two_points_at_one_place(tmp_path):
    x, y, z, classes = cloud(2_000)
    x, y, classes = (np.append(column, column[:200]) for column in (x, y, classes))
    z = np.append(z, z[:200] + 1.0)
    path = write(tmp_path / "in.laz", x, y, z, classes)
    inner = np.flatnonzero(
        (classes[:200] == 2) & (np.abs(x[:200] - 50) < 45) & (np.abs(y[:200] - 50) < 45)
    )
    rows = np.column_stack((x[inner] + EAST, y[inner] + NORTH, z[inner]))
    done = check([path], Checkpoints.of(rows))
    assert done.counted == len(inner)
    assert done.nva.rmse < 0.001  # the lowest of the points is the vertex


def test_the_figures_of_known_errors():
    errors = np.array([0.03, -0.05, 0.02, 0.10])
    figures = Figures.of(errors, 0.02)
    assert figures.rmse == pytest.approx(np.sqrt((errors**2).mean()), abs=1e-6)
    assert figures.total_rmse == pytest.approx(np.hypot(figures.rmse, 0.02), abs=1e-6)
    assert figures.mean == pytest.approx(0.025) and figures.median == pytest.approx(0.025)
    assert figures.standard_deviation == pytest.approx(errors.std(ddof=1), abs=1e-6)
    assert (figures.minimum, figures.maximum, figures.count) == (-0.05, 0.1, 4)
    assert Figures.of(np.empty(0)) is None


def test_checkpoints_that_are_off_by_known_amounts(survey):
    xy = places(40)
    xy = xy[xy[:, 0] < 45]  # on the plane the TIN has no error
    errors = np.where(np.arange(len(xy)) % 2 == 0, 0.05, 0.01)
    covers = ["Forest" if number % 5 == 0 else "gravel" for number in range(len(xy))]
    errors[::5] = 0.3
    names = [f"P{number}" for number in range(len(xy))]
    accuracy = Accuracy(survey_error=0.02, accuracy_class=0.05)
    done = check([survey], points(xy, errors, covers, names), accuracy)
    known = np.arange(len(xy)) % 5 != 0
    assert done.nva.count == known.sum() and done.vva.count == (~known).sum()
    assert done.nva.rmse == pytest.approx(np.sqrt((errors[known] ** 2).mean()), abs=0.001)
    assert done.nva.total_rmse == pytest.approx(np.hypot(done.nva.rmse, 0.02), abs=1e-5)
    assert done.vva.mean == pytest.approx(0.3, abs=0.001)
    assert done.shift == -done.nva.mean and done.meets_class is True
    forest = {name for name, cover in zip(names, covers) if cover == "Forest"}
    assert {value["name"] for value in done.largest[: len(forest)]} == forest
    assert f"{done.shift:+.3f} m" in "\n".join(done.lines())


def test_checkpoints_outside_and_in_voids_are_named_and_not_counted(survey):
    xy = np.array([(50.0, 20.0), (25.0, 50.0), (150.0, 50.0), (50.0, 100.5)])
    given = points(xy, 0.0, None, ["good", "roof", "far", "edge"])
    done = check([survey], given, CheckOptions(max_edge=8.0))
    assert done.counted == 1
    assert done.not_counted == {"void": ["roof"], "outside": ["far", "edge"]}
    # A long edge is allowed by default: the building is interpolated from its sides.
    assert check([survey], given, CheckOptions(max_edge=60.0)).counted == 2
    with pytest.raises(BareEarthError, match="1 checkpoints"):
        check([survey], points(xy[1:2]), CheckOptions(max_edge=8.0))
    with pytest.raises(BareEarthError, match="20 m"):
        check([survey], points(xy[2:3]))


def test_north_before_east_is_noticed(survey):
    rows = points(places(5)).xyz[:, [1, 0, 2]]
    with pytest.raises(BareEarthError, match="x and y"):
        check([survey], Checkpoints.of(rows))


@pytest.mark.rest
def test_many_files_equal_one(survey, tmp_path, monkeypatch):
    x, y, z, classes = cloud()
    order = np.random.default_rng(5).permutation(len(x))
    for number in range(6):
        part = order[(x[order] // 34 * 2 + (y[order] > 47)).astype(int) == number]
        write(tmp_path / f"{number}.laz", *(column[part] for column in (x, y, z, classes)))
    given = points(places(60), 0.03)
    how = CheckOptions(hold_out=0.1)
    one = check([survey], given, how)
    assert check([tmp_path], given, how) == one
    # Neither does it matter how many points and places are looked at together.
    monkeypatch.setattr(survey_ground, "_TOGETHER", 1_000)
    monkeypatch.setattr(survey_ground, "_PLACES", 37)
    assert check([tmp_path], given, how) == one


@pytest.mark.rest
def test_held_out_points_are_the_same_in_each_run_and_tell_the_noise(tmp_path):
    random = np.random.default_rng(3)
    x, y = np.round(random.uniform(0, SIZE, (2, 30_000)), 3)
    slope = np.where(y < 30, 0.6, 0.0)
    z = np.round(50 + slope * x + random.normal(0, 0.05, len(x)), 3)
    returns = np.where(y > 80, 3, 1)
    path = write(tmp_path / "in.laz", x, y, z, np.full(len(x), 2), returns=returns)
    how = CheckOptions(hold_out=0.05)
    one, other = (check([path], None, how).hold_out for _ in range(2))
    assert one == other
    assert one.left_out == pytest.approx(1500, rel=0.1)
    assert one.all.count + one.no_height == one.left_out and one.no_height < 15
    assert not one.single and "dense plants" in one.limits()
    # The noise of the point, and the mean of three weights: 1 + 1/2 times the variance or less.
    assert 0.05 < one.open.rmse < 0.07
    # Along the edge at y = 30 the slope changes.
    shares = [value.count / one.all.count for value in (one.steep, one.open, one.under_trees)]
    assert shares == pytest.approx([0.3, 0.5, 0.2], abs=0.04)


def test_held_out_points_of_single_returns_and_of_a_terrain_with_gaps_say_so(tmp_path):
    path = write(tmp_path / "in.laz", *cloud())
    left = check([path], None, CheckOptions(hold_out=0.05)).hold_out
    assert left.single and "several returns" in left.limits()


def test_more_held_out_points_than_are_measured(survey, monkeypatch):
    from bare_earth.algorithms.tools.check import hold_out

    monkeypatch.setattr(hold_out, "MOST", 50)
    found = check([survey], None, CheckOptions(hold_out=0.3)).hold_out
    assert found.left_out > 1_000 and found.all.count + found.no_height == 50


def test_a_terrain_model(survey, tmp_path):
    dtm = tmp_path / "dtm.tif"
    assert main(["terrain", str(survey), "--dtm", str(dtm)]) == 0
    xy = places(60)
    done = check([survey], points(xy, 0.1), dtm=str(dtm))
    assert done.dtm_nva.count == 60
    assert done.dtm_nva.mean == pytest.approx(0.1, abs=0.01)
    assert any(fact.name == "DTM statement" for fact in done.facts)


@pytest.mark.rest
def test_the_expected_error_is_compared_with_the_errors(survey, tmp_path):
    dtm, error = tmp_path / "dtm.tif", tmp_path / "error.tif"
    assert main(["terrain", str(survey), "--dtm", str(dtm), "--expected-error", str(error)]) == 0
    rasters = {"dtm": str(dtm), "expected_error": str(error)}
    right = check([survey], points(places(60)), **rasters).expected
    assert right.count == 60 and right.inside >= 55 and right.factor < 1.2
    wrong = check([survey], points(places(60), 0.5), **rasters).expected
    assert wrong.inside < 20 and wrong.factor > 2.0
    assert f"{wrong.inside} of 60 errors" in wrong.text
    assert f"factor {wrong.factor:.2f}" in wrong.text
    command = ["terrain", str(survey), "--expected-error", rasters["expected_error"]]
    assert main([*command, "--error-factor", f"{wrong.factor:.6f}"]) == 0
    again = check([survey], points(places(60), 0.5), **rasters).expected
    assert again.inside >= 57 and again.factor == pytest.approx(1.0, abs=0.01)
    few = check([survey], points(places(10)), **rasters)
    assert few.expected.factor is None and "30 checkpoints" in few.expected.text
    assert check([survey], points(places(10)), dtm=str(dtm)).expected is None


def test_checkpoints_in_low_confidence_areas_have_figures_of_their_own(survey):
    xy = places()
    inside = xy[:, 0] < 50
    given = points(xy, np.where(inside, 1.0, 0.1))
    corners = np.array([[0, 0], [50, 0], [50, 100], [0, 100]]) + CORNER
    found = check([survey], given, low_confidence=((corners,),))
    assert found.counted == found.nva.count == np.count_nonzero(~inside)
    assert found.nva.rmse < 0.2 < 0.9 < found.low_confidence.rmse
    assert found.low_confidence.count == np.count_nonzero(inside)
    assert len(found.not_counted["low confidence area"]) == found.low_confidence.count
    assert found.dtm_low_confidence is None
    assert check([survey], given, low_confidence=()).counted == len(xy)


def test_points_in_feet(tmp_path):
    foot = 1200 / 3937
    x, y, z, classes = cloud()
    path = write(
        tmp_path / "in.laz", x / foot, y / foot, z / foot, classes, "EPSG:2230+6360"
    )  # fmt: skip
    xy = places(30)
    rows = np.column_stack((xy / foot + CORNER, (height(*xy.T) - 0.1) / foot))
    done = check([path], Checkpoints.of(rows))
    assert done.counted == 30 and done.nva.mean == pytest.approx(0.1, abs=0.01)


def table(path, text, encoding="utf-8"):
    path.write_bytes(text.encode(encoding))
    return path


ROWS = [("A1", 500010.25, 5600020.5, 51.125, "Wald"), ("A2", 500090.0, 5600003.0, 48.5, "Schotter")]
PLAIN = "\n".join("{},{},{},{},{}".format(*row) for row in ROWS)
COMMAS = "\n".join(";".join(map(str, row)).replace(".", ",") for row in ROWS)
TABLES = {
    "english": "Point ID,Easting (m),Northing (m),Elevation (m),Land cover\n" + PLAIN,
    "german": "Punktnummer;Rechtswert;Hochwert;Höhe;Bodenbedeckung\n" + COMMAS,
    "ost": "Nr;Ost;Nord;Hoehe;Klasse\n" + COMMAS,
    "french": "Nom;Est;Nord;Altitude;Couverture\n" + COMMAS,
    "spanish": "Nombre;Este;Norte;Cota;Cobertura\n" + COMMAS,
    "short": "id,E,N,H,class\n" + PLAIN,
    "order": "z,y,x,name,cover\n" + "\n".join("{3},{2},{1},{0},{4}".format(*row) for row in ROWS),
    "comment": "# name,x,y,z,cover\n# by GNSS\n" + PLAIN + "\n\n",
    "none": PLAIN,
    "tabs": PLAIN.replace(",", "\t"),
    "spaces": COMMAS.replace(";", "  "),
    "swiss": "name;x;y;z;cover\n"
    + COMMAS.replace(",", ".").replace("500", "500'").replace("'", "\u2019"),
}


@pytest.mark.parametrize("encoding", ["utf-8-sig", "cp1252", "utf-16"])
@pytest.mark.parametrize("kind", TABLES)
def test_tables_of_many_kinds(tmp_path, kind, encoding):
    found = read_checkpoints(table(tmp_path / "p.csv", TABLES[kind], encoding))
    assert found.names == ("A1", "A2") and found.covers == ("Wald", "Schotter")
    assert found.xyz.tolist() == [list(row[1:4]) for row in ROWS]


def test_tables_without_names(tmp_path):
    three = read_checkpoints(table(tmp_path / "p.xyz", "1.5 2 3\n4 5 6.5\n"))
    assert three.xyz.tolist() == [[1.5, 2.0, 3.0], [4.0, 5.0, 6.5]] and three.names == ("1", "2")
    four = read_checkpoints(table(tmp_path / "p.txt", "17 1.5 2 3\n18 4 5 6.5\n"))
    assert four.names == ("17", "18") and four.xyz.tolist() == three.xyz.tolist()
    chosen = read_checkpoints(table(tmp_path / "p.csv", "17,2,1.5,3\n18,5,4,6.5\n"), "x=3,y=2")
    assert chosen.xyz.tolist() == three.xyz.tolist()


def test_columns_can_be_chosen(tmp_path):
    path = table(tmp_path / "p.csv", "a,b,c,d,z\n1,2,3,kind,9\n")
    assert read_checkpoints(path, "x=a,y=B,z=c,cover=d").xyz.tolist() == [[1.0, 2.0, 3.0]]
    assert read_checkpoints(path, "x=a,y=2").xyz.tolist() == [[1.0, 2.0, 9.0]]
    for columns, words in {
        "": "x and y among a, b, c, d, z",
        "x=q": "column q.* a, b, c, d, z",
        "x:a": "like x=E",
        "x=d,y=b": "Line 2 .* x, but 'kind'",
    }.items():
        with pytest.raises(BareEarthError, match=words):
            read_checkpoints(path, columns)


@pytest.mark.parametrize("text", ["", "only words\nin it\n", "1;2\n3;4\n"])
def test_a_file_without_points_is_refused(tmp_path, text):
    with pytest.raises(BareEarthError, match="no table of points"):
        read_checkpoints(table(tmp_path / "p.csv", text))


def collection(path, crs=None, z=True, **fields):
    features = [
        {
            "type": "Feature",
            "properties": {"Name": name, "Cover": cover, "H": up, **fields},
            "geometry": {"type": "Point", "coordinates": [x, y, up] if z else [x, y]},
        }
        for name, x, y, up, cover in ROWS
    ]
    content = {"type": "FeatureCollection", "features": features}
    if crs:
        content["crs"] = {"type": "name", "properties": {"name": crs}}
    path.write_text(json.dumps(content), encoding="utf-8")
    return path


def test_attributes_are_paired_with_the_names_that_the_library_returns(tmp_path, monkeypatch):
    pyogrio = pytest.importorskip("pyogrio")
    path = collection(tmp_path / "p.geojson", "EPSG:25832", False, Alt=7.0)
    about, _, shapes, values = pyogrio.raw.read(str(path))
    pyogrio.raw.write(
        str(tmp_path / "p.gpkg"), shapes, values, about["fields"], geometry_type="Point",
        crs="EPSG:25832",
    )  # fmt: skip
    reads = pyogrio.raw.read

    def in_alphabetical_order(*words, **others):
        """Return the fields as pyogrio before 0.13 does."""
        about, ids, shapes, values = reads(*words, **others)
        order = np.argsort(about["fields"])
        return {**about, "fields": about["fields"][order]}, ids, shapes, [values[k] for k in order]

    monkeypatch.setattr(pyogrio.raw, "read", in_alphabetical_order)
    found = read_checkpoints(tmp_path / "p.gpkg", "z=H")
    assert found.xyz.tolist() == [list(row[1:4]) for row in ROWS]
    assert found.names == ("A1", "A2")


@pytest.mark.parametrize("has_z", [True, False])
@pytest.mark.parametrize("suffix", [".geojson", ".gpkg", ".shp"])
def test_vector_files(tmp_path, suffix, has_z):
    path = collection(tmp_path / "p.geojson", "EPSG:25832", has_z)
    if suffix != ".geojson":
        pyogrio = pytest.importorskip("pyogrio")
        about, _, shapes, values = pyogrio.raw.read(str(path))
        kind = "Point Z" if has_z else "Point"
        pyogrio.raw.write(
            str(path.with_suffix(suffix)), shapes, values, about["fields"], geometry_type=kind,
            crs="EPSG:25832",
        )  # fmt: skip
        path = path.with_suffix(suffix)
    found = read_checkpoints(path)
    assert found.names == ("A1", "A2") and found.covers == ("Wald", "Schotter")
    assert found.xyz.tolist() == [list(row[1:4]) for row in ROWS]
    assert "25832" in found.places.crs


def test_each_point_may_write_its_attributes_in_another_case(tmp_path):
    path = collection(tmp_path / "p.geojson", z=False)
    content = json.loads(path.read_text(encoding="utf-8"))
    first = content["features"][0]
    first["properties"] = {name.upper(): one for name, one in first["properties"].items()}
    path.write_text(json.dumps(content), encoding="utf-8")
    for source in (path, content):
        for columns in (None, "z=h"):
            found = read_checkpoints(source, columns)
            assert found.names == ("A1", "A2") and found.covers == ("Wald", "Schotter")
            assert found.xyz.tolist() == [list(row[1:4]) for row in ROWS]


def test_a_height_of_the_geometry_or_of_a_field(tmp_path):
    path = collection(tmp_path / "p.geojson", ortho=7.5)
    assert read_checkpoints(path, "z=ortho").xyz[:, 2].tolist() == [7.5, 7.5]
    with pytest.raises(BareEarthError, match="column none"):
        read_checkpoints(path, "z=none")
    with pytest.raises(BareEarthError, match="height, but 'A1'"):
        read_checkpoints(path, "z=Name")


def test_a_vector_crs_is_transformed(survey, tmp_path):
    xy = places(10)
    x, y = pyproj.Transformer.from_crs("EPSG:25832", "EPSG:4326", always_xy=True).transform(
        xy[:, 0] + EAST, xy[:, 1] + NORTH
    )
    rows = "".join(f"{a:.9f},{b:.9f},{z:.3f}\n" for a, b, z in zip(x, y, height(*xy.T)))
    path = table(tmp_path / "p.csv", "lon,lat,height\n" + rows)
    for given in (read_checkpoints(path, crs="EPSG:4326"), read_checkpoints(path)):
        progress = Heard()
        assert check([survey], given, progress=progress).nva.rmse < 0.02
        assert "transformed to the CRS" in str(progress.__dict__)


def test_words_for_vegetated_land_can_be_chosen(survey):
    given = points(places(10), covers=["field"] * 5 + ["Forest"] * 5)
    done = check([survey], given, vegetated=("field",))
    assert (done.nva.count, done.vva.count) == (5, 5)


def test_the_statement_has_the_form_of_the_standard():
    good, few = Figures.of(np.full(30, 0.08)), Figures.of(np.full(29, 0.08))
    text = statement(good, few, 0.1)
    assert text == (
        "This data set was tested to meet ASPRS Positional Accuracy Standards for Digital"
        " Geospatial Data, Edition 2 (2023) for a 10 cm RMSEV Vertical Accuracy Class. The"
        " Non-Vegetated Vertical Accuracy (NVA) was found to be RMSEV = 8 cm. The Vegetated"
        " Vertical Accuracy (VVA) was found to be RMSEV = 8 cm using the reduced number of"
        " checkpoints."
    )
    text = statement(few, None, 0.1)
    assert "ONLY 29 checkpoints" in text and "to meet a 10 cm" in text
    assert "does not meet a 5 cm" in statement(good, None, 0.05)
    assert "to meet" not in statement(good, None, None)
    assert "no test" in statement(None, good, 0.1)


def test_the_command_writes_page_table_and_layer(survey, tmp_path, capsys):
    xy = np.concatenate((places(35), [(150.0, 50.0)]))
    given = points(xy, 0.04)
    names = [f"<P{number}>" for number in range(34)] + ["=1+1", "far"]
    rows = "".join(
        f"{name};{x:.3f};{y:.3f};{z:.4f};{cover}\n"
        for name, (x, y, z), cover in zip(names, given.xyz, ["forest", *["sand"] * 35])
    )
    source = table(tmp_path / "p.csv", "id;x;y;z;cover\n" + rows)
    words = ["check", str(survey), "--checkpoints", str(source), "--accuracy-class", "0.1"]
    words += ["--report", str(tmp_path / "r.html"), "--table", str(tmp_path / "t.csv")]
    words += ["--residuals", str(tmp_path / "r.geojson"), "--hold-out", "0.05"]
    assert main([*words, "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert (figures["counted"], figures["not_counted"]) == (35, {"outside": ["far"]})
    assert figures["nva"]["count"] == 34 and figures["meets_class"] is True
    page = (tmp_path / "r.html").read_text(encoding="utf-8")
    tags = Tags(page)
    assert not tags.open and not tags.links and "<P1>" not in page
    assert figures["statement"] in tags.texts and page.count("<circle") == 36
    assert page.count("<svg") == 2 and "held out" in page
    assert (tmp_path / "t.csv").read_bytes().startswith(b"\xef\xbb\xbfx,y,name")  # for Excel
    with open(tmp_path / "t.csv", encoding="utf-8-sig", newline="") as file:
        read = list(csv.DictReader(file))
    assert len(read) == 36 and read[34]["name"] == "'=1+1" and read[35]["error"] == ""
    assert {value["state"] for value in read} == {"counted", "outside"}
    assert float(read[1]["error"]) == pytest.approx(0.04, abs=0.02)
    layer = json.loads((tmp_path / "r.geojson").read_text(encoding="utf-8"))
    assert layer["crs"]["properties"]["name"].endswith("25832")
    last = layer["features"][-1]
    assert last["properties"]["ERROR"] is None and last["geometry"]["type"] == "Point"
    assert len(last["geometry"]["coordinates"]) == 3
    assert main(words) == 0
    said = capsys.readouterr().out
    assert "tested to meet" in said and "under trees" not in said


@pytest.mark.parametrize("suffix", [".gpkg", ".shp", ".fgb"])
def test_layers_of_other_formats(survey, tmp_path, suffix):
    pyogrio = pytest.importorskip("pyogrio")
    given = points(np.concatenate((places(5), [(150.0, 50.0)])), 0.04)
    target = tmp_path / f"r{suffix}"
    check([survey], given, outputs={"residuals": target})
    about, _, shapes, values = pyogrio.raw.read(str(target))
    fields = dict(zip(about["fields"], values))
    assert "25832" in about["crs"] and about["geometry_type"].endswith("Z")
    errors = fields["ERROR"][np.argsort(fields["NAME"])]  # FlatGeobuf has an order of its own
    assert len(shapes) == 6 and np.isnan(errors[5])
    assert errors[:5] == pytest.approx(np.full(5, 0.04), abs=0.02)


def test_what_cannot_be_done_is_refused_before_the_work(survey, tmp_path, capsys):
    given = points(places(3))
    for name, file, words in [
        ("report", "r.pdf", r"r\.pdf: .*\.html"),
        ("table", "r.xls", r"r\.xls: .*\.csv"),
        ("residuals", "r.kml", "Name it so"),
        ("report", "missing/r.html", "missing .*exist"),
    ]:
        with pytest.raises(BareEarthError, match=words):
            check([tmp_path / "missing.laz"], given, outputs={name: tmp_path / file})
    with pytest.raises(BareEarthError, match="checkpoints"):
        check([survey])
    with pytest.raises(BareEarthError, match="checkpoints"):
        outputs = {"table": tmp_path / "t.csv"}
        check([survey], None, CheckOptions(hold_out=0.1), outputs=outputs)
    assert main(["check", str(survey)]) == 2
    assert "--hold-out" in capsys.readouterr().err
    with pytest.raises(BareEarthError, match="ground"):
        check([survey], given, GroundClasses(ground_classes=(9,)))
