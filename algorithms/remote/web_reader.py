"""Reads whole files and parts of files from web servers.

A derived class makes the single requests: here by http.client, in QGIS by its network manager.
"""

from __future__ import annotations

import threading
from typing import Callable, Optional
from urllib.parse import urljoin, urlsplit

from ..core.errors import BareEarthError
from ..core.version import __version__
from .addresses import checked, host_of, origin_of, shown
from .answers import (
    FileVersion,
    Headers,
    Unfinished,
    check_range,
    check_whole,
    encoding_of,
    range_of,
    unpacked,
)

_MOST_REDIRECTS = 5

# Raises an error for an answer with a wrong status or headers, or returns the number of bytes that
# follow, None if it is not stated.
Check = Callable[[int, Headers], Optional[int]]


class WebReader:
    """Base of what reads from web servers; several threads can use it at the same time."""

    # Seconds that an answer may take, beside the time for its bytes at the least speed.
    patience = 30.0
    least_speed = 10_000.0  # bytes a second

    def __init__(self) -> None:
        self.requests = self.received = 0  # number of requests, and bytes of answers
        self.notes: list[str] = []  # warnings for the user that are not yet shown
        self.refusal: str | None = None
        self._moved: dict[str, str] = {}  # the targets of redirects, by address
        self._lock, self._closed = threading.Lock(), False

    def read(
        self, address: str, start: int, stop: int, known: FileVersion | None
    ) -> tuple[bytes, FileVersion]:
        """Return bytes of a file, of the known version of it."""
        states: list[FileVersion] = []

        def check(status: int, headers: Headers) -> int:
            state, length = check_range(address, status, headers, start, stop, known)
            states.append(state)
            return length

        data = self._get(address, range_of(start, stop, known), check, stop - start)
        return data, states[-1]

    def read_whole(self, address: str, most: int) -> bytes:
        """Return a whole file of at most `most` bytes."""
        encodings: list[str] = []

        def check(status: int, headers: Headers) -> int | None:
            encodings.append(encoding_of(headers))
            return check_whole(address, status, headers, most)

        data = self._get(address, {}, check, most)
        return unpacked(address, data, most) if encodings[-1] else data

    def place_of(self, address: str) -> str:
        """Return the address to which redirects from another one led before."""
        return self._moved.get(address, address)

    def close(self) -> None:
        """End all connections, also those in use by other threads."""
        raise NotImplementedError

    def end_overdue(self) -> None:
        """End the connections whose answers take too long."""

    def _ask(
        self, place: str, headers: dict[str, str], check: Check, most: int, is_named: bool
    ) -> bytes | str:
        """Return at most `most` bytes of an answer that passes a check, or where a redirect leads;
        `is_named` if the user named the host.
        """
        raise NotImplementedError

    def _get(self, address: str, headers: dict[str, str], check: Check, most: int) -> bytes:
        """Return at most `most` bytes of an answer that passes a check."""
        headers = {
            "User-Agent": f"BareEarth/{__version__}",
            "Accept-Encoding": "identity",
            "Cache-Control": "no-cache",
            **headers,
        }
        place = self.place_of(address)

        def check_place(status: int, headers: Headers) -> int | None:
            if status in (401, 403, 404) and place != address:
                # The target of the redirect was valid for some time only.
                self._moved.pop(address, None)
                raise Unfinished(f"it answers with status {status}")
            return check(status, headers)

        for _ in range(_MOST_REDIRECTS):
            is_named = origin_of(place) == origin_of(address)
            found = self._ask(place, headers, check_place, most, is_named)
            if isinstance(found, bytes):
                return found
            place = self._redirected(address, place, found)
            self._moved[address] = place
        raise BareEarthError(f"{shown(address)} leads from one address to the next. Check it.")

    def _redirected(self, address: str, place: str, location: str) -> str:
        """Return where a redirect leads; refuse other kinds of addresses, and other servers unless
        the user allows them.
        """
        try:
            target = urljoin(place, location)
            is_other = urlsplit(target).scheme != urlsplit(place).scheme
        except ValueError as error:
            raise BareEarthError(
                f"{shown(address)} leads to something that is no address. Check it, or ask who runs"
                " the server."
            ) from error
        if is_other:
            raise BareEarthError(
                f"{shown(place)} leads to {shown(target) or 'nowhere'}, which is not followed. If"
                " you trust it, give that address."
            )
        target = checked(target)
        if origin_of(target) not in (origin_of(place), origin_of(address)):
            if self.refusal is not None:
                raise BareEarthError(
                    f"{shown(address)} leads to another server, {origin_of(target)}. If you trust"
                    f" it, {self.refusal}."
                )
            note = f"{host_of(place)} passes the request on to {host_of(target)}."
            with self._lock:
                if note not in self.notes:
                    self.notes.append(note)
        return target
