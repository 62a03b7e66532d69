"""Consequences of held axes: what a torsional run does not model."""

from __future__ import annotations

from ..checks.fixed_axes import equal_planets
from ..gearset.phasing import mesh_phases
from ..scene import Scene
from ..statics.load_sharing import load_sharing

HELD = "gears and carrier rotate about rigid axes: no bearing loads, no orbits"


def meaning_of_held_axes(scene: Scene) -> str:
    """Describe the consequences of held axes, from statics and symmetry.

    Returns:
        A sentence. With `scene.supports` and a torque it compares load sharing factors; without
        them it states whether the forces of the planets would move an axis.
    """
    if scene.supports is not None and scene.operating_point.input_torque != 0.0:
        try:
            moving = load_sharing(scene)
        except ValueError as reason:
            return f"{HELD}; the bearings of supports do not hold the load in statics: {reason}"
        held = load_sharing(scene.replace(supports=None))
        return (
            f"{HELD}; in statics the largest share of a planet is {held.factor:.3f} with held "
            f"axes and {moving.factor:.3f} with the bearings of supports (command load-sharing); "
            "dynamics = planar lets the axes move"
        )
    if _in_balance(scene):
        return f"{HELD}; the forces of equal planets in phase would not move axes"
    return f"{HELD}; forces of the planets would move axes: give supports, see load-sharing"


def _in_balance(scene: Scene) -> bool:
    """Whether planets are equal, in phase, and evenly spaced, so that their forces balance."""
    if not equal_planets(scene):
        return False
    sun, ring = mesh_phases(scene.gearset.tooth_numbers, scene.gearset.planet_angles)
    return all(phase % 1 == phases[0] % 1 for phases in (sun, ring) for phase in phases)
