"""What nodes import and load at their start, in the process that those of tests are forked from."""

import planetary_twin.composed
import planetary_twin.logger
import planetary_twin.replay
import planetary_twin.simulation  # noqa: F401

import planetary_twin_py as pt

pt.Twin(pt.load_scene("paper")).advance(0.02)
