"""Samples of the quantities of a train."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .._core import (
    AXES,
    QUANTITIES,
    Train,
)


class Samples(NamedTuple):
    """Samples of one window. Body j is at turns @ ratio[j] turns + angle[j]."""

    mesh: np.ndarray  # (room, QUANTITIES, meshes), see `observe`
    turns: np.ndarray  # (room, AXES) whole turns of the motors
    angle: np.ndarray  # (room, bodies) [rad]
    speed: np.ndarray  # (room, bodies) [rad/s]
    drag: np.ndarray  # (room, 2) power loss of bearings and of churning [W]


class Waves(NamedTuple):
    """Every sample of the meshes that are reported, for `Run.window`."""

    time: np.ndarray  # (rows,) [s]
    dte: np.ndarray  # (rows, meshes) [m]
    mesh_force: np.ndarray  # (rows, meshes) [N]
    friction: np.ndarray  # (rows, meshes), magnitude [N]


def new_waves(rows: int, meshes: int) -> Waves:
    """Room for `rows` samples."""
    size = (rows, meshes)
    return Waves(np.empty(rows), np.empty(size), np.empty(size), np.empty(size))


def new_samples(train: Train, room: int) -> Samples:
    """Arrays for `room` samples, filled with zeros."""
    bodies, meshes = int(train.bodies), int(train.meshes)
    return Samples(
        np.zeros((room, QUANTITIES, meshes)),
        np.zeros((room, AXES)),
        np.zeros((room, bodies)),
        np.zeros((room, bodies)),
        np.zeros((room, 2)),
    )
