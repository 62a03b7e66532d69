"""Where a run is stopped, because its figures are none that a gearbox could show.

An unstable drive or a load beyond all strength makes the motion grow until the numbers overflow.
Long before, the equations describe no gearbox: a mesh that is squeezed by a base pitch has a tooth
where its neighbour should be, so teeth have broken or jumped over.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ._records import Record
from .dynamics.bodies import MACHINE_NAMES, build_bodies, mesh_names
from .dynamics.observe import DTE
from .dynamics.static_load import static_torques
from .integrators.interpolant import Samples
from .scene import Scene

EXCESS = 10.0  # what speeds and torques may be, over what the limits of the drive make of them


class RunawayError(ArithmeticError):
    """A run that cannot go on; its line says when and why."""


class Limit(NamedTuple):
    """Largest magnitude of a quantity."""

    quantity: str
    unit: str
    names: Sequence[str]  # of what has it
    largest: np.ndarray  # (names,)
    reason: str  # why more cannot be

    def check(self, values: np.ndarray) -> None:
        """Raise an `ArithmeticError` where one of `values`, (instants, names), is not within it."""
        peak = np.abs(values).max(axis=0, initial=0.0)  # NaN where there is one
        passed = np.flatnonzero(~(peak <= self.largest))
        if passed.size:
            k = int(passed[0])
            raise ArithmeticError(
                f"{self.quantity} of {self.names[k]} = {peak[k]:.4g} {self.unit}: must be at most "
                f"{self.largest[k]:.4g} {self.unit}, {self.reason}"
            )


class Limits:
    """What a run of a scene may show.

    Args:
        scene: what runs.
        train: of `dynamics.train.build_train`.
    """

    def __init__(self, scene: Scene, train: Record) -> None:
        drive, meshes = scene.drive, mesh_names(scene)
        self.squeeze = Limit(
            "squeeze",
            "m",
            _names(dict(zip(meshes.names, meshes.place, strict=True)), int(train.meshes)),
            np.full(train.meshes, train.base_pitch),
            "a base pitch: teeth would have broken or jumped over; lower the torques or stiffen "
            "the teeth",
        )
        """See `squeeze`."""
        fastest = max(drive.speed_limit, abs(drive.speed_control.start_speed or 0.0))
        self.speed = Limit(
            "speed",
            "rad/s",
            _names(build_bodies(scene).place, int(train.bodies)),
            EXCESS * fastest * np.abs(train.ratio[: train.bodies]).sum(axis=1),
            f"{EXCESS:g} times what drive.speed_limit = {drive.speed_limit:g} rad/s allows",
        )
        """Of the bodies."""
        accelerating = drive.speed_control.slew_rate * _inertia(train)
        self.torque = Limit(
            "torque",
            "N m",
            MACHINE_NAMES[: train.machines],
            EXCESS * (drive.torque_limit + accelerating) * np.abs(static_torques(scene)),
            f"{EXCESS:g} times what drive.torque_limit = {drive.torque_limit:g} N m and "
            f"drive.speed_control.slew_rate = {drive.speed_control.slew_rate:g} rad/s^2 ask for",
        )
        """Of the machines."""


def squeeze(samples: Samples, train: Record, load: Record) -> np.ndarray:
    """How far teeth are pressed into one another, at least [m], shape (instants, meshes).

    Along the line of action: |DTE| less half the backlash and the largest errors of form.
    """
    size = np.hypot(train.line_tangential, train.line_radial)
    errors = size.sum(axis=1)[train.kind[: train.meshes]]
    pressed = np.abs(samples.mesh[:, DTE]) - load.half_backlash - errors
    return np.asarray(np.maximum(pressed, 0.0))


def _inertia(train: Record) -> float:
    """Largest inertia of the whole train at a motor [kg m^2]."""
    squares = train.mass * train.radius**2
    return float((squares[:, None] * train.ratio**2).sum(axis=0).max())


def _names(place: Mapping[str, int], count: int) -> list[str]:
    """Names by their places, of those that share one the first."""
    first = {at: name for name, at in reversed(list(place.items()))}
    return [first[at] for at in range(count)]
