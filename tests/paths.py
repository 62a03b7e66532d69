"""Paths of contact of standard gears, at the distance at which their reference circles touch."""

from planetary_twin_py.gearset.geometry import PathOfContact
from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.working import WorkingMesh


def sun_planet_path(teeth: Teeth, pressure_angle: float, addendum: float) -> PathOfContact:
    """Path of the external mesh; pressure angle in rad, addendum in modules."""
    sun, planet = (SpurGear(z, 1.0, pressure_angle, addendum) for z in (teeth.sun, teeth.planet))
    return WorkingMesh(sun, planet, 0.5 * (teeth.sun + teeth.planet)).path


def planet_ring_path(teeth: Teeth, pressure_angle: float, addendum: float) -> PathOfContact:
    """Path of the internal mesh."""
    planet = SpurGear(teeth.planet, 1.0, pressure_angle, addendum)
    ring = SpurGear(teeth.ring, 1.0, pressure_angle, addendum, internal=True)
    return WorkingMesh(planet, ring, 0.5 * (teeth.ring - teeth.planet)).path
