"""Asks servers by http and https: one attempt at a time, with connections that are kept.

Certificates are those of the system or of SSL_CERT_FILE, proxies those of the environment or of the
settings of the system.
"""

from __future__ import annotations

import base64
import contextlib
import http.client
import socket
import ssl
import threading
import time
import urllib.request
from functools import partial
from typing import Callable, Iterator, Optional
from urllib.parse import SplitResult, unquote, urljoin, urlsplit, urlunsplit

from ..core.errors import BareEarthError
from ..core.version import __version__
from .addresses import checked, host_of, shown
from .answers import (
    REDIRECTS,
    Headers,
    State,
    Unfinished,
    check_range,
    check_whole,
    range_of,
    refused_by_proxy,
)

# Seconds without a byte after which a connection is given up.
_TIMEOUT = 30.0
# An answer may take so long, and as long as its bytes take at so many a second.
_PATIENCE, _LEAST_SPEED = 60.0, 10_000
_MOST_REDIRECTS = 5
_BLOCK = 1 << 16
_DEFAULT_PORTS = {"http": 80, "https": 443}

# Refuses an answer by its status and headers, or returns the number of bytes that follow, None if
# it is not stated.
Check = Callable[[int, Headers], Optional[int]]


class WebReader:
    """Base of what reads from web servers; several threads can use it at the same time."""

    def __init__(self) -> None:
        self.requests = self.received = 0  # and bytes of answers
        self.notes: list[str] = []  # what the user should know, not yet told
        self._moved: dict[str, str] = {}  # where redirects led, by address
        self._lock, self._closed = threading.Lock(), False

    def read(self, address: str, start: int, stop: int, known: State | None) -> tuple[bytes, State]:
        """Return bytes of a file, of the known version of it."""
        states: list[State] = []

        def check(status: int, headers: Headers) -> int:
            state, length = check_range(address, status, headers, start, stop, known)
            states.append(state)
            return length

        data = self._get(address, range_of(start, stop, known), check, stop - start)
        return data, states[-1]

    def read_whole(self, address: str, most: int) -> bytes:
        """Return a whole file of at most so many bytes."""
        check = partial(check_whole, address, most=most)
        return self._get(address, {}, check, most)

    def place_of(self, address: str) -> str:
        """Return the address to which redirects from another one led before."""
        return self._moved.get(address, address)

    def close(self) -> None:
        """End all connections, also those in use by other threads."""
        raise NotImplementedError

    def _ask(
        self, place: str, headers: dict[str, str], check: Check, most: int, is_named: bool
    ) -> bytes | str:
        """Return the bytes of at most so many of an answer that passes a check, or where a redirect
        leads; `is_named` if the user named the host.
        """
        raise NotImplementedError

    def _get(self, address: str, headers: dict[str, str], check: Check, most: int) -> bytes:
        """Return the bytes of at most so many of an answer that passes a check."""
        headers = {
            "User-Agent": f"BareEarth/{__version__}",
            "Accept-Encoding": "identity",
            "Cache-Control": "no-cache",
            **headers,
        }
        place = self.place_of(address)

        def check_place(status: int, headers: Headers) -> int | None:
            if status in (401, 403, 404) and place != address:
                # The address to which it led was valid for some time only.
                self._moved.pop(address, None)
                raise Unfinished(f"it answers with status {status}")
            return check(status, headers)

        for _ in range(_MOST_REDIRECTS):
            is_named = host_of(place) == host_of(address)
            found = self._ask(place, headers, check_place, most, is_named)
            if isinstance(found, bytes):
                return found
            place = self._redirected(place, found)
            self._moved[address] = place
        raise BareEarthError(f"{shown(address)} leads from one address to the next. Check it.")

    def _redirected(self, place: str, location: str) -> str:
        """Return where a redirect leads; refuse other kinds of addresses, and tell other hosts."""
        target = urljoin(place, location)
        if urlsplit(target).scheme != urlsplit(place).scheme:
            raise BareEarthError(
                f"{shown(place)} leads to {shown(target) or 'nowhere'}, which is not followed. If"
                " you trust it, give that address."
            )
        target = checked(target)
        if host_of(target) != host_of(place):
            note = f"{host_of(place)} passes the request on to {host_of(target)}."
            with self._lock:
                if note not in self.notes:
                    self.notes.append(note)
        return target


class HttpReader(WebReader):
    """Reads from web servers by http.client."""

    def __init__(self) -> None:
        super().__init__()
        self._idle: dict[tuple[str, str], list[http.client.HTTPConnection]] = {}
        self._open: set[http.client.HTTPConnection] = set()

    def close(self) -> None:
        """End all connections, also those in use by other threads."""
        with self._lock:
            self._closed = True
            connections, self._open, self._idle = list(self._open), set(), {}
        for connection in connections:
            if connection.sock is not None:
                with contextlib.suppress(OSError, ValueError):
                    connection.sock.shutdown(socket.SHUT_RDWR)
            # Those in use are closed by their threads.

    def _ask(
        self, place: str, headers: dict[str, str], check: Check, most: int, is_named: bool
    ) -> bytes | str:
        """Return the bytes of an answer that passes a check, or where a redirect leads."""
        with self._answered(place, headers, is_named) as answer:
            if answer.status in REDIRECTS:
                return answer.headers.get("Location", "")
            return self._body(answer, check(answer.status, answer.headers), most)

    @contextlib.contextmanager
    def _answered(
        self, address: str, headers: dict[str, str], is_named: bool
    ) -> Iterator[http.client.HTTPResponse]:
        """Ask, and yield the answer; keep the connection if it was read to its end."""
        parts = urlsplit(address)
        target, headers = _request(parts, headers, is_named)
        connection, was_idle = self._connection(parts)
        is_kept = has_answered = False
        try:
            with _errors_told(parts.hostname or ""):
                connection.request("GET", target, headers=headers)
                answer = connection.getresponse()
                has_answered = True
                yield answer
                is_kept = answer.isclosed() or answer.length == 0
                is_kept = is_kept and not (answer.will_close or self._closed)
                answer.close()
        except Unfinished as error:
            # A server may end a connection that nobody uses.
            error.is_stale = was_idle and not has_answered
            raise
        finally:
            with self._lock:
                if is_kept:
                    self._idle.setdefault(_origin(parts), []).append(connection)
                else:
                    self._open.discard(connection)
            if not is_kept:
                connection.close()

    def _body(self, answer: http.client.HTTPResponse, length: int | None, most: int) -> bytes:
        """Return the bytes of an answer; `Unfinished` if there are fewer or more."""
        data = bytearray()
        end = time.monotonic() + _PATIENCE + (length or 0) / _LEAST_SPEED
        while block := answer.read1(_BLOCK):
            data += block
            with self._lock:
                self.received += len(block)
            limit = most if length is None else length
            if len(data) > limit:
                raise Unfinished("it sends more bytes than it says")
            if self._closed or time.monotonic() > end:
                raise Unfinished("it sends too slowly")
        if length is not None and len(data) != length:
            raise Unfinished(f"it sent {len(data):,} of {length:,} bytes")
        return bytes(data)

    def _connection(self, parts: SplitResult) -> tuple[http.client.HTTPConnection, bool]:
        """Return a connection to a server, and whether it is one that was kept."""
        with self._lock:
            self.requests += 1
            idle = self._idle.get(_origin(parts))
            connection = idle.pop() if idle else _new_connection(parts)
            self._open.add(connection)
            return connection, connection.sock is not None


def _origin(parts: SplitResult) -> tuple[str, str]:
    return parts.scheme, parts.netloc.rpartition("@")[2].lower()


def _request(
    parts: SplitResult, headers: dict[str, str], is_named: bool
) -> tuple[str, dict[str, str]]:
    """Return what is asked for, and the headers."""
    headers = dict(headers)
    # A password that the user named is for the host that the user named.
    if parts.username is not None and is_named:
        headers["Authorization"] = _basic(parts)
    target, proxy = urlunsplit(("", "", parts.path or "/", parts.query, "")), _proxy_of(parts)
    if proxy is not None and parts.scheme == "http":
        target = f"http://{_origin(parts)[1]}{target}"
        if proxy.username is not None:
            headers["Proxy-Authorization"] = _basic(proxy)
    return target, headers


def _new_connection(parts: SplitResult) -> http.client.HTTPConnection:
    """Return a connection, not yet made, to a server or to the proxy that leads to it."""
    host, port = parts.hostname or "", parts.port or _DEFAULT_PORTS[parts.scheme]
    proxy = _proxy_of(parts)
    via = (host, port) if proxy is None else (proxy.hostname or "", proxy.port or 8080)
    if parts.scheme == "http":
        return http.client.HTTPConnection(*via, timeout=_TIMEOUT)
    secure = http.client.HTTPSConnection(
        *via, timeout=_TIMEOUT, context=ssl.create_default_context()
    )
    if proxy is not None:
        password = {} if proxy.username is None else {"Proxy-Authorization": _basic(proxy)}
        secure.set_tunnel(host, port, password)
    return secure


def _proxy_of(parts: SplitResult) -> SplitResult | None:
    """Return the proxy by which a server is reached, if any."""
    proxy = urllib.request.getproxies().get(parts.scheme)
    if not proxy or urllib.request.proxy_bypass(parts.hostname or ""):
        return None
    through = urlsplit(proxy if "://" in proxy else f"http://{proxy}")
    if through.scheme != "http" or not through.hostname:
        raise BareEarthError(
            f"The proxy {shown(proxy)} is of a kind that is not known here. Give one that begins"
            " with http://, in HTTPS_PROXY."
        )
    return through


def _basic(parts: SplitResult) -> str:
    """Return the user and the password of an address as a header has them."""
    words = f"{unquote(parts.username or '')}:{unquote(parts.password or '')}"
    return f"Basic {base64.b64encode(words.encode()).decode()}"


@contextlib.contextmanager
def _errors_told(host: str) -> Iterator[None]:
    """Turn errors of connections into `Unfinished`, or into a sentence if they will stay."""
    try:
        yield
    except ssl.SSLCertVerificationError as error:
        raise BareEarthError(
            f"The certificate of {host} is not valid for this computer ({error.verify_message})."
            " Check the address and the date of the computer, or ask who runs the network for the"
            " file with its certificates, and name it in SSL_CERT_FILE."
        ) from error
    except socket.gaierror as error:
        raise Unfinished(f"no server of this name is found ({error.strerror})") from error
    except TimeoutError as error:
        raise Unfinished("it does not answer in time") from error
    except http.client.HTTPException as error:
        raise Unfinished("it ended the connection before its answer was complete") from error
    except OSError as error:
        reason = error.strerror or "the connection broke"
        if "Tunnel connection failed: 407" in str(error):
            raise refused_by_proxy(host) from error
        raise Unfinished(reason[:1].lower() + reason[1:]) from error
