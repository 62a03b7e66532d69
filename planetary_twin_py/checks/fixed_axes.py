"""Whether planets share their load with held axes as with the bearings of the scene."""

from __future__ import annotations

from cmath import exp
from typing import NamedTuple

import numpy as np

from ..model.layout import Layout
from ..scene import Scene

UNEQUAL = 0.05  # of a share: smallest difference that is reported


class Shares(NamedTuple):
    """Load shares of the N planets in statics, means over a mesh cycle, (N,) each."""

    held: np.ndarray
    """With held axes."""
    moving: np.ndarray
    """With the bearings of `scene.supports`."""


def equal_planets(scene: Scene) -> bool:
    """Whether planets are evenly spaced, without errors, faults and runout."""
    gearset, runout = scene.gearset, scene.mesh.runout
    errors = [scene.errors.of_planet(i) for i in range(gearset.planets)]
    uneven = scene.errors.of_axes or any(planet.uneven for planet in errors)
    uneven = uneven or any(any(scene.mesh.worn.of_planet(i)) for i in range(gearset.planets))
    if uneven or scene.faults or runout.sun or runout.planet or runout.ring:
        return False
    angles = gearset.planet_angles
    return len(angles) > 2 and abs(sum(exp(1j * angle) for angle in angles)) < 1e-6


def static_shares(scene: Scene) -> Shares:
    """Compare the shares of the load, over a mesh cycle from the start.

    The largest one is K_gamma of `load_sharing`, unless errors turn with the gears.

    Args:
        scene: scene with `supports` and a torque.

    Returns:
        The shares of the planets.

    Raises:
        ValueError: the torque is 0, the teeth are impossible, or bearings cannot hold the load.
    """
    from ..statics.load_sharing import POSITIONS, load_sharing  # most runs do without

    cycle = 1.0 / abs(float(Layout(scene).cycles[0]))
    turns = (np.arange(POSITIONS) + 0.5) / POSITIONS * cycle
    held, moving = (
        load_sharing(given, turns).share.mean(axis=0)
        for given in (scene.replace(supports=None), scene)
    )
    return Shares(held, moving)


def held_axes_warning(scene: Scene) -> str | None:
    """Warn if axes are held although their bearings would change the shares of the load.

    Args:
        scene: the scene.

    Returns:
        A sentence, or None.
    """
    if scene.moving_axes or scene.supports is None or scene.operating_point.input_torque == 0.0:
        return None
    if equal_planets(scene):  # also have equal shares
        return None
    try:
        held, moving = static_shares(scene)
    except ValueError:  # no equilibrium with these bearings, so nothing to compare with
        return None
    planet = int(np.argmax(np.abs(held - moving)))
    if abs(held[planet] - moving[planet]) <= UNEQUAL:
        return None
    dynamics = "quasi_static_planar" if scene.quasi_static else "planar"
    return (
        f"dynamics = {scene.dynamics} holds all axes: planet {planet + 1} carries "
        f"{held[planet]:.2f} times its share of the load, but {moving[planet]:.2f} times with the "
        f"bearings of supports, so mesh forces and transmission error are wrong; set dynamics = "
        f"{dynamics} or auto"
    )
