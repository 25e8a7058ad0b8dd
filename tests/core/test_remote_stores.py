"""Clouds in stores of objects: s3 by a server of the tests, gs and az by the memory of fsspec."""

import json
import os

import pytest
from copcs import many_nodes
from runs import said

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.remote import transfers

fsspec = pytest.importorskip("fsspec")
BOX = (400_000.55, 5_000_000.05, 400_052.0, 5_000_000.65)
KEYS = {"AWS_ACCESS_KEY_ID": "AKIAS3CRET", "AWS_SECRET_ACCESS_KEY": "S3CRET"}


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    return many_nodes(tmp_path_factory.mktemp("copc"))


@pytest.fixture(scope="module")
def moto():
    server = pytest.importorskip("moto.server")
    pytest.importorskip("s3fs")
    running = server.ThreadedMotoServer(ip_address="127.0.0.1", port=0, verbose=False)
    running.start()
    yield "http://{}:{}".format(*running.get_host_and_port())
    running.stop()


@pytest.fixture
def bucket(moto, content, monkeypatch):
    """A bucket with two clouds; return its address."""
    for name in [name for name in os.environ if name.startswith("AWS_")]:
        monkeypatch.delenv(name)
    named = {"AWS_ENDPOINT_URL": moto, "AWS_DEFAULT_REGION": "us-east-1", "no_proxy": "*"}
    for name, value in {**named, **KEYS, "AWS_EC2_METADATA_DISABLED": "true"}.items():
        monkeypatch.setenv(name, value)
    kind = fsspec.get_filesystem_class("s3")
    kind.clear_instance_cache()
    store = fsspec.filesystem("s3")
    store.makedirs("lidar", exist_ok=True)
    for name in ("lidar/a.copc.laz", "lidar/b c.copc.laz"):
        store.pipe(name, content)
    yield "s3://lidar"
    kind.clear_instance_cache()


def local(content, folder):
    """Return the bytes of what is cut out of the file on the disk."""
    (folder / "whole.copc.laz").write_bytes(content)
    bare_earth.fetch(folder / "whole.copc.laz", folder / "local.copc.laz", extent=BOX)
    return (folder / "local.copc.laz").read_bytes()


def check_secrets(folder, *texts):
    for path in folder.rglob("*"):
        assert path.is_dir() or b"S3CRET" not in path.read_bytes(), path
    assert not [text for text in texts if "S3CRET" in text]


@pytest.mark.parametrize("name", ["a.copc.laz", "b c.copc.laz"])
def test_a_part_of_an_object_of_s3_is_that_of_the_file(bucket, content, tmp_path, name):
    target = tmp_path / "part.copc.laz"
    words = f"{bucket}/{name}", target, "--extent", *map(str, BOX), "--verbose"
    code, out, errors = said("fetch", *words)
    assert code == 0, errors
    assert target.read_bytes() == local(content, tmp_path)
    check_secrets(tmp_path, out, errors)


def test_an_object_of_s3_is_an_input_and_stays_in_the_cache(bucket, content, tmp_path, monkeypatch):
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path / "cache"))
    words = "info", f"{bucket}/a.copc.laz", "--json", "--verbose"
    first, again = said(*words), said(*words)
    assert first[0] == again[0] == 0 and json.loads(first[1]) == json.loads(again[1])
    assert "Downloads" in first[2] and "Downloads" not in again[2]
    fsspec.filesystem("s3").pipe("lidar/a.copc.laz", many_nodes(tmp_path, 6))
    third = said(*words)  # of another object
    assert "Downloads" in third[2], third
    check_secrets(tmp_path, *first[1:], *again[1:])


def test_a_list_in_a_store_names_its_neighbours(bucket, content, tmp_path):
    items = [
        {"type": "Feature", "properties": {}, "assets": {"data": {"href": f"./{name}.copc.laz"}}}
        for name in ("a", "b%20c")
    ]
    text = json.dumps({"type": "FeatureCollection", "features": items})
    fsspec.filesystem("s3").pipe("lidar/all.vpc", text.encode())
    done = bare_earth.fetch(f"{bucket}/all.vpc", tmp_path / "all", extent=BOX)
    assert done.file_count == 2


def test_what_is_not_there_is_told(bucket, tmp_path):
    for place in ("s3://lidar/none.copc.laz", "s3://nobody/none.copc.laz"):
        with pytest.raises(BareEarthError, match=f"{place} does not exist"):
            bare_earth.fetch(place, tmp_path / "part.laz")
    assert not list(tmp_path.iterdir())


def test_public_objects_need_no_keys(bucket, content, tmp_path, monkeypatch):
    fsspec.filesystem("s3").pipe("lidar/public.copc.laz", content, ACL="public-read")
    for name in KEYS:
        monkeypatch.delenv(name)
    monkeypatch.setenv("HOME", str(tmp_path))
    fsspec.get_filesystem_class("s3").clear_instance_cache()
    target = tmp_path / "part.copc.laz"
    words = target, "--extent", *map(str, BOX)
    code, _, errors = said("fetch", f"{bucket}/a.copc.laz", *words)
    assert code == 1 and "You may not read s3://lidar/a.copc.laz" in errors
    code, _, errors = said("fetch", f"{bucket}/public.copc.laz", *words)
    assert code == 0, errors
    assert errors.count("s3://lidar is read without keys.") == 1
    assert target.read_bytes() == local(content, tmp_path)


def test_the_errors_of_a_store_are_told(content, tmp_path, monkeypatch):
    class EndpointConnectionError(Exception):
        """As those of botocore, which are no OSError."""

    class Store:
        def info(self, path, refresh):
            raise EndpointConnectionError(f"https://key:S3CRET@{path}")

    monkeypatch.setattr(transfers, "_FIRST_PAUSE", 0.001)
    monkeypatch.setattr(fsspec, "filesystem", lambda name, **options: Store())
    with pytest.raises(BareEarthError, match="EndpointConnectionError, after 6 attempts") as told:
        bare_earth.fetch("s3://lidar/a.copc.laz", tmp_path / "part.laz")
    assert "S3CRET" not in str(told.value)


@pytest.mark.parametrize("scheme", ["gs", "az", "abfs"])
def test_other_stores_are_read_as_fsspec_has_them(scheme, content, tmp_path, monkeypatch):
    from fsspec.implementations.memory import MemoryFileSystem

    store = MemoryFileSystem()
    monkeypatch.setattr(fsspec, "filesystem", lambda name: {scheme: store}[name])
    store.pipe(f"{scheme}://lidar/a.copc.laz", content)
    bare_earth.fetch(f"{scheme}://lidar/a.copc.laz", tmp_path / "part.copc.laz", extent=BOX)
    store.store.clear()
    assert (tmp_path / "part.copc.laz").read_bytes() == local(content, tmp_path)
