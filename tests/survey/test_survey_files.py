import os
import struct

import pytest
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.survey.files import Inputs, find_files, open_survey
from bare_earth.algorithms.survey.vpc import write_vpc

FEET = 'PROJCS["feet",GEOGCS["g",UNIT["degree",0.0174]],UNIT["US survey foot",0.30480060960]]'
METRES = 'PROJCS["{}",GEOGCS["g",UNIT["degree",0.0174]],UNIT["metre",1]{}]'
DEGREES = 'GEOGCS["lon lat",DATUM["d",SPHEROID["s",6378137,298]],UNIT["degree",0.0174]]'


def metres(name="site", code=None):
    return METRES.format(name, f',AUTHORITY["EPSG","{code}"]' if code else "")


def tile(las, name, west=0.0, south=0.0, side=100.0, wkt=None, **wanted):
    path = las.folder / name
    path.parent.mkdir(exist_ok=True, parents=True)
    wkt = metres() if wkt is None else wkt
    vlrs = [las.vlr(b"LASF_Projection", 2112, wkt.encode())] if wkt else []
    data = las.bytes(
        version=4,
        point_format=6,
        encoding=0x10,
        vlrs=vlrs,
        compressed=name.lower().endswith("laz"),
        **wanted,
    )
    data = bytearray(data)
    struct.pack_into("<6d", data, 179, west + side, west, south + side, south, 9.0, 1.0)
    path.write_bytes(data)
    return path


def names(paths):
    return [path.name for path in paths]


def test_a_folder_gives_its_clouds_sorted_and_not_those_below(las):
    for name in ("b.LAS", "a.laz", "c.copc.LAZ", "below/d.las", ".~0123abc1.las"):
        tile(las, name)
    (las.folder / "notes.txt").write_text("no list")
    assert names(find_files([las.folder])) == ["a.laz", "b.LAS", "c.copc.LAZ"]
    assert names(find_files([las.folder], recursive=True)) == [
        "a.laz", "b.LAS", "d.las", "c.copc.LAZ",
    ]  # fmt: skip


def test_every_kind_of_source_is_taken_and_each_file_once(las):
    files = [tile(las, f"{name}.las", 100.0 * number) for number, name in enumerate("abcd")]
    write_vpc(las.folder / "two.vpc", files[:2])
    listed = las.folder / "list.txt"
    listed.write_text('# a list\n\nc.las\n"d.las"\n  a.las\n', encoding="utf-8-sig")
    sources = [las.folder / "two.vpc", str(listed), files[3], las.folder / "." / "d.las"]
    survey = open_survey(sources)
    assert [part.path.resolve() for part in survey.tiles] == files
    assert find_files(las.folder) == files


def test_links_to_the_same_file_count_once(las):
    file = tile(las, "a.las")
    link = las.folder / "link.las"
    try:
        os.symlink(file, link)
    except OSError:
        pytest.skip("no symbolic links here")
    assert len(find_files([las.folder])) == 1


def test_a_tile_is_what_the_header_says(las):
    path = tile(las, "a.laz", 300, 500, count=77, extra=2)
    survey = open_survey([path])
    (found,) = survey.tiles
    assert (found.path, found.count, found.box) == (path, 77, (300, 500, 400, 600))
    assert (found.minimum[2], found.maximum[2]) == (1, 9)
    assert (found.scale, found.offset) == (las.SCALE, las.OFFSET)
    assert (found.point_format, found.record_length) == (6, 32)
    assert (found.is_compressed, found.is_copc) == (True, False)
    assert survey.crs.name == "site"


def test_a_broken_file_stops_nothing_and_is_told(las):
    good = tile(las, "good.las")
    (las.folder / "cut.las").write_bytes(good.read_bytes()[:-10])
    (las.folder / "other.laz").write_bytes(b"PK")
    tile(las, "nowhere.las", float("nan"))
    tile(las, "zero.las", side=0.0)
    tile(las, "empty.las", count=0)
    survey = open_survey([las.folder, las.folder / "missing.laz"])
    assert [part.path for part in survey.tiles] == [good]
    reasons = {path.path.name: path.reason for path in survey.broken}
    assert "damaged or cut off" in reasons["cut.las"]
    assert "not a LAS or LAZ file" in reasons["other.laz"]
    assert "does not state the extent" in reasons["nowhere.las"]
    assert "does not state the extent" in reasons["zero.las"]
    assert [layout.path.name for layout in survey.empty] == ["empty.las"]
    assert "does not exist" in reasons["missing.laz"]
    assert len(reasons) == 5


def test_nothing_that_can_be_read_is_an_error(las):
    for number in range(2):
        (las.folder / f"{number}.las").write_bytes(b"PK")
    with pytest.raises(BareEarthError, match=r"the 2 files .* not a LAS or LAZ"):
        open_survey([las.folder])
    with pytest.raises(BareEarthError, match=r"0\.las is not a LAS"):
        open_survey([las.folder / "0.las"])


@pytest.mark.parametrize(
    ("name", "text"),
    [("points.txt", "id E N H\nA 1 2 3\n"), ("points.txt", "500038.22 5500000.26 101.48\n"),
     ("points.txt", "1,2,3\n"), ("points.lst", "x;y;z\n1,5;2,5;3,5\n"), ("points.csv", "x,y,z\n"),
     ("cp.xlsx", "PK"), ("points.XYZ", "1 2 3\n")],
)  # fmt: skip
def test_a_table_of_points_is_to_be_converted(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(BareEarthError, match="is a table"):
        find_files(path)


def test_a_list_of_files_that_are_missing_is_no_table(tmp_path):
    path = tmp_path / "files.txt"
    path.write_text("tile 500 5500.laz\n568 5931 2.laz\n")
    with pytest.raises(BareEarthError, match=r"tile 500 5500\.laz.* not exist"):
        find_files(path)


def test_sources_that_are_none_are_told(las):
    with pytest.raises(BareEarthError, match=r"No \.las"):
        find_files([las.folder])
    with pytest.raises(BareEarthError, match="does not exist"):
        find_files([las.folder / "no folder"])
    for name, told in {"a.tif": "neither a point cloud", "a.vpc": "not a virtual"}.items():
        (las.folder / name).write_text("x")
        with pytest.raises(BareEarthError, match=told):
            find_files([las.folder / name])
    (las.folder / "a.txt").write_text("b.txt")
    with pytest.raises(BareEarthError, match="lists another list"):
        find_files([las.folder / "a.txt"])
    (las.folder / "a.txt").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(BareEarthError, match="UTF-8"):
        find_files([las.folder / "a.txt"])


@pytest.mark.parametrize(
    ("other", "told"),
    [
        (FEET, "feet in US survey foot, height US survey foot: b.las"),
        (metres("elsewhere"), "elsewhere in metre, height metre: b.las"),
        (metres("site", 25833), None),
        (DEGREES, "lon lat in degrees: b.las"),
    ],
)
def test_tiles_in_different_crs_are_refused(las, other, told):
    tile(las, "a.las", wkt=metres("site", 25832))
    tile(las, "b.las", 100, wkt=other)
    with pytest.raises(BareEarthError, match="not in the same CRS") as error:
        open_survey([las.folder])
    assert told is None or told in str(error.value)
    assert "site in metre, height metre: a" in str(error.value)


def test_one_crs_written_in_two_ways_is_one(las):
    tile(las, "a.las", wkt=metres("WGS 84 / UTM zone 32N", 32632))
    tile(las, "b.las", 100, wkt=metres("WGS_84_UTM_zone_32N"))
    heard = Heard()
    assert len(open_survey([las.folder], progress=heard).tiles) == 2
    assert heard.warnings == []


def heights(name, datum, unit="1", code=""):
    """Return a CRS with heights, given their name, datum, unit and the code of the datum."""
    code = code and f',AUTHORITY["EPSG","{code}"]'
    return (
        f'COMPD_CS["site + {name}",{metres("site", 25832)},VERT_CS["{name}",'
        f'VERT_DATUM["{datum}",2005{code}],UNIT["unit",{unit}],AXIS["Up",UP]]]'
    )


@pytest.mark.parametrize(
    "other",
    [
        heights("Wellington 1953", "Wellington 1953", code="5168"),
        heights("NZVD2016 (ft)", "New Zealand Vertical Datum 2016", "0.3048", "1169"),
        heights("NZVD2016", "New Zealand Vertical Datum 2016", "0.3048006096012192"),
    ],
)
def test_heights_of_another_datum_or_unit_are_refused_and_a_crs_helps(las, other):
    tile(las, "a.las", wkt=metres("site", 25832))
    one = heights("NZVD2016 height", "New Zealand Vertical Datum 2016", code="1169")
    tile(las, "b.las", 100, wkt=one)
    tile(las, "c.las", 200, wkt=other)
    with pytest.raises(BareEarthError, match="heights of the files") as error:
        open_survey([las.folder])
    told = str(error.value)
    assert "site + NZVD2016 height in metre, height metre: b.las" in told and "c.las" in told
    assert "such as EPSG:25832+7837" in told
    given = open_survey(Inputs([las.folder]).read_as(one))
    assert given.crs.datum.epsg == 1169


def test_a_datum_that_is_not_stated_or_named_differently_is_told(las):
    tile(las, "a.las", wkt=metres("site", 25832))
    tile(las, "b.las", 100, wkt=heights("NZVD2016 height", "New Zealand Vertical Datum 2016"))
    heard = Heard()
    assert open_survey([las.folder], progress=heard).crs.datum.crs == "NZVD2016 height"
    (info,) = [text for text in heard.infos if "datum" in text]
    assert "vertical datum" in info and " a.las" in info and not heard.warnings
    tile(las, "c.las", 200, wkt=heights("Vertical", "New_Zealand_Vertical_Datum_2016"))
    open_survey([las.folder], progress=heard)
    assert not heard.warnings
    tile(las, "d.las", 300, wkt=heights("Geoid 2016", "our geoid"))
    open_survey([las.folder], progress=heard)
    (warning,) = heard.warnings
    assert "NZVD2016 height" in warning and "Geoid 2016: d.las" in warning


def test_files_with_a_placeholder_for_their_datum_are_joined_and_told(las):
    tile(las, "a.las", wkt=heights("unknown", "unknown"))
    real = heights("NZVD2016 height", "New Zealand Vertical Datum 2016")
    for wkt in (real, heights("Ellipsoid (meters)", "Ellipsoid").replace("2005", "2002")):
        tile(las, "b.las", 100, wkt=wkt)
        heard = Heard()
        survey = open_survey([las.folder], progress=heard)
        assert len(survey.tiles) == 2 and survey.crs.datum is not None
        (told,) = [text for text in (*heard.infos, *heard.warnings) if "datum" in text]
        assert "vertical datum" in told and " a.las" in told
    assert heard.warnings == [told]  # heights above the ellipsoid are far off


def test_a_missing_crs_is_taken_from_the_others_if_these_are_metres(las):
    heard = Heard()
    tile(las, "a.las")
    for number in range(5):
        tile(las, f"b{number}.las", 100 * number + 100, wkt="")
    assert open_survey([las.folder], progress=heard).crs.name == "site"
    (warning,) = heard.warnings
    assert warning.startswith("b0.las, b1.las, b2.las and 2 more ")
    tile(las, "a.las", wkt=FEET)
    with pytest.raises(BareEarthError, match=r"none stated: b0\.las"):
        open_survey([las.folder])


def test_what_is_odd_about_all_files_is_told_once(las):
    # The heights have a unit, but none that is known.
    wkt = metres().join(('COMPD_CS["both",', ',VERT_CS["heights",VERT_DATUM["d",2005]]]'))
    for number in range(4):
        tile(las, f"{number}.las", 100 * number, wkt=wkt)
    heard = Heard()
    open_survey([las.folder], progress=heard)
    assert len(heard.warnings) == 1
    assert heard.warnings[0].endswith("(in 4 files)")
    assert heard.fractions[-1] == 1


def test_the_same_tile_twice_is_told(las):
    tile(las, "a.las")
    tile(las, "b.laz")
    heard = Heard()
    open_survey([las.folder], progress=heard)
    assert any("a.las and b.laz" in text and "extent" in text for text in heard.warnings)


def test_a_copy_beside_a_file_of_a_folder_is_left_out_and_it_is_told(las):
    for name in ("a.laz", "a.copc.laz", "b.las", "b.laz", "below/a.copc.laz"):
        tile(las, name)
    tile(las, "c.laz")
    tile(las, "c.copc.laz", count=59)
    tile(las, "d.laz")
    tile(las, "d.copc.laz", side=99.0)
    heard = Heard()
    survey = open_survey(Inputs([las.folder]).read_as(None, recursive=True), heard)
    assert names(part.path for part in survey.tiles) == [
        "a.laz", "b.las", "a.copc.laz", "c.copc.laz", "c.laz", "d.copc.laz", "d.laz",
    ]  # fmt: skip
    (info,) = heard.infos
    assert ": a.copc.laz (as a.laz), b.laz (as b.las)." in info


def test_copies_that_are_named_are_all_used(las):
    copc = tile(las, "a.copc.laz")
    heard, files = Heard(), [tile(las, "a.laz"), copc]
    survey = open_survey(files, progress=heard)
    assert names(part.path for part in survey.tiles) == ["a.copc.laz", "a.laz"]
    assert any("have the same extent" in text for text in heard.warnings) and not heard.infos
    # One that is named beside the folder is that which is used.
    (las.folder / "list.txt").write_text("../clouds/a.copc.laz")
    for more in (copc, las.folder / "list.txt"):
        survey = open_survey([las.folder, more])
        assert names(part.path for part in survey.tiles) == ["a.copc.laz"]


def test_the_tiles_that_touch_a_box_are_found(las):
    for row in range(4):
        for column in range(4):
            tile(las, f"{row}{column}.las", 100 * column, 100 * row)
    tile(las, "far.las", 450, 0, 50)
    survey = open_survey([las.folder])
    assert survey.box == pytest.approx((0, 0, 500, 400), abs=0.011)

    def touching(*box):
        return [part.path.stem for part in survey.touching(box)]

    assert touching(0, 0, 99, 99) == ["00"]
    assert touching(0, 0, 100, 100) == ["00", "01", "10", "11"]
    assert touching(101, 101, 199, 201) == ["11", "21"]
    assert touching(401, 0, 449, 50) == []
    assert touching(400, 0, 450, 50) == ["03", "far"]
    assert touching(310, 310, 320, 320) == ["33"]


def test_files_outside_of_the_folder_of_their_list_are_told(las):
    inside, outside = tile(las, "sub/a.las"), tile(las, "b.las", 100.0)
    vpc = las.folder / "sub" / "all.vpc"
    write_vpc(vpc, [inside, outside])
    heard = Heard()
    assert len(open_survey([vpc], progress=heard).tiles) == 2
    assert [text for text in heard.warnings if f"first is {outside.resolve()}" in text]
    write_vpc(las.folder / "all.vpc", [inside, outside])
    heard = Heard()
    open_survey([las.folder / "all.vpc"], progress=heard)
    assert not any("outside" in text for text in heard.warnings)
