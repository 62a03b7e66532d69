"""The page that explains the interfaces, from `msgs_spec`, where it stands beside their files."""

import re

from .interfaces import SPEC

_FILE = re.compile(r"\((?:msg|srv)/(\w+)\.(?:msg|srv)\)")


def page() -> str:
    """The same with links into the page of messages instead of to the files."""
    text = (SPEC / "README.md").read_text()
    return _FILE.sub(lambda link: f"(messages.md#{link[1].lower()})", text)
