"""A run in progress, with or without dynamics, as `Twin` and `simulate` see it."""

from __future__ import annotations

from fractions import Fraction
from typing import Protocol

import numpy as np

from ._records import Record
from .dynamics.mesh_sums import MeshSums
from .dynamics.speed_loop import check_speed_loop
from .dynamics.train import build_train
from .engine import Engine
from .integrators.interpolant import Samples
from .quasi_static.engine import QuasiStaticEngine
from .scene import OperatingPoint, Scene


class Run(Protocol):
    """A model that is stepped."""

    train: Record

    @property
    def reached(self) -> Fraction:
        """Up to where the ledger counts [s], at or after the end of the last window."""

    @property
    def control(self) -> Record:
        """Counters of steps and events, see `integrators.progress`."""

    @property
    def repeats(self) -> bool:
        """Whether mesh cycles repeat and are not computed again."""

    @property
    def powers(self) -> np.ndarray:
        """By which the ledger grows at `reached`."""

    def advance(
        self, until: float | Fraction, first_sample: int, sample_rate: float, room: int
    ) -> Samples:
        """Run to `until` [s]; samples lie at whole multiples of 1/sample_rate."""

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], the end of the last window."""

    def change(self, point: OperatingPoint, tolerance: float, time: float | Fraction) -> None:
        """Run on with these from `time` [s], the end of the last window."""

    def take_ledger(self) -> np.ndarray:
        """Integrals of the ledger up to `reached` since they were last taken."""

    def take_mesh_sums(self, time: float | Fraction) -> MeshSums:
        """Integrals and extremes of the meshes since they were last taken.

        Up to `time` [s], the end of the last window.
        """

    def stored(self) -> tuple[float, float]:
        """Kinetic and elastic energy at `reached` [J]."""


def start(scene: Scene, tolerance: float, method: str = "auto") -> Run:
    """Begin a run of `scene` with the dynamics it asks for.

    Args:
        scene: what to simulate.
        tolerance, method: see `Engine`; without dynamics there is no choice of a method.

    Raises:
        ValueError: an argument is out of range, or the scene cannot be built.
    """
    if scene.dynamics == "torsional":
        return Engine(scene, tolerance, method)
    if method not in ("auto", "march"):
        raise ValueError(
            f"method = {method!r}: must be auto or march, "
            f"dynamics = {scene.dynamics!r} takes no steps"
        )
    return QuasiStaticEngine(scene, tolerance)


def check_point(scene: Scene, point: OperatingPoint) -> None:
    """Refuse an operating point at which a run of `scene` would not be stable.

    Args:
        scene: what runs.
        point: where it is to run.

    Raises:
        ValueError: the speed loop of the drive is not stable there.
    """
    if scene.dynamics == "torsional":
        check_speed_loop(scene, build_train(scene), point)
