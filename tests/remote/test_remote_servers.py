"""Servers of clouds: certificates, signatures that expire, and stores of objects."""

import json
import re
import ssl

import pytest
from copcs import many_nodes
from remote_server import serving
from runs import said

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.remote import files, signing, transfers

BLOBS, TOKENS = "usgslidareuwest.blob.core.windows.net", "planetarycomputer.microsoft.com"
SECRETS = [f"sig=S3CRET{number}" for number in range(30)]
BOX = (400_000.55, 5_000_000.05, 400_052.0, 5_000_000.65)


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    return many_nodes(tmp_path_factory.mktemp("copc"))


# Certificates, of an authority that the tests make


@pytest.fixture(scope="module")
def authority():
    return pytest.importorskip("trustme").CA()


@pytest.fixture
def serve(authority, monkeypatch, tmp_path):
    """Return what serves a file by https, with a certificate for a name."""
    monkeypatch.setenv("no_proxy", "*")

    def context(*names, **wanted):
        secured = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        authority.issue_cert(*names, **wanted).configure_cert(secured)
        return serving(secured)

    return context


def trust(authority, monkeypatch, tmp_path):
    file = tmp_path / "authorities.pem"
    authority.cert_pem.write_to_path(str(file))
    monkeypatch.setenv("SSL_CERT_FILE", str(file))


@pytest.mark.rest
def test_an_authority_in_ssl_cert_file_is_trusted(serve, authority, monkeypatch, tmp_path):
    content = many_nodes(tmp_path)
    trust(authority, monkeypatch, tmp_path)
    with serve("localhost", "127.0.0.1") as server:
        server.add("a.copc.laz", content)
        address = server.address("a.copc.laz", "localhost")
        assert address.startswith("https://")
        bare_earth.fetch(address, tmp_path / "web.copc.laz", extent=BOX)
        assert len(server.asked) > 1
    bare_earth.fetch(tmp_path / "plain.copc.laz", tmp_path / "disk.copc.laz", extent=BOX)
    with_pages = bare_earth.info(tmp_path / "web.copc.laz")
    assert with_pages.point_count == bare_earth.info(tmp_path / "disk.copc.laz").point_count > 0


@pytest.mark.parametrize(
    ("case", "words"),
    [
        ("unknown", "self.signed certificate|local issuer"),
        ("of another host", "[Hh]ostname mismatch"),
        ("expired", "certificate has expired"),
    ],
)
def test_certificates_that_are_not_valid_are_refused(
    serve, authority, monkeypatch, tmp_path, case, words
):
    import datetime

    if case != "unknown":
        trust(authority, monkeypatch, tmp_path)
    names = ("elsewhere.example",) if case == "of another host" else ("localhost",)
    past = datetime.datetime(2020, 1, 1, tzinfo=datetime.timezone.utc)
    wanted = {"not_after": past} if case == "expired" else {}
    with serve(*names, **wanted) as server:
        server.add("a.copc.laz", b"LASF")
        with pytest.raises(BareEarthError, match=words) as told:
            bare_earth.fetch(server.address("a.copc.laz", "localhost"), tmp_path / "a.laz")
        # Nothing was asked for, with a query or without.
        assert not server.asked
    assert "certificate of localhost" in str(told.value)
    assert "SSL_CERT_FILE" in str(told.value)


def test_https_does_not_lead_to_http(serve, authority, monkeypatch, tmp_path):
    trust(authority, monkeypatch, tmp_path)
    with serve("localhost") as server, serving() as plain:
        server.add("a.copc.laz", b"LASF")
        server.fault = lambda number, path: f"to {plain.add('a.copc.laz', b'LASF')}"
        with pytest.raises(BareEarthError, match=r"http://.* not followed"):
            bare_earth.fetch(server.address("a.copc.laz", "localhost"), tmp_path / "a.laz")
        assert not plain.asked


# Addresses of the Planetary Computer: signed anew when it takes long, and the token is nowhere


class Planet:
    """A server that plays Azure and the Planetary Computer, as a proxy between us and them."""

    def __init__(self, server):
        self.server, self.given = server, 0
        self.refusal = "409"  # without a signature; Azure has 404 as well
        self.lasts = 1000  # requests for which a token is valid
        self.uses = 0
        self.is_renewed, self.is_known = True, True
        server.fault = self.answer

    def address(self, path, host=BLOBS):
        return f"http://{host}/{path}"

    def add(self, path, data, host=BLOBS):
        address = self.address(path, host)
        # What is asked of a proxy is a whole address, of which the server takes off a character.
        self.server.add(address[1:], data)
        return address

    def answer(self, number, path):
        with self.server.lock:
            if TOKENS in path and path.startswith("ttp"):
                if "/sas/v1/token/" not in path:
                    return ""
                if not self.is_known:
                    return "404"
                self.given += self.is_renewed or not self.given
                self.uses = 0
                token = {"msft:expiry": "2026-11-26T00:00:00Z", "token": SECRETS[self.given]}
                self.server.files[path] = json.dumps(token).encode()
                self.server.etags[path] = '"1"'
                return ""
            query = self.server.asked[number][3]
            if not query:
                return self.refusal
            self.uses += 1
            is_valid = query == SECRETS[self.given] and self.uses <= self.lasts
            return "" if is_valid else "403"

    @property
    def asked_for_tokens(self):
        return [path for path, *_ in self.server.asked if "/sas/v1/token/" in path]


@pytest.fixture
def planet(monkeypatch):
    monkeypatch.setattr(signing, "_TOKENS", signing._TOKENS.replace("https", "http"))
    # So that there are many requests.
    monkeypatch.setattr(files, "_MOST", 10_000)
    monkeypatch.setattr(files, "_FIRST", 4_000)
    monkeypatch.delenv("no_proxy", raising=False)
    with serving() as server:
        monkeypatch.setenv("http_proxy", f"http://127.0.0.1:{server.port}")
        yield Planet(server)


def check_secrets(folder, *texts):
    """No token stands in a message, a name or a file."""
    for text in texts:
        assert "S3CRET" not in str(text)
    for path in folder.rglob("*"):
        assert "S3CRET" not in str(path)
        assert path.is_dir() or b"S3CRET" not in path.read_bytes(), path


@pytest.mark.rest(but="1000-403")
@pytest.mark.parametrize("refusal", ["409", "403", "404", "401"])
@pytest.mark.parametrize("lasts", [1000, 4])
def test_a_token_is_got_and_renewed(planet, content, tmp_path, refusal, lasts, monkeypatch):
    monkeypatch.setattr(transfers, "_THREADS", 1)
    planet.refusal, planet.lasts = refusal, lasts
    address = planet.add("copc/a.copc.laz", content)
    code, out, errors = said("fetch", address, tmp_path / "all.copc.laz", "--follow", "--verbose")
    assert code == 0, errors
    (tmp_path / "whole.copc.laz").write_bytes(content)
    bare_earth.fetch(tmp_path / "whole.copc.laz", tmp_path / "local.copc.laz")
    assert (tmp_path / "all.copc.laz").read_bytes() == (tmp_path / "local.copc.laz").read_bytes()
    assert re.search(f"{TOKENS} .* usgslidareuwest/copc", errors)
    assert len(planet.asked_for_tokens) == planet.given and (planet.given > 1) == (lasts == 4)
    assert {path.rpartition("/token/")[2] for path in planet.asked_for_tokens} == {
        "usgslidareuwest/copc"
    }
    check_secrets(tmp_path, out, errors)


def test_one_of_several_threads_asks_for_the_next_token(planet, content, tmp_path):
    planet.lasts = 6
    answer = planet.server.fault

    def expire_once(number, path):
        planet.lasts = 6 if planet.given < 2 else 1000
        return answer(number, path)

    planet.server.fault = expire_once
    address = planet.add("copc/a.copc.laz", content)
    assert bare_earth.fetch(address, tmp_path / "all.laz", follow=True).point_count == 4000
    assert planet.given == len(planet.asked_for_tokens) == 2


def test_without_leave_nobody_is_asked(planet, content, tmp_path):
    address = planet.add("copc/a.copc.laz", content)
    for words in (("fetch",), ("classify",)):
        cache = ("--cache", tmp_path / "cache") if words == ("classify",) else ()
        code, _, errors = said(*words, address, tmp_path / "out.laz", *cache)
        assert code == 1 and "--follow of 'bare-earth fetch'" in errors
    assert not planet.asked_for_tokens and not (tmp_path / "out.laz").exists()


def test_an_address_whose_own_signature_expires_is_renewed_or_told(
    planet, content, tmp_path, monkeypatch
):
    monkeypatch.setattr(transfers, "_THREADS", 1)
    address = f"{planet.add('copc/a.copc.laz', content)}?{SECRETS[0]}"
    planet.lasts = 3
    with pytest.raises(BareEarthError, match=r"expired.*follow=True") as told:
        bare_earth.fetch(address, tmp_path / "all.laz")
    # What was there stays, under a name without the token.
    assert (tmp_path / "all.laz.parts").is_dir() and not (tmp_path / "all.laz").exists()
    check_secrets(tmp_path, told.value)
    bare_earth.fetch(address, tmp_path / "all.laz", follow=True)
    check_secrets(tmp_path)
    assert planet.given and [path.name for path in tmp_path.iterdir()] == ["all.laz"]


@pytest.mark.parametrize("case", ["always expired", "of others", "gone"])
def test_what_no_token_opens_is_one_sentence(planet, content, tmp_path, case):
    address = planet.add("copc/a.copc.laz", content)
    if case == "always expired":
        planet.lasts, planet.is_renewed = 0, False
    elif case == "of others":
        planet.is_known = False
    else:
        planet.server.files.clear()
    words = {"always expired": "has expired", "of others": "status 409", "gone": "status 404"}
    with pytest.raises(BareEarthError, match=words[case]) as told:
        bare_earth.fetch(address, tmp_path / "all.laz", follow=True)
    assert len(planet.asked_for_tokens) <= 2 and not list(tmp_path.iterdir())
    check_secrets(tmp_path, told.value)


def test_a_server_of_tokens_that_fails_is_told(planet, content, tmp_path, monkeypatch):
    monkeypatch.setattr(signing, "_TOKENS", "http://127.0.0.1:9/token")
    monkeypatch.setenv("no_proxy", "127.0.0.1")
    with pytest.raises(BareEarthError, match=r"127\.0\.0\.1 .* refused"):
        bare_earth.fetch(planet.add("copc/a.copc.laz", content), tmp_path / "a.laz", follow=True)


def test_an_item_of_stac_leads_to_signed_clouds(planet, content, tmp_path):
    near, far = (planet.add(f"copc/{name}.copc.laz", content) for name in "ab")
    assets = {"data": {"href": near}, "thumbnail": {"href": far.replace("laz", "png")}}
    item = {"type": "Feature", "properties": {}, "assets": assets}
    address = planet.add("api/stac/v1/item", json.dumps(item).encode(), TOKENS)
    with pytest.raises(BareEarthError, match=f"servers: http://{BLOBS}"):
        bare_earth.fetch(address, tmp_path / "part.laz", extent=BOX)
    assert not planet.asked_for_tokens
    done = bare_earth.fetch(address, tmp_path / "part.laz", extent=BOX, follow=True)
    assert done.point_count and len(planet.asked_for_tokens) == 1
    check_secrets(tmp_path)


# Stores of objects, as fsspec has them: here in its memory


@pytest.fixture
def fsspec():
    return pytest.importorskip("fsspec")


@pytest.fixture(params=["s3", "gs", "az", "abfs"])
def bucket(request, content, monkeypatch, fsspec):
    """A bucket with two clouds; return its address."""
    from fsspec.implementations.memory import MemoryFileSystem

    store = MemoryFileSystem()
    monkeypatch.setattr(fsspec, "filesystem", lambda name: {request.param: store}[name])
    for name in ("a", "b c"):
        store.pipe(f"{request.param}://lidar/{name}.copc.laz", content)
    yield f"{request.param}://lidar"
    store.store.clear()


@pytest.mark.rest(but="gs")
def test_a_part_of_an_object_is_that_of_the_file(bucket, content, tmp_path):
    (tmp_path / "whole.copc.laz").write_bytes(content)
    bare_earth.fetch(tmp_path / "whole.copc.laz", tmp_path / "local.copc.laz", extent=BOX)
    for name in ("a", "b c"):
        bare_earth.fetch(f"{bucket}/{name}.copc.laz", tmp_path / f"{name}.copc.laz", extent=BOX)
        found = (tmp_path / f"{name}.copc.laz").read_bytes()
        assert found == (tmp_path / "local.copc.laz").read_bytes()


def test_a_list_in_a_store_names_its_neighbours(bucket, fsspec, tmp_path):
    items = [
        {"type": "Feature", "properties": {}, "assets": {"data": {"href": f"./{name}.copc.laz"}}}
        for name in ("a", "b%20c")
    ]
    text = json.dumps({"type": "FeatureCollection", "features": items})
    fsspec.filesystem(bucket[:-8]).pipe(f"{bucket}/all.vpc", text.encode())
    done = bare_earth.fetch(f"{bucket}/all.vpc", tmp_path / "all", extent=BOX)
    assert done.file_count == 2


def test_what_is_not_there_is_told(bucket, tmp_path):
    with pytest.raises(BareEarthError, match=f"{bucket}/none.copc.laz .* exist"):
        bare_earth.fetch(f"{bucket}/none.copc.laz", tmp_path / "part.laz")
    assert not list(tmp_path.iterdir())


class EndpointConnectionError(Exception):
    """As those of botocore, which are no OSError."""


class NoCredentialsError(Exception):
    """Another one."""


@pytest.mark.parametrize(
    ("raised", "words"),
    [
        (EndpointConnectionError, "EndpointConnectionError.* 6 attempts"),
        (NoCredentialsError, "not read s3://lidar/a.copc.laz .* fsspec"),
        (PermissionError, "You may not read"),
        (ImportError, "pip install fsspec"),
    ],
)
def test_the_errors_of_a_store_are_told(tmp_path, monkeypatch, fsspec, raised, words):
    class Store:
        def info(self, path, refresh):
            raise raised(f"of s3 S3CRET@{path}" if raised is not ImportError else "Install s3fs")

    monkeypatch.setattr(fsspec, "filesystem", lambda name: Store())
    code, _, errors = said("fetch", "s3://lidar/a.copc.laz", tmp_path / "part.laz")
    assert code == 1 and "S3CRET" not in errors
    with pytest.raises(BareEarthError, match=words):
        bare_earth.fetch("s3://lidar/a.copc.laz", tmp_path / "part.laz")
