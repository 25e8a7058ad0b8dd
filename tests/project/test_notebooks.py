"""The notebooks of docs/ run from their first cell to the last, on a small survey."""

import json
from pathlib import Path

import numpy as np
import pytest
from surveys import strip, write

import bare_earth

NOTEBOOKS = sorted((Path(__file__).parents[2] / "docs" / "notebooks").glob("*.ipynb"))
NEEDED = ("matplotlib", "rasterio", "xarray", "distributed")


def cells(notebook, kind):
    whole = json.loads(notebook.read_text(encoding="utf-8"))
    return ["".join(cell["source"]) for cell in whole["cells"] if cell["cell_type"] == kind]


@pytest.mark.rest
@pytest.mark.parametrize(
    "notebook",
    [
        pytest.param(path, marks=pytest.mark.long if "cluster" in path.stem else ())
        for path in NOTEBOOKS
    ],
    ids=lambda path: path.stem,
)
def test_a_notebook_runs(notebook, tmp_path, monkeypatch):
    for name in NEEDED:
        pytest.importorskip(name)
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "tile.laz", strip())
    (tmp_path / "tiles").mkdir()
    for number in range(2):
        write(
            tmp_path / "tiles" / f"{number}.laz",
            strip(seed=number) + np.array((30_000 * number, 0, 0)),
        )
    names = {}
    for cell in cells(notebook, "code"):
        exec(compile(cell, notebook.name, "exec"), names)
    if "cluster" in notebook.stem:
        assert len([*(tmp_path / "classified").glob("*.laz")]) == 2 and names["survey"]
    else:
        assert names["las"] is not None


@pytest.mark.rest
def test_the_page_of_the_library_names_them_and_they_are_clean():
    page = (NOTEBOOKS[0].parents[1] / "api.md").read_text(encoding="utf-8")
    assert len(NOTEBOOKS) == 3 and bare_earth.__version__
    for notebook in NOTEBOOKS:
        assert f"(notebooks/{notebook.name})" in page
        assert '"outputs": []' in notebook.read_text(encoding="utf-8")
