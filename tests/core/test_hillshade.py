import numpy as np
import pytest

from bare_earth.algorithms.grids.hillshade import hillshade


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
