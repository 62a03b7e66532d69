"""Speed and torque that change within a record, as commands at the ports of the drive."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..model.layout import LOAD_MACHINE, Layout
from ..run.commands import Commands
from ..scene import Scene
from .spec import STEP, Course

Array = NDArray[np.float64]


def wander(random: np.random.Generator, count: int, correlation: float) -> Array:
    """A stationary smooth course with mean 0 and standard deviation 1, at steps of `STEP`.

    It is a Gaussian process with the autocorrelation (1 + t/T) exp(-t/T), which has a derivative
    and so shakes no shaft (Rasmussen and Williams 2006, Gaussian Processes for Machine Learning,
    (4.17) and appendix B.2.1).

    Args:
        random: random numbers.
        count: number of values.
        correlation: correlation time T [s].

    Returns:
        Values, (count,).
    """
    step = STEP / correlation
    # Of the value and of its derivative times T, which have the same variance and are independent.
    kept = math.exp(-step) * np.array([[1.0 + step, step], [-step, 1.0 - step]])
    added = np.linalg.cholesky(np.eye(2) - kept @ kept.T)
    start, *shocks = random.standard_normal((count + 1, 2))
    state, values = start, np.empty(count)
    for n in range(count):
        values[n] = state[0]
        state = kept @ state + added @ shocks[n]
    return values


def commands_of(
    scene: Scene, course: Course, begin: float, end: float, random: np.random.Generator
) -> Commands:
    """Commands of the input speed and of the output torque to the end of a record.

    Both start at the operating point and reach their course when the record starts.

    Args:
        scene: scene of the record, whose operating point the course is about.
        course: how both change.
        begin: start of the record [s].
        end: its end [s].
        random: random numbers of the course.
    """
    point, count = scene.operating_point, math.ceil(end / STEP) + 1
    time = STEP * np.arange(1, count + 1)
    speed, torque = (wander(random, count, course.wander_time) for _ in range(2))
    started = np.clip(time / begin, 0.0, 1.0) if begin else 1.0
    ramp = np.clip((time - begin) / (end - begin), 0.0, 1.0) - 0.5
    change = started * (course.speed_ramp * ramp + course.speed_wander * speed)
    load = point.input_torque * float(Layout(scene).machine_torques[LOAD_MACHINE])
    return Commands(
        time,
        input_speed=point.input_speed * (1.0 + change),
        output_torque=load * (1.0 + started * course.torque_wander * torque),
    )
