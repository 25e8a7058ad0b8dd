"""The CRS and the unit that rasters state: only heights have a vertical CRS."""

import laspy
import numpy as np
import pytest
from surveys import write_points

import bare_earth
from bare_earth.algorithms.cli import main

rasterio = pytest.importorskip("rasterio")
pyproj = pytest.importorskip("pyproj")
DATUMS = {
    "DHHN2016": 'VERT_CS["DHHN2016 height",VERT_DATUM["Deutsches Haupthoehennetz 2016",2005,'
    'AUTHORITY["EPSG","1170"]],UNIT["metre",1,AUTHORITY["EPSG","9001"]],AXIS["Up",UP],'
    'AUTHORITY["EPSG","7837"]]',
    "ellipsoid": 'VERT_CS["Ellipsoid (meters)",VERT_DATUM["Ellipsoid",2002],UNIT["metre",1],'
    'AXIS["Up",UP]]',
}
UNITS = {"dtm": "metre", "slope": "degree", "hillshade": None, "sky-view": None,
         "openness": "degree", "expected-error": "metre",
         "relief": "metre"}  # fmt: skip


def written(path, text):
    random = np.random.default_rng(1)
    x, y = random.uniform(0, 30, (2, 3000))
    return write_points(path, x, y, 50 + 0.1 * x, 2, wkt=text)


@pytest.mark.rest
@pytest.mark.parametrize("kind", ["DHHN2016", "ellipsoid", "three axes"])
def test_only_heights_have_a_vertical_crs_and_its_unit(tmp_path, capsys, kind):
    flat = pyproj.CRS("EPSG:25832")
    text = flat.to_3d().to_wkt()
    if kind in DATUMS:
        text = f'COMPD_CS["both",{flat.to_wkt("WKT1_GDAL")},{DATUMS[kind]}]'
    cloud = written(tmp_path / "in.laz", text)
    paths = {name: tmp_path / f"{name}.tif" for name in UNITS}
    options = [part for name, path in paths.items() for part in (f"--{name}", str(path))]
    assert main(["terrain", str(cloud), *options]) == 0
    assert ("not that of its heights" in capsys.readouterr().err) == (kind != "DHHN2016")
    for name, path in paths.items():
        with rasterio.open(path) as raster:
            assert raster.units == (UNITS[name],), name
            has_heights = kind == "DHHN2016" and UNITS[name] == "metre"
            assert ("DHHN2016" in raster.crs.to_wkt()) == has_heights, name
            assert has_heights or raster.crs.to_epsg() == 25832, name
    made = bare_earth.arrays.terrain(laspy.read(cloud), rasters=["dtm", "slope"])
    assert ("DHHN2016" in made["dtm"].crs) == (kind == "DHHN2016")
    assert pyproj.CRS(made["slope"].crs).to_epsg(20) == 25832
