"""Reads from web servers by the network manager of QGIS, which knows proxies, certificates and the
passwords of the user.
"""

from __future__ import annotations

import email.message
import time

from qgis.core import QgsApplication, QgsNetworkAccessManager
from qgis.PyQt.QtCore import QEventLoop, QMetaObject, Qt, QUrl
from qgis.PyQt.QtNetwork import QNetworkReply, QNetworkRequest

from ..algorithms.core.errors import BareEarthError
from ..algorithms.remote.addresses import host_of, origin_of
from ..algorithms.remote.answers import REDIRECTS, Unfinished
from ..algorithms.remote.transfers import use
from ..algorithms.remote.web_reader import Check, WebReader

# Milliseconds without a byte after which a request is given up. The timeout of QGIS ends no
# request of a thread of Python.
_TIMEOUT = 30_000
# The ids of the authentication configurations of layers, by servers.
_LOGINS: dict[str, str] = {}


def use_for(address: str, login: str) -> None:
    """Let the manager of QGIS read from the web, with a login for the server of an address."""
    use(QgisReader)
    _LOGINS.pop(origin_of(address), None)
    if login:
        _LOGINS[origin_of(address)] = login


class QgisReader(WebReader):
    """Reads in threads other than the main one, each with a manager of its own."""

    # Not by QgsBlockingNetworkRequest: it follows redirects by itself, also to files and, with the
    # password, to other hosts; a cancel can let it wait for ever.

    def __init__(self) -> None:
        super().__init__()
        self._running: set[QEventLoop] = set()

    def close(self) -> None:
        """End all requests, also those of other threads."""
        with self._lock:
            self._closed = True
        self.end_overdue()

    def end_overdue(self) -> None:
        """Let all requests look whether they are to end."""
        with self._lock:
            for loop in self._running:
                QMetaObject.invokeMethod(loop, "quit", Qt.ConnectionType.QueuedConnection)

    def _ask(
        self, place: str, headers: dict[str, str], check: Check, most: int, is_named: bool
    ) -> bytes | str:
        """Return the bytes of an answer that passes a check, or where a redirect leads."""
        request, login = _request(place, headers), _LOGINS.get(origin_of(place))
        if login and is_named:
            is_known, request = QgsApplication.authManager().updateNetworkRequest(request, login)
            if not is_known:
                raise BareEarthError(f"QGIS does not give the login of {host_of(place)}. Check it.")
        loop = QEventLoop()
        with self._lock:
            if self._closed:
                raise Unfinished("cancelled")
            self.requests += 1
            self._running.add(loop)
        end = time.monotonic() + self.patience
        direct = Qt.ConnectionType.DirectConnection
        reply = QgsNetworkAccessManager.instance(direct).get(request)
        # A server that knows no ranges sends the whole file, which would fill the memory.
        reply.setReadBufferSize(most + 1)
        try:
            # No function of Python is called by signals: an error in one, as where the reply is
            # gone, ends QGIS.
            for signal in (reply.finished, reply.metaDataChanged, reply.readyRead):
                signal.connect(loop.quit)
            while not (reply.isFinished() or self._closed or _length(reply) > most):
                if time.monotonic() > end + reply.bytesAvailable() / self.least_speed:
                    break
                loop.exec()
            return self._answer(reply, check)
        finally:
            with self._lock:
                self._running.discard(loop)
            reply.abort()
            reply.deleteLater()

    def _answer(self, reply: QNetworkReply, check: Check) -> bytes | str:
        """Return what came of a request; whether Qt names an error means nothing."""
        status = reply.attribute(QNetworkRequest.Attribute.HttpStatusCodeAttribute)
        if not status:
            is_error = reply.error() != QNetworkReply.NetworkError.NoError
            raise Unfinished(reply.errorString() if is_error else "it does not answer in time")
        headers = email.message.Message()  # whose names may have any case
        for name, value in reply.rawHeaderPairs():
            headers[bytes(name).decode("latin-1")] = bytes(value).decode("latin-1")
        if status in REDIRECTS:
            return str(headers.get("Location", ""))
        length, data = check(status, headers), bytes(reply.readAll())
        with self._lock:
            self.received += len(data)
        if (length is not None and len(data) != length) or not reply.isFinished():
            reason = f"it sent {len(data):,} bytes, which is not its whole answer"
            raise Unfinished(reason, data=data[:length])
        return data


def _length(reply: QNetworkReply) -> int:
    """Return the bytes that an answer states, or that have come."""
    stated = reply.header(QNetworkRequest.KnownHeaders.ContentLengthHeader)
    return max(reply.bytesAvailable(), stated or 0)


def _request(place: str, headers: dict[str, str]) -> QNetworkRequest:
    """Return a request that follows no redirect, and is not kept."""
    request, names = QNetworkRequest(QUrl.fromEncoded(place.encode())), QNetworkRequest.Attribute
    manual = QNetworkRequest.RedirectPolicy.ManualRedirectPolicy
    request.setAttribute(names.RedirectPolicyAttribute, manual)
    network = QNetworkRequest.CacheLoadControl.AlwaysNetwork
    request.setAttribute(names.CacheLoadControlAttribute, network)
    request.setAttribute(names.CacheSaveControlAttribute, False)
    request.setTransferTimeout(_TIMEOUT)
    for name, value in headers.items():
        request.setRawHeader(name.encode(), value.encode())
    return request
