"""By how much places would rise as ground, before anybody says so."""

import numpy as np
import pytest
from surveys import write_points

import bare_earth
from bare_earth.algorithms.survey.files import Inputs
from bare_earth.algorithms.tools.review.lift import lifts_of

OFFSET = (500_000.0, 5_600_000.0, 0.0)


def square(west, south, side=20.0):
    corners = [(0, 0), (side, 0), (side, side), (0, side)]
    return (np.add(corners, (OFFSET[0] + west, OFFSET[1] + south)),)


@pytest.mark.rest(but="False")
@pytest.mark.parametrize("is_split", [False, True])
def test_a_hill_lifts_its_place_and_a_roof_does_not(tmp_path, is_split):
    x, y = np.random.default_rng(5).uniform(0, 120, (2, 60_000))
    hill = np.clip(10.0 - np.hypot(x - 30, y - 30), 0.0, None) * 0.5  # up to 5 m
    roof = (x > 70) & (x < 90) & (y > 70) & (y < 90)
    is_hill = hill > 0
    z = 100.0 + hill + np.where(roof, 8.0, 0.0)
    classes = np.where(roof | is_hill, 1, 2)
    folder = tmp_path / "points"
    folder.mkdir()
    parts = {"west": x < 33, "east": x >= 33} if is_split else {"all": x >= 0}
    for name, some in parts.items():
        path = folder / f"{name}.laz"
        write_points(path, x[some], y[some], z[some], classes[some], offset=OFFSET)
    dtm = tmp_path / "dtm.tif"
    bare_earth.terrain(folder, crs=25832, dtm=dtm, dtm_cell_size=1.0)
    places = [square(20, 20), square(70, 70), square(95, 10), square(900, 900)]
    up, of_roof, flat, outside = lifts_of(Inputs(folder), places, dtm)
    # The terrain is flat below the hill, of which 95 % lie below 3.9 m.
    assert up == pytest.approx(3.9, abs=0.5)
    assert not of_roof > 0.3 and not flat > 0.3 and np.isnan(outside)
