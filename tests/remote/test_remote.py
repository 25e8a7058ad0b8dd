"""Ranges of remote files: the same bytes as in the file, or one sentence, never other bytes."""

import re
import sys
import threading
import time

import numpy as np
import pytest
from remote_server import ENDLESS

from bare_earth import BareEarthError, Cancelled, Progress
from bare_earth.algorithms.core.progress import Notes
from bare_earth.algorithms.remote import connections, transfers
from bare_earth.algorithms.remote.addresses import (
    beside,
    checked,
    ends_with,
    origin_of,
    referred,
    shown,
)
from bare_earth.algorithms.remote.files import RemoteFile
from bare_earth.algorithms.remote.transfers import Transfers
from bare_earth.algorithms.remote.web_reader import WebReader

DATA = np.random.default_rng(0).integers(0, 256, 1_000_000, dtype=np.uint8).tobytes()
PIECES = [(100_000, 140_000), (141_000, 180_000), (400_000, 500_000), (900_000, 950_000)]


def fetched(address, folder, progress=Progress(), pieces=PIECES, refusal="say so"):
    """Return the pieces as they are read, and the transfers, which count."""
    with Transfers(progress, refusal) as transfer:
        file = RemoteFile(transfer, address).keep_in(folder)
        file.fetch(file.plan(pieces), progress)
        found = []
        for start, stop in pieces:
            file.seek(start)
            found.append(file.read(stop - start))
        return found, transfer


def wanted(data=DATA):
    return [data[start:stop] for start, stop in PIECES]


def test_pieces_are_joined_and_counted(server, tmp_path):
    found, transfer = fetched(server.add("a", DATA), tmp_path / "parts")
    assert found == wanted()
    # The head, two pieces with a small gap in one request, and two others.
    assert transfer.requests == len(server.asked) == 4
    needed = 65_536 + sum(stop - start for start, stop in PIECES) + 1_000
    assert transfer.received == server.sent == needed
    for _, _, headers, _ in server.asked[1:]:
        assert headers["If-Match"] == '"1000000-1"' and headers["Accept-Encoding"] == "identity"


def test_connections_are_kept(server, tmp_path, monkeypatch):
    made, connect = [], connections.http.client.HTTPConnection.connect
    monkeypatch.setattr(
        connections.http.client.HTTPConnection,
        "connect",
        lambda self: (made.append(self), connect(self)),
    )
    pieces = [(start, start + 10) for start in range(70_000, 900_000, 30_000)]
    fetched(server.add("a", DATA), tmp_path / "parts", pieces=pieces)
    assert len(server.asked) == 1 + len(pieces) and len(made) <= 6


@pytest.mark.parametrize("fault", ["", "old", "cut", "short", "503", "429"])
def test_what_fails_sometimes_gives_the_same_bytes(server, tmp_path, fault):
    server.fault = lambda number, path: fault if number % 3 == 0 or fault == "old" else ""
    assert fetched(server.add("a", DATA), tmp_path / "parts")[0] == wanted()
    assert {path.name for path in (tmp_path / "parts").iterdir()} >= {"about.json"}


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        ("no ranges", "knows no ranges"),
        ("gzip", "compressed by gzip"),
        ("shifted", "in place of"),
        ("fewer", "in place of"),
        ("cut", "after 6 attempts"),
        ("short", "after 6 attempts"),
        ("503", "503.* 6 attempts"),
        ("403", "may not read"),
        ("404", "does not exist"),
        ("416", "cut off|changed"),
        ("400", "status 400"),
        ("to file:///etc/passwd", "file:///etc/passwd.* not followed"),
        ("to ftp://127.0.0.1/a", "ftp://127.0.0.1/a.* not followed"),
        ("to /a", "address to the next"),
    ],
)
@pytest.mark.parametrize("first", [0, 1])
def test_what_stays_wrong_is_one_sentence(server, tmp_path, fault, words, first):
    server.fault = lambda number, path: fault if number >= first else ""
    with pytest.raises(BareEarthError, match=words) as told:
        fetched(f"{server.add('a', DATA)}?token=SECRET", tmp_path / "parts")
    assert "SECRET" not in str(told.value) and "\n" not in str(told.value)


def test_a_whole_file_is_refused_before_it_is_read(server, tmp_path):
    server.fault = lambda number, path: "no ranges"
    with pytest.raises(BareEarthError, match="knows no ranges"):
        fetched(server.add("a", DATA * 100), tmp_path / "parts")
    assert server.sent <= 50 * len(DATA)


def test_a_signature_that_has_expired_is_told(server, tmp_path):
    server.fault = lambda number, path: "403"
    with pytest.raises(BareEarthError, match=r"expired.* address") as told:
        fetched(f"{server.add('a', DATA)}?se=2026&sig=SECRET", tmp_path / "parts")
    assert "SECRET" not in str(told.value)


@pytest.mark.parametrize("fault", ["", "ignores versions"])
def test_a_file_that_is_replaced_meanwhile_is_refused(server, tmp_path, fault):
    address = server.add("a", DATA)

    def replace(number, path):
        if number == 2:
            server.files["a"], server.etags["a"] = DATA[::-1], '"1000000-2"'
        return fault

    server.fault = replace
    with pytest.raises(BareEarthError, match="changed while"):
        fetched(address, tmp_path / "parts")
    # The next run begins anew.
    assert fetched(address, tmp_path / "parts")[0] == wanted(DATA[::-1])


def test_a_run_goes_on_where_it_stopped(server, tmp_path):
    address = server.add("a", DATA)

    def refuse_last(number, path):
        if number < 3:
            return ""
        time.sleep(0.3)  # until the others are there
        return "400"

    server.fault = refuse_last
    with pytest.raises(BareEarthError, match="status 400"):
        fetched(f"{address}?sig=first", tmp_path / "parts")
    server.asked.clear()
    server.fault = lambda number, path: ""
    assert fetched(f"{address}?sig=second", tmp_path / "parts")[0] == wanted()
    ranges = [headers for _, headers, _, _ in server.asked]
    assert 2 <= len(ranges) <= 3 and ranges[0] == "bytes=0-65535"
    assert "first" not in (tmp_path / "parts" / "about.json").read_text()


def test_parts_of_others_are_not_touched(server, tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "thesis.txt").write_text("mine")
    with pytest.raises(BareEarthError, match="is in the way"):
        fetched(server.add("a", DATA), tmp_path / "parts")
    assert (tmp_path / "parts" / "thesis.txt").read_text() == "mine"


def test_redirects_to_another_host_are_told_and_get_no_password(server, tmp_path):
    address, notes = server.add("b", DATA), Notes()
    address = server.address("a").replace("//", "//user:SECRET@")
    server.fault = lambda number, path: (
        f"to {server.address('b', 'localhost')}?sig=SECRET" if path == "a" else ""
    )
    with pytest.raises(BareEarthError, match="another server, http://localhost:") as told:
        fetched(address, tmp_path / "parts")
    assert "SECRET" not in str(told.value) and [path for path, *_ in server.asked] == ["a"]
    server.asked.clear()
    assert fetched(address, tmp_path / "parts", notes, refusal=None)[0] == wanted()
    assert notes.messages == [("warning", "127.0.0.1 passes the request on to localhost.")]
    by_path = {path: headers for path, _, headers, _ in server.asked}
    assert by_path["a"]["Authorization"].startswith("Basic ")
    assert "Authorization" not in by_path["b"]
    assert [path for path, *_ in server.asked].count("a") == 1  # where it leads is known then


class Cancelling(Progress):
    """Cancels some time after the work has begun."""

    def __init__(self, seconds):
        self.end = time.monotonic() + seconds

    def report(self, fraction):
        if time.monotonic() > self.end:
            raise Cancelled


@pytest.mark.parametrize("fault", ["silent", "slow"])
@pytest.mark.parametrize("first", [0, 1])
def test_a_cancel_is_noticed_within_two_seconds(server, tmp_path, fault, first):
    server.fault = lambda number, path: fault if number >= first else ""
    address, begun = server.add("a", DATA), time.monotonic()
    with pytest.raises(Cancelled):
        fetched(address, tmp_path / "parts", Cancelling(0.3))
    assert time.monotonic() - begun < 2.3
    server.released.set()
    for thread in threading.enumerate():
        if thread.name == "download":
            thread.join(5)
            assert not thread.is_alive()


def test_a_server_that_is_not_there_is_told(tmp_path):
    with pytest.raises(BareEarthError, match=r"127\.0\.0\.1 .* refused"):
        fetched("http://127.0.0.1:9/a", tmp_path / "parts")


def test_a_silent_server_is_given_up(server, tmp_path, monkeypatch):
    monkeypatch.setattr(connections, "_TIMEOUT", 0.1)
    server.fault = lambda number, path: "silent"
    with pytest.raises(BareEarthError, match=r"127\.0\.0\.1 cannot be read"):
        fetched(server.add("a", DATA), tmp_path / "parts")


@pytest.mark.parametrize("fault", ENDLESS)
def test_an_answer_without_end_is_given_up(server, tmp_path, monkeypatch, fault):
    monkeypatch.setattr(WebReader, "patience", 0.3)
    monkeypatch.setattr(WebReader, "least_speed", 1e9)
    monkeypatch.setattr(transfers, "_LONGEST", 0.5)
    monkeypatch.setattr(transfers, "_LEAST_SPEED", 1e9)
    monkeypatch.setattr(transfers, "_SILENCE", 0.05)
    server.fault = lambda number, path: fault
    notes, begun = Notes(), time.monotonic()
    with pytest.raises(BareEarthError, match=r"127\.0\.0\.1"):
        # One piece: several are asked for side by side.
        fetched(server.add("a", DATA), tmp_path / "parts", notes, PIECES[:1])
    assert time.monotonic() - begun < 5 and len(server.asked) <= 3
    told = [text for _, text in notes.messages]
    assert len(told) == 1 or (not told and fault in ("body", "trailer"))
    assert not told or re.search(r"127\.0\.0\.1 .* 0 seconds", told[0])


@pytest.mark.parametrize(
    ("status", "headers", "words"),
    [
        ("429", {"Retry-After": "\u00b2"}, "429.* 6 attempts"),
        ("503", {"Retry-After": "Fri, 32 Nov 2026 25:61:61 GMT"}, "503.* 6 attempts"),
        ("429", {"Retry-After": "9" * 5000}, "status 429"),
        ("302", {"Location": "http://[::bad/x"}, "no address"),
        ("302", {"Location": "http://a:b/x"}, "names no server"),
        ("206", {"Content-Range": f"bytes 0-{'9' * 5000}/{'9' * 5000}"}, "no range of bytes"),
        ("206", {"Content-Range": "bytes 0-\u00b2/\u00b2"}, "no range of bytes"),
    ],
)
def test_bad_headers_are_one_sentence(server, tmp_path, status, headers, words):
    server.headers = {
        name: text.encode().decode("latin-1") for name, text in headers.items()
    }  # fmt: skip
    server.fault = lambda number, path: status
    with pytest.raises(BareEarthError, match=words) as told:
        fetched(server.add("a", DATA), tmp_path / "parts")
    assert len(str(told.value)) < 400


def test_what_came_of_an_answer_is_not_asked_for_again(server, tmp_path):
    server.fault = lambda number, path: "cut" if number == 1 else ""
    address = server.add("a", DATA)
    assert fetched(address, tmp_path / "parts", pieces=[(200_000, 900_000)])[0] == [
        DATA[200_000:900_000]
    ]
    first, again = (int(asked[1][6:].partition("-")[0]) for asked in server.asked[1:])
    assert first == 200_000 < again and server.asked[2][1].endswith("-899999")


def test_a_cancel_keeps_what_came(server, tmp_path):
    server.fault = lambda number, path: "slow" if number else ""
    address, pieces = server.add("a", DATA), [(200_000, 900_000)]
    with pytest.raises(Cancelled):
        fetched(address, tmp_path / "parts", Cancelling(1.0), pieces)
    for thread in threading.enumerate():
        if thread.name == "download":
            thread.join(5)
    kept = sum(path.stat().st_size for path in (tmp_path / "parts").glob("[0-9]*-*"))
    assert kept > 4000
    server.fault = lambda number, path: ""
    found, transfer = fetched(address, tmp_path / "parts", pieces=pieces)
    # Not what the server counts, which sends some bytes to the run before late.
    assert found == [DATA[200_000:900_000]] and transfer.received == 65_536 + 700_000 - kept


def test_what_is_damaged_is_dropped_and_asked_for_once_more(server, tmp_path):
    def read(file):
        file.seek(200_000)
        if file.read(1000) != DATA[200_000:201_000]:
            raise BareEarthError("damaged")
        return True

    address, kept = server.add("a", DATA), tmp_path / "parts"
    for wrong, is_read in (({1}, True), ({1, 2}, False), ((), True)):
        server.asked.clear()
        server.fault = lambda number, path, wrong=wrong: "wrong" if number in wrong else ""
        with Transfers(Progress()) as transfer:
            file = RemoteFile(transfer, address).keep_in(kept)
            if is_read:
                assert file.twice(lambda file=file: read(file))
            else:
                with pytest.raises(BareEarthError, match="damaged"):
                    file.twice(lambda file=file: read(file))
        assert len(server.asked) == 1 + len(wrong) + is_read * (not wrong or len(wrong) == 1)
        for path in kept.glob("2*"):
            path.unlink()


def test_a_host_gets_no_more_requests_than_it_allows(server, tmp_path, monkeypatch):
    monkeypatch.setitem(transfers._LIMITS, "localhost", 20.0)
    server.add("a", DATA)
    pieces = [(start, start + 10) for start in range(70_000, 900_000, 60_000)]
    begun = time.monotonic()
    fetched(server.address("a", "localhost"), tmp_path / "parts", pieces=pieces)
    assert len(server.asked) == 1 + len(pieces)
    assert time.monotonic() - begun >= len(pieces) / 20.0


@pytest.mark.parametrize("host", ["data.geopf.fr", "somewhere.example"])
def test_ign_is_asked_less_than_ten_times_a_second(server, tmp_path, monkeypatch, host):
    """Also if another server leads there."""
    place = "http://data.geopf.fr/a"
    server.add(place[1:], DATA)
    server.fault = lambda number, path: f"to {place}" if "somewhere" in path else ""
    monkeypatch.setenv("http_proxy", f"http://127.0.0.1:{server.port}")
    monkeypatch.delenv("no_proxy", raising=False)
    pieces = [(start, start + 10) for start in range(70_000, 900_000, 70_000)]
    begun = time.monotonic()
    fetched(f"http://{host}/a", tmp_path / "parts", pieces=pieces, refusal=None)
    asked = [path for path, *_ in server.asked if "geopf" in path]
    assert len(asked) == 1 + len(pieces)
    assert len(pieces) / (time.monotonic() - begun) <= 10.0


def test_a_proxy_is_asked_for_the_address(server, tmp_path, monkeypatch):
    server.add("http://far.example/a", DATA)
    server.files["ttp://far.example/a"] = DATA
    server.etags["ttp://far.example/a"] = '"1"'
    monkeypatch.setenv("http_proxy", f"http://me:word@127.0.0.1:{server.port}")
    assert fetched("http://far.example/a", tmp_path / "parts")[0] == wanted()
    assert server.asked[0][2]["Proxy-Authorization"].startswith("Basic ")
    monkeypatch.setenv("http_proxy", "socks5://127.0.0.1:1")
    with pytest.raises(BareEarthError, match="proxy socks5:"):
        fetched("http://far.example/a", tmp_path / "parts")


def test_addresses_are_shown_without_secrets():
    assert shown("https://me:word@host.org:8/a b?sig=x#y") == "https://host.org:8/a b"
    assert shown("https://me:w/rd@host.org/a@b") == "https://b"
    assert shown("http://host:8/tiles@2/a") == "http://host:8/tiles@2/a"
    assert shown("me:word@host.org/a") == shown("http:/me:word@host.org/a") == "...@host.org/a"
    origins = ["http://h/a", "http://u:p@H:80/b", "https://h", "http://h:81", "s3://h"]
    assert [origin_of(place) for place in origins] == [
        "http://h", "http://h", "https://h", "http://h:81", "s3://h",
    ]  # fmt: skip
    assert checked("https://host.org/a b.laz?sig=%2F+=") == "https://host.org/a%20b.laz?sig=%2F+="
    assert ends_with("https://host.org/A.COPC.LAZ?sig=x.json", ".copc.laz")
    assert beside("https://h/e/ept.json?s=1", "ept-data/0.laz") == "https://h/e/ept-data/0.laz?s=1"
    assert referred("https://h/a/b.json", "../c.laz") == "https://h/c.laz"
    assert referred("s3://bucket/a/b.json", "c.laz") == "s3://bucket/a/c.laz"
    for address in ("file:///etc/passwd", "ftp://host/a", "https:///a", "https://host:x/a"):
        with pytest.raises(BareEarthError):
            checked(address)


class Store:
    """A file system as fsspec has them, which may give fewer bytes or change its objects."""

    def __init__(self, fault):
        self.fault, self.etags = fault, iter(range(100))

    def info(self, path, refresh):
        if self.fault == "missing":
            raise FileNotFoundError(path)
        return {"size": len(DATA), "ETag": next(self.etags) if self.fault == "changed" else 1}

    def cat_file(self, path, start, end):
        if self.fault == "denied":
            raise PermissionError(path)
        return DATA[start : end - 100 if self.fault == "short" else end]


@pytest.mark.parametrize(
    ("fault", "words"),
    [
        ("missing", "s3://bucket/a .* exist"),
        ("denied", "may not read s3://bucket/a"),
        ("changed", "changed while"),
        ("short", "after 6 attempts"),
        ("", None),
    ],
)
def test_objects_of_stores_are_checked_as_well(tmp_path, monkeypatch, fault, words):
    fsspec = pytest.importorskip("fsspec")
    store = Store(fault)
    monkeypatch.setattr(fsspec, "filesystem", lambda scheme, **options: store)
    if words is None:
        assert fetched("s3://bucket/a", tmp_path / "parts")[0] == wanted()
        return
    with pytest.raises(BareEarthError, match=words):
        fetched("s3://bucket/a", tmp_path / "parts")


def test_a_store_without_fsspec_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "fsspec", None)
    with pytest.raises(BareEarthError, match="pip install fsspec"):
        fetched("s3://bucket/a", tmp_path / "parts")
