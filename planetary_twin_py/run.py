"""Interface of a run in progress, dynamic or quasi-static, for `Twin` and `simulate`."""

from __future__ import annotations

from fractions import Fraction
from typing import Protocol

import numpy as np

from ._core import Control, Report, Train, WindowEnd
from .driven_engine import DrivenEngine
from .dynamics.mesh_sums import MeshSums
from .dynamics.planet_bearings import check_planet_bearings
from .dynamics.speed_loop import check_speed_loop
from .dynamics.train import build_train, held_axes
from .energy_books import EnergyBooks
from .integrators.interpolant import Samples, Waves
from .printable import one_line
from .quasi_static.engine import QuasiStaticEngine
from .scene import OperatingPoint, Scene, SceneError
from .window_jobs import WindowJobs


class Run(Protocol):
    """A model that is advanced in time."""

    train: Train
    start_warning: str
    """Why the start is no equilibrium, "" if it is one."""

    @property
    def reached(self) -> Fraction:
        """End of the ledger [s], at or after the end of the last window."""

    @property
    def control(self) -> Control:
        """Counters of steps and events, see `integrators.progress`."""

    @property
    def repeats(self) -> bool:
        """Whether the motion is periodic, so that mesh cycles are not computed again."""

    @property
    def powers(self) -> np.ndarray:
        """Rate of the ledger at `reached` [W]."""

    def advance(
        self, until: float | Fraction, first_sample: int, sample_rate: float, room: int
    ) -> Samples:
        """Simulate until `until` [s]; sample times are integer multiples of 1/sample_rate."""

    def window(
        self, until: int, first: int, rate: float, report: Report, out: Waves, end: WindowEnd
    ) -> WindowJobs:
        """Simulate until `until` [ticks of the clock]; fill the waveform, and the window's end.

        Sample `first` and all others are integer multiples of 1/rate. Energy ledger and mesh sums
        of `end` are those since the last window. The work is done as the jobs are.
        """

    def begin_window(self, time: int, end: WindowEnd) -> None:
        """Begin a window at `time` [ticks of the clock], the end of the last one."""

    def sample(self, time: float | Fraction) -> Samples:
        """One sample at `time` [s], the end of the last window."""

    def change(self, point: OperatingPoint, tolerance: float, time: float | Fraction) -> None:
        """Change operating point and tolerance at `time` [s], the end of the last window."""

    def books(self, time: float | Fraction) -> EnergyBooks:
        """Energy at `time` [s], the end of the last window; it changes nothing."""

    def pop_mesh_sums(self, time: float | Fraction) -> MeshSums:
        """Integrals and extremes of the meshes since the last call.

        Up to `time` [s], the end of the last window.
        """


def start(scene: Scene, tolerance: float, method: str = "auto") -> Run:
    """Start a run of `scene` with the dynamics that it selects.

    Args:
        scene: to simulate.
        tolerance: see `Engine`.
        method: see `Engine`; quasi-static runs have no choice.

    Returns:
        The run.

    Raises:
        ValueError: an argument is out of range, or the scene cannot be built.
    """
    if scene.dynamics == "auto":
        name = one_line(scene.name, 100)
        raise SceneError(
            "dynamics = 'auto': must be selected first: use `choose_dynamics(scene).scene`, or "
            f"give torsional, planar or quasi_static; `planetary-twin explain {name}` "
            "compares them"
        )
    check_planet_bearings(scene, scene.operating_point)
    if not scene.quasi_static:
        return DrivenEngine(scene, tolerance, method)
    if method not in ("auto", "march"):
        raise ValueError(
            f"method = {method!r}: must be auto or march, because dynamics = {scene.dynamics!r}"
        )
    return QuasiStaticEngine(scene, tolerance)


def check_point(scene: Scene, point: OperatingPoint) -> None:
    """Check that a run of `scene` is stable at an operating point.

    Args:
        scene: the scene.
        point: the operating point.

    Raises:
        ValueError: the speed loop of the drive is not stable, or bearings of planets are too soft.
    """
    check_planet_bearings(scene, point)
    if not scene.quasi_static:
        check_speed_loop(scene, build_train(held_axes(scene)), point)
