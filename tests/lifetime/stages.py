"""Scenes of the gallery with materials, whose damage is counted."""

from docs.blocks import ROOT, blocks

import planetary_twin_py as pt


def stage(name: str) -> pt.Scene:
    for block in blocks(ROOT / "docs/gallery.md"):
        if block.word("file") == f"{name}.yaml":
            return pt.parse_scene(block.text).replace(durability={})
    raise AssertionError(name)
