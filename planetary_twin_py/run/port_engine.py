"""A run in progress whose ports accept torques and motions from outside."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from .._core import PORTS, REFUSED, WITHIN_LIMITS, PortStates, WindowEnd
from ..model.clock import NEVER, TICKS, Instant, instant, instant_of_ticks, sampling
from ..model.gearbox import Gearbox
from ..model.layout import MOTOR
from ..model.speed_loop_check import SpeedLoopCheck
from ..model.start import begin_given
from ..scene import OperatingPoint, Scene
from .braking import Braking, braking
from .commands import NOTHING, Command, port_ranges
from .engine import Engine
from .samples import new_samples


def kept_trim(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Factors of the trims of the speed loops after a change of ports.

    Args:
        before: torque of each machine per trim before the change [N m/rad], (MACHINES, AXES).
        after: the same after it.

    Returns:
        For each speed that the same machine controls before and after the change, the factor by
        which its torque does not jump; 0 for others, (AXES,).
    """
    same = ((before != 0.0) == (after != 0.0)).all(axis=0)
    old, new = before.sum(axis=0), after.sum(axis=0)  # at most one machine controls each speed
    return np.asarray(np.divide(old, new, out=np.zeros_like(old), where=same & (new != 0.0)))


class DrivenEngine(Engine):
    """An engine with torques and motions given at its ports, step by step.

    A brake of the input is a course of the speed that the engine itself follows: no command acts
    meanwhile, so none can be refused.

    Args:
        scene: scene to simulate.
        tolerance: see `Engine`.
        method: see `Engine`.

    Raises:
        ValueError: the tolerance is out of range, or the scene cannot be built.
    """

    def __init__(self, scene: Scene, tolerance: float, method: str = "auto") -> None:
        self._braking: Braking | None = None  # until the shaft is at rest
        super().__init__(scene, tolerance, method)
        self.port_ranges = port_ranges(self.gearbox)
        self._linear = scene.drive.interpolation == "linear"
        self._ports_set = -1  # [ticks] time of the last change of ports
        self._stepped = False  # since the last window, without sums of the meshes
        self._unlimited = self._core.PortRanges(
            torque=np.full(PORTS, np.inf), speed=np.full(PORTS, np.inf)
        )
        self._brake(0)

    def set_ports(self, scene: Scene, point: OperatingPoint, time: Fraction) -> None:
        """Continue with the ports of `scene` from `time` [s], the end of the last window.

        Newly given torques and motions start at their present values. A machine that starts to
        control the speed begins with the present speed as set-point; one that goes on controlling a
        speed keeps its set-point and its trim.

        Args:
            scene: scene of the run, with other ports.
            point: operating point from `time` on.
            time: end of the last window [s].

        Raises:
            ValueError: the speed loop would be unstable; the ports are unchanged.
            RunawayError: the run has been stopped.
        """
        if self._failure is not None:
            raise self._failure
        gearbox = Gearbox(scene)
        speed_loop = SpeedLoopCheck(gearbox)
        speed_loop.check(point)
        ticks = int(time * TICKS)
        self.apply_command(ticks, ticks, NOTHING)  # a shaft that has reached its position stops
        self._ports_set = ticks
        shown = self.port_states(ticks)
        self._end_step(time)
        self.scene, self.gearbox, self._speed_loop = scene, gearbox, speed_loop
        self._inputs.set_ports(gearbox)
        gain = self.model.operation.trim_gain.copy()
        self._load(point)
        if scene.drive.ports.given:
            begin_given(self.model.operation, instant(time), shown)
        share = kept_trim(gain, self.model.operation.trim_gain)
        self._end.trim = share * self._end.trim
        if share[0] == 0.0:
            self._end.set_speed[0] = shown.input_speed
        self._brake(ticks)

    @property
    def _braked(self) -> bool:
        return self.scene.drive.input.port == "brake"

    def _brake(self, ticks: int) -> None:
        """Begin the brake of the scene, if it has one, at `ticks`, the end of the last window."""
        self._braking = None
        if not self._braked:
            return
        if self.scene.drive.output.port == "torque":
            self._give(ticks, ticks, Command(output_torque=0.0))
        slew_rate = self.scene.drive.speed_control.slew_rate
        self._braking = braking(ticks, float(self.model.operation.speed[MOTOR]), slew_rate)
        self._give(ticks, self._braking.rest, Command(input_speed=0.0))

    def _give(self, begin: int, end: int, command: Command) -> None:
        """Let speeds and torques of the engine itself be reached at `end` along straight lines."""
        try:
            self._core.apply_command(
                self.model, self.integrator, begin, end, command, True, self._unlimited
            )
        except ArithmeticError as reason:
            self._fail(reason)
        self._shown = None

    def _stops(self, until: int, goal: Instant) -> Iterator[Fraction]:
        stops = super()._stops(until, goal)
        if self._braking is None:
            return stops
        rest = self._braking.rest
        return iter(sorted({*stops, Fraction(rest, TICKS)})) if rest < until else stops

    def _pass(self, stop: float | Fraction) -> None:
        super()._pass(stop)
        if self._braking is not None and stop * TICKS >= self._braking.rest:
            self._rest(self._braking.rest)

    def _rest(self, ticks: int) -> None:
        """End the braking of a shaft that is at rest."""
        self._braking = None
        self._give(ticks, ticks, Command(input_speed=0.0))

    def port_states(self, ticks: int) -> PortStates:
        """State of the ports at the end of the last window.

        Args:
            ticks: end of the last window, in ticks of the clock.

        Returns:
            Angles, speeds and torques of both shafts.
        """
        shown: PortStates = self._core.PortStates()
        integrator = self.integrator
        if ticks == self._ports_set:  # the last step had other ports: read from a next one
            integrator, sample = self.integrator.copy(), new_samples(self.train, 1)
            after = instant_of_ticks(ticks + 1)
            self._core.advance(self.model, integrator, after, NEVER, sampling(1, 1.0), sample)
        self._core.read_ports(self.model, integrator, instant_of_ticks(ticks), shown)
        return shown

    def apply_command(self, begin: int, end: int, command: Command) -> None:
        """Apply a command from the end of the last window on.

        Args:
            begin: end of the last window, in ticks of the clock.
            end: time at which positions are reached, in ticks of the clock; with
                `drive.interpolation = linear`, torques and speeds, too.
            command: torques and motions at the ports.

        Raises:
            ValueError: the ports do not accept the command; the run is unchanged.
            RunawayError: the run has been stopped, or no step is possible.
        """
        if self._failure is not None:
            raise self._failure
        if self._braked:
            if command != NOTHING:
                self.refuse(begin, end, command)
            if self._braking is not None and begin >= self._braking.rest:
                self._rest(begin)
            return
        try:
            accepted = self._core.apply_command(
                self.model, self.integrator, begin, end, command, self._linear, self.port_ranges
            )
        except ArithmeticError as reason:
            self._fail(reason)
        except TypeError:
            self.refuse(begin, end, command)
            raise
        if not accepted:
            self.refuse(begin, end, command)
        self._shown = None

    def begin_window(self, time: int, end: WindowEnd) -> None:
        """Begin a window at `time` [ticks], the end of the last one or of steps."""
        if self._stepped:
            now = instant_of_ticks(time)
            self._core.pop_mesh_sums(self.model, self.integrator, now, end.sums)
            self._stepped = False
        super().begin_window(time, end)

    def refuse(self, begin: int, end: int, command: Command) -> None:
        """Raise the error of a command that the ports do not accept.

        Args:
            begin: end of the last window, in ticks of the clock.
            end: end of the step, in ticks of the clock.
            command: torques and motions at the ports.

        Raises:
            ValueError: a value is no number, is out of range, or is not given at its port.
        """
        command.check_numbers()
        command.check(self.scene.drive.ports, self.port_ranges)
        duration = (end - begin) / TICKS
        command.check_positions(self.port_states(begin), duration, self.port_ranges)

    def step(
        self, begin: int, end: int, command: Command, out: PortStates, reached: WindowEnd
    ) -> bool:
        """Apply a command and integrate, without samples.

        Args:
            begin: present time, in ticks of the clock.
            end: end of the step, in ticks of the clock.
            command: torques and motions at the ports.
            out: receives the state of the ports at the end.
            reached: receives the quantities that are compared with the limits of the run.

        Returns:
            Whether the ports accept the command; if not, the run is unchanged.

        Raises:
            RunawayError: the run exceeds physical limits, or has been stopped before.
        """
        if self._failure is not None:
            raise self._failure
        linear, ranges, braked = self._linear, self.port_ranges, self._braking
        if braked is not None and command == NOTHING:
            if begin < braked.rest < end:
                self.step(begin, braked.rest, NOTHING, out, reached)
                begin = braked.rest
            command = Command(input_speed=braked.at(end))
            linear, ranges = True, self._unlimited
            if begin >= braked.rest:
                self._rest(begin)
        elif self._braked and command != NOTHING:
            return False
        try:
            outcome = self._core.step_ports(
                self.model, self.integrator, begin, end, command, linear, ranges,
                self._limits.record, reached, out,
            )  # fmt: skip
        except TypeError:  # only here: checks of every value would slow down each step
            self.refuse(begin, end, command)
            raise
        except KeyboardInterrupt:
            self._end_interrupted()
            raise
        if outcome == REFUSED:
            return False
        self._shown, self._stepped = None, True
        if outcome != WITHIN_LIMITS:
            self._watch(outcome, reached)
        if self.warming is not None and end >= self.warming.next:
            self._warm(end)
        return True
