"""Patches that a page shows apply to the present files."""

import subprocess

import pytest
from docs.blocks import ROOT, blocks, pages

PATCHES = [block for page in pages() for block in blocks(page) if block.language == "diff"]


def test_pages_show_patches():
    assert PATCHES


@pytest.mark.parametrize("patch", PATCHES, ids=str)
def test_a_patch_of_a_page_applies(patch):
    done = subprocess.run(
        ["git", "apply", "--check", "-"], cwd=ROOT, input=patch.text, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
