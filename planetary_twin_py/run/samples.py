"""Samples of the quantities of a train."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .._core import AXES, QUANTITIES, WAVEFORM, Train

MEMBERS = 3  # sun, ring, carrier
SAMPLE_AXES = 4  # components of what a bearing shows in the plane
SAMPLE_TILTING = 6  # and beyond it


class Samples(NamedTuple):
    """Samples of one window. Body j is at turns @ ratio[j] turns + angle[j]."""

    mesh: np.ndarray  # (room, QUANTITIES, meshes), see `observe`
    turns: np.ndarray  # (room, AXES) whole turns of the motors
    angle: np.ndarray  # (room, bodies) [rad]
    speed: np.ndarray  # (room, bodies) [rad/s]
    drag: np.ndarray  # (room, 2) power loss of bearings and of churning [W]
    moved: np.ndarray  # (room, bearings, 4) displacement [m], force on the bearing [N]
    # Where axes tilt: axial displacement [m], tilts [rad], axial force [N] and moments [N m] on the
    # bearing; else without columns.
    tilting: np.ndarray  # (room, bearings, 6 or 0)


class Waves(NamedTuple):
    """Every sample of the meshes that are reported, for `Run.window`."""

    time: np.ndarray  # (rows,) [s]
    mesh: tuple[np.ndarray, ...]  # of each of `WAVEFORM` (rows, meshes)
    displacement: np.ndarray  # (rows, 2 bearings) of axes that move [m]
    bearing_force: np.ndarray  # (rows, 2 bearings), on the bearing [N]
    orbit: np.ndarray  # (rows, 6) of sun, ring and carrier in the housing [m]
    flank_force: np.ndarray  # (rows, 2 meshes) of drive, then of coast flanks [N]
    tilting: np.ndarray  # (rows, 6 bearings) of axes that tilt, see `Samples`


def wave_rows(waves: Waves, begin: int, end: int) -> Waves:
    """Some of the samples; what is written there is written into them."""
    time, mesh, *axes = waves
    part = slice(begin, end)
    return Waves(time[part], tuple(each[part] for each in mesh), *(each[part] for each in axes))


def new_waves(rows: int, meshes: int, bearings: int = 0, tilting: bool = False) -> Waves:
    """Room for `rows` samples; without bearings, axes are held and have no columns."""
    of_axes = (2 * bearings, 2 * bearings, 2 * MEMBERS, 2 * meshes) if bearings else (0,) * 4
    of_tilting = SAMPLE_TILTING * bearings if tilting else 0
    return Waves(
        np.empty(rows),
        tuple(np.empty((rows, meshes)) for _ in WAVEFORM),
        *(np.empty((rows, columns)) for columns in (*of_axes, of_tilting)),
    )


def bearings_of(train: Train) -> int:
    """Number of the bearings of axes that move; 0 if they are held."""
    return int(train.moving.bearings)


def tilts(train: Train) -> bool:
    """Whether the axes tilt: then the rows of the meshes fill their room."""
    return bearings_of(train) > 0 and int(train.moving.entries) == train.mesh.sign.shape[1]


def new_samples(train: Train, room: int) -> Samples:
    """Arrays for `room` samples, filled with zeros."""
    bodies, meshes = int(train.bodies), int(train.meshes)
    return Samples(
        np.zeros((room, QUANTITIES, meshes)),
        np.zeros((room, AXES)),
        np.zeros((room, bodies)),
        np.zeros((room, bodies)),
        np.zeros((room, 2)),
        np.zeros((room, bearings_of(train), SAMPLE_AXES)),
        np.zeros((room, bearings_of(train), SAMPLE_TILTING if tilts(train) else 0)),
    )
