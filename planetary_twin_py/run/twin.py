"""A simulation that advances in windows and whose inputs can be changed between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from types import MappingProxyType
from typing import Any, NamedTuple

from .._core import PortStates
from ..durability.turning import put_turning
from ..model.clock import TICKS
from ..model.layout import LOAD_MACHINE, MOTOR
from ..scene import OperatingPoint, Scene, SceneError
from ..scene.drive import Causality, Ports
from ..scene.given import check_scene
from ..scene.live import PORT_FIELDS, live_values, split_live
from ..text.number_check import check_number
from ..text.object_repr import brief, brief_record
from .commands import NOTHING, Command, CommandLog, Commands
from .interface import NO_CHANGE
from .port_engine import DrivenEngine
from .start import check_severities
from .steady_temperatures import with_start
from .tolerance import LIVE_TOLERANCE, check_tolerance
from .window import Window
from .window_jobs import WindowJobs, run_alone
from .window_plan import Plan, check_sample_rate, window_end
from .windows import Windows

LONGEST_STEP = 1.0  # [s] of `Twin.step`, which cannot be interrupted


class Change(NamedTuple):
    """Inputs of a run from a certain time on."""

    time: float
    """Simulated time from which they apply [s]."""
    point: OperatingPoint
    """Operating point."""
    tolerance: float
    """Relative local error tolerance."""
    sample_rate: float
    """Sample rate of the waveform [Hz]; it does not affect the motion."""
    ports: Ports = Ports()
    """What acts on the shafts of input and output."""
    severities: Mapping[str, float] = MappingProxyType({})
    """Severities of the faults by dotted name; they may grow from then on."""
    worsened: tuple[str, ...] = ()
    """Names of the severities that were set at this time."""
    oil_temperature: float | None = None
    """Temperature of the oil at this time [K] if it is a state; None: that of `point`."""

    @property
    def values(self) -> dict[str, Any]:
        """Operating point, ports and severities, by the arguments of `Twin.set`."""
        return live_values(self.point, self.ports, self.severities)

    def __repr__(self) -> str:
        """One line."""
        return brief_record(self)


class Twin:
    """A running gearbox whose operating point can be changed between windows.

    The equations of motion are those of `simulate`; their sources are in docs/model.md.

    Args:
        scene: the scene; the run starts at the speeds of its operating point, deflected by its
            torques. This is a steady state unless a port is given: its torque starts at the value
            without losses, which a machine at the other port adds, or which slows the train down.
        sample_rate: sample rate of the waveform [Hz].
        tolerance: relative local error tolerance; the default is suitable for real time.
        keep_commands: whether to keep the commands at the ports, see `commands`.

    Raises:
        ValueError: the scene, the sample rate or the tolerance is invalid.
    """

    def __init__(
        self,
        scene: Scene,
        sample_rate: float = 50_000.0,
        tolerance: float = LIVE_TOLERANCE,
        keep_commands: bool = False,
    ) -> None:
        check_scene(scene)
        check_sample_rate(sample_rate)
        scene = with_start(scene)
        self.start = scene
        """Scene at the start of the run."""
        self.scene = scene
        """Scene with the present ports."""
        self._windows = Windows(scene, tolerance)
        self._engine = self._windows.run
        gearbox = self._engine.gearbox
        self._names, self._mesh_names = gearbox.body_names, gearbox.mesh_names
        given = scene.severities
        self.log = [
            Change(
                0.0, scene.operating_point, tolerance, float(sample_rate), scene.drive.ports,
                given, tuple(given), self.temperatures.get("oil"),
            )
        ]  # fmt: skip
        """All changes. Applied at the same times, they reproduce the run and its samples."""
        self._grows = any(fault.growing is not None for fault in scene.faults)
        linear = scene.drive.interpolation == "linear"
        self._kept = CommandLog(linear) if keep_commands else None
        self._given = scene.drive.ports.given
        self._stepped = False  # since the last window
        core = gearbox.core
        self._shown, self._reached = core.PortStates(), core.WindowEnd()

    @property
    def bodies(self) -> tuple[str, ...]:
        """Names of the bodies, in the order of arrays over bodies."""
        return self._names.names

    @property
    def meshes(self) -> tuple[str, ...]:
        """Names of the meshes, in the order of arrays over meshes."""
        return self._mesh_names.names

    @property
    def time(self) -> float:
        """Simulated time [s]: the end of the last window."""
        return self._windows.ticks / TICKS

    @property
    def operating_point(self) -> OperatingPoint:
        """Current operating point, with the oil's present temperature where it is a state."""
        point, oil = self.log[-1].point, self.temperatures.get("oil")
        return point if oil is None else point.model_copy(update={"oil_temperature": oil})

    @property
    def temperatures(self) -> Mapping[str, float]:
        """Current temperatures [K], see `Window.temperatures`."""
        warming = self._windows.run.warming
        return {} if warming is None else warming.temperatures

    @property
    def severities(self) -> Mapping[str, float]:
        """Current severities of the faults by dotted name, `faults.0.depth` [SI]."""
        return MappingProxyType(dict(self._windows.run.severities))

    @property
    def tolerance(self) -> float:
        """Current relative local error tolerance."""
        return self.log[-1].tolerance

    @property
    def sample_rate(self) -> float:
        """Current sample rate of the waveform [Hz]."""
        return self.log[-1].sample_rate

    @property
    def ports(self) -> Ports:
        """What acts on the shafts of input and output."""
        return self.log[-1].ports

    @property
    def commands(self) -> Commands:
        """All commands at the ports so far; with them, `simulate` repeats the run.

        Raises:
            ValueError: the twin was not made with `keep_commands`.
        """
        if self._kept is None:
            raise ValueError("keep_commands = False: must be True to keep commands")
        return self._kept.course()

    @property
    def port_states(self) -> PortStates:
        """Angles, speeds and torques of the input and the output shaft at the current time.

        Raises:
            ValueError: the scene is quasi-static.
        """
        return self._driven().port_states(self._windows.ticks)

    def continue_cycles(self, turning: Mapping[str, Sequence[float]]) -> None:
        """Count the cycles of shafts on from an earlier run, before the first window of this one.

        Args:
            turning: torques that are in no closed cycle yet [N m], by shaft, see `Damage.turning`.
        """
        put_turning(self._windows.run.passages, turning)

    @property
    def speed_limits(self) -> tuple[float, float]:
        """Largest speeds of commands for the input and the output shaft [rad/s].

        Raises:
            ValueError: the scene is quasi-static.
        """
        most = self._driven().port_ranges.speed
        return float(most[MOTOR]), float(most[LOAD_MACHINE])

    def check_command(self, command: Command, ports: Ports, duration: float) -> None:
        """Check that ports accept a command from the current time on.

        Args:
            command: values at the ports.
            ports: what acts on the shafts.
            duration: time in which positions are reached [s]; 0: positions are not checked.

        Raises:
            ValueError: a value is out of range, or is not given at its port.
        """
        ranges = self._driven().port_ranges
        command.check(ports, ranges)
        if duration:
            command.check_positions(self.port_states, duration, ranges)

    def set(self, **changes: Any) -> float:
        """Change operating point, ports and severities of faults at the current time.

        Newly given torques and motions keep their present values until a command changes them. A
        machine that starts to control the speed begins with the present speed as set-point, and
        approaches the set-point of the operating point at the slew rate of the drive.

        Args:
            changes: values in SI by field name; of the ports "machine", "torque" or "motion"
                (``**{"drive.input.port": "torque"}``); of faults ``**{"faults.0.depth": 1e-4}``.

        Returns:
            The simulated time from which they apply [s].

        Raises:
            ValueError: a name is unknown, a value is out of range, the scene does not allow a
                port, or a fault follows a table; no field is changed.
        """
        tuned, causalities, named = split_live(changes, self.scene.severities)
        point = self.scene.point_with(self.log[-1].point, tuned)
        return self._change(
            self._worsened(named), point=point, ports=self.ports._replace(**causalities)
        )

    def _worsened(self, named: Mapping[str, float]) -> dict[str, float]:
        """Those of the named severities that differ from the present ones, checked."""
        present = self._windows.run.severities
        changed = {name: value for name, value in named.items() if value != present[name]}
        if not changed:
            return {}
        check_severities(self.scene, changed)
        given = self.scene.replace(**changed).severities
        return {name: given[name] for name in changed}

    def set_tolerance(self, tolerance: float) -> float:
        """Change the tolerance at the current time.

        Args:
            tolerance: relative local error tolerance.

        Returns:
            The simulated time from which it applies [s].

        Raises:
            ValueError: the value is out of range; it is not changed.
        """
        check_tolerance(tolerance)
        return self._change(tolerance=tolerance)

    def set_sample_rate(self, sample_rate: float) -> float:
        """Change the sample rate of the waveform at the current time; the motion is not affected.

        Args:
            sample_rate: sample rate [Hz]; sample times are integer multiples of its period.

        Returns:
            The simulated time from which it applies [s].

        Raises:
            ValueError: the value is out of range; it is not changed.
        """
        check_sample_rate(sample_rate)
        if sample_rate != self.sample_rate:
            last = self.log[-1]
            now = last._replace(time=self.time, sample_rate=float(sample_rate), worsened=())
            self._note(now)
        return self.time

    def set_ports(self, input: Causality | None = None, output: Causality | None = None) -> float:
        """Change what acts on the shafts of input and output at the current time, as `set` does.

        Args:
            input: "machine", "torque" or "motion", see `drive.input.port`; None: no change.
            output: the same for the output shaft.

        Returns:
            The simulated time from which they apply [s].

        Raises:
            ValueError: the scene does not allow this port; nothing is changed.
        """
        return self._change(ports=Ports(input or self.ports.input, output or self.ports.output))

    def step(
        self,
        dt: float,
        *,
        input_torque: float | None = None,
        output_torque: float | None = None,
        input_speed: float | None = None,
        output_speed: float | None = None,
        input_position: float | None = None,
        output_position: float | None = None,
    ) -> PortStates:
        """Apply torques or motions at the ports, and simulate without waveform or statistics.

        Omitted arguments keep their last values. With `drive.interpolation = hold`, values act from
        the present time on; with `linear`, they are reached at the end of the step. A position is
        reached at the end of the step at constant speed, whatever the interpolation. Then the shaft
        has the speed that is given with the position, or stops. Positive torques act on the shafts
        in the positive direction, so a brake on a shaft that turns forwards has a negative torque.
        Sensors have no readings of steps: they restart with the next window, after which their
        filters have to fill again.

        Args:
            dt: simulated time [s], above 0 and at most 1 s.
            input_torque: torque on the input shaft [N m]; requires `drive.input.port = torque`.
            output_torque: torque on the output shaft [N m]; requires `drive.output.port = torque`.
            input_speed: speed of the input shaft [rad/s]; requires `drive.input.port = motion`.
            output_speed: speed of the output shaft [rad/s]; requires `drive.output.port = motion`.
            input_position: angle of the input shaft, as in the returned state [rad]; requires
                `drive.input.port = motion`.
            output_position: angle of the output shaft [rad]; requires `drive.output.port = motion`.

        Returns:
            Angles, speeds and torques of the shafts at the end. It is the same object in every
            step; `copy()` keeps its values.

        Raises:
            ValueError: dt or a value is out of range, or a port does not accept a value; nothing
                has changed.
            RunawayError: the run exceeds physical limits; the twin cannot be advanced further.
        """
        begin, engine = self._windows.ticks, self._engine
        try:
            if self._grows:
                raise SceneError("faults: growth requires windows of `advance`, not `step`")
            if not 0.0 < dt <= LONGEST_STEP:
                raise ValueError(f"dt = {dt!r} s: must be above 0 and at most {LONGEST_STEP:g}")
            end = begin + (round(dt * TICKS) or 1)
        except (TypeError, ValueError):
            check_number("dt", dt, "s")
            raise
        command = Command(
            input_torque, output_torque, input_speed, output_speed, input_position, output_position
        )
        if not (
            isinstance(engine, DrivenEngine)
            and engine.step(begin, end, command, self._shown, self._reached)
        ):
            self._driven().refuse(begin, end, command)
        if self._kept is not None:
            self._kept.keep(begin, end, command)
        self._windows.ticks, self._stepped = end, True
        return self._shown

    def _driven(self) -> DrivenEngine:
        """The engine; raises SceneError if torque or motion cannot be prescribed."""
        if not isinstance(self._engine, DrivenEngine):
            raise SceneError(
                f"dynamics = {self.scene.dynamics!r}: does not allow commands at ports"
            )
        return self._engine

    def _end_steps(self) -> None:
        """Begin a window after steps, which have no sums of the meshes."""
        if self._stepped:
            self._windows.begin()
            self._stepped = False

    def advance(
        self,
        duration: float,
        *,
        input_torque: float | None = None,
        output_torque: float | None = None,
        input_speed: float | None = None,
        output_speed: float | None = None,
        input_position: float | None = None,
        output_position: float | None = None,
    ) -> Window:
        """Simulate one window.

        Args:
            duration: simulated time [s], above 0 and at most 60 s or 4096 samples, whichever is
                longer.
            input_torque: torque on the input shaft [N m], as in `step`.
            output_torque: torque on the output shaft [N m].
            input_speed: speed of the input shaft [rad/s].
            output_speed: speed of the output shaft [rad/s].
            input_position: angle of the input shaft at the end of the window [rad].
            output_position: angle of the output shaft at the end of the window [rad].

        Returns:
            Statistics and waveform of the window.

        Raises:
            ValueError: the duration or a value is out of range, or a port does not accept a value;
                nothing has changed.
            RunawayError: the run exceeds physical limits; the twin cannot be advanced further.
        """
        command = Command(
            input_torque, output_torque, input_speed, output_speed, input_position, output_position
        )
        plan = self._plan(duration)
        self._begin(plan, command)
        if command != NOTHING:
            plan = plan._replace(given=command.values)
        run_alone(self._jobs(plan))
        return self._close(plan)

    def _begin(self, plan: Plan, command: Command = NOTHING) -> None:
        """Apply a command in a window that begins now."""
        self._end_steps()
        if self._given or command.values:
            self._apply_command(command, plan.end)

    def _apply_command(self, command: Command, end: int) -> None:
        """Apply a command from the present time to `end` [ticks]."""
        begin = self._windows.ticks
        self._driven().apply_command(begin, end, command)
        if self._kept is not None:
            self._kept.keep(begin, end, command)

    def _jobs(self, plan: Plan) -> WindowJobs:
        """Jobs of the core for a window."""
        return self._windows.jobs(plan)

    def _change(self, worsened: Mapping[str, float] = NO_CHANGE, **inputs: Any) -> float:
        """Continue with other severities and inputs, fields of `Change`; returns the time [s]."""
        before = self.log[-1]
        change = before._replace(time=self.time, **inputs)
        if change[1:] == before[1:] and not worsened:
            return self.time
        if change.ports != before.ports:
            self._set_ports(change)
        if worsened or change.ports == before.ports:
            self._end_steps()
            self._engine.change(change.point, change.tolerance, self._instant, worsened)
        if worsened:
            self.scene = self.scene.replace(**worsened)
        change = change._replace(severities=dict(self._engine.severities), worsened=tuple(worsened))
        self._windows.begin()  # a change of backlash or of a fault is not work of this window
        self._windows.set_point(change.point)
        self._note(change)
        return self.time

    def _note(self, change: Change) -> None:
        """Append a change to the log."""
        self.log.append(change._replace(oil_temperature=self.temperatures.get("oil")))

    def _set_ports(self, change: Change) -> None:
        """Continue with the ports and the operating point of `change`."""
        ports = {name: getattr(change.ports, side) for name, side in PORT_FIELDS.items()}
        scene = self.scene.replace(**ports)
        self._end_steps()
        self._driven().set_ports(scene, change.point, self._instant)
        self.scene, self._given = scene, change.ports.given

    @property
    def _instant(self) -> Fraction:
        """Simulated time [s], exactly."""
        return Fraction(self._windows.ticks, TICKS)

    def _plan(self, duration: float) -> Plan:
        """Plan a window of `duration` seconds from the present time on."""
        rate = self.sample_rate
        return self._windows.plan(window_end(self._windows.ticks, duration, rate), rate)

    def _close(self, plan: Plan) -> Window:
        """Results of the window that the engine has run through."""
        return self._windows.results(self._windows.close(plan), self.tolerance)

    def __repr__(self) -> str:
        """One line."""
        how = f"{self.time:g} s", f"tolerance {self.tolerance:g}"
        return brief(self, self.scene.name, self.scene.dynamics, *how)
