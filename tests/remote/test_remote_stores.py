"""Clouds in stores of objects, as fsspec has them: here in its memory."""

import json

import pytest
from copcs import many_nodes
from runs import said

import bare_earth
from bare_earth import BareEarthError

fsspec = pytest.importorskip("fsspec")
BOX = (400_000.55, 5_000_000.05, 400_052.0, 5_000_000.65)


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    return many_nodes(tmp_path_factory.mktemp("copc"))


@pytest.fixture(params=["s3", "gs", "az", "abfs"])
def bucket(request, content, monkeypatch):
    """A bucket with two clouds; return its address."""
    from fsspec.implementations.memory import MemoryFileSystem

    store = MemoryFileSystem()
    monkeypatch.setattr(fsspec, "filesystem", lambda name: {request.param: store}[name])
    for name in ("a", "b c"):
        store.pipe(f"{request.param}://lidar/{name}.copc.laz", content)
    yield f"{request.param}://lidar"
    store.store.clear()


def test_a_part_of_an_object_is_that_of_the_file(bucket, content, tmp_path):
    (tmp_path / "whole.copc.laz").write_bytes(content)
    bare_earth.fetch(tmp_path / "whole.copc.laz", tmp_path / "local.copc.laz", extent=BOX)
    for name in ("a", "b c"):
        bare_earth.fetch(f"{bucket}/{name}.copc.laz", tmp_path / f"{name}.copc.laz", extent=BOX)
        found = (tmp_path / f"{name}.copc.laz").read_bytes()
        assert found == (tmp_path / "local.copc.laz").read_bytes()


def test_a_list_in_a_store_names_its_neighbours(bucket, content, tmp_path):
    items = [
        {"type": "Feature", "properties": {}, "assets": {"data": {"href": f"./{name}.copc.laz"}}}
        for name in ("a", "b%20c")
    ]
    text = json.dumps({"type": "FeatureCollection", "features": items})
    fsspec.filesystem(bucket[:-8]).pipe(f"{bucket}/all.vpc", text.encode())
    done = bare_earth.fetch(f"{bucket}/all.vpc", tmp_path / "all", extent=BOX)
    assert done.file_count == 2


def test_what_is_not_there_is_told(bucket, tmp_path):
    with pytest.raises(BareEarthError, match=f"{bucket}/none.copc.laz does not exist"):
        bare_earth.fetch(f"{bucket}/none.copc.laz", tmp_path / "part.laz")
    assert not list(tmp_path.iterdir())


class EndpointConnectionError(Exception):
    """As those of botocore, which are no OSError."""


class NoCredentialsError(Exception):
    """Another one."""


@pytest.mark.parametrize(
    ("raised", "words"),
    [
        (EndpointConnectionError, "EndpointConnectionError, after 6 attempts"),
        (NoCredentialsError, "You may not read s3://lidar/a.copc.laz .* how fsspec is set up"),
        (PermissionError, "You may not read"),
        (ImportError, "needs fsspec .*: pip install fsspec"),
    ],
)
def test_the_errors_of_a_store_are_told(tmp_path, monkeypatch, raised, words):
    class Store:
        def info(self, path, refresh):
            raise raised(f"of s3 S3CRET@{path}" if raised is not ImportError else "Install s3fs")

    monkeypatch.setattr(fsspec, "filesystem", lambda name: Store())
    code, _, errors = said("fetch", "s3://lidar/a.copc.laz", tmp_path / "part.laz")
    assert code == 1 and "S3CRET" not in errors
    with pytest.raises(BareEarthError, match=words):
        bare_earth.fetch("s3://lidar/a.copc.laz", tmp_path / "part.laz")
