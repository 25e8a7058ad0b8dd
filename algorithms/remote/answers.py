"""Checks of the answers of servers: only the requested bytes of the same file are accepted.

Servers may answer a request for a range with a whole file, another range, compressed bytes, or
bytes of a file that was replaced. Libraries that do not notice this return too few or wrong points
without an error.

References
----------
RFC 9110, HTTP Semantics, sections 8.8.3 (ETag), 13.1 (If-Match) and 14 (ranges)
"""

from __future__ import annotations

import email.utils
import json
import re
import time
import zlib
from typing import Any, Dict, NamedTuple, Protocol

from ..core.errors import BareEarthError
from .addresses import host_of, shown

# Numbers have no more digits than sizes of files.
_RANGE = re.compile(r"bytes ([0-9]{1,18})-([0-9]{1,18})/([0-9]{1,18})")
_NUMBER = re.compile(r"[0-9]{1,18}")
_AGAIN = (408, 425, 429, 500, 502, 503, 504)
REDIRECTS = (301, 302, 303, 307, 308)
_GZIP = "gzip"
# Most bytes of memory that Python needs for an object, a member, a list and a value of JSON, by a
# character that each contains.
_COSTS = {b"{": 64, b"[": 72, b":": 150, b",": 40}
_MOST_MEMORY = 600_000_000  # bytes for a whole document
# Parameters in the query of a signed address, of Azure, Amazon and Google.
_SIGNED = re.compile(r"[?&](sig|X-Amz-Signature|Signature|X-Goog-Signature)=", re.IGNORECASE)
# The names and values of a document in JSON, which may be of any kind until they are checked.
Document = Dict[str, Any]


class Headers(Protocol):
    """Headers of an answer, whose names may have any case."""

    def get(self, name: str, default: str, /) -> str:
        """Return a header."""


class Unfinished(Exception):
    """There is no complete answer, but another attempt may succeed."""

    def __init__(self, reason: str, pause: float = 0.0, data: bytes = b"") -> None:
        super().__init__(reason)
        self.pause = pause  # seconds to wait that the server states
        self.data = data  # the first of the requested bytes, if some came
        self.is_stale = False  # whether the only reason is a connection that was kept too long


class Missing(BareEarthError):
    """The server does not have the file, or does not say whether it has it."""


class Expired(BareEarthError):
    """The signature in an address is not, or no longer, valid."""


class FileVersion(NamedTuple):
    """The version of a remote file, as far as the server states it."""

    size: int  # bytes
    etag: str  # of the server for this version of the file; empty if not stated
    modified: str

    @property
    def strong_etag(self) -> str:
        """The ETag, if equal ones mean equal bytes."""
        return "" if self.etag.startswith("W/") else self.etag

    @property
    def is_certain(self) -> bool:
        """Whether it differs for different versions of the file."""
        return bool(self.strong_etag or self.modified)


def range_of(start: int, stop: int, known: FileVersion | None) -> dict[str, str]:
    """Return the headers of a request for bytes, of the known version of the file if any."""
    headers = {"Range": f"bytes={start}-{stop - 1}"}
    if known is not None and known.strong_etag:
        headers["If-Match"] = known.strong_etag
    return headers


def check_range(
    address: str, status: int, headers: Headers, start: int, stop: int, known: FileVersion | None
) -> tuple[FileVersion, int]:
    """Return the state of the file and the number of bytes that follow, after a check that they are
    the requested ones; they may be fewer only at the end of a file whose state is not yet known.
    """
    if known is not None and status in (412, 416):
        raise changed(address)
    if status == 200:
        raise BareEarthError(
            f"{host_of(address)} gives {shown(address)} only as a whole: it knows no ranges."
            " Download the file with a browser, and give it as a file."
        )
    if status == 416:
        raise BareEarthError(f"{shown(address)} is empty or cut off. Check the address.")
    check_status(address, status, headers)
    if encoding := encoding_of(headers):
        raise _not_asked(address, f"it compressed by {encoding}, although it was asked not to")
    found = _RANGE.fullmatch(headers.get("Content-Range", "").strip())
    if status != 206 or found is None:
        raise _not_asked(address, "no range of bytes, or none whose file has a size")
    first, last, size = map(int, found.groups())
    etag, modified = (headers.get(name, "").strip() for name in ("ETag", "Last-Modified"))
    state = FileVersion(size, etag if etag.isprintable() else "", modified)
    if known is not None and not _is_same(known, state):
        raise changed(address)
    if first != start or last != min(stop, size if known is None else stop) - 1 or last < first:
        raise _not_asked(address, f"bytes {first} to {last} in place of {start} to {stop - 1}")
    length, stated = last - first + 1, headers.get("Content-Length", "")
    if stated and stated.strip() != str(length):
        raise Unfinished("its answer has another length than it says")
    return state, length


def check_whole(address: str, status: int, headers: Headers, most: int) -> int | None:
    """Return the number of bytes of a whole file that follow; None if they come in chunks, whose
    end is marked.
    """
    check_status(address, status, headers)
    if encoding_of(headers) not in ("", _GZIP):
        raise _not_asked(address, f"it compressed by {encoding_of(headers)}")
    if status != 200:
        raise _not_asked(address, f"status {status}")
    stated = headers.get("Content-Length", "").strip()
    if not _NUMBER.fullmatch(stated):
        if headers.get("Transfer-Encoding", "").lower() == "chunked":
            return None
        raise _not_asked(address, "a file without its length, which may be cut off")
    if int(stated) > most:
        raise too_large(address, f"has {int(stated):,} bytes")
    return int(stated)


def encoding_of(headers: Headers) -> str:
    """Return the compression of an answer; empty if it has none."""
    encoding = headers.get("Content-Encoding", "").strip().lower()
    return {"identity": "", "x-gzip": _GZIP}.get(encoding, encoding)


def unpacked(address: str, data: bytes, most: int) -> bytes:
    """Return a whole file that a server compressed by gzip, of at most `most` bytes."""
    stream = zlib.decompressobj(wbits=31)
    try:
        found = stream.decompress(data, most + 1)
    except zlib.error as error:
        raise Unfinished("its compressed answer is damaged") from error
    if len(found) > most:
        raise too_large(address, f"has more than {most:,} bytes")
    if not stream.eof or stream.unused_data:
        raise Unfinished("its compressed answer is cut off")
    return found


def parsed(text: bytes) -> Document:
    """Return an object of JSON; ValueError if it is invalid or would need much memory."""
    size = sum(text.count(mark) * cost for mark, cost in _COSTS.items())
    if size > _MOST_MEMORY:
        raise ValueError("it would need too much memory")
    try:
        found = json.loads(text.decode("utf-8-sig"))
    except RecursionError as error:
        raise ValueError("it is nested too deeply") from error
    if not isinstance(found, dict):
        raise ValueError("it is no object")
    return found


def check_status(address: str, status: int, headers: Headers) -> None:
    """Refuse answers without a file, and say what to do; `Unfinished` if a new attempt may help."""
    host, place = host_of(address), shown(address)
    if status in _AGAIN:
        raise Unfinished(f"it answers with status {status}", _pause(headers.get("Retry-After", "")))
    # Azure answers with 409 where nothing can be read without a signature.
    if status in (401, 403, 409):
        if _SIGNED.search(address):
            raise Expired(
                f"{host} refuses {place} (status {status}): the signature in the address is wrong"
                " or has expired. Get a new address, and run it again."
            )
        raise Missing(
            f"{host} refuses {place} (status {status}): you may not read it, or it does not exist."
            " Check the address, and whether it needs a password or a signature."
        )
    if status in (404, 410):
        raise Missing(f"{place} does not exist (status {status}). Check the address.")
    if status == 407:
        raise refused_by_proxy(host)
    if not 200 <= status < 300:
        raise BareEarthError(f"{host} does not give {place} (status {status}). Check the address.")


def refused_by_proxy(host: str) -> BareEarthError:
    """Return the error for a proxy that wants a password."""
    return BareEarthError(
        f"The proxy asks for user and password before it lets you reach {host}. Set them in"
        " HTTPS_PROXY, with a colon between them and @ before the proxy."
    )


def too_large(address: str, how: str) -> BareEarthError:
    """Return the error for a file that would fill the memory."""
    return BareEarthError(
        f"{shown(address)} {how}, which is too much for what it should be. Check the address."
    )


def changed(address: str) -> BareEarthError:
    """Return the error for a remote file that was replaced while it was read."""
    return BareEarthError(
        f"{shown(address)} has changed while it was downloaded. Run it again, which begins anew."
    )


def _is_same(known: FileVersion, state: FileVersion) -> bool:
    """Return whether two answers are of the same version; some servers leave headers out."""
    pairs = (known.etag, state.etag), (known.modified, state.modified)
    return known.size == state.size and all(a == b for a, b in pairs if a and b)


def _not_asked(address: str, found: str) -> BareEarthError:
    return BareEarthError(
        f"{host_of(address)} answers with something else than was asked for of {shown(address)}:"
        f" {found}. Ask who runs the server, or download what you need with a browser."
    )


def _pause(text: str) -> float:
    """Return the seconds to wait that a server states, as a number or as a date."""
    if _NUMBER.fullmatch(text.strip()):
        return float(text)
    try:
        return max(email.utils.parsedate_to_datetime(text).timestamp() - time.time(), 0.0)
    except (ValueError, TypeError, OverflowError):  # it is neither
        return 0.0
