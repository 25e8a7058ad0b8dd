"""Servers by https, whose certificates are of an authority that the tests make."""

import ssl

import pytest
from copcs import many_nodes
from remote_server import serving

import bare_earth
from bare_earth import BareEarthError

trustme = pytest.importorskip("trustme")
BOX = (400_000.55, 5_000_000.05, 400_052.0, 5_000_000.65)


@pytest.fixture(scope="module")
def authority():
    return trustme.CA()


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
        ("unknown", "self.signed certificate in certificate chain|unable to get local issuer"),
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
    assert "The certificate of localhost is not valid" in str(told.value)
    assert "SSL_CERT_FILE" in str(told.value)


def test_https_does_not_lead_to_http(serve, authority, monkeypatch, tmp_path):
    trust(authority, monkeypatch, tmp_path)
    with serve("localhost") as server, serving() as plain:
        server.add("a.copc.laz", b"LASF")
        server.fault = lambda number, path: f"to {plain.add('a.copc.laz', b'LASF')}"
        with pytest.raises(BareEarthError, match="which is not followed"):
            bare_earth.fetch(server.address("a.copc.laz", "localhost"), tmp_path / "a.laz")
        assert not plain.asked
