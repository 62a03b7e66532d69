"""Bending vibration of the rim of a ring under the forces of its meshes.

A thin ring without extension has a pair of modes for each number of waves m >= 2, which turn as
exp(+-i m phi), with u_r = cos(m phi), u_t = -sin(m phi)/m, the frequency w_m of `natural_frequency`
and the modal mass (1 + 1/m^2) pi rho A R (Hoppe 1871, Crelle 73, 158-170; Love 1927, art. 293). A
unit mesh force acts on it with sin a - (i/m) cos a, with a the working pressure angle.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..scene.sensors import FlexibleRing
from .filters import Path
from .mode import Mode


def natural_frequency(ring: FlexibleRing, waves: int) -> float:
    """Natural frequency of the modes with a number of waves [rad/s].

    Args:
        ring: the rim.
        waves: number of waves m around the rim, at least 2.
    """
    m2 = waves**2
    bending = ring.youngs_modulus * ring.second_moment / (ring.density * ring.area)
    free = bending / ring.radius**4 * m2 * (m2 - 1) ** 2 / (m2 + 1)
    # springs all around: half of their stiffness is in each of the two modes
    return math.sqrt(free + 0.5 * ring.mounting / modal_mass(ring, waves))


def modal_mass(ring: FlexibleRing, waves: int) -> float:
    """Modal mass of a mode with a number of waves, at a unit radial displacement [kg]."""
    return (1.0 + 1.0 / waves**2) * math.pi * ring.density * ring.area * ring.radius


def radial_paths(
    ring: FlexibleRing,
    force: NDArray[np.float64],
    place: NDArray[np.float64],
    sensor: float,
    pressure_angle: float,
) -> list[Path]:
    """Radial acceleration at a sensor, as filtered parts of the forces.

    Args:
        ring: the rim.
        force: normal forces of the ring meshes, negative on coast flanks [N], (samples, planets).
        place: angles of the planets in the housing [rad], (samples, planets).
        sensor: angle of the sensor [rad].
        pressure_angle: working one of the ring meshes [rad].

    Returns:
        A path for each number of waves.
    """
    # Teeth press outwards; those of drive flanks turn the ring clockwise if the sun drives.
    radial, tangential = np.abs(force) * math.sin(pressure_angle), -force * math.cos(pressure_angle)
    paths = []
    for m in range(2, ring.waves + 1):
        along = m * (sensor - place)
        driving = (radial * np.cos(along) + tangential / m * np.sin(along)).sum(axis=1)
        mode = Mode(natural_frequency(ring, m), ring.damping_ratio)
        paths.append(Path(driving / modal_mass(ring, m), mode.acceleration, mode.decay))
    return paths
