"""Commands at the ports of a run: torques and motions from outside, over simulated time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .._core import PortRanges, PortStates
from ..model.clock import TICKS
from ..model.gearbox import Gearbox
from ..model.layout import LOAD_MACHINE, MOTOR
from ..scene.drive import Causality, Ports
from ..text.number_check import check_number
from ..text.object_repr import brief_record

NAMES = (
    "input_torque",
    "output_torque",
    "input_speed",
    "output_speed",
    "input_position",
    "output_position",
)
"""Names of the values of a command."""
SIDES = ("input", "output")


class Command(NamedTuple):
    """Values at the ports; None leaves a value unchanged."""

    input_torque: float | None = None
    """Torque on the input shaft [N m]."""
    output_torque: float | None = None
    """Torque on the output shaft [N m]."""
    input_speed: float | None = None
    """Speed of the input shaft [rad/s]."""
    output_speed: float | None = None
    """Speed of the output shaft [rad/s]."""
    input_position: float | None = None
    """Angle that the input shaft reaches at the end of the step [rad]."""
    output_position: float | None = None
    """Angle that the output shaft reaches at the end of the step [rad]."""

    @property
    def values(self) -> dict[str, float]:
        """Values other than None, by name."""
        named = zip(NAMES, self, strict=True)
        return {name: value for name, value in named if value is not None}

    def check_numbers(self) -> None:
        """Check that the values are numbers.

        Raises:
            ValueError: a value is no number.
        """
        for name, value in self.values.items():
            check_number(name, value, UNITS[name.split("_")[1]])

    def check(self, ports: Ports, ranges: PortRanges) -> None:
        """Check that ports accept this command.

        Args:
            ports: what acts on the shafts.
            ranges: from `port_ranges`.

        Raises:
            ValueError: a value is out of range, or is not given at its port.
        """
        for name, value in zip(NAMES, self, strict=True):
            if value is None:
                continue
            if ports.input == "brake":
                raise ValueError(
                    f"{name} = {value!r}: drive.input.port = 'brake' takes no commands"
                )
            side, quantity = name.split("_")
            field, needed = f"drive.{side}.port", CAUSALITIES[quantity]
            port = getattr(ports, side)
            if port != needed:
                raise ValueError(f"{name} = {value!r}: requires {field} = {needed!r}, not {port!r}")
            if quantity == "position":
                if not math.isfinite(value):
                    raise ValueError(f"{name} = {value!r} rad: must be finite")
                continue
            place = MOTOR if side == "input" else LOAD_MACHINE
            most, unit = float(getattr(ranges, quantity)[place]), UNITS[quantity]
            if not abs(value) <= most:
                raise ValueError(
                    f"{name} = {value!r} {unit}: must be within {-most:g} and {most:g} {unit}, "
                    f"from drive.{quantity}_limit"
                )

    def check_positions(self, states: PortStates, duration: float, ranges: PortRanges) -> None:
        """Check that the shafts can reach the positions of this command.

        Args:
            states: present state of the ports.
            duration: time in which the positions are reached [s].
            ranges: from `port_ranges`.

        Raises:
            ValueError: a shaft would exceed its largest speed.
        """
        for side, place in zip(SIDES, (MOTOR, LOAD_MACHINE), strict=True):
            name = f"{side}_position"
            value = getattr(self, name)
            if value is None:
                continue
            angle, most = getattr(states, f"{side}_angle"), float(ranges.speed[place])
            if not abs(value - angle) <= most * duration:
                raise ValueError(
                    f"{name} = {value!r} rad: must be within {angle - most * duration:g} and "
                    f"{angle + most * duration:g} rad, {duration:g} s from {angle:g} rad, from "
                    "drive.speed_limit"
                )


NOTHING = Command()  # changes no value
CAUSALITIES: dict[str, Causality] = {"torque": "torque", "speed": "motion", "position": "motion"}
"""Kind of port that accepts a quantity."""
UNITS = {"torque": "N m", "speed": "rad/s", "position": "rad"}
"""SI unit of a quantity."""


def port_ranges(gearbox: Gearbox) -> PortRanges:
    """Largest magnitudes of commands, from the limits of the drive.

    Returns:
        Limits at input and output: those of the drive, and these converted by the gear ratio.
    """
    drive, train, shafts = gearbox.scene.drive, gearbox.train, [MOTOR, LOAD_MACHINE]
    bodies = train.coupling.ends[shafts, 0]
    ranges: PortRanges = gearbox.core.PortRanges(
        torque=drive.torque_limit * np.abs(gearbox.machine_torques[shafts]),
        speed=drive.speed_limit * np.abs(train.body.ratio[bodies]).sum(axis=1),
    )
    return ranges


@dataclass(frozen=True)
class Commands:
    """Commands at the ports of a run over simulated time.

    With `drive.interpolation = hold`, torques and speeds act from their time on. With `linear`,
    they are reached at their time along a straight line from the previous value; a value at time 0
    acts at once. A position is reached at its time, at constant speed from the time of the command
    before it; then the shaft has the speed of the same command, or stops. NaN, or an omitted array,
    leaves the value at the port unchanged.

    Raises:
        ValueError: times do not increase, shapes differ, or a position is given at time 0.
    """

    time: np.ndarray
    """Simulated times [s], (commands,)."""
    input_torque: np.ndarray | None = None
    """On the input shaft [N m], (commands,)."""
    output_torque: np.ndarray | None = None
    """On the output shaft [N m], (commands,)."""
    input_speed: np.ndarray | None = None
    """Of the input shaft [rad/s], (commands,)."""
    output_speed: np.ndarray | None = None
    """Of the output shaft [rad/s], (commands,)."""
    input_position: np.ndarray | None = None
    """Of the input shaft, an angle as in `PortStates` [rad], (commands,)."""
    output_position: np.ndarray | None = None
    """Of the output shaft, an angle as in `PortStates` [rad], (commands,)."""

    def __post_init__(self) -> None:
        time = np.asarray(self.time, dtype=float)
        object.__setattr__(self, "time", time)
        if time.ndim != 1 or not (np.isfinite(time).all() and (np.diff(time) > 0.0).all()):
            raise ValueError("commands.time: must be finite numbers in increasing order")
        if time.size and time[0] < 0.0:
            raise ValueError(f"commands.time = {time[0]!r} s: must be at least 0")
        for name in NAMES:
            values = getattr(self, name)
            if values is None:
                continue
            values = np.asarray(values, dtype=float)
            object.__setattr__(self, name, values)
            if values.shape != time.shape:
                raise ValueError(
                    f"commands.{name}: has shape {values.shape}: must be {time.shape}, as time"
                )
            at_once = time.size > 0 and time[0] == 0.0 and not math.isnan(values[0])
            if name.endswith("position") and at_once:
                raise ValueError(
                    f"commands.{name} = {float(values[0])!r} rad at time 0: must be NaN, because a "
                    "position is reached at its time"
                )

    @property
    def names(self) -> list[str]:
        """Names of the quantities that are given."""
        return [name for name in NAMES if getattr(self, name) is not None]

    def __len__(self) -> int:
        """Number of commands."""
        return len(self.time)

    def __iter__(self) -> Iterator[tuple[int, Command]]:
        """Times in ticks of 1e-12 s, and commands."""
        columns = [getattr(self, name) for name in NAMES]
        for n, time in enumerate(self.time):
            values = (None if column is None else _value(column[n]) for column in columns)
            yield round(float(time) * TICKS), Command(*values)

    def __repr__(self) -> str:
        """One line; arrays by their shapes."""
        return brief_record(self)


def _value(value: float) -> float | None:
    return None if math.isnan(value) else float(value)


class Action(NamedTuple):
    """A command, with the times at which it starts and ends to act."""

    begin: int
    """Time from which it acts, in ticks of the clock."""
    end: int
    """Time at which positions, and values along straight lines, are reached, in ticks."""
    command: Command
    """Values of the command."""


def actions(commands: Commands, linear: bool) -> Iterator[Action]:
    """Actions of a course, in order of time.

    Args:
        commands: the course.
        linear: whether values are reached along straight lines, see `Commands`.
    """
    now, held = 0, NOTHING
    for ticks, command in commands:
        yield Action(now, ticks, command if linear else _heading_for(command, held))
        now, held = ticks, command
    yield Action(now, now, NOTHING if linear else _heading_for(NOTHING, held))


def _heading_for(following: Command, held: Command) -> Command:
    """Values after `held` until `following`, at whose time its positions are reached."""
    change: dict[str, float | None] = {}
    for side in SIDES:
        position = change[f"{side}_position"] = getattr(following, f"{side}_position")
        if position is not None:
            change[f"{side}_speed"] = None
    return held._replace(**change)


class CommandLog:
    """Commands of a twin, and the course that repeats them.

    Args:
        linear: whether torques and speeds are reached along straight lines, see `Commands`.
    """

    def __init__(self, linear: bool) -> None:
        self._linear = linear
        self._given: dict[int, Command] = {}  # by time in ticks, in order

    def keep(self, begin: int, end: int, command: Command) -> None:
        """Keep the command of a step.

        Args:
            begin: start of the step, in ticks of the clock.
            end: end of the step, in ticks of the clock.
            command: command of the step.
        """
        if self._linear:
            self._add(end, command)
            return
        values, arriving = command.values, dict[str, float]()
        for side in SIDES:
            if f"{side}_position" in values:
                named = (f"{side}_position", f"{side}_speed")
                arriving |= {name: values.pop(name) for name in named if name in values}
        if command != NOTHING:
            self._add(begin, Command(**values))
        if arriving:
            self._add(end, Command(**arriving))

    def _add(self, ticks: int, command: Command) -> None:
        before = self._given.get(ticks, NOTHING)
        self._given[ticks] = before._replace(**command.values)

    def course(self) -> Commands:
        """Return the course of all commands."""
        columns = np.array(
            [
                [math.nan if value is None else value for value in command]
                for command in self._given.values()
            ],
            dtype=float,
        ).reshape(-1, len(NAMES))
        used = {
            name: column
            for name, column in zip(NAMES, columns.T, strict=True)
            if not np.isnan(column).all()
        }
        return Commands(np.array([tick / TICKS for tick in self._given]), **used)
