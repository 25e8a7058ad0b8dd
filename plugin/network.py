"""Reads from web servers by the network manager of QGIS, which knows proxies, certificates and the
passwords of the user.
"""

from __future__ import annotations

import time

from qgis.core import QgsBlockingNetworkRequest, QgsFeedback
from qgis.PyQt.QtCore import Qt, QUrl
from qgis.PyQt.QtNetwork import QNetworkRequest

from ..algorithms.remote.addresses import host_of
from ..algorithms.remote.answers import REDIRECTS, Unfinished
from ..algorithms.remote.connections import Check, WebReader
from ..algorithms.remote.transfers import use

# Milliseconds without a byte after which a request is given up. The timeout of QGIS ends no
# request of a thread of Python.
_TIMEOUT = 30_000
# Seconds that requests get to end, and between two looks at them.
_PATIENCE, _BEAT = 0.5, 0.02
# The ids of the authentication configurations of layers, by hosts.
_LOGINS: dict[str, str] = {}


def use_for(address: str, login: str) -> None:
    """Let the manager of QGIS read from the web, with a login for the host of an address."""
    use(QgisReader)
    _LOGINS.pop(host_of(address), None)
    if login:
        _LOGINS[host_of(address)] = login


class QgisReader(WebReader):
    """Reads by requests that block their thread, which must not be the main one."""

    def __init__(self) -> None:
        super().__init__()
        self._running: dict[QgsBlockingNetworkRequest, QgsFeedback] = {}

    def close(self) -> None:
        """End all requests, also those of other threads."""
        with self._lock:
            self._closed = True
            running = dict(self._running)
        for feedback in running.values():
            feedback.cancel()
        end = time.monotonic() + _PATIENCE
        while self._running and time.monotonic() < end:
            time.sleep(_BEAT)
        for blocking in list(self._running):
            # It may have removed the reply before it heard of the end, and would wait for ever.
            blocking.finished.emit()

    def _ask(
        self, place: str, headers: dict[str, str], check: Check, most: int, is_named: bool
    ) -> bytes | str:
        """Return the bytes of an answer that passes a check, or where a redirect leads."""
        request, feedback = _request(place, headers), QgsFeedback()
        blocking = QgsBlockingNetworkRequest()
        login = _LOGINS.get(host_of(place))
        if login and is_named:
            blocking.setAuthCfg(login)
        sizes: list[int] = []  # of an answer that is too long

        def look(received: int, size: int) -> None:
            # A server that knows no ranges sends the whole file, which would fill the memory.
            if max(received, size) > most:
                sizes.append(size)
                feedback.cancel()

        blocking.downloadProgress.connect(look, Qt.ConnectionType.DirectConnection)
        with self._lock:
            if self._closed:
                raise Unfinished("cancelled")
            self.requests += 1
            self._running[blocking] = feedback
        try:
            blocking.get(request, True, feedback)
        finally:
            with self._lock:
                del self._running[blocking]
        if sizes:
            check(200, {"Content-Length": str(sizes[0])})
            raise Unfinished("it sends more bytes than it says")
        return self._answer(blocking, check)

    def _answer(self, blocking: QgsBlockingNetworkRequest, check: Check) -> bytes | str:
        """Return what came of a request; its status of success means nothing."""
        reply = blocking.reply()
        status = reply.attribute(QNetworkRequest.Attribute.HttpStatusCodeAttribute)
        data = bytes(reply.content())
        with self._lock:
            self.received += len(data)
        if not status:
            raise Unfinished(blocking.errorMessage() or "it does not answer in time")
        headers = {
            bytes(name).decode("latin-1").title(): bytes(reply.rawHeader(name)).decode("latin-1")
            for name in reply.rawHeaderList()
        }
        if status in REDIRECTS:
            return headers.get("Location", "")
        length = check(status, {**headers, "ETag": headers.get("Etag", "")})
        if length is not None and len(data) != length:
            raise Unfinished(f"it sent {len(data):,} of {length:,} bytes")
        return data


def _request(place: str, headers: dict[str, str]) -> QNetworkRequest:
    """Return a request that follows no redirect: QGIS would leave the range out, or read a file."""
    request = QNetworkRequest(QUrl.fromEncoded(place.encode()))
    attribute = QNetworkRequest.Attribute.RedirectPolicyAttribute
    request.setAttribute(attribute, QNetworkRequest.RedirectPolicy.SameOriginRedirectPolicy)
    request.setTransferTimeout(_TIMEOUT)
    for name, value in headers.items():
        request.setRawHeader(name.encode(), value.encode())
    return request
