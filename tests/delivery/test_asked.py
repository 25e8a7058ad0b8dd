"""What was asked for is what runs, also if it equals the default of the tool."""

import json
import os
import shutil
import sys

import pytest
from surveys import write_points

import bare_earth
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.delivery import folder as folder_module


@pytest.fixture(scope="module")
def cloud(tmp_path_factory):
    import numpy as np

    path = tmp_path_factory.mktemp("asked") / "raw.laz"
    x, y = np.random.default_rng(2).uniform(0, 40, (2, 3000))
    write_points(
        path, x, y, 50.0 + 0.05 * x, np.ones(len(x), int), offset=(500_000.0, 5_600_000.0, 0.0)
    )
    return path


def _by_command(cloud, target, *words):
    command = ["deliver", "drone-site", str(cloud), str(target), "--crs", "EPSG:25832", *words]
    assert main([*command, "--verbose"]) == 0


def _by_library(cloud, target, *words):
    values = {"preset": "automatic", "low_noise_class": False} if words else {}
    bare_earth.deliver(cloud, target, delivery="drone-site", crs=25832, **values)


@pytest.mark.rest
@pytest.mark.parametrize("run", [_by_command, _by_library])
def test_a_value_that_was_given_is_not_that_of_the_delivery(cloud, tmp_path, run, capsys):
    run(cloud, tmp_path / "usual")
    usual = json.loads((tmp_path / "usual" / "delivery.json").read_text(encoding="utf-8"))
    said = capsys.readouterr()
    assert usual["asked"] == []
    assert usual["settings"]["TIN densification"]["preset"] == "site"
    assert usual["settings"]["Classes"]["low_noise_class"] == "on"

    run(cloud, tmp_path / "asked", "--preset", "automatic", "--no-low-noise-class")
    asked = json.loads((tmp_path / "asked" / "delivery.json").read_text(encoding="utf-8"))
    assert asked["asked"] == ["low_noise_class", "preset"]
    assert asked["settings"]["TIN densification"] == {"preset": "automatic"}
    assert asked["settings"]["Classes"]["low_noise_class"] == "off"
    assert asked["settings"]["Classes"]["high_noise_class"] == "on"
    if run is _by_command:
        assert "Drone site: preset site" in said.err + said.out
        said = capsys.readouterr()
        lines = (said.err + said.out).splitlines()
        assert any("preset automatic, low noise class off" in line for line in lines)
        assert not any("preset site" in line for line in lines)


@pytest.mark.rest
@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="names of files are Unicode there")
def test_a_name_that_is_not_utf_8_is_delivered(cloud, tmp_path):
    source = tmp_path / os.fsdecode(b"Gr\xf6\xdfe.laz")
    shutil.copy(cloud, source)
    _by_command(source, tmp_path / "out")
    page = (tmp_path / "out" / "index.html").read_text(encoding="utf-8")
    assert 'href="points/Gr%F6%DFe.laz"' in page and "\\xf6" in page


def test_a_read_only_disk_is_named(cloud, tmp_path, monkeypatch):
    def refuse(*_):
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr(folder_module, "check_lengths", refuse)
    with pytest.raises(BareEarthError, match=r"out: .* read-only"):
        bare_earth.deliver(cloud, tmp_path / "out", delivery="forestry", crs=25832)
