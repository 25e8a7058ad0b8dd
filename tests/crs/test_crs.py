import re
import struct

import pytest
from runs import Heard

from bare_earth.algorithms.crs import provider
from bare_earth.algorithms.crs.matching import is_other_datum
from bare_earth.algorithms.crs.system import Crs, compound_wkt, crs_of_wkt, unit_name
from bare_earth.algorithms.crs.wkt import of_map, read_wkt
from bare_earth.algorithms.las.crs_records import read_crs
from bare_earth.algorithms.las.opening import open_las

SURVEY, FOOT = 1200 / 3937, 0.3048
BASE_1 = 'GEOGCS["g",DATUM["d",SPHEROID["s",6378137,298.25]],UNIT["degree",0.0174532925199433]]'
BASE_2 = (
    'BASEGEOGCRS["g",DATUM["d",ELLIPSOID["s",6378137,298.25,LENGTHUNIT["metre",1]]],'
    'PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]]]'
)


def projcs(unit, extra=""):
    parameter = 'PARAMETER["false_easting",500000]'
    return f'PROJCS["flat",{BASE_1},PROJECTION["TM"],{parameter},{unit}{extra}]'


def projcrs(*units):
    conversion = 'CONVERSION["c",METHOD["TM"],PARAMETER["x",0,LENGTHUNIT["metre",1]]]'
    axes = f'CS[Cartesian,2],AXIS["(E)",east{units[0]}],AXIS["(N)",north{units[0]}]'
    return f'PROJCRS["flat",{BASE_2},{conversion},{axes}{"".join(units[1:])},ID["EPSG",26912]]'


METRE_1, SURVEY_1, FOOT_1 = (
    'UNIT["metre",1,AUTHORITY["EPSG","9001"]]',
    'UNIT["US survey foot",0.304800609601219,AUTHORITY["EPSG","9003"]]',
    'UNIT["foot",0.3048]',
)


def vertical_1(unit):
    return f'VERT_CS["NAVD88",VERT_DATUM["v",2005],{unit},AXIS["Up",UP]]'


def vertical_2(unit):
    return f'VERTCRS["NAVD88",VDATUM["v"],CS[vertical,1],AXIS["height",up],{unit}]'


SURVEY_2, FOOT_2, METRE_2 = (
    'LENGTHUNIT["US survey foot",0.304800609601219]',
    'LENGTHUNIT["foot",0.3048]',
    'LENGTHUNIT["metre",1]',
)


@pytest.mark.parametrize(
    ("text", "horizontal", "vertical"),
    [
        (projcs(METRE_1), 1, None),
        (projcs(SURVEY_1), SURVEY, None),
        (projcs(FOOT_1), FOOT, None),
        (f'COMPD_CS["c",{projcs(SURVEY_1)},{vertical_1(SURVEY_1)}]', SURVEY, SURVEY),
        (f'COMPD_CS["c",{projcs(METRE_1)},{vertical_1(SURVEY_1)}]', 1, SURVEY),
        (f'COMPD_CS["c",{projcs(FOOT_1)},{vertical_1(METRE_1)}]', FOOT, 1),
        (projcrs("", "," + METRE_2), 1, None),
        (projcrs("," + SURVEY_2), SURVEY, None),
        (projcrs("", "," + FOOT_2), FOOT, None),
        (f'COMPOUNDCRS["c",{projcrs("," + FOOT_2)},{vertical_2(METRE_2)}]', FOOT, 1),
        (f'COMPOUNDCRS["c",{projcrs("," + METRE_2)},{vertical_2(SURVEY_2)}]', 1, SURVEY),
        (
            f'BOUNDCRS[SOURCECRS[{projcrs("," + SURVEY_2)}],TARGETCRS[GEOGCRS["g"]]]',
            SURVEY,
            None,
        ),
        ('LOCAL_CS["site",UNIT["foot",0.3048]]', FOOT, None),
        ('PROJCS["cut off",GEOGCS["g",UNIT["degree",0.01', None, None),
    ],
)
def test_units_of_well_known_text(text, horizontal, vertical):
    facts = read_wkt(text)
    assert facts.horizontal_unit == (horizontal and pytest.approx(horizontal, rel=1e-9))
    assert facts.vertical_unit == (vertical and pytest.approx(vertical, rel=1e-9))
    assert facts.has_vertical == (vertical is not None)
    assert not facts.is_geographic


@pytest.mark.parametrize("text", ["", "EPSG:25832", '{"type": "ProjectedCRS"}', "][,,(", '"'])
def test_what_is_no_text_of_a_crs_says_nothing(text):
    assert read_wkt(text) is None


def test_the_code_is_that_of_the_crs_and_not_of_its_base():
    assert read_wkt(projcrs("," + METRE_2)).epsg == 26912
    assert read_wkt(projcs(METRE_1)).epsg is None
    assert read_wkt(projcs(METRE_1, ',AUTHORITY["EPSG","32632"]')).epsg == 32632


@pytest.mark.parametrize("kind", ["WKT1_GDAL", "WKT1_ESRI", "WKT2_2019", "WKT2_2015"])
@pytest.mark.parametrize(
    ("code", "horizontal", "vertical"),
    [
        ("EPSG:32632", 1, None),
        ("EPSG:2264", SURVEY, None),
        ("EPSG:2992", FOOT, None),
        ("EPSG:6349", None, 1),
        ("EPSG:26912+5703", 1, 1),
        ("EPSG:2264+6360", SURVEY, SURVEY),
        ("EPSG:26912+8228", 1, FOOT),
    ],
)
def test_units_of_what_proj_writes(code, horizontal, vertical, kind):
    pyproj = pytest.importorskip("pyproj")
    reference = pyproj.CRS.from_user_input(code)
    text = reference.to_wkt(kind)
    if text is None:
        pytest.skip(f"PROJ writes no {kind} of {code}")
    facts = read_wkt(text)
    if horizontal is None:
        assert facts.is_geographic
        return
    assert facts.horizontal_unit == pytest.approx(horizontal, rel=1e-9)
    assert facts.vertical_unit == (vertical and pytest.approx(vertical, rel=1e-9))


def keys(**values):
    numbers = {"model": 1024, "projected": 3072, "unit": 3076, "size": 3077, "geographic": 2048,
               "vertical": 4096, "vertical_unit": 4099}  # fmt: skip
    entries = [(numbers[name], 0, 1, value) for name, value in values.items() if name != "size"]
    if "size" in values:
        entries.append((3077, 34736, 1, 0))
    return struct.pack(f"<{4 + 4 * len(entries)}H", 1, 1, 0, len(entries), *sum(entries, ()))


def crs_of(las, *vlrs, encoding=0):
    progress = Heard()
    layout = open_las(las.make(vlrs=vlrs, encoding=encoding))
    return read_crs(layout, progress), progress


def geotiff(las, **values):
    records = [las.vlr(b"LASF_Projection", 34735, keys(**values))]
    if "size" in values:
        data = struct.pack("<d", values["size"])
        records.append(las.vlr(b"LASF_Projection", 34736, data))
    return records


@pytest.mark.parametrize(
    ("values", "horizontal", "vertical"),
    [
        ({"projected": 32767, "unit": 9001}, 1, 1),
        ({"projected": 32767, "unit": 9002}, FOOT, FOOT),
        ({"projected": 32767, "unit": 9003}, SURVEY, SURVEY),
        ({"projected": 32767, "unit": 9003, "vertical_unit": 9001}, SURVEY, 1),
        ({"projected": 32767, "unit": 9001, "vertical_unit": 9002}, 1, FOOT),
        ({"projected": 32767, "unit": 32767, "size": 0.25}, 0.25, 0.25),
        ({"unit": 9003}, SURVEY, SURVEY),
    ],
)
def test_units_of_geotiff_keys(las, values, horizontal, vertical):
    crs, _ = crs_of(las, *geotiff(las, model=1, **values))
    assert crs.horizontal_unit == pytest.approx(horizontal, rel=1e-12)
    assert crs.vertical_unit == pytest.approx(vertical, rel=1e-12)
    assert not crs.is_geographic


@pytest.mark.parametrize(
    ("code", "vertical", "expected"),
    [
        (2264, None, (SURVEY, SURVEY)),
        (2992, None, (FOOT, FOOT)),
        (26912, 5703, (1, 1)),
        (26912, 6360, (1, SURVEY)),
        (2992, 5703, (FOOT, 1)),
    ],
)
def test_units_of_the_codes_in_geotiff_keys(las, code, vertical, expected):
    pytest.importorskip("pyproj")
    more = {"vertical": vertical} if vertical else {}
    crs, _ = crs_of(las, *geotiff(las, model=1, projected=code, **more))
    assert crs.epsg == code and crs.wkt
    assert (crs.horizontal_unit, crs.vertical_unit) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("model", [2, 3])
def test_geotiff_keys_of_degrees(las, model):
    assert crs_of(las, *geotiff(las, model=model, geographic=4326))[0].is_geographic


def test_a_stated_unit_that_contradicts_the_code_is_used_and_told(las):
    pytest.importorskip("pyproj")
    crs, progress = crs_of(las, *geotiff(las, model=1, projected=32632, unit=9002))
    assert crs.horizontal_unit == FOOT
    assert any(re.search("unit metre.* foot", text) for text in progress.warnings)


def test_an_unknown_unit_is_taken_as_metres_and_told(las):
    crs, progress = crs_of(las, *geotiff(las, model=1, projected=32767, unit=9300))
    assert crs.horizontal_unit == 1.0
    assert any("EPSG code 9300" in text for text in progress.warnings)
    assert any("taken as metres" in text for text in progress.warnings)


def test_no_crs_is_taken_as_metres_and_told(las):
    crs, progress = crs_of(las)
    assert crs == Crs()
    (warning,) = progress.warnings
    assert warning.startswith("in.las does not say its CRS") and "metres" in warning
    assert "'crs', such as EPSG:25832" in warning


@pytest.mark.parametrize(("encoding", "unit"), [(0x00, FOOT), (0x10, SURVEY)])
def test_the_header_says_which_of_two_descriptions_holds(las, encoding, unit):
    text = las.vlr(b"LASF_Projection", 2112, projcs(SURVEY_1).encode())
    crs, _ = crs_of(las, text, *geotiff(las, model=1, unit=9002), encoding=encoding)
    assert crs.horizontal_unit == pytest.approx(unit, rel=1e-9)


NAVD88 = 'VERT_DATUM["North American Vertical Datum 1988",2005,AUTHORITY["EPSG","5103"]]'
COMPOUND_1 = f'COMPD_CS["c",{projcs(METRE_1)},VERT_CS["NAVD88",{NAVD88},{SURVEY_1}]]'
COMPOUND_2 = f'COMPOUNDCRS["c",{projcrs("," + METRE_2)},{vertical_2(FOOT_2)}]'


@pytest.mark.parametrize(
    ("point_format", "encoding", "text", "values", "expected"),
    [
        # Point formats 6 to 10 need text, whether the bit says so or not.
        (6, 0x00, COMPOUND_1, {"projected": 32767, "unit": 9001}, (1, SURVEY)),
        (7, 0x10, projcs(SURVEY_1), {"unit": 9001}, (SURVEY, SURVEY)),
        (6, 0x00, None, {"unit": 9001, "vertical_unit": 9003}, (1, SURVEY)),
        # What one lacks comes from the other.
        (6, 0x10, projcs(METRE_1), {"unit": 9001, "vertical_unit": 9003}, (1, SURVEY)),
        (6, 0x10, projcs(METRE_1), {"vertical_unit": 9002}, (1, FOOT)),
        (1, 0x00, COMPOUND_1, {"projected": 32767, "unit": 9001}, (1, SURVEY)),
        (1, 0x00, COMPOUND_2, {"projected": 26912, "unit": 9001}, (1, FOOT)),
        (1, 0x00, projcs(SURVEY_1), {"projected": 32767, "vertical_unit": 9001}, (SURVEY, 1)),
        (1, 0x10, projcs(FOOT_1), {"unit": 9002, "vertical_unit": 9001}, (FOOT, 1)),
        (6, 0x10, f'COMPD_CS["c",{projcs(METRE_1)},VERT_CS["v",VERT_DATUM["unknown",2005]]]',
         {"unit": 9001, "vertical_unit": 9002}, (1, FOOT)),
    ],
)  # fmt: skip
def test_units_come_from_all_records(las, point_format, encoding, text, values, expected):
    records = [] if text is None else [las.vlr(b"LASF_Projection", 2112, text.encode())]
    layout = open_las(
        las.make(
            vlrs=[*geotiff(las, model=1, **values), *records],
            version=4, point_format=point_format, encoding=encoding,
        )
    )  # fmt: skip
    progress = Heard()
    crs = read_crs(layout, progress)
    assert (crs.horizontal_unit, crs.vertical_unit) == pytest.approx(expected, rel=1e-9)
    contradicts = text == projcs(SURVEY_1) and values == {"unit": 9001}
    assert any("contradict each other" in told for told in progress.warnings) == contradicts


@pytest.mark.parametrize("encoding", [0x00, 0x10])
def test_a_text_behind_the_points_adds_to_keys_before_them(las, encoding):
    record = las.evlr(b"LASF_Projection", 2112, COMPOUND_1.encode() + b"\0")
    keys = geotiff(las, model=1, unit=9001)
    source = las.make(
        "in.laz", version=4, point_format=6, encoding=encoding, vlrs=keys, evlrs=[record]
    )
    assert read_crs(open_las(source)).vertical_unit == pytest.approx(SURVEY)


def test_two_texts_add_to_each_other_and_contradictions_are_told(las):
    before = las.vlr(b"LASF_Projection", 2112, projcs(METRE_1).encode())
    for behind, contradicts in ((COMPOUND_1, False), (projcs(SURVEY_1), True), ("", False)):
        record, progress = las.evlr(b"LASF_Projection", 2112, behind.encode()), Heard()
        source = las.make(
            "in.laz", version=4, point_format=6, encoding=0x10, vlrs=[before], evlrs=[record]
        )
        crs = read_crs(open_las(source), progress)
        assert crs.horizontal_unit == 1.0
        assert crs.vertical_unit == pytest.approx(SURVEY if behind == COMPOUND_1 else 1.0)
        told = [text for text in progress.warnings if "other well-known text" in text]
        assert len(told) == contradicts


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"unit": 9002}, "c + NAVD88 in metre, height US survey foot"),
        ({"unit": 9001, "vertical_unit": 9001}, "in metre, height metre"),
        ({"unit": 9001, "vertical": 5102}, "datum EPSG:5102 in metre"),
        ({"unit": 9001, "vertical": 5103}, None),
        ({"unit": 9001, "vertical_unit": 9003}, None),
    ],
)
def test_records_that_contradict_each_other_are_told(las, values, told):
    text = las.vlr(b"LASF_Projection", 2112, COMPOUND_1.encode())
    crs, progress = crs_of(las, text, *geotiff(las, model=1, **values), encoding=0x10)
    assert crs.vertical_unit == pytest.approx(SURVEY) and crs.datum.epsg == 5103
    warnings = [text for text in progress.warnings if "contradict each other" in text]
    assert len(warnings) == (told is not None)
    assert all(told in words and "give the CRS: with 'crs'" in words for words in warnings)


def test_the_old_code_of_an_ellipsoid_is_that_of_no_vertical_crs(las):
    crs, _ = crs_of(las, *geotiff(las, model=1, projected=32632, unit=9001, vertical=5030))
    assert crs.datum.is_ellipsoid and crs.datum.crs_epsg is None


def test_the_code_of_a_compound_crs_gives_both_parts(las):
    pytest.importorskip("pyproj")
    crs, progress = crs_of(las, *geotiff(las, model=1, projected=7415))
    assert crs.epsg == 28992 and crs.datum.epsg == 5109 and not progress.warnings


@pytest.mark.parametrize("kind", ["WKT1_GDAL", "WKT1_ESRI", "WKT2_2019"])
@pytest.mark.parametrize(
    ("code", "is_other"), [("2193+5770", True), ("2193+7839", False), ("2193", None)]
)
def test_the_datum_of_heights_is_known_in_each_form_of_text(kind, code, is_other):
    pyproj = pytest.importorskip("pyproj")
    one = crs_of_wkt(provider.wkt_of_text("EPSG:2193+7839"))
    other = crs_of_wkt(pyproj.CRS.from_user_input(f"EPSG:{code}").to_wkt(kind))
    # Texts of ESRI have no codes, so another name is no proof.
    expected = None if is_other and kind == "WKT1_ESRI" else is_other
    assert is_other_datum(one.datum, other.datum) is expected


@pytest.mark.parametrize("encoding", [0x00, 0x10])
def test_the_other_description_is_read_where_the_one_is_not_there(las, encoding):
    text = las.vlr(b"LASF_Projection", 2112, projcs(SURVEY_1).encode())
    assert crs_of(las, text, encoding=encoding)[0].horizontal_unit == pytest.approx(SURVEY)
    crs, _ = crs_of(las, *geotiff(las, model=1, unit=9002), encoding=encoding)
    assert crs.horizontal_unit == FOOT


@pytest.mark.parametrize("data", [b"", b"\0" * 7, b"\1\0" * 5, b"\xff" * 40])
def test_broken_keys_do_not_keep_a_file_from_being_read(las, data):
    crs, progress = crs_of(las, las.vlr(b"LASF_Projection", 34735, data))
    assert crs.horizontal_unit == 1.0 and progress.warnings


def test_heights_without_a_unit_take_that_of_x_and_y_and_it_is_told(las):
    text = f'COMPD_CS["c",{projcs(SURVEY_1)},VERT_CS["v",VERT_DATUM["d",2005]]]'
    crs, progress = crs_of(las, las.vlr(b"LASF_Projection", 2112, text.encode()), encoding=0x10)
    assert crs.vertical_unit == crs.horizontal_unit == pytest.approx(SURVEY)
    assert any("unit of the heights" in text for text in progress.warnings)


@pytest.mark.parametrize("unit", [1.0, FOOT, SURVEY, 0.25])
@pytest.mark.parametrize("text", [projcs(METRE_1), projcrs("," + METRE_2)])
def test_compound_text_reads_as_the_units_it_was_made_from(text, unit):
    crs = Crs(text, "flat", 1.0, unit)
    facts = read_wkt(compound_wkt(crs))
    assert facts.horizontal_unit == 1.0
    assert (facts.vertical_unit or facts.horizontal_unit) == pytest.approx(unit, rel=1e-12)


def test_compound_text_is_none_where_it_would_contradict_the_file():
    assert compound_wkt(Crs(projcs(METRE_1), "flat", FOOT, FOOT)) is None
    assert compound_wkt(Crs()) is None


def test_codes_need_no_library(las, monkeypatch):
    monkeypatch.setattr(provider.importlib.util, "find_spec", lambda name: None)
    crs, progress = crs_of(las, *geotiff(las, model=1, projected=2264, unit=9003))
    assert (crs.wkt, crs.epsg) == (None, 2264)
    assert crs.horizontal_unit == pytest.approx(SURVEY) and not progress.warnings


def test_a_library_knows_the_units_of_a_code():
    pytest.importorskip("pyproj")
    assert read_wkt(provider.wkt_of_epsg(2264)).horizontal_unit == pytest.approx(SURVEY)
    assert provider.wkt_of_epsg(32099 + 30_000) is None


@pytest.mark.parametrize(
    ("metres", "name"),
    [(1, "metre"), (FOOT, "foot"), (SURVEY, "US survey foot"), (0.25, "0.25 m")],
)
def test_units_have_names(metres, name):
    assert unit_name(metres) == name


@pytest.mark.parametrize(
    ("user", "number"),
    [(b"LASF_Projection", 4224), (b"PDAL", 4224), (b"liblas", 2112), (b"LASF_Projection", 4225),
     (b"PDAL", 4225)],
)  # fmt: skip
def test_the_records_of_pdal_and_liblas_are_read(las, user, number):
    pyproj = pytest.importorskip("pyproj")
    crs = pyproj.CRS("EPSG:2264+6360")
    text = {2112: crs.to_wkt("WKT1_GDAL"), 4224: crs.to_wkt(), 4225: crs.to_json()}[number]
    found, progress = crs_of(las, las.vlr(user, number, text.encode()))
    assert found.epsg == 2264 and found.datum.name == "North American Vertical Datum 1988"
    assert found.horizontal_unit == found.vertical_unit == pytest.approx(SURVEY)
    assert progress.warnings == []


@pytest.mark.parametrize("text", ["{}", '{"type": "GeographicCRS"', "[" * 5000, '{"a":' * 5000])
def test_a_projjson_that_cannot_be_read_is_named(las, text):
    crs, progress = crs_of(las, las.vlr(b"PDAL", 4225, text.encode()))
    assert crs == Crs()
    assert any("4225 (PROJJSON)" in warning for warning in progress.warnings)


def test_a_projjson_needs_a_library(las, monkeypatch):
    monkeypatch.setattr(provider.importlib.util, "find_spec", lambda name: None)
    _, progress = crs_of(las, las.vlr(b"PDAL", 4225, b'{"type": "ProjectedCRS"}'))
    assert any("pip install pyproj" in warning for warning in progress.warnings)


@pytest.mark.parametrize(
    "name", ["unknown", "Unknown vertical datum", "unnamed", "N/A", "none", ""]
)
def test_a_placeholder_states_no_vertical_datum(name):
    heights = f'VERT_CS["{name}",VERT_DATUM["{name}",2005],UNIT["metre",1],AXIS["Up",UP]]'
    crs = crs_of_wkt(f'COMPD_CS["x",{projcs(METRE_1)},{heights}]')
    assert crs.datum is None and crs.vertical_unit == 1.0
    above = crs_of_wkt(f'COMPD_CS["x",{projcs(METRE_1)},{heights.replace("2005", "2002")}]')
    assert above.datum.is_ellipsoid


@pytest.mark.parametrize("kind", ["WKT1_GDAL", "WKT1_ESRI", "WKT2_2019"])
@pytest.mark.parametrize("code", ["25832", "25832+7837", "25832 3D"])
def test_the_horizontal_part_of_a_text(kind, code):
    pyproj = pytest.importorskip("pyproj")
    crs = pyproj.CRS(f"EPSG:{code.split()[0]}")
    text = crs.to_3d().to_wkt() if "3D" in code else crs.to_wkt(kind)
    flat = pyproj.CRS(of_map(text))
    assert len(flat.axis_info) == 2 and flat.to_epsg(20) == 25832
    assert of_map(of_map(text)) == of_map(text)
