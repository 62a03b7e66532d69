"""The viewer's page without what it would load from other hosts.

Rerun's own page fetches a font from Google, and its program a list of examples and a host for its
statistics. Here the page passes through a server on this machine that takes the references to other
hosts out of it, and whose Content-Security-Policy forbids the browser to ask other hosts later.
"""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from http.client import HTTPConnection, HTTPException
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

_HOST = "127.0.0.1"
_PATIENCE = 20.0  # [s] for the viewer to answer
_LOADING = re.compile(r"<link\b[^>]*\bhref=[\"']?(?:https?:)?//[^>]*>", re.IGNORECASE)


def without_other_hosts(page: str) -> str:
    """`page` (HTML) without its links to styles, fonts and connections of other hosts."""
    return _LOADING.sub("", page)


def policy(data: int) -> str:
    """The Content-Security-Policy of the page: this server, and the viewer's data on port `data`.

    The page's scripts are written into it and compile WebAssembly; pictures and workers may be made
    by these themselves.
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
    """Serve on this machine what the viewer serves, for as long as the context lasts.

    Args:
        port: of the page.
        origin: port on which the viewer serves its own page.
        data: port of the viewer's data.

    Raises:
        OSError: the port is taken.
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
            with suppress(ConnectionError):  # a browser that was closed meanwhile
                self.wfile.write(body)

        def log_message(self, format: str, *args: object) -> None:
            """Print no line for each request."""

    return Handler


def _fetched(origin: int, path: str) -> tuple[int, str, bytes]:
    """Status, type and content that the viewer serves at `path`."""
    connection = HTTPConnection(_HOST, origin, timeout=_PATIENCE)
    try:
        connection.request("GET", path)
        answer = connection.getresponse()
        kind, body = answer.getheader("Content-Type", "application/octet-stream"), answer.read()
    finally:
        connection.close()
    if kind.startswith("text/html"):
        body = without_other_hosts(body.decode("utf-8")).encode("utf-8")
    return answer.status, kind, body
