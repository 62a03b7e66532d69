"""Samples of the quantities of a train."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from .._core import AXES, PUBLISHED, QUANTITIES, WAVEFORM, Report, Train

MEMBERS = 3  # sun, ring, carrier
SAMPLE_DRAGS = 2  # losses of bearings and of churning
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


class Asked(NamedTuple):
    """Quantities of the samples of a window that its caller wants; others cost nothing."""

    mesh: frozenset[str]
    """Names of `WAVEFORM`."""
    bodies: bool = False
    """Whether also angles and speeds of bodies, and the losses of bearings and of churning."""
    torque: bool = False
    """Whether also torques in the shafts of the machines; if so, `bodies` too."""
    sensors: bool = True
    """Whether also the readings of the sensors of the scene."""


PUBLISHED_ONES = Asked(frozenset(WAVEFORM[:PUBLISHED]))  # of messages and of a twin
EVERYTHING = Asked(frozenset(WAVEFORM), bodies=True)
SENSED = Asked(frozenset({"mesh_force"}), bodies=True, torque=True)  # by sensors


class BodyWaves(NamedTuple):
    """Samples of the reported bodies."""

    angle: np.ndarray  # (rows, bodies) absolute [rad]
    speed: np.ndarray  # (rows, bodies) absolute [rad/s]
    drag: np.ndarray  # (rows, 2) power loss of bearings and of churning [W]


class AxesWaves(NamedTuple):
    """Samples of axes that move."""

    displacement: np.ndarray  # (rows, 2 bearings) [m]
    bearing_force: np.ndarray  # (rows, 2 bearings), on the bearing [N]
    orbit: np.ndarray  # (rows, 6) of sun, ring and carrier in the housing [m]
    flank_force: np.ndarray  # (rows, 2 meshes) of drive, then of coast flanks [N]
    tilting: np.ndarray  # (rows, 6 bearings or 0) of axes that tilt, see `Samples`


class Waves(NamedTuple):
    """Samples of what is reported, for `Run.window`; None: not requested, or axes are held."""

    time: np.ndarray  # (rows,) [s]
    mesh: tuple[np.ndarray | None, ...]  # of each of `WAVEFORM` (rows, meshes)
    bodies: BodyWaves | None
    axes: AxesWaves | None
    torque: np.ndarray | None  # in the shafts of the machines (rows, machines) [N m]

    @property
    def asked_of_meshes(self) -> list[np.ndarray]:
        """Samples of the quantities of meshes that were requested, (rows, meshes) each."""
        return [each for each in self.mesh if each is not None]

    @property
    def arrays(self) -> list[np.ndarray]:
        """All arrays that were requested."""
        torque = () if self.torque is None else (self.torque,)
        return [
            self.time, *self.asked_of_meshes, *(self.bodies or ()), *(self.axes or ()), *torque
        ]  # fmt: skip

    def select(self, choose: Callable[[np.ndarray], np.ndarray]) -> Waves:
        """Apply `choose` to each array of samples."""
        return Waves(
            choose(self.time),
            tuple(None if each is None else choose(each) for each in self.mesh),
            None if self.bodies is None else BodyWaves(*map(choose, self.bodies)),
            None if self.axes is None else AxesWaves(*map(choose, self.axes)),
            None if self.torque is None else choose(self.torque),
        )


def wave_rows(waves: Waves, begin: int, end: int) -> Waves:
    """Some of the samples; what is written there is written into them."""
    part = slice(begin, end)
    return waves.select(lambda values: values[part])


def joined_waves(parts: Sequence[Waves]) -> Waves:
    """Samples of consecutive windows, of which there is at least one."""
    if len(parts) == 1:
        return parts[0]
    rows = sum(len(part.time) for part in parts)
    whole, begin = parts[0].select(lambda values: np.empty((rows, *values.shape[1:]))), 0
    for part in parts:
        end = begin + len(part.time)
        for room, values in zip(wave_rows(whole, begin, end).arrays, part.arrays, strict=True):
            room[:] = values
        begin = end
    return whole


class WaveRoom:
    """Makes arrays for the samples of a run.

    Args:
        train: of the run.
        report: number of the reported bodies and meshes.
        asked: quantities that are wanted.
    """

    def __init__(self, train: Train, report: Report, asked: Asked) -> None:
        self._meshes, self._bodies = int(report.meshes), int(report.bodies)
        self._mesh = tuple(name in asked.mesh for name in WAVEFORM)
        self._of_bodies = asked.bodies
        self._machines = int(train.machines) if asked.torque else 0
        self._bearings = bearings_of(train)
        self._tilting = SAMPLE_TILTING * self._bearings if tilts(train) else 0

    def new(self, rows: int) -> Waves:
        """Arrays for `rows` samples."""
        shape, bodies, axes = (rows, self._meshes), None, None
        if self._of_bodies:
            pairs = (self._bodies, self._bodies, SAMPLE_DRAGS)
            bodies = BodyWaves(*(np.empty((rows, columns)) for columns in pairs))
        if self._bearings:
            plane = 2 * self._bearings
            columns = (plane, plane, 2 * MEMBERS, 2 * self._meshes, self._tilting)
            axes = AxesWaves(*(np.empty((rows, count)) for count in columns))
        mesh = tuple(np.empty(shape) if asked else None for asked in self._mesh)
        torque = np.empty((rows, self._machines)) if self._machines else None
        return Waves(np.empty(rows), mesh, bodies, axes, torque)


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
        np.zeros((room, SAMPLE_DRAGS)),
        np.zeros((room, bearings_of(train), SAMPLE_AXES)),
        np.zeros((room, bearings_of(train), SAMPLE_TILTING if tilts(train) else 0)),
    )


def due_before(time: Fraction | float, rate: float, first: int) -> int:
    """Number of samples from number `first` on that lie before `time` [s] or at it."""
    return math.floor(Fraction(time) * Fraction(rate)) + 1 - first
