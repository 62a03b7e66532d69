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

from ..model.layout import Layout
from ..scene.sensors.accelerometer import Accelerometer
from ..scene.sensors.paths import FlexibleRing
from .filters import Response
from .mode import Mode
from .path import SensorInput, planet_places, ring_force
from .sensed import Sensed

Array = NDArray[np.float64]


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


def flexible_path(layout: Layout, sensor: Accelerometer, ring: FlexibleRing) -> SensorInput:
    """What an accelerometer on a flexible ring senses.

    Args:
        layout: the gearbox.
        sensor: the sensor.
        ring: its path.

    Returns:
        A signal for each number of waves.
    """
    angle = layout.scene.gearset.geometry.meshes[1].pressure_angle
    across = sensor.direction == "tangential"
    waves = range(2, ring.waves + 1)
    modes = [Mode(natural_frequency(ring, m), ring.damping_ratio) for m in waves]

    def signals(sensed: Sensed) -> list[Array]:
        force, distance = ring_force(layout, sensed), planet_places(layout, sensed) - sensor.angle
        return [
            driving_force(force, distance, m, angle, across) / modal_mass(ring, m) for m in waves
        ]

    return SensorInput(signals, tuple(Response(mode.acceleration, (mode,)) for mode in modes))


def driving_force(
    force: Array, distance: Array, waves: int, pressure_angle: float, across: bool
) -> Array:
    """Modal force of the meshes on the modes with a number of waves, as it moves a sensor.

    Args:
        force: normal forces of the ring meshes, negative on coast flanks [N], (samples, planets).
        distance: angle from the sensor to each planet [rad], (samples, planets).
        waves: number of waves m.
        pressure_angle: working one of the ring meshes [rad].
        across: whether the axis of the sensor is tangential instead of radial.

    Returns:
        Force, of which the acceleration of a mode of unit mass is that of the sensor [N],
        (samples,).
    """
    # Teeth press outwards; those of drive flanks turn the ring clockwise if the sun drives.
    radial, tangential = np.abs(force) * math.sin(pressure_angle), -force * math.cos(pressure_angle)
    sine, cosine = np.sin(waves * distance), np.cos(waves * distance)
    if across:
        driving = (radial * sine + tangential / waves * cosine) / waves
    else:
        driving = radial * cosine - tangential / waves * sine
    return np.asarray(driving.sum(axis=1))
