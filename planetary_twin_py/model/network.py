"""Capacities and conductances of the parts of a gearbox, for the temperatures of the core."""

from __future__ import annotations

import math

import numpy as np

from .. import _core
from .._core import Network, Oil, OilAtTemperature
from ..lubrication.schlenk import VISCOSITY
from ..lubrication.viscosity import walther_level
from ..scene import Scene
from ..scene.thermal import NODES, SOURCES, Thermal

OIL, SUN, PLANETS, RING, HOUSING = range(len(NODES))
GEAR_HALVES = {"sun_planet_meshes": (SUN, PLANETS), "planet_ring_meshes": (PLANETS, RING)}
"""Gears that share the tooth friction of a mesh in equal parts."""
AT_NODE = {"bearings": OIL, "churning": OIL, "seals": HOUSING}
"""Parts that the other sources of heat warm."""

assert (len(NODES), len(SOURCES)) == (_core.NODES, _core.HEATS)


def build_network(scene: Scene, oil: Oil) -> Network:
    """Build the network of a scene; it has no temperatures yet.

    Args:
        scene: the scene, with the section `thermal`.
        oil: its constants at the temperature of the operating point.
    """
    data = scene.thermal
    assert data is not None
    conductance = np.zeros((len(NODES), len(NODES)))
    for node, area in zip((SUN, PLANETS, RING), flank_areas(scene), strict=True):
        conductance[OIL, node] = conductance[node, OIL] = data.gears.to_oil * area
    conductance[OIL, HOUSING] = conductance[HOUSING, OIL] = data.housing.from_oil
    return Network(
        capacity=capacities(scene, data),
        conductance=conductance,
        share=heat_shares(),
        area=data.housing.area,
        height=data.housing.height,
        emissivity=data.housing.emissivity,
        to_ambient=0.0 if data.housing.to_ambient == "still_air" else data.housing.to_ambient,
        cooling=0.0 if data.cooler is None else data.cooler.capacity,
        opens=0.0 if data.cooler is None else data.cooler.opens,
        dead_band=data.dead_band,
        oil=_oil_at_temperature(scene, oil),
        ambient=scene.operating_point.ambient_temperature,
    )


def heat_shares() -> np.ndarray:
    """Shares of the heat of each source that the parts take, (sources, nodes)."""
    share = np.zeros((len(SOURCES), len(NODES)))
    for row, source in enumerate(SOURCES):
        if source in AT_NODE:
            share[row, AT_NODE[source]] = 1.0
        else:
            share[row, list(GEAR_HALVES[source])] = 0.5
    return share


def flank_areas(scene: Scene) -> np.ndarray:
    """Area of both flanks of all teeth of sun, planets and ring [m^2], (3,).

    Height of the basic rack times face width, without the curvature of the flanks.
    """
    gearset = scene.gearset
    sizes, teeth = gearset.transverse, gearset.tooth_numbers
    height = (sizes.addendum + sizes.dedendum) * sizes.module
    length = gearset.face_width / math.cos(gearset.helix_angle)
    count = np.array([teeth.sun, gearset.planets * teeth.planet, teeth.ring])
    return np.asarray(2.0 * count * height * length)


def gear_masses(scene: Scene, data: Thermal) -> np.ndarray:
    """Mass of sun, planets and ring [kg], (3,).

    Without a given mass, the sun is a disc, J = m r^2/2, and the ring a rim, J = m r^2.
    """
    gearset, supports = scene.gearset, scene.supports
    rims = gearset.rim_masses
    default = (2.0 * rims.sun, rims.ring)
    if supports is not None:
        default = (supports.sun.mass, supports.ring.mass)
    given = (data.gears.sun_mass, data.gears.ring_mass)
    sun, ring = (
        fallback if mass is None else mass for mass, fallback in zip(given, default, strict=True)
    )
    return np.array([sun, gearset.planets * gearset.planet_mass, ring])


def capacities(scene: Scene, data: Thermal) -> np.ndarray:
    """Heat capacities of the parts [J/K], (nodes,)."""
    gears = gear_masses(scene, data) * scene.lubrication.solid_heat_capacity
    oil, housing = data.oil, data.housing
    return np.array([oil.mass * oil.heat_capacity, *gears, housing.mass * housing.heat_capacity])


def _oil_at_temperature(scene: Scene, oil: Oil) -> OilAtTemperature:
    """Constants of the oil without its viscosity, see core/model/network.hpp."""
    data = scene.lubrication
    of_oil = math.log(oil.kinematic * oil.density)
    return OilAtTemperature(
        level=walther_level(data.viscosity / data.oil_density),
        slope=data.viscosity_slope,
        reference=data.reference_temperature,
        density=data.oil_density,
        log_speed_group=oil.log_speed_group - of_oil,
        log_root=oil.traction.log_root - of_oil,
        log_shear_time=oil.shear_thinning.log_shear_time - of_oil,
        log_schlenk=oil.log_schlenk - VISCOSITY * of_oil,
    )
