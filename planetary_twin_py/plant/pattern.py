"""Transmission error of a plant over the mesh cycles since its start.

It comes from dynamic runs at steady torques, with linear interpolation between these torques. So it
contains the vibration excited by meshes and faults; the response to a change of load is static.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.train import FollowedTrain
from ..following.transmission_error import model_error
from ..scene import Scene
from ..scene.faults import Fault
from .changes import Change

Array = NDArray[np.float64]

POINTS = 100  # points of the transmission error in a mesh cycle
BESIDE = 0.15  # relative difference of the torques of two runs from that of a load
TOLERANCE = 1e-5
SETTLING = 1.0  # [s] before a run is used


class Pattern(NamedTuple):
    """A quantity over a hunting period at several torques."""

    torques: Array
    """Input torques [N m], (k,)."""
    values: Array
    """The quantity, (k, POINTS * hunting cycles)."""

    def at(self, cycles: Array, torque: Array) -> Array:
        """Values of the quantity, (n,), after mesh cycles, (n,), at input torques [N m], (n,)."""
        count = self.values.shape[1]
        position = np.mod(cycles * POINTS, count)
        low = position.astype(np.int64)
        fraction = position - low
        low %= count
        high = (low + 1) % count
        values = self.values[:, low] * (1.0 - fraction) + self.values[:, high] * fraction
        n = np.clip(np.searchsorted(self.torques, torque) - 1, 0, len(self.torques) - 2)
        step = (torque - self.torques[n]) / (self.torques[n + 1] - self.torques[n])
        k = np.arange(len(torque))
        return np.asarray(values[n, k] * (1.0 - step) + values[n + 1, k] * step)


class Stage(NamedTuple):
    """Time between two changes of faults."""

    begin: float
    """[s]."""
    end: float
    """[s]."""
    pattern: Pattern
    """Its transmission error [m]."""


def error_stages(
    scene: Scene, changes: tuple[Change, ...], train: FollowedTrain
) -> tuple[Stage, ...]:
    """Simulate the transmission error before and after every change of faults, in order of time."""
    loads = sorted({1.0, *(c.load for c in changes if c.load is not None)})
    torques = np.unique([load * (1.0 + b) for load in loads for b in (-BESIDE, BESIDE)])
    torques = np.sort(torques * train.torque * np.sign(scene.operating_point.input_torque))
    faulty = [(c.at, c.faults) for c in changes if c.faults is not None]
    begins = [0.0, *(at for at, _ in faulty)]
    ends = [*begins[1:], math.inf]
    states: list[tuple[Fault, ...]] = [scene.faults, *(faults for _, faults in faulty)]
    return tuple(
        Stage(begin, end, _pattern(scene, faults, torques, train))
        for begin, end, faults in zip(begins, ends, states, strict=True)
    )


def course_of(stages: tuple[Stage, ...], time: Array, cycles: Array, torque: Array) -> Array:
    """Values of the patterns of all stages, (n,), over time [s], mesh cycles and torques [N m]."""
    values = np.empty(len(time))
    for begin, end, pattern in stages:
        rows = (time >= begin) & (time < end)
        values[rows] = pattern.at(cycles[rows], torque[rows])
    return values


def _pattern(
    scene: Scene, faults: tuple[Fault, ...], torques: Array, train: FollowedTrain
) -> Pattern:
    rows = []
    for torque in torques:
        loaded_scene = scene.replace(
            faults=[fault.model_dump() for fault in faults], input_torque=float(torque)
        )
        first, error = model_error(loaded_scene, train.hunting_cycles, POINTS, SETTLING, TOLERANCE)
        rows.append(np.roll(error, first % len(error)))
    return Pattern(torques, np.array(rows))
