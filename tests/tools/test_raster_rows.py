"""A raster is a row: its option, its keyword in the library and its file follow."""

import numpy as np
import pytest
from runs import said
from surveys import write
from toy_raster import add_toy, forget, is_right

import bare_earth

rasterio = pytest.importorskip("rasterio")


@pytest.fixture
def toy(monkeypatch):
    yield add_toy(monkeypatch)
    monkeypatch.undo()
    forget()


@pytest.fixture
def ground(tmp_path):
    """Write a plane that rises by 1 m to the east in each metre."""
    x, y = (axis.ravel() for axis in np.mgrid[25:4000:50, 25:4000:50])
    (tmp_path / "in").mkdir()
    return write(tmp_path / "in" / "in.laz", np.column_stack((x, y, x)), classes=2)


def test_the_command_has_an_option_and_writes_the_file(toy, ground, tmp_path):
    code, shown, _ = said("terrain", "--help")
    assert code == 0 and f"--toy-roughness FILE {toy.help}" in " ".join(shown.split())
    code, _, error = said("terrain", ground, "--toy-roughness", tmp_path / "toy.tif")
    assert code == 0, error
    with rasterio.open(tmp_path / "toy.tif") as raster:
        assert is_right(raster.read(1)) and raster.descriptions == ("Roughness, m",)
        assert raster.nodata == -9999 and raster.units == ("metre",)


def test_the_library_has_a_keyword_for_one_file_and_for_many(toy, ground, tmp_path):
    documentation = " ".join(bare_earth.terrain.__doc__.split())
    assert f"toy_roughness : path, optional {toy.help}" in documentation
    for name, source in (("one", ground), ("many", [ground.parent])):
        path = tmp_path / f"{name}.tif"
        bare_earth.terrain(source, toy_roughness=path)
        with rasterio.open(path) as raster:
            assert is_right(raster.read(1))
