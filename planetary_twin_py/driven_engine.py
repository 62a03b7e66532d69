"""A run in progress whose ports may be driven from outside."""

from __future__ import annotations

from fractions import Fraction

from ._core import AXES, REFUSED, WITHIN_LIMITS, PortStates, WindowEnd
from .commands import Command, port_ranges
from .dynamics.speed_loop import SpeedLoopCheck
from .dynamics.start import LoadBuilder, begin_given
from .dynamics.train import build_train, held_axes
from .engine import Engine
from .integrators.clock import instant, instant_of_ticks
from .scene import OperatingPoint, Scene


class DrivenEngine(Engine):
    """An engine that takes torques and motions at its ports, step by step.

    Args:
        scene: what to simulate.
        tolerance: see `Engine`.
        method: see `Engine`.

    Raises:
        ValueError: the tolerance is out of range, or the scene cannot be built.
    """

    def __init__(self, scene: Scene, tolerance: float, method: str = "auto") -> None:
        super().__init__(scene, tolerance, method)
        self.port_ranges = port_ranges(scene, self.train)
        self._linear = scene.drive.interpolation == "linear"

    def set_ports(self, scene: Scene, point: OperatingPoint, time: Fraction) -> None:
        """Continue with the ports of `scene` from `time` [s], the end of the last window.

        Torques and motions that are given from then on begin as they are; a machine that takes
        over the speed begins at the present one.

        Args:
            scene: that of the run, with other ports.
            point: operating point of the run.
            time: the end of the last window [s].

        Raises:
            ValueError: the speed loop would not be stable; nothing has changed.
            RunawayError: the run has been stopped.
        """
        if self._failure is not None:
            raise self._failure
        speed_loop = SpeedLoopCheck(scene, build_train(held_axes(scene)))
        loads = LoadBuilder(scene, self.train)
        speed_loop.check(point)
        shown = self._core.PortStates()
        self._core.read_ports(self.model, self.march, instant(time), shown)
        self._cut(time)
        self.scene, self._speed_loop, self._loads = scene, speed_loop, loads
        self._given = False
        self._cycles.clear()
        self._load(point)
        if scene.drive.ports.given:
            begin_given(self.model.load, instant(time), shown)
        self._end.trim = [0.0] * AXES
        self._end.set_speed[0] = shown.input_speed

    def port_states(self, ticks: int) -> PortStates:
        """What the ports show at the end of the last window, in ticks of the clock."""
        shown: PortStates = self._core.PortStates()
        self._core.read_ports(self.model, self.march, instant_of_ticks(ticks), shown)
        return shown

    def give(self, command: Command, ticks: int, reaching: float) -> None:
        """Let a command act from the end of the last window on.

        Args:
            command: what is given at the ports.
            ticks: the end of the last window, in ticks of the clock.
            reaching: time in which values are reached along straight lines [s]; 0: at once.

        Raises:
            RunawayError: the run has been stopped, or no step is possible.
        """
        if self._failure is not None:
            raise self._failure
        try:
            self._core.give(self.model, self.march, instant_of_ticks(ticks), *command, reaching)
        except ArithmeticError as reason:
            self._fail(reason)
        self._shown = None

    def step(
        self, begin: int, end: int, command: Command, out: PortStates, reached: WindowEnd
    ) -> bool:
        """Let a command act and integrate, without samples.

        Args:
            begin: the present time, in ticks of the clock.
            end: the end of the step, in ticks of the clock.
            command: what is given at the ports.
            out: what the ports show at the end.
            reached: room for what the limits of the run are checked against.

        Returns:
            Whether the ports took the command; otherwise nothing has changed.

        Raises:
            RunawayError: the run exceeds physical limits, or has been stopped before.
        """
        if self._failure is not None:
            raise self._failure
        outcome = self._core.step_ports(
            self.model, self.march, begin, end, *command, self._linear, self.port_ranges,
            self._limits.record, reached, out,
        )  # fmt: skip
        if outcome == REFUSED:
            return False
        self._shown = None
        if outcome != WITHIN_LIMITS:
            self._watch(outcome, reached)
        return True
