"""Tooth pairs of a gear set of equal modules and full teeth."""

from paths import planet_ring_path, sun_planet_path

from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.tooth.contact import ContactLaw
from planetary_twin_py.tooth.material import Material
from planetary_twin_py.tooth.pair import ToothPair
from planetary_twin_py.tooth.tooth import HUB, RIM, Tooth


def sun_planet_pair(
    teeth: Teeth,
    module: float,
    pressure_angle: float,
    addendum: float,
    material: Material,
    contact: ContactLaw,
) -> ToothPair:
    """Tooth pair of the external mesh; module in m, pressure angle in rad, addendum in modules."""
    sun, planet = (
        Tooth(SpurGear(z, module, pressure_angle, addendum), material, HUB)
        for z in (teeth.sun, teeth.planet)
    )
    return ToothPair(sun, planet, sun_planet_path(teeth, pressure_angle, addendum), contact)


def planet_ring_pair(
    teeth: Teeth,
    module: float,
    pressure_angle: float,
    addendum: float,
    material: Material,
    contact: ContactLaw,
) -> ToothPair:
    """Tooth pair of the internal mesh, with the arguments of `sun_planet_pair`."""
    planet = Tooth(SpurGear(teeth.planet, module, pressure_angle, addendum), material, HUB)
    ring = Tooth(SpurGear(teeth.ring, module, pressure_angle, addendum, True), material, RIM)
    return ToothPair(planet, ring, planet_ring_path(teeth, pressure_angle, addendum), contact)
