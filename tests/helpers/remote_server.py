"""A server on this computer that answers ranges, rightly or in the ways of bad servers."""

import contextlib
import gzip
import http.server
import re
import socket
import threading
import time

# What begins an answer that has no end, and what goes on.
_FIRST = b"HTTP/1.1 206 P\r\nContent-Range: bytes 0-65535/1000000\r\n"
ENDLESS = {
    "hundred": (b"", b"HTTP/1.1 100 Continue\r\n\r\n"),
    "header": (b"HTTP/1.1 206 P\r\nX: ", b"a"),
    "trailer": (
        _FIRST + b"Transfer-Encoding: chunked\r\n\r\n10000\r\n" + bytes(1 << 16) + b"\r\n0\r\n",
        b"X: y\r\n",
    ),
    "body": (_FIRST + b"Content-Length: 65536\r\n\r\n", b"a"),
}  # fmt: skip


class Server:
    """Serves bytes by path; `fault` says what is wrong with an answer to a path, by number."""

    def __init__(self, secured=None):
        self.files, self.etags, self.asked = {}, {}, []
        self.headers = {}  # more of them, of refusals
        self.fault = lambda number, path: ""
        self.latency, self.sent = 0.0, 0
        self.lock = threading.Lock()
        self.released = threading.Event()
        handler = type("Handler", (_Handler,), {"server_of_test": self})
        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        self._server.daemon_threads = True
        self._server.handle_error = lambda request, address: None  # the tests end connections
        self.scheme = "http" if secured is None else "https"
        if secured is not None:
            # Not for the listening socket, whose thread a client without an answer would stop.
            self._server.get_request = lambda: _secured(self._server.socket.accept(), secured)
        self.port = self._server.server_address[1]
        threading.Thread(target=self._server.serve_forever, args=(0.02,), daemon=True).start()

    def address(self, path, host="127.0.0.1"):
        return f"{self.scheme}://{host}:{self.port}/{path}"

    def add(self, path, data):
        self.files[path] = data
        self.etags[path] = f'"{len(data)}-1"'
        return self.address(path)

    def close(self):
        self.released.set()
        self._server.shutdown()
        self._server.server_close()


def _secured(accepted, context):
    """Return a connection by TLS, which begins when the first byte is read."""
    connection, address = accepted
    return context.wrap_socket(connection, server_side=True, do_handshake_on_connect=False), address


@contextlib.contextmanager
def serving(secured=None):
    """Run a server, by https if an `SSLContext` is given."""
    server = Server(secured)
    try:
        yield server
    finally:
        server.close()


class _Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True
    wbufsize = -1

    def log_message(self, *words):
        pass

    def do_GET(self):
        server, (path, _, query) = self.server_of_test, self.path[1:].partition("?")
        with server.lock:
            number = len(server.asked)
            server.asked.append((path, self.headers.get("Range"), dict(self.headers), query))
        time.sleep(server.latency)
        fault = server.fault(number, path)
        if fault in ENDLESS:
            return self._go_on(*ENDLESS[fault])
        if fault.isdigit():
            return self._refuse(int(fault))
        if fault.startswith("to "):
            return self._refuse(302, Location=fault[3:])
        if path not in server.files:
            return self._refuse(404)
        data, etag = server.files[path], server.etags[path]
        if fault == "packed":
            return self._send(200, gzip.compress(data), "gzip", {"ETag": etag})
        if self.headers.get("If-Match", etag) != etag and fault != "ignores versions":
            return self._refuse(412)
        wanted = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range", ""))
        if fault == "no ranges" or wanted is None:
            return self._send(200, data, fault, {"ETag": etag})
        start, stop = int(wanted[1]), min(int(wanted[2]) + 1, len(data))
        if fault == "shifted":
            start, stop = start + 1, min(stop + 1, len(data))
        if fault == "wrong":
            data = data[:start] + bytes(byte ^ 255 for byte in data[start:stop]) + data[stop:]
        if fault == "fewer":
            stop -= 100
        stated = {"Content-Range": f"bytes {start}-{stop - 1}/{len(data)}", "ETag": etag}
        return self._send(206, data[start:stop], fault, stated)

    def _go_on(self, start, more):
        with contextlib.suppress(OSError):
            self.wfile.write(start)
            while not self.server_of_test.released.wait(0.02):
                self.wfile.write(more)
                self.wfile.flush()
        self.close_connection = True

    def _refuse(self, status, **headers):
        self.send_response(status)
        for name, value in {"Retry-After": "0", **self.server_of_test.headers, **headers}.items():
            self.send_header(name, value)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def _send(self, status, body, fault, headers):
        if fault == "old":
            self.protocol_version = "HTTP/1.0"
        if fault == "silent":
            self.server_of_test.released.wait(30)
        length = len(body)
        if fault == "short":
            body, length = body[: length - 100], length - 100
        self.send_response(status)
        for name, value in headers.items():
            self.send_header(name, value)
        if fault == "gzip":
            self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(length))
        self.end_headers()
        if fault == "cut":
            body = body[: length // 2]
        blocks = [body[place : place + 4096] for place in range(0, len(body), 4096)]
        with contextlib.suppress(OSError):
            for block in blocks:
                if fault == "slow":
                    self.server_of_test.released.wait(0.2)
                self.wfile.write(block)
                with self.server_of_test.lock:
                    self.server_of_test.sent += len(block)
                if fault == "slow":
                    self.wfile.flush()
            self.wfile.flush()
            if fault in ("cut", "old"):
                self.close_connection = True
                self.connection.shutdown(socket.SHUT_WR)
