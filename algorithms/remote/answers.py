"""What an answer of a server is worth: only what was asked for, of the same file, is taken.

Servers answer ranges with whole files, other ranges, compressed bytes, or of a file that was
replaced; libraries that do not notice give fewer points, or wrong ones, without an error.

References
----------
RFC 9110, HTTP Semantics, sections 8.8.3 (ETag), 13.1 (If-Match) and 14 (ranges)
"""

from __future__ import annotations

import email.utils
import re
import time
from typing import NamedTuple, Protocol

from ..core.errors import BareEarthError
from .addresses import host_of, shown

_RANGE = re.compile(r"bytes (\d+)-(\d+)/(\d+)")
_AGAIN = (408, 425, 429, 500, 502, 503, 504)
REDIRECTS = (301, 302, 303, 307, 308)
# Parameters of the query that say that an address is signed: of Azure, Amazon and Google.
_SIGNED = re.compile(r"[?&](sig|X-Amz-Signature|Signature|X-Goog-Signature)=", re.IGNORECASE)


class Headers(Protocol):
    """Headers of an answer, whose names may have any case."""

    def get(self, name: str, default: str, /) -> str:
        """Return a header."""


class Unfinished(Exception):
    """The answer is missing or incomplete; the next one may be right."""

    def __init__(self, reason: str, pause: float = 0.0) -> None:
        super().__init__(reason)
        self.pause = pause  # seconds that the server asks for
        self.is_stale = False  # whether only a connection was too old


class Missing(BareEarthError):
    """The server does not have the file, or does not say whether it has it."""


class Expired(BareEarthError):
    """The signature in an address is not, or no longer, valid."""


class State(NamedTuple):
    """What shows whether a remote file has changed."""

    size: int  # bytes
    etag: str  # of the server for this version of the file; empty if there is none
    modified: str

    @property
    def strong_etag(self) -> str:
        """The ETag, if equal ones mean equal bytes."""
        return "" if self.etag.startswith("W/") else self.etag

    @property
    def is_certain(self) -> bool:
        """Whether it tells one version of the file from another."""
        return bool(self.strong_etag or self.modified)


def range_of(start: int, stop: int, known: State | None) -> dict[str, str]:
    """Return the headers that ask for bytes, of the known version of the file."""
    headers = {"Range": f"bytes={start}-{stop - 1}"}
    if known is not None and known.strong_etag:
        headers["If-Match"] = known.strong_etag
    return headers


def check_range(
    address: str, status: int, headers: Headers, start: int, stop: int, known: State | None
) -> tuple[State, int]:
    """Return the state of the file and the number of bytes that follow, which are those that were
    asked for, fewer only at the end of a file whose state is not yet known.
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
    found = _RANGE.fullmatch(headers.get("Content-Range", "").strip())
    if status != 206 or found is None:
        raise _not_asked(address, "no range of bytes, or none whose file has a size")
    first, last, size = map(int, found.groups())
    state = State(size, headers.get("ETag", "").strip(), headers.get("Last-Modified", "").strip())
    if known is not None and not _is_same(known, state):
        raise changed(address)
    if first != start or last != min(stop, size if known is None else stop) - 1 or last < first:
        raise _not_asked(address, f"bytes {first} to {last} in place of {start} to {stop - 1}")
    length, stated = last - first + 1, headers.get("Content-Length", "")
    if stated and stated.strip() != str(length):
        raise Unfinished("its answer has another length than it says")
    return state, length


def check_whole(address: str, status: int, headers: Headers, most: int) -> int | None:
    """Return the number of bytes of a whole file that follow, None if they come in chunks that tell
    their end.
    """
    check_status(address, status, headers)
    if status != 200:
        raise _not_asked(address, f"status {status}")
    stated = headers.get("Content-Length", "").strip()
    if not stated.isdigit():
        if headers.get("Transfer-Encoding", "").lower() == "chunked":
            return None
        raise _not_asked(address, "a file without its length, which may be cut off")
    if int(stated) > most:
        raise BareEarthError(
            f"{shown(address)} has {int(stated):,} bytes, which is too much for what it should be."
            " Check the address."
        )
    return int(stated)


def check_status(address: str, status: int, headers: Headers) -> None:
    """Refuse answers that are none, and say what to do; `Unfinished` if asking again may help."""
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
    encoding = headers.get("Content-Encoding", "").strip().lower()
    if encoding not in ("", "identity"):
        raise _not_asked(address, f"it compressed by {encoding}, although it was asked not to")


def refused_by_proxy(host: str) -> BareEarthError:
    """Return the error for a proxy that wants a password."""
    return BareEarthError(
        f"The proxy asks for user and password before it lets you reach {host}. Set them in"
        " HTTPS_PROXY, with a colon between them and @ before the proxy."
    )


def changed(address: str) -> BareEarthError:
    """Return the error for a remote file that was replaced while it was read."""
    return BareEarthError(
        f"{shown(address)} has changed while it was downloaded. Run it again, which begins anew."
    )


def _is_same(known: State, state: State) -> bool:
    """Return whether two answers are of the same version; some servers leave headers out."""
    pairs = (known.etag, state.etag), (known.modified, state.modified)
    return known.size == state.size and all(a == b for a, b in pairs if a and b)


def _not_asked(address: str, what: str) -> BareEarthError:
    return BareEarthError(
        f"{host_of(address)} answers with something else than was asked for of {shown(address)}:"
        f" {what}. Download the whole file with a browser, or ask who runs the server."
    )


def _pause(text: str) -> float:
    """Return the seconds to wait that a server states, as a number or as a date."""
    if text.strip().isdigit():
        return float(text)
    date = email.utils.parsedate_to_datetime(text) if _is_date(text) else None
    return 0.0 if date is None else max(date.timestamp() - time.time(), 0.0)


def _is_date(text: str) -> bool:
    return email.utils.parsedate_tz(text) is not None
