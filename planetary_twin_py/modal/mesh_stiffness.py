"""Constant mesh stiffness of the natural modes, in place of the varying one."""

from __future__ import annotations

from typing import NamedTuple

from ..model.mean_stiffness import mean_stiffness
from ..model.stiffness_laws import stiffness_laws
from ..model.teeth import build_teeth
from ..scene import Scene

STIFFNESSES = ("single", "mean")


class MeshStiffness(NamedTuple):
    """Stiffness of one mesh of each kind along the line of action [N/m]."""

    sun_planet: float
    """Stiffness of a sun-planet mesh [N/m]."""
    planet_ring: float
    """Stiffness of a planet-ring mesh [N/m]."""


def mesh_stiffness(scene: Scene, stiffness: str) -> MeshStiffness:
    """Mesh stiffness of a scene.

    The mean is c_gamma of ISO 6336-1, which Kahraman 1994 and Lin and Parker 1999 use.

    Args:
        scene: gives teeth and stiffness law.
        stiffness: "single" for one tooth pair, or "mean" for the mean over the mesh cycle.

    Returns:
        Stiffnesses along the line of action [N/m].

    Raises:
        ValueError: the stiffness is unknown, the teeth are impossible, or at times no pair is in
            contact.
    """
    if stiffness == "single":
        return MeshStiffness(*(law.single for law in stiffness_laws(scene)))
    if stiffness == "mean":
        return MeshStiffness(*mean_stiffness(build_teeth(scene)).tolist())
    raise ValueError(f"stiffness = {stiffness!r}: must be one of {', '.join(STIFFNESSES)}")
