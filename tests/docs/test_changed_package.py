"""Pages that change the package: its patches apply, compile, and do what the page shows."""

import shutil
import sys

import pytest
from docs.blocks import ROOT, pages
from docs.trial import changes_code, readers_environment, tried, try_block

pytestmark = [pytest.mark.exhaustive, pytest.mark.slow]


def test_pages_that_change_the_package():
    """All in one copy of the package, whose changes precede all other blocks: it compiles once."""
    folder = ROOT / "build" / "changed"  # .ci/run names this path to its compiler cache
    shutil.rmtree(folder, ignore_errors=True)
    ignored = shutil.ignore_patterns("__pycache__", "*.so")
    for part in ("planetary_twin_py", "tools", "docs/examples"):
        shutil.copytree(ROOT / part, folder / part, ignore=ignored)
    here = {"PYTHONPATH": str(folder), "VIRTUAL_ENV": sys.prefix}
    here["GIT_CEILING_DIRECTORIES"] = str(folder.parent)  # a patch is for this copy
    changing = [block for page in pages() if changes_code(page) for block in tried(page)]
    assert len({block.page for block in changing}) > 1
    with readers_environment() as environment:
        for block in sorted(changing, key=lambda block: not makes_a_change(block)):
            try_block(block, folder, environment | here, {}, [])
    shutil.rmtree(folder)


def makes_a_change(block):
    return block.word("file") is not None or any("git apply" in line for line in block.commands)
