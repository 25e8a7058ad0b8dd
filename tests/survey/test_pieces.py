"""Surveys in pieces far apart, and points that lie far from all others."""

import json

import numpy as np
import pytest
from checkpoints import write
from runs import said
from surveys import write as write_cloud
from water_scenes import lake_scene

import bare_earth


def _cloud(path, x, y):
    metres = np.column_stack((x, y, np.full(len(x), 50.0)))
    return write_cloud(path, np.round(metres * 100).astype(np.int64), classes=2)


def _site(count=4000, east=0.0, north=0.0, side=60.0, seed=0):
    x, y = np.random.default_rng(seed).uniform(0.0, side, (2, count))
    return x + east, y + north


def _joined(*sites):
    return np.concatenate(sites, axis=1)


STRAY = np.array([[30_000.0], [24_000.0]])
# Columns of points, and what is told of strays, if anything is.
CLOUDS = {
    "a stray point": (_joined(_site(), STRAY), "1 point lies 38 km"),
    "two at one place": (_joined(_site(), STRAY, STRAY + 3.0), "2 points lie 38 km"),
    "two apart": (_joined(_site(), STRAY, -STRAY), "1 point lies 38 km"),
    "a second site": (_joined(_site(), _site(400, 22_000.0)), ""),
    "a small second site": (_joined(_site(40_000), _site(400, 22_000.0)), ""),
    "no stray point": (_site(), ""),
    "a corridor": (np.array([np.linspace(0.0, 20_000.0, 9000)] * 2), ""),
}


@pytest.mark.rest(but="no stray point")
@pytest.mark.parametrize("name", CLOUDS)
def test_points_far_from_all_others_are_told_and_sites_are_not(tmp_path, name):
    points, expected = CLOUDS[name]
    path = _cloud(tmp_path / "a.laz", *points)
    code, _, told = said("info", path)
    assert code == 0 and expected in told
    assert told.count("from all others") == (2 if name == "two apart" else bool(expected))
    if name == "two at one place":
        words = "terrain", path, "--dtm", tmp_path / "a.tif", "--dtm-cell-size", 50
        for more in ((), ("--water", "automatic")):
            code, _, told = said(*words, *more)
            assert code == 0 and told.count(expected) == 1


def test_a_stray_point_in_a_file_of_its_own_is_told(tmp_path):
    _cloud(tmp_path / "a.laz", *_site())
    _cloud(tmp_path / "b.laz", *STRAY)
    words = "terrain", tmp_path, "--dtm", tmp_path / "a.tif", "--dtm-cell-size", 50
    assert "1 point lies 38 km" in said(*words)[2]


@pytest.mark.rest
def test_water_is_that_of_each_piece(tmp_path):
    scene = lake_scene("empty")
    columns = scene.x, scene.y, scene.z

    def found(name, x, y, z, classes):
        source, target = tmp_path / f"{name}.laz", tmp_path / f"{name}.geojson"
        write(source, x, y, z, classes)
        summary = bare_earth.water(source, target)
        features = json.loads(target.read_text("utf-8"))["features"]
        return summary, [feature["geometry"] for feature in features]

    summary, (alone,) = found("alone", *columns, scene.classes)
    more = [np.append(axis, end) for axis, end in zip(columns, (30_000.0, 24_000.0, 50.0))]
    assert found("stray", *more, np.append(scene.classes, 2)) == (summary, [alone])
    twice = [np.concatenate((axis, axis + far)) for axis, far in zip(columns, (2e4, 2e4, 0.0))]
    found_twice, both = found("twice", *twice, np.tile(scene.classes, 2))
    assert found_twice.lakes == 2 and found_twice.cell == summary.cell and both[1] == alone
