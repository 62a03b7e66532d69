"""Counts of two encoders of a plant, on the input and output members.

The transmission error is a function of the mesh cycles since the start, from dynamic runs at steady
torques, with linear interpolation between these torques. So it contains the vibration excited by
meshes and faults; the response to a change of load is static.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..following.train import FollowedTrain, followed_train
from ..following.transmission_error import model_error
from ..scene import Scene
from ..scene.faults import Fault
from .hidden import EncoderErrors
from .readings import Plant

Array = NDArray[np.float64]

POINTS = 100  # points of the transmission error in a mesh cycle
BESIDE = 0.15  # relative difference of the torques of two runs from that of a load
CHUNK = 20_000  # samples computed at once
TOLERANCE = 1e-5
SETTLING = 1.0  # [s] before a run is used


class EncoderCounts(NamedTuple):
    """Successive samples of both encoders."""

    sample: NDArray[np.int64]
    """Numbers of the samples, (n,); sample 0 is taken at time 0."""
    counts: NDArray[np.int64]
    """Counts of input and output since time 0, (n, 2)."""


class _Pattern(NamedTuple):
    """Transmission error over a hunting period at several torques."""

    torques: Array  # [N m], (k,)
    error: Array  # [m], (k, POINTS * hunting cycles)

    def at(self, cycles: Array, torque: Array, hunting: int) -> Array:
        """Transmission error [m], (n,)."""
        place = np.mod(cycles, hunting) * POINTS
        low = place.astype(np.int64)
        part = place - low
        low %= self.error.shape[1]
        high = (low + 1) % self.error.shape[1]
        values = self.error[:, low] * (1.0 - part) + self.error[:, high] * part
        n = np.clip(np.searchsorted(self.torques, torque) - 1, 0, len(self.torques) - 2)
        step = (torque - self.torques[n]) / (self.torques[n + 1] - self.torques[n])
        k = np.arange(len(torque))
        return np.asarray(values[n, k] * (1.0 - step) + values[n + 1, k] * step)


def play_encoders(plant: Plant) -> Iterator[EncoderCounts]:
    """Simulate the encoders of a plant, in packets of which some are lost.

    Args:
        plant: the plant; `hidden.sensors.encoders.rate` must not be 0.

    Returns:
        Counts of several packets at a time.
    """
    train = followed_train(plant.true_scene)
    errors = plant.hidden.sensors.encoders
    chance = np.random.default_rng([plant.hidden.seed, 2])
    phases = chance.uniform(0.0, 2.0 * math.pi, 4)
    courses = _patterns(plant, train)
    total = int(plant.duration * errors.rate)
    for first in range(0, total, CHUNK):
        sample = np.arange(first, min(first + CHUNK, total))
        time = sample / errors.rate
        angle, torque = plant.course.angle_at(time), plant.course.torque_at(time)
        cycles = float(train.cycles) * angle / (2.0 * math.pi)
        twist = np.empty(len(time))
        for begin, end, pattern in courses:
            rows = (time >= begin) & (time < end)
            error = pattern.at(cycles[rows], torque[rows], train.hunting_cycles)
            twist[rows] = error / train.lever
        output = (float(train.twist[0]) * angle - twist) / float(train.twist[1])
        moved = errors.delay + errors.jitter * chance.standard_normal(len(time))
        read = output + train.ratio * plant.course.speed_at(time) * moved
        orders = float(train.cycles), float(train.cycles) / train.ratio
        columns = [
            _counts(value, order, errors, phases[2 * k : 2 * k + 2], chance)
            for k, (value, order) in enumerate(zip((angle, read), orders, strict=True))
        ]
        packet = sample // errors.packet
        lost = chance.random(packet[-1] - packet[0] + 1) < errors.lost
        kept = ~lost[packet - packet[0]]
        yield EncoderCounts(sample[kept], np.stack(columns, axis=1)[kept])


def _counts(
    angle: Array, order: float, errors: EncoderErrors, phases: Array, chance: np.random.Generator
) -> NDArray[np.int64]:
    """Counts of one encoder."""
    shown = angle + errors.long_wave * np.sin(angle + phases[0])
    shown = shown + errors.mesh_wave * np.sin(order * angle + phases[1])
    shown = shown + errors.noise * chance.standard_normal(len(angle))
    return np.floor(shown * 2.0**errors.bits / (2.0 * math.pi)).astype(np.int64)


def _patterns(plant: Plant, train: FollowedTrain) -> list[tuple[float, float, _Pattern]]:
    """Start, end [s] and transmission error of each interval between two changes of faults."""
    loads = sorted({1.0, *(c.load for c in plant.hidden.changes if c.load is not None)})
    torques = np.unique([load * (1.0 + b) for load in loads for b in (-BESIDE, BESIDE)])
    torques = torques * train.torque * np.sign(plant.scene.operating_point.input_torque)
    torques = np.sort(torques)
    healthy = plant.true_scene.faults
    changes = [(c.at, c.faults) for c in plant.hidden.changes if c.faults is not None]
    begins = [0.0, *(at for at, _ in changes)]
    ends = [*begins[1:], math.inf]
    states: list[tuple[Fault, ...]] = [healthy, *(faults for _, faults in changes)]
    return [
        (begin, end, _pattern(plant.true_scene, faults, torques, train))
        for begin, end, faults in zip(begins, ends, states, strict=True)
    ]


def _pattern(
    scene: Scene, faults: tuple[Fault, ...], torques: Array, train: FollowedTrain
) -> _Pattern:
    rows = []
    for torque in torques:
        there = scene.replace(
            faults=[fault.model_dump() for fault in faults], input_torque=float(torque)
        )
        first, error = model_error(there, train.hunting_cycles, POINTS, SETTLING, TOLERANCE)
        rows.append(np.roll(error, first % len(error)))
    return _Pattern(torques, np.array(rows))
