"""What loads a point of a flank: Hertz pressure, contact temperature, and wear of a passage."""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .._core import half_width, tooth_contact
from ..durability.flash import Solid, flash_temperature
from ..lubrication.hertz import contact_modulus
from ..lubrication.wear import FILM_FACTORS, depth_of_passage, slips
from ..model.oil import build_oil
from ..scene import OperatingPoint, Scene
from ..text.warning_types import AccuracyWarning

Array = NDArray[np.float64]


class FlankState(NamedTuple):
    """Pairs of spur teeth at n instants, NaN where they carry no load, (n,) each."""

    pressure: Array
    """Largest pressure (Hertz 1882) [Pa]."""
    temperature: Array
    """Contact temperature (Blok 1937) [K]."""
    wear: Array
    """Depth that a passage removes of both flanks together [m]; NaN without `durability.wear`."""


def flank_state(
    scene: Scene, kind: int, point: OperatingPoint, frequency: float, position: Array, load: Array
) -> FlankState:
    """State of pairs on their path of contact.

    Args:
        scene: scene with spur teeth.
        kind: 0 for sun-planet meshes, 1 for planet-ring meshes.
        point: operating point, of which the oil counts; gears are as warm as it.
        frequency: of the mesh [Hz], not negative.
        position: after the pitch point [base pitches], (n,).
        load: of the pairs [N], (n,).
    """
    found = np.full((3, len(position)), np.nan)
    rows = np.flatnonzero(load > 0.0)
    mesh, data, width = (
        scene.gearset.geometry.meshes[kind],
        scene.lubrication,
        scene.gearset.face_width,
    )
    external = -1.0 if mesh.internal else 1.0
    oil, turn = build_oil(scene, point), 2.0 * math.pi * frequency
    spin = turn / mesh.first.teeth, -external * turn / mesh.second.teeth
    rho1, rho2 = (np.asarray(rho) for rho in mesh.curvatures_at(position[rows]))
    radius = rho1 * rho2 / (rho2 + external * rho1)
    modulus = contact_modulus(data.youngs_modulus, data.poisson_ratio)
    half = np.array(
        [half_width(w, r, width, modulus) for w, r in zip(load[rows], radius, strict=True)]
    )
    pairs = [
        tooth_contact(oil, (float(r1), float(r2), external, *spin, float(w)))
        for r1, r2, w in zip(rho1, rho2, load[rows], strict=True)
    ]
    friction, film = np.array([(each[0], each[3]) for each in pairs]).reshape(-1, 2).T
    solid = Solid(data.solid_conductivity, data.solid_density, data.solid_heat_capacity)
    found[0, rows] = 0.5 * modulus * half / radius
    if len(rows):
        with warnings.catch_warnings():  # next to the pitch point and at creep, where it is small
            warnings.simplefilter("ignore", AccuracyWarning)
            flash = flash_temperature(
                friction / width, spin[0] * rho1, abs(spin[1]) * rho2, half, solid, solid
            )
        found[1, rows] = point.oil_temperature + flash
    law = scene.durability and scene.durability.wear
    if law:
        ratio = np.exp(film - oil.log_roughness)
        if data.lambda_ratio == "prescribed":
            ratio = np.full(len(rows), point.lambda_ratio)
        k = law.coefficient * FILM_FACTORS[law.film](ratio)
        slip = np.add(*slips(mesh, position[rows]))
        found[2, rows] = [
            depth_of_passage(*each) for each in zip(k, load[rows] / width, slip, strict=True)
        ]
    return FlankState(*found)
