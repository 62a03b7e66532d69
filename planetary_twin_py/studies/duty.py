"""Duty cycle: operating points in time, from a table, and the energy that they lose.

Each row holds from its time to that of the next one, and its losses are those of steady running, so
the energy that accelerates the train is left out: it returns when the train slows.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..recording.tables.measurements import TIME, Array, missing_column, read_columns
from ..scene import OperatingPoint, Scene
from ..scene.names import did_you_mean
from ..scene.quantity import unit_of
from ..units.catalogue import MESH, SIDES
from .plan import MOST_POINTS, Point, Settings, Study

if TYPE_CHECKING:
    import pyarrow as pa

NAMES = {"torque": "input_torque", "speed": "input_speed"}
"""Short names of columns."""
REQUIRED = tuple(NAMES.values())
PEAKS = tuple(f"{side}_{name}" for side in SIDES for name in MESH if name.endswith("_peak"))


class Duty(NamedTuple):
    """Rows of a duty cycle, without the last, which ends it."""

    time: Array
    """Start of each row [s], (rows,)."""
    held: Array
    """How long it holds [s], (rows,)."""
    columns: dict[str, Array]
    """Quantities of the operating point by name, in SI, (rows,) each."""

    def study(self, scene: Scene, settings: Settings) -> tuple[Study, np.ndarray]:
        """Distinct operating points as a study, and the point of each row, (rows,).

        Args:
            scene: the gearbox.
            settings: of the run at each point.

        Raises:
            ValueError: a setting is out of range, or there are too many points.
        """
        settings.check()
        values = np.column_stack([*self.columns.values()])
        distinct, place = np.unique(values, axis=0, return_inverse=True)
        if len(distinct) > MOST_POINTS:
            raise ValueError(f"{len(distinct)} points: must be at most {MOST_POINTS}")
        points = tuple(
            Point(k, dict(zip(self.columns, row, strict=True)))
            for k, row in enumerate(distinct.tolist())
        )
        return Study(scene, tuple(self.columns), points, settings), place.ravel()


class Summary(NamedTuple):
    """What a duty cycle costs, and its peaks."""

    duration: float
    """[s]"""
    driving_energy: float
    """Of the machines that drive [J]."""
    loss_energy: float
    """Of tooth friction, bearings, seals and churning [J]."""
    peaks: dict[str, tuple[float, float]]
    """Largest value in SI and the start of its row [s], by the names of `PEAKS`."""

    @property
    def efficiency(self) -> float:
        """1 - lost energy/driving energy; NaN without driving energy."""
        return 1.0 - self.loss_energy / self.driving_energy if self.driving_energy else math.nan


def read_duty(path: Path) -> Duty:
    """Read a duty cycle.

    Args:
        path: table with the columns `time`, `torque` and `speed` of the first motor, and others by
            the names of `OperatingPoint`; units in the headings, such as `speed [rpm]`, or SI. Each
            row holds up to the time of the next one; the last row only ends the cycle.

    Returns:
        The rows in SI.

    Raises:
        ValueError: a column is missing or unknown, a value is missing, or times do not increase.
        OSError: the file cannot be read.
    """
    table = {NAMES.get(name, name): column for name, column in read_columns(path).items()}
    known = OperatingPoint.model_fields
    for name, column in table.items():
        if name not in (TIME[0], *known):
            near = did_you_mean(name, [TIME[0], *NAMES, *known])
            expected = near or f"; must be {TIME[0]} or one of {', '.join((*NAMES, *known))}"
            raise ValueError(f"{path}: column {column.heading!r}: no such quantity{expected}")
    for name in (TIME[0], *REQUIRED):
        if name not in table:
            raise missing_column(path, name, table)
    columns = {
        name: column.in_si(name, "s" if name == TIME[0] else unit_of(known[name]) or "")
        for name, column in table.items()
    }
    for name, values in columns.items():
        for row in np.flatnonzero(~np.isfinite(values))[:1]:
            raise ValueError(f"{path}: row {row + 1}: {name} is missing")
    time = columns.pop(TIME[0])
    if len(time) < 2:
        raise ValueError(f"{path}: must have two rows or more: the last one ends the cycle")
    held = np.diff(time)
    for row in np.flatnonzero(held <= 0.0)[:1]:
        raise ValueError(f"{path}: row {row + 2}: time = {time[row + 1]:g} s: must increase")
    return Duty(time[:-1], held, {name: values[:-1] for name, values in columns.items()})


def summary_of_duty(duty: Duty, place: np.ndarray, table: pa.Table) -> Summary:
    """Sum the results of the operating points over a duty cycle.

    Args:
        duty: the rows.
        place: operating point of each row, (rows,).
        table: results of all operating points.

    Returns:
        Energies and peaks.

    Raises:
        ValueError: a point failed, so sums would lack its time.
    """
    reasons = table["failure"].to_pylist()
    failed = np.array([reason is not None for reason in reasons])
    if failed.any():
        lost = float(duty.held[failed[place]].sum())
        first = next(reason for reason in reasons if reason is not None)
        raise ValueError(
            f"{int(failed.sum())} of {len(failed)} operating points failed, which hold for "
            f"{lost:g} s: there are no sums without them; the first: {first}"
        )
    names = ("input_power", "output_power", "power_loss", *PEAKS)
    figures = {name: table[name].to_numpy()[place] for name in names}
    driving = np.maximum(figures["input_power"], -figures["output_power"])
    peaks = {}
    for name in PEAKS:
        row = int(np.argmax(figures[name]))
        peaks[name] = (float(figures[name][row]), float(duty.time[row]))
    return Summary(
        float(duty.held.sum()),
        float(np.maximum(driving, 0.0) @ duty.held),
        float(figures["power_loss"] @ duty.held),
        peaks,
    )
