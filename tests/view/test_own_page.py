"""The page of `view --serve` loads nothing from the internet.

What a browser loads by itself is read from the HTML; later requests of the viewer's program are
blocked by the policy, which is interpreted by the standard (W3C, Content Security Policy 3).
"""

import urllib.request
from collections.abc import Iterator
from html.parser import HTMLParser
from urllib.parse import urlsplit

import pytest

from planetary_twin_py.view.own_page import policy
from planetary_twin_py.view.viewer import Viewer, page


class Loaded(HTMLParser):
    """Addresses that a browser loads with a page: not those of links to click on."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if value and (name in ("src", "srcset", "data") or (tag, name) == ("link", "href")):
                self.addresses.append(value)

    @property
    def hosts(self) -> set[str]:
        return {urlsplit(address).netloc for address in self.addresses}


@pytest.fixture(scope="module")
def served_page() -> Iterator[Viewer]:
    with page() as viewer:
        yield viewer


def fetched(viewer: Viewer, path: str) -> tuple[bytes, dict[str, str]]:
    address = f"http://127.0.0.1:{viewer.page}/{path}"
    with urllib.request.urlopen(address, timeout=60) as answer:
        return answer.read(), dict(answer.headers)


def test_the_page_loads_its_program_from_this_server_only(
    served_page: Viewer,
) -> None:
    content, _ = fetched(served_page, "")
    loaded = Loaded(content.decode())
    assert "re_viewer.js" in loaded.addresses
    assert loaded.hosts == {""}
    for address in loaded.addresses:
        fetched(served_page, address)  # raises if there is no such file


def test_program_and_page_are_served_with_the_policy(served_page: Viewer) -> None:
    for path in ("", "re_viewer.js", "re_viewer_bg.wasm"):
        content, headers = fetched(served_page, path)
        assert headers["Content-Security-Policy"] == policy(served_page.data)
        assert len(content) == int(headers["Content-Length"]) > 1000
    assert headers["Content-Type"] == "application/wasm"
    assert content.startswith(b"\0asm")


def test_the_policy_names_no_host_but_this_machine() -> None:
    directives = dict(part.strip().split(" ", 1) for part in policy(9091).split(";"))
    assert directives["default-src"] == "'self'"
    sources = {source for listed in directives.values() for source in listed.split()}
    hosts = {source for source in sources if not source.startswith("'")} - {"data:", "blob:"}
    assert hosts == {"http://127.0.0.1:9091", "http://localhost:9091"}
