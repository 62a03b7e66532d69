"""Commands at the ports of a run: torques and speeds that are given from outside, over time."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ._core import PortRanges, Train
from .dynamics.bodies import LOAD_MACHINE, MOTOR
from .dynamics.library import library
from .dynamics.static_load import static_torques
from .integrators.clock import TICKS
from .scene import Scene

NAMES = ("input_torque", "output_torque", "input_speed", "output_speed")
"""Of the values of a command."""


class Command(NamedTuple):
    """What is given at the ports; `None`: what acts stays as it is."""

    input_torque: float | None = None
    """On the input shaft [N m]."""
    output_torque: float | None = None
    """On the output shaft [N m]."""
    input_speed: float | None = None
    """Of the input shaft [rad/s]."""
    output_speed: float | None = None
    """Of the output shaft [rad/s]."""

    @property
    def values(self) -> dict[str, float]:
        """Values that are given, by name."""
        named = zip(NAMES, self, strict=True)
        return {name: value for name, value in named if value is not None}

    def check(self, scene: Scene, ranges: PortRanges) -> None:
        """Check that the ports of a scene take this command.

        Args:
            scene: the scene, with its present ports.
            ranges: from `port_ranges`.

        Raises:
            ValueError: a value is out of range, or is not given at its port.
        """
        for name, value in zip(NAMES, self, strict=True):
            if value is None:
                continue
            side, quantity = name.split("_")
            field, needed = f"drive.{side}.port", {"torque": "torque", "speed": "motion"}[quantity]
            port = getattr(scene.drive.ports, side)
            if port != needed:
                raise ValueError(f"{name} = {value!r}: requires {field} = {needed!r}, not {port!r}")
            place = MOTOR if side == "input" else LOAD_MACHINE
            most, unit = float(getattr(ranges, quantity)[place]), _UNITS[quantity]
            if not abs(value) <= most:
                raise ValueError(
                    f"{name} = {value!r} {unit}: must be within {-most:g} and {most:g} {unit}, "
                    f"from drive.{quantity}_limit"
                )


_UNITS = {"torque": "N m", "speed": "rad/s"}


def port_ranges(scene: Scene, train: Train) -> PortRanges:
    """Largest magnitudes of commands, from the limits of the drive.

    Args:
        scene: the scene.
        train: from `dynamics.train.build_train`.

    Returns:
        Limits at input and output: those of the drive, carried to the output by the tooth numbers.
    """
    drive, bodies = scene.drive, train.coupling[[MOTOR, LOAD_MACHINE], 0]
    ranges: PortRanges = library(scene).PortRanges(
        torque=drive.torque_limit * np.abs(static_torques(scene)[[MOTOR, LOAD_MACHINE]]),
        speed=drive.speed_limit * np.abs(train.ratio[bodies, 0]),
    )
    return ranges


@dataclass(frozen=True)
class Commands:
    """A course of commands: what is given at the ports of a run, over simulated time.

    With `drive.interpolation = hold`, each value acts from its time on. With `linear`, it is
    reached at its time along a straight line from what acted before; a value at time 0 acts at
    once. NaN, like an array that is left out, leaves the port as it is.

    Raises:
        ValueError: times do not increase, or shapes differ.
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

    def __len__(self) -> int:
        """Number of commands."""
        return len(self.time)

    def __iter__(self) -> Iterator[tuple[int, Command]]:
        """Times in ticks of 1e-12 s, and commands."""
        columns = [getattr(self, name) for name in NAMES]
        for n, time in enumerate(self.time):
            values = (None if column is None else _value(column[n]) for column in columns)
            yield round(float(time) * TICKS), Command(*values)


def _value(value: float) -> float | None:
    return None if math.isnan(value) else float(value)


def course_of(ticks: Sequence[int], given: Sequence[Command]) -> Commands:
    """The course of commands that were given at these times [ticks]."""
    columns = np.array(
        [[math.nan if value is None else value for value in command] for command in given],
        dtype=float,
    ).reshape(-1, len(NAMES))
    used = {
        name: column
        for name, column in zip(NAMES, columns.T, strict=True)
        if not np.isnan(column).all()
    }
    return Commands(np.array([tick / TICKS for tick in ticks]), **used)


class Action(NamedTuple):
    """A command of a course that begins to act."""

    ticks: int
    """Time from which it acts, in ticks of the clock."""
    command: Command
    """What is given."""
    reaching: float
    """Time in which its values are reached along straight lines [s]; 0: at once."""


def actions(commands: Commands, linear: bool) -> Iterator[Action]:
    """Actions of a course, in order of time.

    Args:
        commands: the course.
        linear: whether values are reached along straight lines, see `Commands`.

    Yields:
        The actions.
    """
    if not linear:
        yield from (Action(ticks, command, 0.0) for ticks, command in commands)
        return
    before = 0
    for ticks, command in commands:
        yield Action(before, command, (ticks - before) / TICKS)
        before = ticks
    yield Action(before, Command(), 0.0)  # the last values stay
