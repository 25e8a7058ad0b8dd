import numpy as np
import pytest

from bare_earth.algorithms.relief.hillshade import hillshade, multidirectional_hillshade


def plane(slope_east, slope_north, size=6, cell=2.0):
    rows, columns = np.mgrid[0:size, 0:size]
    return slope_east * columns * cell - slope_north * rows * cell


def test_a_level_plane_is_as_bright_as_the_sine_of_the_altitude():
    shade = hillshade(plane(0, 0), 2.0, altitude=30.0)
    assert np.all(shade == round(1 + 254 * 0.5))


def test_a_slope_that_faces_the_light_is_brightest():
    facing, averted = hillshade(plane(-1, 0), 2.0, 90.0), hillshade(plane(1, 0), 2.0, 90.0)
    assert facing[2, 2] == 255
    assert averted[2, 2] == 1


@pytest.mark.parametrize(("azimuth", "slopes"), [(0, (0, -1)), (180, (0, 1)), (270, (1, 0))])
def test_the_azimuth_is_clockwise_from_north(azimuth, slopes):
    assert hillshade(plane(*slopes), 2.0, azimuth)[2, 2] == 255


def test_cells_without_height_are_0_and_do_not_darken_their_neighbours():
    heights = plane(0, 0).astype(float)
    heights[2, 3] = np.nan
    shade = hillshade(heights, 2.0)
    assert shade[2, 3] == 0
    assert len(np.unique(shade[shade > 0])) == 1


def test_four_lights_are_weighed_by_how_much_they_face_the_slope():
    # Towards the northwest, at 45 degrees: light from there meets it at a right angle, those from
    # west and north at 60 degrees, and that from the southwest has no weight.
    fall = np.sqrt(0.5)
    (shade,) = np.unique(multidirectional_hillshade(plane(fall, -fall), 2.0)[1:-1, 1:-1])
    oblique = 0.5 + 0.5 * np.sqrt(0.5)
    assert shade == round(1 + 254 * (1.0 + 2 * 0.5 * oblique) / 2)


def test_four_lights_show_what_runs_along_one_light():
    # A ridge from northwest to southeast: in one light its flanks are as bright as each other.
    rows, columns = np.mgrid[0:41, 0:41]
    ridge = 3.0 * np.exp(-(((rows - columns) / 8.0) ** 2))
    one, four = hillshade(ridge, 1.0), multidirectional_hillshade(ridge, 1.0)
    southwest, northeast = (20, 15), (20, 25)
    assert one[southwest] == one[northeast]
    assert int(four[southwest]) - int(four[northeast]) > 30


def test_level_land_is_as_bright_in_four_lights_as_in_one():
    level = plane(0, 0).astype(float)
    level[0, 0] = np.nan
    assert np.array_equal(multidirectional_hillshade(level, 1.0), hillshade(level, 1.0))
