"""The web page of the viewer, without requests to other hosts.

The page of Rerun loads a font from Google, and its program a list of examples and sends usage
statistics. A proxy on this machine removes the references to other hosts from the page, and its
Content-Security-Policy forbids the browser to contact other hosts.
"""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from http.client import HTTPConnection, HTTPException
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

_HOST = "127.0.0.1"
_TIMEOUT = 20.0  # [s] for the viewer to answer
_LOADING = re.compile(r"<link\b[^>]*\bhref=[\"']?(?:https?:)?//[^>]*>", re.IGNORECASE)


def without_other_hosts(page: str) -> str:
    """`page` (HTML) without its links to styles, fonts and connections of other hosts."""
    return _LOADING.sub("", page)


def policy(data: int) -> str:
    """The Content-Security-Policy of the page: this server, and the viewer's data on port `data`.

    Inline scripts of the page compile WebAssembly, and create images and workers.
    """
    return "; ".join(
        (
            "default-src 'self'",
            "script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'",
            "style-src 'self' 'unsafe-inline'",
            "img-src 'self' data: blob:",
            "worker-src 'self' blob:",
            f"connect-src 'self' data: blob: http://127.0.0.1:{data} http://localhost:{data}",
        )
    )


@contextmanager
def served(port: int, origin: int, data: int) -> Iterator[None]:
    """Context in which a proxy serves the page of the viewer on this machine.

    Args:
        port: port of the proxy.
        origin: port of the viewer's page.
        data: port of the viewer's data.

    Raises:
        OSError: the port is in use.
    """
    with ThreadingHTTPServer((_HOST, port), _handler(origin, policy(data))) as server:
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        try:
            yield
        finally:
            server.shutdown()
            thread.join()


def _handler(origin: int, allowed: str) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            try:
                status, kind, body = _fetched(origin, self.path)
            except (OSError, HTTPException) as reason:
                self.send_error(502, f"the viewer does not answer: {reason}")
                return
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(body)))
            self.send_header("Content-Security-Policy", allowed)
            self.end_headers()
            with suppress(ConnectionError):  # the browser was closed
                self.wfile.write(body)

        def log_message(self, format: str, *args: object) -> None:
            """Print no line for each request."""

    return Handler


def _fetched(origin: int, path: str) -> tuple[int, str, bytes]:
    """Status, type and content that the viewer serves at `path`."""
    connection = HTTPConnection(_HOST, origin, timeout=_TIMEOUT)
    try:
        connection.request("GET", path)
        answer = connection.getresponse()
        kind, body = answer.getheader("Content-Type", "application/octet-stream"), answer.read()
    finally:
        connection.close()
    if kind.startswith("text/html"):
        body = without_other_hosts(body.decode("utf-8")).encode("utf-8")
    return answer.status, kind, body
