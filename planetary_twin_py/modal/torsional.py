"""Torsional model of a scene: the linear part of the equations of motion of a simulation.

The coordinates are u = r theta with base radii (r_c cos(phi) for the carrier). Stiffness acts along
the line of action (Kahraman 1994, with the carrier coupled to both meshes).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..model.gearbox import Gearbox
from ..scene import Scene
from ..scene.drive import MOVED
from .mesh_stiffness import MeshStiffness
from .springs import Rows, Spring, SpringModel


def torsional_model(
    scene: Scene, mesh: MeshStiffness, factors: Sequence[float], with_machines: bool = False
) -> SpringModel:
    """Spring model of the gears and the carrier.

    Args:
        scene: gives inertias and couplings.
        mesh: stiffnesses of the meshes.
        factors: factors on the stiffness of both meshes of each planet, (planets,).
        with_machines: whether to include motors and load with their couplings. The end of a shaft
            whose motion is given (port "motion" or "brake") is at rest.

    Returns:
        Masses and springs.
    """
    gearbox = Gearbox(scene).held
    bodies, machines = gearbox.bodies, gearbox.machines
    moving = [name for name, machine in machines.items() if machine.port not in MOVED]
    still = set(machines) - set(moving if with_machines else ())
    free = (name for name, place in bodies.place.items() if place != bodies.ground)
    names = [name for name in free if name not in still]
    coordinates = tuple(f"{name}.u" for name in names)
    row, springs = Rows(coordinates), []
    carried = scene.gearset.geometry.carrier_ratio
    for name, factor in zip(gearbox.planets, factors, strict=True):
        planet = f"{name}.u"
        sun_row = row({"sun.u": 1.0, planet: 1.0, "carrier.u": -1.0})
        ring_row = row({planet: -1.0, "ring.u": 1.0, "carrier.u": -carried})
        springs += [Spring("sun_planet", factor * mesh.sun_planet, sun_row, factor)]
        springs += [Spring("planet_ring", factor * mesh.planet_ring, ring_row, factor)]
    if with_machines:
        for name, machine in machines.items():
            shaft = row({f"{name}.u": 1.0, f"{machine.member}.u": -1.0})
            stiffness = machine.coupling_stiffness / gearbox.radii[machine.member] ** 2
            springs.append(Spring(f"{name}_coupling", stiffness, shaft))
    mass = np.array([bodies.mass[bodies.place[name]] for name in names])
    return SpringModel(coordinates, mass, tuple(springs))
