"""Files and folders of the repository that a page names exist."""

import re

import pytest
from docs.blocks import ROOT, blocks, pages

PACKAGE = ROOT / "planetary_twin_py"
ROOTS = (ROOT, PACKAGE, PACKAGE / "core")
"""A path starts at one of these, or at the folder of its page."""
READMES = [
    ROOT / name
    for name in (
        "CONTRIBUTING.md", "msgs_spec/README.md", "benchmarks/README.md",
        "ros_ws/src/planetary_twin/README.md",
    )
]  # fmt: skip
PATH = re.compile(r"`((?:[\w.*-]+/)+[\w.*-]*|[\w-]+\.(?:py|hpp|cpp))`")
MADE = {"recordings", ".venv", "lib"}
"""Folders that a run or an installation makes."""
NODES = {"simulation", "sensors"}
"""Nodes and groups of topics of the name of a folder: topics and services start with it."""


def named(text):
    """Paths between back quotes: of files with source code, or that start with a known folder."""
    return [path for path in PATH.findall(text) if is_of_repository(path)]


def is_of_repository(path):
    first = path.split("/")[0]
    if first in MADE:
        return False
    source = path.endswith(("/", ".py", ".hpp", ".cpp", ".yaml", ".msg", ".srv"))
    return source or (first not in NODES and any((root / first).is_dir() for root in ROOTS))


def exists(path, page, made):
    name = path.rstrip("/")
    if name in made or any(list(root.glob(name)) for root in (*ROOTS, page.parent)):
        return True
    # A file without its folder is one of those that the page writes about.
    return "/" not in name and any(ROOT.glob(f"[!.]*/**/{name}"))


@pytest.mark.parametrize("page", [*pages(), *READMES], ids=lambda page: str(page.relative_to(ROOT)))
def test_files_and_folders_that_a_page_names_exist(page):
    made = {block.word("file") for block in blocks(page)}
    assert [path for path in named(page.read_text()) if not exists(path, page, made)] == []
