"""The quality of surveys whose densities, voids and strips are known."""

import json
import os

import laspy
import numpy as np
import pytest
from quality_by_hand import quality_by_hand
from runs import CancelAt
from surveys import heights_of, write_points

import bare_earth
from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.grids import piece_grid
from bare_earth.algorithms.las.reading import read_parts
from bare_earth.algorithms.tools.quality import cells, measuring

pyproj = pytest.importorskip("pyproj")
EAST, NORTH, SIZE = 500_000.0, 5_600_000.0, 100.0


def terrain(x, y):
    return 50.0 + 0.05 * x + 0.02 * y


def grid(step=0.5):
    """Return x and y of a regular grid of points that fills a square of 100 m."""
    along = np.arange(step / 2, SIZE, step)
    x, y = np.meshgrid(along, along)
    return x.ravel(), y.ravel()


def write(path, x, y, z, crs="EPSG:25832", **columns):
    return write_points(path, x, y, z, 2, offset=(EAST, NORTH, 0), crs=crs, **columns)


def measured(*paths, **options):
    return bare_earth.quality(paths, **options)


def states(found):
    return {line.name: line.state for line in found.comparison}


def test_the_density_of_a_regular_grid(tmp_path):
    x, y = grid(0.5)
    found = measured(write(tmp_path / "in.laz", x, y, terrain(x, y)))
    assert found.points == len(x)
    assert found.pulse_density == found.ground_density == found.point_density == 4.0
    assert found.ground_void_share == 0.0
    assert found.classes == {2: len(x)}
    assert found.comparison == []


@pytest.mark.rest(but="lbs-ql2-0.5-True")
@pytest.mark.parametrize(
    "name, step, passes", [("lbs-ql1", 0.5, False), ("lbs-ql2", 0.5, True), ("lbs-ql1", 0.25, True)]
)
def test_density_and_distribution_are_compared_with_the_specification(tmp_path, name, step, passes):
    x, y = grid(step)
    columns = {"classification": np.where(x < 3, 1, 2)}
    path = write(tmp_path / "in.laz", x, y, terrain(x, y), **columns)
    found = measured(path, specification=name)
    assert (states(found)["Density"] == "pass") == passes
    assert found.dense_share == (1.0 if passes else 0.0)
    # With one strip, nothing is known about differences between strips.
    assert found.passes is (None if passes else False)


def test_only_first_returns_count_as_pulses_and_neither_noise_nor_withheld(tmp_path):
    x, y = grid(0.5)
    number = np.arange(len(x)) % 2 + 1
    classes, withheld = np.full(len(x), 2), np.zeros(len(x), bool)
    x, y, z = (
        np.append(x, [50.0, 50.0]),
        np.append(y, [50.0, 50.0]),
        np.append(terrain(x, y), [400.0, 900.0]),
    )
    columns = {
        "return_number": np.append(number, [1, 1]),
        "number_of_returns": np.full(len(x), 2),
        "classification": np.append(classes, [18, 1]),
        "withheld": np.append(withheld, [False, True]),
    }
    found = measured(write(tmp_path / "in.laz", x, y, z, **columns), folder=tmp_path / "rasters")
    assert found.pulse_density == 2.0 and found.point_density == 4.0
    assert found.withheld == 1 and found.classes == {2: len(x) - 2, 18: 1}
    # All returns but withheld ones make the surface, noise included, as the specification says.
    heights = heights_of(tmp_path / "rasters" / "surface_height.tif")
    assert np.nanmax(heights) == 400.0


def forest(path, x, y, share=0.1, classes=5, returns=1):
    """Write a survey with 4 pulses in a square metre, of which a share reaches the ground in a
    square of 50 m, where pulses have so many returns.
    """
    is_forest = (np.abs(x - 50) < 25) & (np.abs(y - 50) < 25)
    is_above = is_forest & (np.arange(len(x)) % round(1 / share) > 0)
    z = terrain(x, y) + np.where(is_above, 9.0, 0.0)
    columns = {"classification": np.where(is_above, classes, 2)}
    columns["number_of_returns"] = np.where(is_above, returns, 1)
    return write(path, x, y, z, **columns)


def low_confidence(path):
    """Return the attributes of low confidence areas, and x and y of their corners."""
    features = json.loads(path.read_text("utf-8"))["features"]
    corners = (np.concatenate(one["geometry"]["coordinates"]) for one in features)
    return [one["properties"] for one in features], list(corners)


def test_a_low_confidence_area_of_known_size(tmp_path):
    path, areas = forest(tmp_path / "in.laz", *grid(0.5)), tmp_path / "areas.geojson"
    found = measured(path, low_confidence=areas, page=tmp_path / "page.html")
    assert found.low_confidence_density == 1.0 and found.low_confidence_count == 1
    ((area,), (corners,)) = low_confidence(areas)
    # Cells along its edge see the ground beside it.
    assert 46**2 < area["AREA"] < 51**2
    assert area["DENSITY"] == pytest.approx(0.4, abs=0.05) and area["RETURNS"] == 0.0
    assert np.abs(corners - (EAST + 50, NORTH + 50)).max() < 26
    # The land is the survey without its border of 10 m.
    assert found.low_confidence_share == pytest.approx(area["AREA"] / 80**2)
    assert found.low_confidence_without_plants == 1  # all pulses have one return
    assert "1 area of 2,000 m2" in (tmp_path / "page.html").read_text("utf-8")


def test_a_low_confidence_area_under_trees_is_told_from_a_roof(tmp_path):
    areas = tmp_path / "areas.geojson"
    trees = forest(tmp_path / "in.laz", *grid(0.5), returns=2)
    found = measured(trees, low_confidence=areas)
    assert found.low_confidence_count == 1 and found.low_confidence_without_plants == 0
    assert low_confidence(areas)[0][0]["RETURNS"] > 0.95


@pytest.mark.rest(but="enough ground")
@pytest.mark.parametrize("why", ["smaller", "enough ground", "specification", "water", "building"])
def test_what_is_no_low_confidence_area(tmp_path, why):
    share = {"enough ground": 0.5, "specification": 0.2}.get(why, 0.1)
    classes = {"water": 9, "building": 6}.get(why, 5)
    path = forest(tmp_path / "in.laz", *grid(0.5), share, classes)
    least = {"low_confidence_area": 2600.0} if why == "smaller" else {}
    # The specification asks for 2 pulses in a square metre, of which 0.8 are more than a quarter.
    asked = {"specification": "lbs-ql2"} if why == "specification" else {}
    areas = tmp_path / "areas.geojson"
    found = measured(path, low_confidence=areas, **least, **asked)
    assert found.low_confidence_count == 0 and found.low_confidence_share == 0.0
    assert low_confidence(areas) == ([], [])


def test_a_void_of_known_size(tmp_path):
    x, y = grid(0.5)
    hole = (np.abs(x - 50) < 10) & (np.abs(y - 50) < 10)
    ground = write(tmp_path / "in.laz", x[~hole], y[~hole], terrain(x, y)[~hole])
    found = measured(ground, specification="lbs-ql2", folder=tmp_path / "rasters")
    voids = heights_of(tmp_path / "rasters" / "voids.tif")
    # Farther than 3 m from ground points, whose cells begin at the edge of the void of 20 m.
    assert 13**2 <= np.nansum(voids == 1) <= 16**2
    assert found.void_count > 100 and states(found)["Voids of first returns"] == "look"
    density = heights_of(tmp_path / "rasters" / "pulse_density.tif")
    assert np.count_nonzero(density == 0) == 20**2
    # Where the same land is water, its voids are no fault.
    lake = write(
        tmp_path / "lake.laz", x, y, terrain(x, y), classification=np.where(hole, 9, 2),
        return_number=np.where(hole, 2, 1), number_of_returns=np.where(hole, 2, 1),
    )  # fmt: skip
    wet = measured(lake, specification="lbs-ql2")
    assert wet.void_count == 0 and wet.ground_void_share == 0.0 and wet.filled_share == 1.0


@pytest.mark.rest(but="0.12-fail")
@pytest.mark.parametrize("offset, state", [(0.05, "pass"), (0.12, "fail")])
def test_two_strips_with_a_known_offset(tmp_path, offset, state):
    x, y = grid(0.5)
    east = x + 0.25
    # The strips overlap in the middle 40 m.
    one, two = x < 70, east > 30
    xs, ys = np.append(x[one], east[two]), np.append(y[one], y[two])
    strip = np.append(np.full(one.sum(), 7), np.full(two.sum(), 65535))
    z = terrain(xs, ys) + np.where(strip == 65535, offset, 0.0)
    path = write(tmp_path / "in.laz", xs, ys, z, point_source_id=strip)
    found = measured(path, specification="lbs-ql2", folder=tmp_path / "rasters")
    assert found.strips == [7, 65535]
    assert found.strip_rms == pytest.approx(offset, abs=0.005)
    assert found.strip_shares[0 if offset < 0.08 else 1] == pytest.approx(1.0, abs=0.06)
    assert states(found)["Differences between strips"] == state
    # Of 10 to 100 m: the second strip reaches into a square of its own in the east.
    assert found.overlap_share == pytest.approx(4 / 9, abs=0.02)
    made = heights_of(tmp_path / "rasters" / "strip_differences.tif")
    assert np.nanmedian(made) == pytest.approx(offset, abs=0.003)
    assert np.count_nonzero(~np.isnan(made)) == pytest.approx(20 * 50, rel=0.06)
    number = heights_of(tmp_path / "rasters" / "overlap.tif")
    assert np.nanmax(number) == 2 and number[25, 5] == 1 and number[25, 25] == 2


def test_points_without_a_source_id_belong_to_the_strip_of_their_file(tmp_path):
    x, y = grid(0.5)
    files = [tmp_path / "one.laz", tmp_path / "two.laz"]
    for number, path in enumerate(files):
        there = x < 70 if number == 0 else x > 30
        here = x[there] + 0.25 * number, y[there]
        source = np.where(here[1] < 10, 7, 0)  # some points state a strip of their own
        z = terrain(*here) + 0.12 * number
        write(path, *here, z, point_source_id=source)
        with path.open("r+b") as file:
            file.seek(4)  # the file source id
            file.write([40, 65535][number].to_bytes(2, "little"))
    found = measured(*files, specification="lbs-ql2")
    assert found.strips == [7, 40, 65535]
    assert found.strip_rms == pytest.approx(0.12, abs=0.005)
    assert states(found)["Differences between strips"] == "fail"


@pytest.mark.parametrize("version, point_format", [("1.2", 1), ("1.4", 6), ("1.4", 7)])
@pytest.mark.parametrize("name", ["in.las", "in.laz"])
def test_the_strips_of_points_are_read_if_wanted(tmp_path, version, point_format, name):
    x, y = grid(1.0)
    strip = np.arange(len(x)) % 65536
    layout = {"version": version, "point_format": point_format, "point_source_id": strip}
    path = write(tmp_path / name, x, y, terrain(x, y), **layout)
    (part,) = read_parts(path, strips=True)
    np.testing.assert_array_equal(part.strip, strip)
    (part,) = read_parts(path)
    assert part.strip is None


def test_strips_are_not_judged_on_slopes_and_under_trees(tmp_path):
    x, y = grid(0.5)
    strip, several = np.arange(len(x)) % 2, np.where(y > 50, 2, 1)
    z = 0.3 * x + np.where(strip, 0.1, 0.0)
    path = write(tmp_path / "slope.laz", x, y, z, point_source_id=strip)
    assert measured(path).compared == 0
    z = terrain(x, y) + np.where(strip & (y > 50), 0.1, 0.0)
    columns = {"return_number": several, "number_of_returns": several, "point_source_id": strip}
    found = measured(write(tmp_path / "trees.laz", x, y, z, **columns))
    assert found.compared > 0 and found.strip_rms < 0.02
    assert found.strip_shares[1] == pytest.approx(0.5, abs=0.05)


def strips_scene(path, offset):
    """Write two strips over a square, of which the second is off in the north, with a house."""
    random = np.random.default_rng(5)
    x, y = random.uniform(0, SIZE, (2, 60_000))
    strip = np.arange(len(x)) % 2 + 11
    z = terrain(x, y) + random.normal(0, 0.02, len(x))
    z[(strip == 12) & (y > 60)] += offset
    # A house, and trees that one return meets: both strips see them alike, but not cell by cell.
    z[(np.abs(x - 30) < 6) & (np.abs(y - 30) < 8)] += 4.0
    in_tree = (np.hypot(x % 12 - 6, y % 12 - 6) < 1.5) & (random.uniform(size=len(x)) < 0.5)
    z[in_tree] += random.uniform(0.5, 6.0, in_tree.sum())
    classes = np.where(z > terrain(x, y) + 0.2 + (strip == 12) * (y > 60) * offset, 1, 2)
    return write(path, x, y, z, point_source_id=strip, classification=classes)


@pytest.mark.rest
def test_strips_far_apart_in_a_part_of_the_overlap_fail_and_trees_and_houses_do_not(tmp_path):
    off = measured(strips_scene(tmp_path / "off.laz", 1.2), specification="lbs-ql1")
    assert off.strip_rms == pytest.approx(1.2 * 0.375**0.5, rel=0.15)
    assert off.strip_largest > 1.1
    assert states(off)["Differences between strips"] == "fail" and off.passes is False
    fits = measured(strips_scene(tmp_path / "fits.laz", 0.0), specification="lbs-ql1")
    assert fits.strip_rms < 0.04 and fits.compared > 0.4 * fits.overlapping
    assert states(fits)["Differences between strips"] == "pass"


def test_few_compared_cells_are_no_pass(tmp_path):
    x, y = grid(0.5)
    strip = np.where((x < 44) | (np.arange(len(x)) % 2 == 0), 1, 2)
    strip[(x > 50) | (y > 22) | (y < 14)] = 1
    path = write(tmp_path / "in.laz", x, y, terrain(x, y), point_source_id=strip)
    found = measured(path, specification="lbs-ql2")
    assert 0 < found.compared < 30 and found.strip_rms < 0.01
    assert states(found)["Differences between strips"] == "look" and found.passes is None


@pytest.mark.rest
def test_points_that_files_share_duplicates_and_points_that_were_not_measured_are_no_pulses(
    tmp_path,
):
    x, y, z, columns = scene()
    columns["gps_time"] = np.arange(len(x)) * 1e-4
    whole = measured(write(tmp_path / "one.laz", x, y, z, **columns))
    west, east = x < 60, x > 40

    def part(name, some, more=0, **others):
        which = np.append(np.flatnonzero(some), np.flatnonzero(some)[:more])
        kept = {key: values[which] for key, values in {**columns, **others}.items()}
        return write(tmp_path / name, x[which], y[which], z[which], **kept)

    buffered = measured(part("w.laz", west, more=500), part("e.laz", east, more=300))
    # Of the points that one file repeats, some are those that the other holds.
    assert buffered.shared >= np.count_nonzero(west & east) and buffered.duplicates > 500
    assert buffered.shared + buffered.duplicates == np.count_nonzero(west & east) + 800
    for name in ("pulse_density", "ground_density", "point_density", "filled_share"):
        assert getattr(buffered, name) == pytest.approx(getattr(whole, name), abs=1e-6)
    assert buffered.strip_rms == pytest.approx(whole.strip_rms, abs=1e-3)
    # Other attributes of a copy do not make it another point.
    again = measured(part("w.laz", west), part("e.laz", east, user_data=np.arange(len(x)) % 7))
    assert again.shared == np.count_nonzero(west & east) and again.duplicates == 0
    made = np.arange(len(x)) % 3 == 0
    synthetic = measured(part("s.laz", west | east, synthetic=made))
    assert synthetic.synthetic == made.sum()
    assert synthetic.pulse_density == pytest.approx(whole.pulse_density * 2 / 3, rel=0.02)
    assert f"synthetic: {made.sum():,}" in "\n".join(synthetic.lines())


def test_points_that_are_all_synthetic_count_unless_a_specification_asks_for_pulses(tmp_path):
    x, y = grid(0.5)
    path = write(tmp_path / "images.laz", x, y, terrain(x, y), synthetic=np.ones(len(x), bool))
    found = measured(path)
    assert found.ground_density == 4.0 and found.synthetic == len(x)
    assert measured(path, specification="lbs-ql2").pulse_density == 0.0


# What infilled, virtual and synthetic points say of themselves.
MADE = {
    "no return": {"return_number": 0, "number_of_returns": 0, "classification": 2},
    "no return of one": {"return_number": 0, "classification": 26},
    "own source": {"classification": 26, "gps_time": 5.0},
    "own source of virtual points": {"classification": 66, "point_source_id": 7},
    "source of a strip": {"classification": 66, "point_source_id": 12},
    "synthetic": {"synthetic": True},
}


def infilled_scene(**made):
    """Return two strips with a house whose land was infilled, and which points are infilled."""
    x, y, z, columns = scene()
    columns["classification"][columns["classification"] == 9] = 2
    strip = np.where(x + np.random.default_rng(4).uniform(-12, 12, len(x)) < 50, 11, 12)
    house = (np.abs(x - 55) < 6) & (np.abs(y - 45) < 6)
    here = np.flatnonzero(house)
    which = np.concatenate((np.flatnonzero(~house), here))
    is_made = np.arange(len(which)) >= len(which) - len(here)
    columns = {name: values[which] for name, values in columns.items()}
    columns.update(point_source_id=strip[which], gps_time=np.where(is_made, 0.0, 1.0 + which))
    z = z[which] - 3.0 * is_made
    columns.update(return_number=1, number_of_returns=1, synthetic=False)
    for name, value in {"point_source_id": 0, **made}.items():
        columns[name] = np.where(is_made, value, columns[name])
    columns = {name: np.broadcast_to(values, is_made.shape) for name, values in columns.items()}
    return x[which], y[which], z, columns, is_made


@pytest.mark.rest
@pytest.mark.parametrize("kind", MADE)
def test_points_that_were_made_are_neither_pulses_nor_strips_and_are_told(tmp_path, kind):
    x, y, z, columns, is_made = infilled_scene(**MADE[kind])
    path = write(tmp_path / "in.laz", x, y, z, **columns)
    left = {name: values[~is_made] for name, values in columns.items()}
    without = write(tmp_path / "out.laz", x[~is_made], y[~is_made], z[~is_made], **left)
    found, right = (measured(some, specification="lbs-ql1") for some in (path, without))
    assert found.strips == right.strips == [11, 12]
    assert found.infilled + found.synthetic == is_made.sum() and right.infilled == 0
    assert found.void_count == right.void_count > 100
    for name in ("pulse_density", "ground_density", "filled_share", "strip_rms", "overlap_share"):
        assert getattr(found, name) == pytest.approx(getattr(right, name), rel=1e-6)
    assert f"ed: {is_made.sum():,}" in found.no_pulses or kind == "synthetic"


@pytest.mark.rest
def test_measured_points_of_producers_classes_and_without_any_return_numbers_count(tmp_path):
    x, y, z, columns = scene()
    whole = measured(write(tmp_path / "in.laz", x, y, z, **columns))
    bridge = np.where(np.abs(x - 50) < 5, 26, columns["classification"])
    times = np.ones(len(x))
    path = write(tmp_path / "in.laz", x, y, z, **{**columns, "classification": bridge},
                 gps_time=times)  # fmt: skip
    assert measured(path).pulse_density == whole.pulse_density
    zeros = np.zeros(len(x), dtype=int)
    none = {**columns, "return_number": zeros, "number_of_returns": zeros}
    path = write(tmp_path / "none.laz", x, y, z, **none)
    found = measured(path)
    assert found.infilled == 0 and found.pulse_density == found.point_density > 5
    # Beside a tile that counts returns, too; but a tile of a lake that was filled is no survey.
    counts = write(tmp_path / "counts.laz", x + 100, y, z, **columns)
    assert measured(path, counts).infilled == 0
    none["classification"] = np.full(len(x), 9)
    lake = write(tmp_path / "lake.laz", x, y, z, **none)
    assert measured(lake, counts).infilled == len(x) and measured(lake).infilled == 0


@pytest.mark.rest
def test_all_figures_are_those_of_a_computation_by_hand(tmp_path):
    x, y, z, columns, is_made = infilled_scene(**MADE["no return"])
    random = np.random.default_rng(8)
    z += np.where(columns["point_source_id"] == 12, 0.02 + 0.1 * (y > 60), 0.0)
    kept = (np.hypot(x - 40, y - 70) > 7) & (random.uniform(size=len(x)) < 0.5)
    pond = np.hypot(x - 75, y - 70) < 9
    columns["classification"] = np.where(pond & ~is_made, 9, columns["classification"])
    columns = {name: values[kept] for name, values in columns.items()}
    path = write(tmp_path / "in.laz", x[kept], y[kept], z[kept], **columns)
    las = laspy.read(path)
    names = ("x", "y", "z", *columns, "withheld")
    right = quality_by_hand({name: las[name] for name in names}, is_made[kept], 0.35, 8.0)
    found = measured(path, specification="lbs-ql1").as_dict()
    assert right["void_count"] > 50 and right["compared"] > 100 and right["strip_largest"] > 0.1
    for name, value in right.items():
        assert found[name] == pytest.approx(value, rel=1e-6), name


@pytest.mark.rest
@pytest.mark.parametrize("flag", ["flag", "class 12"])
def test_points_of_overlap_are_no_pulses(tmp_path, flag):
    x, y = grid(0.25)
    inside = x < 50
    of_one = inside & (np.arange(len(x)) % 2 == 0)
    density = {}
    for name, flagged in (("one strip", of_one), ("all", inside)):
        columns = {"version": "1.2", "point_format": 1} if flag == "class 12" else {}
        if flag == "class 12":
            columns["classification"] = np.where(flagged, 12, 2)
        else:
            columns["overlap"] = flagged
        path = write(tmp_path / f"{name}.laz", x, y, terrain(x, y), **columns)
        density[name] = measured(path, specification="lbs-ql1")
        assert density[name].flagged == flagged.sum()
    # With a flag for the points of one strip, the others are left; the flag of all leaves none,
    # so that land is not judged.
    assert density["one strip"].flagged_area == 0.0
    assert density["one strip"].pulse_density == pytest.approx(16 * 0.75, abs=0.1)
    # Squares of 10 m from 10 to 50 m, without the border of the survey.
    assert density["all"].flagged_area == 40.0 * 80.0
    assert density["all"].pulse_density == 16.0
    assert density["all"].void_count == 0 and density["all"].filled_share == 1.0


def test_what_could_not_be_measured_is_no_pass(tmp_path):
    x, y = grid(0.5)
    path = write(tmp_path / "in.laz", x, y, terrain(x, y), overlap=np.ones(len(x), bool))
    found = measured(path, specification="lbs-ql2")
    assert found.pulse_density is None and found.filled_share is None and found.void_count is None
    lines = states(found)
    assert lines["Density"] == lines["Cells with a first return"] == "look"
    assert lines["Voids of first returns"] == "look" and found.passes is None
    assert "not measured" in "\n".join(found.lines())


def test_low_vegetation_is_counted_on_a_slope(tmp_path):
    x, y = grid(0.5)
    random = np.random.default_rng(1)
    slope = 0.8 * x
    low = x > 50
    z = np.concatenate((slope, slope[low] + random.uniform(0.3, 1.9, low.sum()), slope[low] + 5))
    classes = np.concatenate((np.full(len(x), 2), np.full(2 * low.sum(), 1)))
    x, y = (np.concatenate((axis, axis[low], axis[low])) for axis in (x, y))
    path = write(tmp_path / "in.laz", x, y, z, classification=classes)
    measured(path, folder=tmp_path / "rasters")
    made = heights_of(tmp_path / "rasters" / "low_vegetation.tif")
    assert (made[:, 52:98] == 4.0).all() and (made[:, 2:48] == 0.0).all()


def test_class_0_left_over_old_formats_and_no_crs(tmp_path):
    x, y = grid(0.5)
    classes = np.where(np.arange(len(x)) < 3, 0, 2)
    path = write(tmp_path / "a.laz", x, y, terrain(x, y), classification=classes)
    lines = states(measured(path, specification="lbs-ql2"))
    assert lines["Class 0 (never classified)"] == "fail"
    assert lines["Files"] == lines["CRS"] == "pass"
    old = write(tmp_path / "b.laz", x, y, terrain(x, y), None, version="1.2", point_format=1)
    lines = states(measured(old, specification="lbs-ql2"))
    assert lines["Class 0 (never classified)"] == "pass"
    assert lines["Files"] == lines["CRS"] == "fail"
    lines = states(measured(path, specification="ign"))
    assert lines["Class 0 (never classified)"] == "fail"
    assert lines["Classes that are not listed"] == "pass"
    assert lines["Density"] == "fail"
    lines = states(measured(path, specification="linz"))
    assert lines["Class 6 (building)"] == "look" and lines["Density"] == "pass"


def scene(seed=3):
    random = np.random.default_rng(seed)
    x, y = np.round(random.uniform(0, SIZE, (2, 60_000)), 3)
    z = np.round(terrain(x, y) + random.normal(0, 0.03, len(x)), 3)
    classes, strip = (
        random.choice([1, 2, 9], len(x), p=[0.3, 0.69, 0.01]),
        random.integers(1, 4, len(x)),
    )
    z[classes == 1] += 1.0
    return x, y, z, {"classification": classes, "point_source_id": strip}


@pytest.fixture(scope="module")
def one_and_many(tmp_path_factory):
    folder = tmp_path_factory.mktemp("survey")
    x, y, z, columns = scene()
    one, many = write(folder / "one.laz", x, y, z, **columns), []
    for number in range(4):
        part = (x // 50.0001 + 2 * (y // 50.0001)) == number
        some = {name: values[part] for name, values in columns.items()}
        many.append(write(folder / f"part{number}.laz", x[part], y[part], z[part], **some))
    return one, many


@pytest.mark.rest
def test_many_files_equal_one(one_and_many, tmp_path):
    one, many = one_and_many
    first = measured(one, specification="lbs-ql2", folder=tmp_path / "one")
    second = measured(*many, specification="lbs-ql2", folder=tmp_path / "many")
    for name in ("points", "classes", "pulse_density", "filled_share", "void_count", "area"):
        assert getattr(first, name) == getattr(second, name)
    assert first.strip_rms == pytest.approx(second.strip_rms, abs=1e-6)
    same_rasters(tmp_path / "one", tmp_path / "many", 1e-5)


def same_rasters(one, other, tolerance):
    paths = sorted(one.iterdir())
    assert len(paths) > 5 and [path.name for path in paths] == sorted(os.listdir(other))
    for path in paths:
        np.testing.assert_allclose(heights_of(path), heights_of(other / path.name), atol=tolerance)


@pytest.mark.rest
def test_pieces_and_cells_on_disk_change_nothing(one_and_many, tmp_path, monkeypatch):
    one, _ = one_and_many
    measured(one, folder=tmp_path / "whole")
    monkeypatch.setattr(cells, "_TILE", 22)
    monkeypatch.setattr(cells, "_MOST_IN_MEMORY", 100)
    for module in (piece_grid, measuring):
        monkeypatch.setattr(module, "_TOGETHER", 1_000)
    measured(one, folder=tmp_path / "pieces")
    same_rasters(tmp_path / "whole", tmp_path / "pieces", 1e-6)


def test_too_many_cells_are_refused(one_and_many, monkeypatch):
    monkeypatch.setattr(cells, "MOST_CELLS", 1_000)
    with pytest.raises(BareEarthError, match="larger cell size"):
        measured(one_and_many[0])


def test_the_command_writes_a_page_and_prints_figures(one_and_many, tmp_path, capsys):
    page, folder = tmp_path / "page.html", tmp_path / "rasters"
    command = ["quality", str(one_and_many[0]), "--specification", "lbs-ql2"]
    assert main([*command, "--page", str(page), "--folder", str(folder), "--cell-size", "2"]) == 0
    assert "first returns/m2" in capsys.readouterr().out
    html = page.read_text(encoding="utf-8")
    # All rasters, and the low confidence areas.
    assert html.count("<figure>") == len(os.listdir(folder)) + 1
    assert "Spatial Distribution and Regularity" in html and "<script" not in html
    assert main([*command, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["specification"] == "lbs-ql2" and found["lines"][0]["state"] == "pass"


def test_a_survey_without_ground(tmp_path):
    x, y = grid(1.0)
    path = write(tmp_path / "in.laz", x, y, terrain(x, y), classification=np.full(len(x), 1))
    found = measured(path, page=tmp_path / "page.html", folder=tmp_path / "rasters")
    assert found.ground_density == 0.0 and found.ground_void_share == 1.0
    assert found.strip_rms is None


def test_feet_are_converted(tmp_path):
    x, y = grid(0.5)
    foot, path = 1200 / 3937, tmp_path / "in.laz"
    write(path, x / foot, y / foot, terrain(x, y) / foot, crs="EPSG:2230+6360")
    found = measured(path, folder=tmp_path / "rasters")
    assert found.pulse_density == pytest.approx(4.0, rel=0.02)
    heights = heights_of(tmp_path / "rasters" / "surface_height.tif")
    assert np.nanmax(heights) == pytest.approx(terrain(x, y).max() / foot, abs=0.01)


@pytest.mark.rest
def test_a_cancel_leaves_no_output_and_old_ones_as_they_were(one_and_many, tmp_path):
    page, folder = tmp_path / "page.html", tmp_path / "rasters"
    run = {"page": page, "folder": folder}

    def cancelled():
        for share in (0.5, 0.9, 1.0):
            with pytest.raises(Cancelled):
                measured(one_and_many[0], **run, progress=CancelAt(share))
            yield share

    assert [share for share in cancelled() if list(tmp_path.iterdir())] == []
    measured(one_and_many[0], **run)
    old = [page, *folder.iterdir()]
    for path in old:
        path.write_bytes(b"old")
    for _ in cancelled():
        assert {path.read_bytes() for path in old} == {b"old"}
        assert sorted(folder.iterdir()) == sorted(old[1:])
