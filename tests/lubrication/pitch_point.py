"""The tooth pairs of the paper's gearset at their pitch points, 63 N m on three planets."""

import math
from typing import NamedTuple

from planetary_twin_core_parts import log_film_thickness

from planetary_twin_py.lubrication.film import FILM_LAWS
from planetary_twin_py.model.oil import build_oil

CASES = [(mesh, rpm) for mesh in ("sp", "pr") for rpm in (1000, 2000, 3000)]
MODULUS = 206e9 / (1 - 0.3**2)  # E' = 2 E*
VISCOSITY, PRESSURE_VISCOSITY = 0.08, 2.1e-8  # Table 3
FACE_WIDTH = 0.02
LOAD = 63.0 / 3 / (0.012 * math.cos(math.radians(21.34)))


class PitchPoint(NamedTuple):
    radius: float  # reduced radius of curvature [m]
    speed: float  # mean surface speed [m/s]

    @property
    def half_width(self):
        return math.sqrt(4 * LOAD * self.radius / (math.pi * FACE_WIDTH * MODULUS / 2))

    @property
    def area(self):
        return 2 * self.half_width * FACE_WIDTH


def pitch_point(mesh, rpm):
    sine = math.sin(math.radians(21.34))
    sun, planet, ring = (r * sine for r in (0.012, 0.008, 0.028))
    radius = {"sp": sun * planet / (sun + planet), "pr": planet * ring / (ring - planet)}[mesh]
    return PitchPoint(radius, sun * rpm * math.pi / 30)


def log_film(law, mesh, rpm, load=LOAD):
    point = pitch_point(mesh, rpm)
    sizes = (
        point.radius,
        VISCOSITY * point.speed / (MODULUS * point.radius),
        PRESSURE_VISCOSITY * MODULUS,
        load / (MODULUS * point.radius * FACE_WIDTH),
    )
    return log_film_thickness(FILM_LAWS[law], *map(math.log, sizes))


def film(law, mesh, rpm, load=LOAD):
    return math.exp(log_film(law, mesh, rpm, load))


def oil_of(scene):
    return build_oil(scene, scene.operating_point)
