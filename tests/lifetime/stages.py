"""Scenes of the gallery with materials, whose damage is counted."""

from docs.blocks import ROOT

import planetary_twin_py as pt


def stage(name: str) -> pt.Scene:
    return pt.load_scene(str(ROOT / f"docs/examples/{name}.yaml")).replace(durability={})
