"""What surveyors and their software write about checkpoints."""

import json

import numpy as np
import pytest
from checkpoints import CORNER, check, cloud, height, places, write
from realdata import real
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.tools.check.accuracy import Accuracy
from bare_earth.algorithms.tools.check.checkpoints import Checkpoints
from bare_earth.algorithms.tools.check.columns import ColumnName
from bare_earth.algorithms.tools.check.land_covers import LandCovers
from bare_earth.algorithms.tools.check.reading import read_checkpoints
from bare_earth.algorithms.tools.check.residuals import offset_in_words

X, Y, Z = 500010.25, 5600020.5, 51.125


def read(tmp_path, text, columns=None, name="p.csv"):
    (tmp_path / name).write_text(text, encoding="utf-8")
    return read_checkpoints(tmp_path / name, columns)


VEGETATED = """Forest|Nadelwald|brush land|VVA|Vegetated|tall grass|Forêt|Corn|Corn field
    |Maize|Wheat|Marsh
    |Swamp|Mangrove|Undergrowth|GRASS_TALL|Hecke|TallGrass|Tall weeds and crops
    |Brush lands and low trees|Woody Wetlands|Shrub/Scrub|Cultivated Crops|open woodland
    |Gravel/shrubs|under trees|VVA_12|Cornfield|Vegetated Vertical Accuracy|Tussock
    |hohes Gras|Gebuesch|Röhricht|Maisfeld|Waldboden|Weinberg|Fichtenwald|Weg unter Bäumen
    |herbes hautes|Roseaux|Sous-bois|haies|Culture de maïs|Végétation basse|Bomen|Naaldbos
    |Hoog gras|Struiken|Árboles|hierba alta|Maíz|Matorral denso|Olivar|Alder|Eucalyptus
    |Erlen|Buschwerk|hohe Wiese|Ronciers|Canne à sucre|Prairie haute|Populieren
    |Onderbegroeiing|Girasoles|Arrozal|Sottobosco|Erba alta|Brughiera|Milho|Capim alto
    |Pinhal|Las|Las sosnowy|Wysoka trawa|Krzaki|Marsh grass|Blackberries|Tall meadow
    |Weizenacker|Kartoffelacker|Baumreihe|Mangroven|Champ de céréales|Pantano|Humedal
    |Zona boscosa|Mangrovie|Milharal|Cana-de-açúcar|Brejo|Korenveld|Ondergroei|Mokradło
    |Żywopłot|Pole kukurydzy|Podrost"""
OPEN = """NVA|non-vegetated|unvegetated|no trees|Street|asphalt|grass|Woodward Street|Treeless
    |Wooden deck|Waldweg|Open terrain|Urban|OpenTerrain|Short grass|Forest road|Oak Avenue
    |Nonvegetated|Non-vegetated (bare earth)|NVA - short grass|FVA|Reed Street
    |road in forest|vegetation free|Developed, Open Space|Bush track
    |Non-Vegetated Vertical Accuracy|Straße|Forststraße|vegetationslos|unbewachsen|Wiesenweg
    |ohne Bewuchs|sans végétation|chemin forestier|chemin en forêt|Sol nu|pont en bois
    |sin vegetación|Camino del bosque|Suelo desnudo|Bospad|bosweg|geen bomen|Plowed field
    |Deforested|Steinbruch|Clairière|Déboisé|Onbegroeid|Asfalt|Barbecho|Gravilla
    |Calle de las flores|Via del Bosco|Erba bassa|Terreno nudo|Relva curta|Sem vegetação
    |Holzterrasse|städtisch|Avenida del Bosque|Terraza de madera|Terrazza in legno
    |Trilha na floresta|Boomloos|Bez drzew|Drewniany taras|Terreno aperto|Teren otwarty
    |Droga leśna|Niska trawa|Bez roślinności"""


def names_in(text):
    return [word.strip() for word in text.split("|")]


@pytest.mark.parametrize("cover", names_in(VEGETATED))
def test_land_covers_that_are_vegetated(cover):
    assert LandCovers().kind("", cover) == "VVA"


@pytest.mark.parametrize("cover", names_in(OPEN))
def test_land_covers_that_are_not(cover):
    assert LandCovers().kind("", cover) == "NVA"


@pytest.mark.parametrize(
    "cover", ["Moon", "GS", "Metall", "12", "Woodward", "Hollywood", "Oakland"]
)
def test_land_covers_that_are_not_known(cover):
    assert LandCovers().kind("", cover) == ""


@pytest.mark.parametrize(
    ("use", "cover", "kind"),
    [("Control", "", "control"), ("GCP", "forest", "control"), ("3D GCP", "", "control"),
     ("Passpunkt", "", "control"), ("Point d'appui", "", "control"), ("", "GCP-01", "control"),
     ("Check", "forest", "VVA"), ("Check Point", "", None), ("Kontrollpunkt", "", None),
     ("point de contrôle", "", None), ("Quality control", "", None), ("NVA", "forest", "NVA"),
     ("NVA Check Point", "", "NVA"), ("Vegetated", "", "VVA")],
)  # fmt: skip
def test_uses_of_points(use, cover, kind):
    assert LandCovers().kind(use, cover) == kind


@pytest.mark.parametrize(
    ("name", "unit"),
    [("Elevation (ft)", 0.3048), ("z_ftUS", 1200 / 3937), ("Höhe [m]", 1.0), ("ELEV_FT", 0.3048),
     ("Height (US survey ft)", 1200 / 3937), ("Elev, feet", 0.3048), ("Z", None), ("m", None)],
)  # fmt: skip
def test_units_in_headers(name, unit):
    assert ColumnName.of(name).unit == unit


HEIGHTS = [  # the one that is taken comes first
    ("Elevation", "Height"), ("H", "h"), ("ortho_ht", "ellips_h"), ("Cota ortométrica", "Altura"),
    ("Höhe über NHN", "Höhe"), ("Elevation", "Ellipsoidal height"), ("NHN-Höhe", "ell. Höhe"),
    ("Elevation NAVD88", "Elevation"), ("altitude NGF", "hauteur ellipsoïdale"), ("H_ortho", "z"),
    ("Height", "HAE"), ("Elev", "Geoid height"), ("Elevation", "Elevation RMS"),
    ("z", "Antenna height"), ("RL", "Height"), ("AHD", "RL"), ("Known Z", "Laser Z"),
    ("Survey elevation", "dZ"), ("Orth Ht", "Elev"), ("Height above mean sea level", "H"),
    ("OrthoHeight", "EllHt"), ("MSL", "Height (WGS84)"),
]  # fmt: skip


@pytest.mark.parametrize(("taken", "left"), HEIGHTS)
@pytest.mark.parametrize("is_first", [True, False])
def test_which_height_is_taken(tmp_path, taken, left, is_first):
    names = (taken, left) if is_first else (left, taken)
    values = (Z, Z + 47) if is_first else (Z + 47, Z)
    text = "id;x;y;{};{}\nP;{};{};{};{}\n".format(*names, X, Y, *values)
    found = read(tmp_path, text)
    assert found.xyz.tolist() == [[X, Y, Z]]
    is_height = ColumnName.of(left).rank("z") is not None
    assert len(found.notes) == is_height
    assert not is_height or found.notes[0].index(taken) < found.notes[0].rindex(left)


def test_a_height_above_the_ellipsoid_that_has_no_other_beside_it(tmp_path):
    assert "above the ellipsoid" in read(tmp_path, f"x,y,HAE\n{X},{Y},{Z}\n").notes[0]
    same = read(tmp_path, f"x,y,z,Elevation (ft)\n{X},{Y},{Z},{Z / 0.3048}\n")
    assert not same.notes and same.xyz[0, 2] == Z


EMLID = (
    "Name,Code,Code description,Easting,Northing,Elevation,Description,Longitude,Latitude,"
    "Ellipsoidal height,Origin,Easting RMS,Northing RMS,Elevation RMS,Lateral RMS,Antenna height,"
    "Antenna height units,Solution status,Base easting,Base northing,Base elevation\n"
    f"P1,TR,Tree,{X},{Y},{Z},,9.0,50.5,{Z + 47},Local,0.01,0.01,0.02,0.014,1.8,m,FIX,500,56,5\n"
)
TABLES = {
    "emlid": EMLID,
    "agisoft": "# CoordinateSystem: EPSG:25832\n"
    "#Label,X/Easting,Y/Northing,Z/Altitude,Error_(m),X_error,Y_error,Z_error,X_est,Y_est,Z_est\n"
    f"P1,{X},{Y},{Z},0.02,0.01,0.01,0.01,{X + 1},{Y + 1},{Z + 1}\n# Total Error\n",
    "agisoft with cameras": "# Cameras (1)\n#Label,X/East,Y/North,Z/Altitude\n"
    f"DJI_1.JPG,{X},{Y},150\n# Markers (1)\n#Label,X/East,Y/North,Z/Altitude\nP1,{X},{Y},{Z}\n",
    "pnezd": f"P1,{Y},{X},{Z},TR\nP2,{Y + 1},{X},{Z},\n",
    "penzd": f"P1,{X},{Y},{Z},TR\nP2,{X},{Y + 1},{Z},TR\n",
    "pnez": f"P1 {Y} {X} {Z}\n",
    "usgs": "unique_identifier,point_type,source_easting,source_northing,source_elevation\n"
    f"P1,NVA,{X},{Y},{Z}\n",
    "title": f"Report of 2024;;;\n\nPunktnr.;Rechtswert;Hochwert;Höhe\nP1;{X};{Y};{Z}\n;;;\n;;;\n",
    "comments": f"// by GNSS\n% and a level\nname,x,y,z\n! here\nP1,{X},{Y},{Z}\n# end\n",
    "units": f"Name,East,North,Elevation\n,[m],[m],[ft]\nP1,{X},{Y},{Z / 0.3048:.6f}\n",
    "odm": f"EPSG:25832\n{X} {Y} {Z} 10 20 A.JPG P1\n{X} {Y} {Z} 11 21 B.JPG P1\n",
    "odm in words": f"WGS84 UTM 32N\n{X} {Y} {Z} 10 20 A.JPG P1\n",
    "odm with proj": f"+proj=utm +zone=32 +ellps=GRS80 +units=m\n{X} {Y} {Z} 10 20 A.JPG P1\n",
    "two headers": f"name,x,y,z\nP1,{X},{Y},{Z}\nname,x,y,z\nP2,{X},{Y},{Z}\n",
}


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    return write(tmp_path_factory.mktemp("survey") / "in.laz", *cloud())


@pytest.mark.parametrize("kind", TABLES)
def test_tables_of_field_software(tmp_path, survey, kind):
    from bare_earth.algorithms.classes.ground_classes import GroundClasses
    from bare_earth.algorithms.tools.check.survey_ground import SurveyGround

    given = read(tmp_path, TABLES[kind], name="gcp_list.txt")
    found = given.located(SurveyGround.of([survey], GroundClasses()).place, near=20.0)
    assert found.names[0] == "P1" and given.count == 1 + (found.names[-1] == "P2")
    # The CRS of two of them is not that of the points.
    assert found.xyz[0] == pytest.approx([X, Y, Z], abs=0.01)


def test_ground_control_points_are_told_and_checks_among_them_count(tmp_path):
    rows = "{} {} {} 10 20 A.JPG {}\n"
    found = read(tmp_path, "EPSG:25832\n" + rows.format(X, Y, Z, "gcp1"), name="gcp_list.txt")
    assert "control points" in found.notes[0]
    text = "EPSG:25832\n" + rows.format(X, Y, Z, "a") + rows.format(X, Y, Z, "CHK-b")
    found = read(tmp_path, text, name="gcp_list.txt")
    assert found.types == ("control", "check") and not found.notes


@pytest.mark.parametrize("kind", ["NVA", "VVA"])
def test_the_name_of_a_file_says_the_kind_if_nothing_else_does(tmp_path, kind):
    found = read(tmp_path, f"id,x,y,z\nP,{X},{Y},{Z}\n", name=f"county_{kind}_2024.csv")
    assert found.types == (kind,) and kind in found.notes[0]
    found = read(tmp_path, f"id,x,y,z,cover\nP,{X},{Y},{Z},sand\n", name=f"{kind}.csv")
    assert found.types == ("",) and not found.notes


def test_a_column_that_says_yes_or_no_to_plants(tmp_path):
    rows = "".join(f"{X},{Y},{Z},{name}\n" for name in ("yes", "no", "1", "none", "forest"))
    found = read(tmp_path, "x,y,z,Vegetation\n" + rows)
    kinds = [LandCovers().kind("", cover) for cover in found.covers]
    assert kinds == ["VVA", "NVA", "VVA", "NVA", "VVA"]


def test_rows_without_coordinates_are_left_out_and_told(tmp_path):
    found = read(tmp_path, f"name,x,y,z\nP1,{X},{Y},{Z}\nP2,,,\nP3,,,\n")
    assert found.names == ("P1",)
    assert "2 rows" in found.notes[0] and "Line 3 " in found.notes[0]
    with pytest.raises(BareEarthError, match=r"Line 3 .* x, but ''"):
        read(tmp_path, f"name,x,y,z\nP1,{X},{Y},{Z}\nP2,,{Y},{Z}\n")
    with pytest.raises(BareEarthError, match=r"Line 3 .* z, but 'wet'"):
        read(tmp_path, f"name,x,y,z\nP1,{X},{Y},{Z}\nP2,{X},{Y},wet\n")
    with pytest.raises(BareEarthError, match="z, but '-9999'"):
        read(tmp_path, f"name,x,y,z\nP1,{X},{Y},-9999\nP2,{X},{Y},-9999\n")


@pytest.mark.parametrize(
    "text",
    [f"EPSG:25832\n{X} {Y} {Z} 1 2 A.JPG P\n{X}\n",
     f"name,x,zP,{X},{Y},{Z}\nname\nP,{X},{Y},{Z}\n", f"x,y,z\n{X},{Y},{Z}\nend of file,\n"],
)  # fmt: skip
def test_damaged_tables_are_refused_with_a_sentence(tmp_path, text):
    with pytest.raises(BareEarthError, match=r"has no number|no column|holds no"):
        read(tmp_path, text)


@pytest.mark.parametrize("name", ["p.xlsx", "p.XLS", "p.ods"])
def test_spreadsheets_are_to_be_saved_as_csv(tmp_path, name):
    with pytest.raises(BareEarthError, match="CSV"):
        read(tmp_path, "PK", name=name)


def test_columns_that_differ_by_capitals_alone(tmp_path):
    text = f"x,y,h,H\n{X},{Y},{Z + 47},{Z}\n"
    assert read(tmp_path, text, "z=H").xyz[0, 2] == Z
    assert read(tmp_path, text, "z=h").xyz[0, 2] == Z + 47


def layer(tmp_path, heights, **fields):
    """Write points with z, and with attributes of one value each."""
    features = [
        {
            "type": "Feature",
            "properties": {name: values[k] for name, values in fields.items()},
            "geometry": {"type": "Point", "coordinates": [X + k, Y, z]},
        }
        for k, z in enumerate(heights)
    ]
    path = tmp_path / "p.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


GIVEN = [Z, Z + 1, Z + 2]
HIGHER = [option + 47 for option in GIVEN]


@pytest.mark.parametrize(
    ("heights", "fields", "expected", "note"),
    [([0, 0, 0], {"Elevation": GIVEN}, GIVEN, "not z of the points"),
     ([Z, 0, Z + 2], {"Elevation": GIVEN}, GIVEN, "not z of the points"),
     ([-9999, Z, Z], {"Elevation": GIVEN}, GIVEN, "not z of the points"),
     ([9, 9, 9], {"Elevation": GIVEN}, GIVEN, "not z of the points"),
     (HIGHER, {"ortho_ht": GIVEN}, GIVEN, "not z of the points"),
     (GIVEN, {"Height": HIGHER}, GIVEN, "not the attribute Height"),
     (GIVEN, {"Elevation": GIVEN}, GIVEN, None),
     (GIVEN, {"elev_ft": [option / 0.3048 for option in GIVEN]}, GIVEN, None)],
)  # fmt: skip
def test_z_of_the_geometry_or_of_an_attribute(tmp_path, heights, fields, expected, note):
    found = read_checkpoints(layer(tmp_path, heights, **fields))
    assert found.xyz[:, 2].tolist() == expected
    assert (note in found.notes[0]) if note else not found.notes


@pytest.mark.parametrize("z", [0, -9999])
def test_points_whose_z_is_nodata_are_refused(tmp_path, z):
    with pytest.raises(BareEarthError, match=f"{z}, a nodata"):
        read_checkpoints(layer(tmp_path, [z, z], name=["a", "b"]))


def test_units_of_columns_are_those_of_the_points(tmp_path):
    foot = 1200 / 3937
    x, y, z, classes = cloud()
    xy = places(30)
    heights = height(*xy.T)
    metres = write(tmp_path / "m.laz", x, y, z, classes)
    feet = write(tmp_path / "ft.laz", x / foot, y / foot, z / foot, classes, "EPSG:2230+6360")
    rows = "".join(
        f"{a + 500_000:.4f},{b + 5_600_000:.4f},{up / 0.3048:.4f}\n"
        for (a, b), up in zip(xy, heights)
    )
    progress = Heard()
    given = read(tmp_path, "East [m],North [m],Elev (ft)\n" + rows)
    assert check([metres], given, progress=progress).nva.rmse < 0.05
    assert any("feet" in text for text in progress.infos)
    # "ft" of points in US survey feet is this foot: coordinates of millions stay.
    rows = "".join(
        f"{a / foot + 500_000:.4f},{b / foot + 5_600_000:.4f},{up / foot:.4f}\n"
        for (a, b), up in zip(xy, heights)
    )
    given = read(tmp_path, "East (ft),North (ft),Elev (ft)\n" + rows)
    found = check([feet], given, progress=progress)
    assert found.counted == 30 and found.nva.rmse < 0.05


def points_at(xy, heights, **others):
    return Checkpoints.of(np.column_stack((xy + CORNER, heights)), **others)


def test_control_points_are_left_out_and_unknown_covers_are_told(survey, tmp_path):
    xy = places(8)
    true = height(*xy.T)
    types = ["Control", "Control", "NVA", "NVA", "VVA", "check", "", ""]
    covers = ["", "", "", "", "", "forest", "Moon", "sand"]
    progress = Heard()
    found = check([survey], points_at(xy, true, covers=covers, types=types), progress=progress)
    assert (found.counted, found.nva.count, found.vva.count) == (6, 4, 2)
    assert found.not_counted == {"control": ["1", "2"]} and found.unknown_covers == {"Moon": 1}
    assert "Moon (1)" in " ".join(progress.warnings)
    none = points_at(xy, true, types=["VVA"] * 8)
    found = check([survey], none, Accuracy(accuracy_class=0.1))
    assert found.meets_class is None and "No checkpoint" in found.statement
    with pytest.raises(BareEarthError, match=r"8 .*control"):
        check([survey], points_at(xy, true, types=["GCP"] * 8))


def test_names_say_the_kind_if_nothing_else_does(survey):
    xy = places(4)
    names = ["NVA-1", "NVA02", "VVA_1", "x4"]
    found = check([survey], points_at(xy, height(*xy.T), names=names))
    assert (found.nva.count, found.vva.count) == (3, 1)


@pytest.mark.parametrize(
    ("change", "words"),
    [(lambda z: z + 47.3, "above"), (lambda z: z - 30, "below"),
     (lambda z: z / 0.3048, "feet"),
     (lambda z: z + 1.8, "antenna"), (lambda z: z + 400, "unit")],
)  # fmt: skip
def test_a_difference_of_metres_is_named_and_nothing_is_stated(survey, change, words):
    xy, progress = places(40), Heard()
    given = points_at(xy, change(height(*xy.T)))
    found = check([survey], given, Accuracy(accuracy_class=0.1), progress=progress)
    assert words in found.doubt and found.doubt in progress.warnings[-1]
    assert found.meets_class is None and found.shift is None
    assert "meet" not in found.statement and found.lines()[0].endswith(found.doubt)


@pytest.mark.parametrize("in_feet", [False, True])
def test_other_heights_that_fit_are_taken(survey, tmp_path, in_feet):
    xy, progress = places(20), Heard()
    true = height(*xy.T)
    names = "x,y,z,Altitude (ft)" if in_feet else "x,y,z,Altitude"
    rows = [(x + 500_000, y + 5_600_000, z + 47, z / (0.3048 if in_feet else 1))
            for (x, y), z in zip(xy.tolist(), true.tolist())]  # fmt: skip
    text = "\n".join([names, *(",".join(map(str, row)) for row in rows)])
    found = check([survey], read(tmp_path, text), progress=progress)
    assert not found.doubt and found.nva.rmse < 0.05
    assert "column Altitude" in progress.warnings[-1]
    chosen = check([survey], read(tmp_path, text, "z=z"))
    assert chosen.doubt and chosen.nva.mean == pytest.approx(-47, abs=0.1)


def test_errors_that_are_not_alike_are_no_other_datum():
    random = np.random.default_rng(1)
    true = random.uniform(40, 60, 30)
    assert offset_in_words(true, true + random.normal(0, 3, 30)) == ""
    assert offset_in_words(true, true + 0.4) == "" and offset_in_words(true[:0], true[:0]) == ""
    assert offset_in_words(true[:1], true[:1] + 2.0) == ""
    assert "40.00 m above" in offset_in_words(true[:1], true[:1] + 40.0)


FIELD = {  # counted checkpoints without and with vegetation
    "cp-usgs_Survey_Points.gpkg": (28, 8), "cp-covers.csv": (6, 10),
    "cp-height-and-elevation.csv": (40, 0), "cp-header-feet.csv": (40, 0),
    "cp-excel-empty-rows.csv": (40, 0), "cp-odm-gcp_list.txt": (40, 0),
}  # fmt: skip


@pytest.mark.rest(but="cp-header-feet.csv")
@pytest.mark.parametrize("name", FIELD)
def test_files_from_the_field(name):
    given = read_checkpoints(real(f"field2/{name}"))
    found = check([real("field2/ground.laz")], given)
    counts = [0 if figures is None else figures.count for figures in (found.nva, found.vva)]
    assert tuple(counts) == FIELD[name] and found.nva.rmse < 0.03
