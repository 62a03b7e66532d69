"""Samples of what a train shows."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .._core import (
    AXES,
    QUANTITIES,
    Train,
)


class Samples(NamedTuple):
    """Samples of one window. Body j stands at turns @ ratio[j] turns + angle[j]."""

    mesh: np.ndarray  # (room, QUANTITIES, meshes), see `observe`
    turns: np.ndarray  # (room, AXES) whole turns of the motors
    angle: np.ndarray  # (room, bodies) [rad]
    speed: np.ndarray  # (room, bodies) [rad/s]
    drag: np.ndarray  # (room, 2) power that bearings and churning take [W]


def new_samples(train: Train, room: int) -> Samples:
    """Room for `room` samples."""
    bodies, meshes = int(train.bodies), int(train.meshes)
    return Samples(
        np.zeros((room, QUANTITIES, meshes)),
        np.zeros((room, AXES)),
        np.zeros((room, bodies)),
        np.zeros((room, bodies)),
        np.zeros((room, 2)),
    )
