"""The one stiffness of a mesh that natural modes take for that which varies as teeth pass."""

from __future__ import annotations

from typing import NamedTuple

from ..dynamics.mean_stiffness import mean_stiffness
from ..dynamics.stiffness_laws import stiffness_laws
from ..dynamics.train import build_train
from ..scene import Scene

STIFFNESSES = ("single", "mean")


class MeshStiffness(NamedTuple):
    """Of one mesh of each kind, along the line of action [N/m]."""

    sun_planet: float
    planet_ring: float


def mesh_stiffness(scene: Scene, stiffness: str) -> MeshStiffness:
    """That of one tooth pair ("single") or the mean over the mesh cycle ("mean").

    The mean is c_gamma of ISO 6336-1 and what Kahraman 1994 and Lin and Parker 1999 take.

    Raises:
        ValueError: there is no such stiffness, there are no such teeth, or they leave a moment
            without contact.
    """
    if stiffness == "single":
        return MeshStiffness(*(law.single for law in stiffness_laws(scene)))
    if stiffness == "mean":
        return MeshStiffness(*mean_stiffness(build_train(scene)).tolist())
    raise ValueError(f"stiffness = {stiffness!r}: must be one of {', '.join(STIFFNESSES)}")
