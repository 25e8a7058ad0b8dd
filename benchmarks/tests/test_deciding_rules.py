"""The raster of the rules that decided cells: what is ground by it is ground by the filter."""

import numpy as np
import pytest

from bare_earth import BareEarthError
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.las.cloud import survey_frame
from benchmarks.clouds import classify_cloud
from benchmarks.deciding_rules import deciding_rules
from benchmarks.scenes import make

rasterio = pytest.importorskip("rasterio")


@pytest.mark.parametrize("method", METHODS)
def test_each_cell_has_the_rule_that_decided_it(method, tmp_path):
    scene = make("village", seed=7, size=60.0)
    counts = deciding_rules(scene.cloud(), tmp_path / "rules.tif", method)
    with rasterio.open(tmp_path / "rules.tif") as raster:
        codes, left, top = raster.read(1), raster.bounds.left, raster.bounds.top
        size = raster.transform.a
        names = raster.descriptions[0].split(": ")[2].split(", ")
    numbers = {name: int(number) for number, name in map(str.split, names)}
    cloud = scene.cloud()
    x, y = cloud.places(slice(None), survey_frame(cloud.crs))
    code = codes[((top - y) / size).astype(int), ((x - left) / size).astype(int)]
    classes, takes_part = classify_cloud(scene.cloud(), METHODS[method].parameters())
    ground = classes == 2
    assert (code[takes_part] > 0).all() and (code[ground] < 100).all()
    # A house of the village is an object, and most of the ground was never in doubt.
    objects = "tall-objects" if method == "grid-minimum" else "raised-objects"
    assert counts[f"not-{objects}"] == np.count_nonzero(codes == 100 + numbers[objects]) > 0
    assert np.mean(code[ground] == numbers["lowest-points"]) > 0.8


def test_a_preset_without_cells_is_refused(tmp_path):
    scene = make("village", seed=7, size=60.0)
    with pytest.raises(BareEarthError, match="whitebox"):
        deciding_rules(scene.cloud(), tmp_path / "rules.tif", "slope", "whitebox")
    assert not (tmp_path / "rules.tif").exists()
