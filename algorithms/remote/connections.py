"""Single requests by http and https, with connections that are kept open.

Certificates are those of the system or of SSL_CERT_FILE. Proxies are those of the environment or of
the settings of the system.
"""

from __future__ import annotations

import base64
import contextlib
import http.client
import math
import socket
import ssl
import time
import urllib.request
from typing import Iterator
from urllib.parse import SplitResult, unquote, urlsplit, urlunsplit

from ..core.errors import BareEarthError
from .addresses import DEFAULT_PORTS, shown
from .answers import REDIRECTS, Unfinished, refused_by_proxy
from .web_reader import Check, WebReader

_TIMEOUT = 30.0  # seconds without a byte after which a connection is closed
_BLOCK = 1 << 16


class HttpReader(WebReader):
    """Reads from web servers by http.client."""

    def __init__(self) -> None:
        super().__init__()
        self._idle: dict[tuple[str, str], list[http.client.HTTPConnection]] = {}
        # Connections, with the time at which those in use must end, which received bytes extend.
        self._open: dict[http.client.HTTPConnection, float] = {}

    def close(self) -> None:
        """End all connections, also those in use by other threads."""
        with self._lock:
            self._closed = True
            connections, self._open, self._idle = list(self._open), {}, {}
        for connection in connections:
            _end(connection)

    def end_overdue(self) -> None:
        """End the connections whose answers take too long."""
        # The timeout of a socket is for a single read, but a server can send single bytes.
        with self._lock:
            now = time.monotonic()
            overdue = [connection for connection, end in self._open.items() if now > end]
        for connection in overdue:
            _end(connection)

    def _ask(
        self, place: str, headers: dict[str, str], check: Check, most: int, is_named: bool
    ) -> bytes | str:
        """Return the bytes of an answer that passes a check, or the target of a redirect."""
        with self._answered(place, headers, is_named) as (connection, answer):
            if answer.status in REDIRECTS:
                return answer.headers.get("Location", "")
            length = check(answer.status, answer.headers)
            return self._body(connection, answer, length, most)

    @contextlib.contextmanager
    def _answered(
        self, address: str, headers: dict[str, str], is_named: bool
    ) -> Iterator[tuple[http.client.HTTPConnection, http.client.HTTPResponse]]:
        """Make a request, and yield connection and answer; keep the connection if all was read."""
        parts = urlsplit(address)
        target, headers = _request(parts, headers, is_named)
        connection, was_idle = self._connection(parts)
        is_kept = has_answered = False
        try:
            with _errors_told(parts.hostname or ""):
                connection.request("GET", target, headers=headers)
                answer = connection.getresponse()
                has_answered = True
                yield connection, answer
                is_kept = answer.isclosed() or answer.length == 0
                is_kept = is_kept and not (answer.will_close or self._closed)
                answer.close()
        except Unfinished as error:
            # A server may close a connection that was not used for some time.
            error.is_stale = was_idle and not has_answered
            if time.monotonic() > self._open.get(connection, math.inf):
                raise Unfinished("its answer takes too long", data=error.data) from error
            raise
        finally:
            with self._lock:
                if is_kept:
                    self._open[connection] = math.inf
                    self._idle.setdefault(_origin(parts), []).append(connection)
                else:
                    self._open.pop(connection, None)
            if not is_kept:
                connection.close()

    def _body(
        self,
        connection: http.client.HTTPConnection,
        answer: http.client.HTTPResponse,
        length: int | None,
        most: int,
    ) -> bytes:
        """Return the bytes of an answer; `Unfinished`, with the received bytes, if their number is
        wrong.
        """
        data, limit = bytearray(), most if length is None else length
        try:
            with _errors_told(connection.host):
                while block := answer.read1(_BLOCK):
                    data += block
                    with self._lock:
                        self.received += len(block)
                        if self._closed:
                            raise Unfinished("cancelled")
                        self._open[connection] += len(block) / self.least_speed
                    if len(data) > limit:
                        raise Unfinished("it sends more bytes than it says")
        except Unfinished as error:
            error.data = bytes(data[:limit])
            raise
        is_overdue = time.monotonic() > self._open.get(connection, math.inf)
        if is_overdue or (length is not None and len(data) != length):
            reason = f"it sent {len(data):,} of {length or 0:,} bytes"
            raise Unfinished(reason, data=bytes(data))
        return bytes(data)

    def _connection(self, parts: SplitResult) -> tuple[http.client.HTTPConnection, bool]:
        """Return a connection to a server, and whether it was kept from a request before."""
        with self._lock:
            self.requests += 1
            idle = self._idle.get(_origin(parts))
            connection = idle.pop() if idle else _new_connection(parts)
            self._open[connection] = time.monotonic() + self.patience
            return connection, connection.sock is not None


def _end(connection: http.client.HTTPConnection) -> None:
    """Let reads from a connection fail, so that the thread that uses it closes it."""
    if connection.sock is not None:
        with contextlib.suppress(OSError, ValueError):
            connection.sock.shutdown(socket.SHUT_RDWR)


def _origin(parts: SplitResult) -> tuple[str, str]:
    return parts.scheme, parts.netloc.rpartition("@")[2].lower()


def _request(
    parts: SplitResult, headers: dict[str, str], is_named: bool
) -> tuple[str, dict[str, str]]:
    """Return the target and the headers of a request."""
    headers = dict(headers)
    # A password in the address of the user is only for the host in this address.
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
    host, port = parts.hostname or "", parts.port or DEFAULT_PORTS[parts.scheme]
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
    """Return the user and the password of an address as the value of a header."""
    words = f"{unquote(parts.username or '')}:{unquote(parts.password or '')}"
    return f"Basic {base64.b64encode(words.encode()).decode()}"


@contextlib.contextmanager
def _errors_told(host: str) -> Iterator[None]:
    """Turn errors of connections into `Unfinished`, lasting ones into `BareEarthError`."""
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
    except UnicodeError as error:
        raise BareEarthError(
            f"{host} cannot be the name of a server. Check the address."
        ) from error
    except (http.client.HTTPException, ValueError) as error:
        raise Unfinished("it ended the connection before its answer was complete") from error
    except OSError as error:
        reason = error.strerror or "the connection broke"
        if "Tunnel connection failed: 407" in str(error):
            raise refused_by_proxy(host) from error
        raise Unfinished(reason[:1].lower() + reason[1:]) from error
