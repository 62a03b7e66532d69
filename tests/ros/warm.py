"""Imports and loads what nodes need at their start, in the process from which tests fork them."""

import planetary_twin.composed
import planetary_twin.follower
import planetary_twin.logger
import planetary_twin.plant
import planetary_twin.replay
import planetary_twin.simulation  # noqa: F401

import planetary_twin_py as pt

pt.Twin(pt.load_scene("paper")).advance(0.02)
