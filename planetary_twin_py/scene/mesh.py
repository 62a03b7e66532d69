"""How teeth touch along the line of action: stiffness and damping."""

from __future__ import annotations

from typing import Literal

from .quantity import Section, quantity


class MeshDamping(Section):
    """Damping c = tau k of a mesh in every state of contact.

    "meshing_frequency": tau = loss_factor/f_m, f_m not below `lowest_frequency` (Salagianni et
    al. 2017, section 3, whose printed law is unbounded at standstill). "viscous": tau constant,
    from the damping ratio of the mesh on its own two gears at single-pair stiffness.
    """

    law: Literal["meshing_frequency", "viscous"] = "viscous"
    damping_ratio: float = quantity("", "damping ratio of one mesh", 0.05, ge=0.0, le=2.0)
    loss_factor: float = quantity("", "tau times meshing frequency", 0.009, ge=0.0, le=1.0)
    lowest_frequency: float = quantity(
        "Hz", "meshing frequency below which the law no longer follows it", 5.0, gt=0.0, le=1e4
    )


class Mesh(Section):
    """Stiffness and damping along the line of action."""

    sun_planet_stiffness: float = quantity("N/m", "of a single tooth pair", ge=1e3, le=1e13)
    planet_ring_stiffness: float = quantity("N/m", "of a single tooth pair", ge=1e3, le=1e13)
    double_pair_ratio: float = quantity(
        "", "stiffness of two pairs over that of one", 1.75, ge=1.0, le=2.0
    )
    ramp: float = quantity(
        "", "base pitches over which a pair takes up its load; 0: at once", 0.03, ge=0.0, le=0.2
    )
    damping: MeshDamping = MeshDamping()
