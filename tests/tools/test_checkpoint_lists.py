"""Lists of checkpoints with repeated points, control points among them, or missing heights."""

import csv
import json

import numpy as np
import pytest
from checkpoints import CORNER, check, cloud, height, places, write
from html_tags import Tags
from realdata import real
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.tools.check.accuracy import Accuracy
from bare_earth.algorithms.tools.check.checkpoints import Checkpoints
from bare_earth.algorithms.tools.check.reading import read_checkpoints

FOOT = 0.3048


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    return write(tmp_path_factory.mktemp("survey") / "in.laz", *cloud())


def xyz(count=10):
    """Return checkpoints on the ground, and 2 cm below it where the number is even."""
    xy = places(count)
    return np.column_stack((xy + CORNER, height(*xy.T) - 0.02 * (np.arange(count) % 2 == 0)))


def table(path, rows, names=None, head="name,x,y,z"):
    """Write a table; `rows` are x, y and z as numbers or text."""
    names = names or [f"P{number}" for number in range(len(rows))]
    lines = [f"{name},{','.join(map(str, row))}" for name, row in zip(names, rows)]
    path.write_text("\n".join([head, *lines]), encoding="utf-8")
    return read_checkpoints(path)


@pytest.mark.parametrize("shift", [0.0, 0.004, 0.02])
@pytest.mark.parametrize("names", ["same", "other"])
def test_a_point_that_is_listed_thrice_counts_once(survey, shift, names):
    random = np.random.default_rng(3)
    rows = np.tile(xyz(10), (3, 1))
    rows[10:] += random.uniform(-shift, shift, (20, 3))
    kept = [f"P{number}" for number in range(30)]
    names = kept if names == "other" else kept[:10] * 3
    found = check([survey], Checkpoints.of(rows, names), Accuracy(accuracy_class=0.1))
    assert (found.checkpoint_count, found.counted, found.nva.count) == (30, 10, 10)
    assert found.not_counted == {"repeated": names[10:]}
    assert found.nva == check([survey], Checkpoints.of(rows[:10])).nva
    assert "ONLY 10 checkpoints" in found.statement and "by 10 of the 30" in found.verdict
    assert any(line.startswith("not counted") and " 20 " in line for line in found.lines())


def test_points_that_lie_near_each_other_are_not_the_same(survey):
    rows = xyz(10)
    near = rows + np.array([0.3, 0.0, 0.015])
    assert check([survey], Checkpoints.of(np.vstack((rows, near)))).counted == 20


def test_a_place_with_two_heights_does_not_count_and_one_that_is_control_is(survey):
    rows = np.vstack((xyz(10), xyz(10)[:3]))
    rows[10, 2] += 0.4
    types = [""] * 11 + ["Control", ""]
    found = check([survey], Checkpoints.of(rows, types=types))
    assert found.counted == 8
    assert found.not_counted == {
        "several heights": ["1", "11"], "control": ["2", "12"], "repeated": ["13"]
    }  # fmt: skip


def test_points_in_feet_that_repeat_each_other(tmp_path):
    foot = 1200 / 3937
    x, y, z, classes = cloud()
    path = write(tmp_path / "in.laz", x / foot, y / foot, z / foot, classes, "EPSG:2230+6360")
    rows = np.column_stack((places(5) / foot + CORNER, height(*places(5).T) / foot))
    found = check([path], Checkpoints.of(np.vstack((rows, rows + 0.03, rows + 1.0))))
    assert found.counted == 10 and found.not_counted["repeated"] == ["6", "7", "8", "9", "10"]


SPLIT = [  # names of control points and of checkpoints
    ("GCP{}", "CHK{}"), ("gcp_{}", "cp_{}"), ("GCP-{}", "ICP-{}"), ("site2_GCP0{}", "site2_chk0{}"),
    ("GCP{}", "VP{}"), ("PP{}", "KP{}"), ("Passpunkt {}", "Kontrollpunkt {}"),
    ("Passpunkt{}", "Prüfpunkt{}"), ("PA{}", "PV{}"), ("Point d'appui {}", "Point de contrôle {}"),
    ("apoyo {}", "verificación {}"), ("punto de control {}", "punto de comprobación {}"),
    ("appoggio{}", "verifica{}"), ("paspunt{}", "controlepunt{}"), ("GCP {}", "NVA {}"),
    ("CP{}", "CHK{}"), ("CP{}", "ICP{}"), ("Ponto de controle {}", "Ponto de verificação {}"),
    ("Control{}", "Check{}"), ("2024GCP{}", "2024CHKPT{}"), ("GCP{}A", "QC{}A"),
    ("Fotopunkt {}", "Punkt kontrolny {}"), ("GCP{}", "PK{}"), ("ctrl{}", "check{}"),
]  # fmt: skip


@pytest.mark.parametrize(("control", "checks"), SPLIT)
@pytest.mark.parametrize("in_types", [False, True])
def test_names_of_control_points_beside_those_of_check_points(survey, control, checks, in_types):
    names = [(checks if number % 2 else control).format(number) for number in range(10)]
    given = Checkpoints.of(xyz(10), None if in_types else names, types=names if in_types else None)
    progress = Heard()
    found = check([survey], given, progress=progress)
    assert found.counted == 5 and not found.unknown_covers
    assert [*found.not_counted] == ["control"] and len(found.not_counted["control"]) == 5
    assert found.nva.rmse < 0.01  # the others are 2 cm too low
    assert any("control" in fact.text for fact in found.facts if fact.name == "not counted")


@pytest.mark.parametrize(
    ("name", "other"),
    [("GCP{}", "GCP{}"), ("GCP{}", "P{}"), ("EGCP{}", "CHK{}"), ("gcpark{}", "CHK{}"),
     ("PP{}", "P{}"), ("CP{}", "P{}"), ("CHK-GCP{}", "CHK{}"), ("KP{}", "KP{}"), ("CP{}", "CP{}"),
     ("PA{}", "P{}"), ("Appalachia{}", "KP{}")],
)  # fmt: skip
def test_names_that_say_nothing_without_others_beside_them(survey, name, other):
    names = [(other if number % 2 else name).format(number) for number in range(10)]
    assert check([survey], Checkpoints.of(xyz(10), names)).counted == 10


def test_a_land_cover_or_a_use_beside_names_of_control_points(survey):
    names = [f"{'CHK' if number % 2 else 'GCP'}{number}" for number in range(10)]
    covers = ["forest" if number % 3 == 0 else "sand" for number in range(10)]
    found = check([survey], Checkpoints.of(xyz(10), names, covers))
    assert (found.counted, found.nva.count, found.vva.count) == (5, 3, 2)
    # A use outdoes a name.
    found = check([survey], Checkpoints.of(xyz(10), names, types=["check"] * 10))
    assert found.counted == 10


def test_a_table_of_gcps_alone_counts_but_is_told(tmp_path):
    found = table(tmp_path / "p.csv", xyz(3), ["GCP1", "GCP2", "gcp3"])
    assert "control points" in found.notes[0]
    assert not table(tmp_path / "p.csv", xyz(3), ["GCP1", "GCP2", "P3"]).notes


@pytest.mark.parametrize(
    "nodata", ["0", "0.000", "-9999", "-32768", "9999", "1e20", "NaN", "", "n/a", "-3.4e38", "-"]
)
@pytest.mark.parametrize("unit", ["z", "Elevation (ft)"])
def test_heights_that_are_nodata_are_left_out_and_named(tmp_path, survey, nodata, unit):
    rows = xyz(10).tolist()
    for row in rows:
        row[2] /= 1.0 if unit == "z" else FOOT
    for number in (1, 4):
        rows[number][2] = nodata
    given = table(tmp_path / "p.csv", rows, head=f"name,x,y,{unit}")
    found = check([survey], given)
    assert found.counted == 8 and found.not_counted == {"no height": ["P1", "P4"]}
    assert found.nva.rmse < 0.05 and not found.doubt
    (left,) = (fact.text for fact in found.facts if fact.name == "not counted")
    assert left.startswith("2 ") and left.endswith("P1, P4")


def test_a_height_of_zero_where_the_ground_is_near_it_counts(tmp_path):
    x, y, z, classes = cloud()
    sea = xyz(10)[3, 2] - 2.0
    path = write(tmp_path / "in.laz", x, y, z - sea, classes)
    rows = xyz(10) - [0.0, 0.0, sea]
    rows[3, 2] = 0.0
    found = check([path], Checkpoints.of(rows))
    assert found.counted == 10 and found.largest[0]["error"] == pytest.approx(2.0, abs=0.1)


def test_missing_heights_of_arrays(survey):
    rows = xyz(10)
    rows[:4, 2] = np.nan, -9999.0, 0.0, 1e20
    assert check([survey], Checkpoints.of(rows)).not_counted == {"no height": ["1", "2", "3", "4"]}
    rows[:, 2] = 0.0
    with pytest.raises(BareEarthError, match="10 without a height"):
        check([survey], Checkpoints.of(rows))


def layer_of(path, rows, **attributes):
    features = [
        {
            "type": "Feature",
            "properties": {name: values[number] for name, values in attributes.items()},
            "geometry": {"type": "Point", "coordinates": list(row)},
        }
        for number, row in enumerate(rows)
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return read_checkpoints(path)


def test_missing_heights_of_layers(survey, tmp_path):
    rows = xyz(10).tolist()
    rows[0][2], rows[1][2], rows[2] = 0.0, -9999.0, rows[2][:2]
    found = check([survey], layer_of(tmp_path / "p.geojson", rows))
    assert found.counted == 7 and found.not_counted == {"no height": ["1", "2", "3"]}
    heights = [None, -9999, *(row[2] for row in xyz(10).tolist()[2:])]
    flat = [row[:2] for row in xyz(10).tolist()]
    found = check([survey], layer_of(tmp_path / "p.geojson", flat, Elevation=heights))
    assert found.counted == 8 and found.not_counted == {"no height": ["1", "2"]}


@pytest.mark.parametrize("suffix", [".geojson", ".gpkg", ".shp", ".fgb"])
def test_outputs_name_what_was_left_out(survey, tmp_path, suffix):
    if suffix != ".geojson":
        pytest.importorskip("pyogrio")
    rows = np.vstack((xyz(10), xyz(10)[:2])).tolist()
    rows[5][2] = 0
    names = [f"{'GCP' if number == 7 else 'CHK'}{number}" for number in range(12)]
    table(tmp_path / "p.csv", rows, names)
    layer = tmp_path / f"r{suffix}"
    words = ["check", str(survey), "--checkpoints", str(tmp_path / "p.csv"), "--report"]
    words += [str(tmp_path / "r.html"), "--table", str(tmp_path / "t.csv"), "--residuals"]
    assert main([*words, str(layer)]) == 0
    with open(tmp_path / "t.csv", encoding="utf-8-sig", newline="") as file:
        read = {row["name"]: row for row in csv.DictReader(file)}
    states = {name: row["state"] for name, row in read.items() if row["state"] != "counted"}
    left = {"CHK5": "no height", "GCP7": "control", "CHK10": "repeated", "CHK11": "repeated"}
    assert states == left and read["CHK5"]["z"] == read["CHK5"]["error"] == ""
    page = Tags((tmp_path / "r.html").read_text(encoding="utf-8"))
    told = " ".join(page.texts)
    assert "CHK10, CHK11" in told and "nan" not in told
    again = read_checkpoints(layer, "name=NAME,cover=STATE,z=Z")
    assert {n: s for n, s in zip(again.names, again.covers) if s != "counted"} == left


FIELD = {  # counted checkpoints, the reason for the others, and how many these are
    "cp-ten-thrice.csv": (10, "repeated", 20), "cp-mixed-names.csv": (15, "control", 15),
    "cp-zero-heights.csv": (25, "no height", 5),
}  # fmt: skip


@pytest.mark.parametrize("name", FIELD)
def test_lists_from_the_field(name):
    given = read_checkpoints(real(f"field4/{name}"))
    found = check([real("field4/ground.laz")], given, Accuracy(accuracy_class=0.1))
    counted, reason, others = FIELD[name]
    assert found.counted == counted and len(found.not_counted[reason]) == others
    assert found.meets_class is (reason != "control")
