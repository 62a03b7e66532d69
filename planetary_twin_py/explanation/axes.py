"""Consequences of held axes: what a torsional run does not model."""

from __future__ import annotations

from cmath import exp

from ..gearset.phasing import mesh_phases
from ..planar.load_sharing import load_sharing
from ..scene import Scene

HELD = "gears and carrier rotate about rigid axes: no bearing loads, no orbits"


def meaning_of_held_axes(scene: Scene) -> str:
    """Describe the consequences of held axes, from statics and symmetry.

    Args:
        scene: the scene.

    Returns:
        A sentence. With `scene.supports` and a torque it compares load sharing factors; without
        them it states whether the forces of the planets would move an axis.
    """
    if scene.supports is not None and scene.operating_point.input_torque != 0.0:
        moving, held = load_sharing(scene), load_sharing(scene.replace(supports=None))
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
    gearset, runout = scene.gearset, scene.mesh.runout
    errors = [scene.errors.of_planet(i) for i in range(gearset.planets)]
    uneven = scene.errors.of_axes or any(planet.uneven for planet in errors)
    if uneven or scene.faults or runout.sun or runout.planet or runout.ring:
        return False
    teeth = gearset.tooth_numbers
    sun, ring = mesh_phases(teeth, gearset.planet_angles)
    in_phase = all(phase % 1 == phases[0] % 1 for phases in (sun, ring) for phase in phases)
    return in_phase and _evenly_spaced(gearset.planet_angles)


def _evenly_spaced(angles: tuple[float, ...]) -> bool:
    return len(angles) > 2 and abs(sum(exp(1j * angle) for angle in angles)) < 1e-6
