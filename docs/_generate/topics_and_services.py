"""The page on topics, services and parameters: the README of `msgs_spec`."""

import re

from .interfaces import SPEC

_FILE = re.compile(r"\((?:msg|srv)/(\w+)\.(?:msg|srv)\)")


def page() -> str:
    """The README, with links to the page of messages instead of the files."""
    text = (SPEC / "README.md").read_text()
    return _FILE.sub(lambda link: f"(messages.md#{link[1].lower()})", text)
