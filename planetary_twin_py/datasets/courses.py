"""Speed and torque that change within a record, as commands at the ports of the drive."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from ..model.layout import LOAD_MACHINE, Layout
from ..run.commands import Commands
from ..scene import Scene
from .spec import Course

STEP = 0.01  # [s] between commands, between which speed and torque change linearly
Array = NDArray[np.float64]


def wander(random: np.random.Generator, count: int, correlation: float) -> Array:
    """A stationary course with mean 0 and standard deviation 1, at steps of `STEP`.

    It is an Ornstein-Uhlenbeck process (Uhlenbeck and Ornstein 1930, Phys. Rev. 36, 823-841): its
    autocorrelation is exp(-t/correlation).

    Args:
        random: random numbers.
        count: number of values.
        correlation: correlation time [s].

    Returns:
        Values, (count,).
    """
    kept = math.exp(-STEP / correlation)
    steps = random.standard_normal(count)
    steps[1:] *= math.sqrt(1.0 - kept**2)
    return np.asarray(lfilter([1.0], [1.0, -kept], steps))


def commands_of(
    scene: Scene, course: Course, begin: float, end: float, random: np.random.Generator
) -> Commands:
    """Commands of the input speed and of the output torque from time 0 to the end.

    Args:
        scene: scene of the record, whose operating point the course is about.
        course: how both change.
        begin: start of the record [s]; before it, the speed does not ramp.
        end: its end [s].
        random: random numbers of the course.
    """
    point, count = scene.operating_point, math.ceil(end / STEP) + 2
    time = STEP * np.arange(count)
    speed, torque = (wander(random, count, course.wander_time) for _ in range(2))
    ramp = np.clip((time - begin) / (end - begin), 0.0, 1.0) - 0.5
    change = course.speed_ramp * ramp + course.speed_wander * speed
    load = point.input_torque * float(Layout(scene).machine_torques[LOAD_MACHINE])
    return Commands(
        time,
        input_speed=point.input_speed * (1.0 + change),
        output_torque=load * (1.0 + course.torque_wander * torque),
    )
