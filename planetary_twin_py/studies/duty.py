"""Duty cycle: operating points in time, from a table, and the energy that they lose.

Each row holds from its time to that of the next one, and its losses are those of steady running, so
the energy that accelerates the train is left out: it returns when the train slows.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..lifetime.duty_table import Duty, read_duty
from ..scene import OperatingPoint, Scene
from ..units.catalogue import MESH, SIDES
from .plan import MOST_POINTS, Point, Settings, Study

if TYPE_CHECKING:
    import pyarrow as pa

PEAKS = tuple(f"{side}_{name}" for side in SIDES for name in MESH if name.endswith("_peak"))


def study_of(duty: Duty, scene: Scene, settings: Settings) -> tuple[Study, np.ndarray]:
    """Distinct operating points of a duty cycle as a study, and the point of each row, (rows,).

    Raises:
        ValueError: a setting is out of range, or there are too many points.
    """
    settings.check()
    values = np.column_stack([*duty.columns.values()])
    distinct, place = np.unique(values, axis=0, return_inverse=True)
    if len(distinct) > MOST_POINTS:
        raise ValueError(f"{len(distinct)} points: must be at most {MOST_POINTS}")
    points = tuple(
        Point(k, dict(zip(duty.columns, row, strict=True)))
        for k, row in enumerate(distinct.tolist())
    )
    return Study(scene, tuple(duty.columns), points, settings), place.ravel()


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


def read_cycle(path: Path) -> Duty:
    """Read a duty cycle: a duty in time, with any quantities of the operating point.

    Args:
        path: see `read_duty`.

    Returns:
        The rows in SI.

    Raises:
        ValueError: see `read_duty`; or the table has no times.
        OSError: the file cannot be read.
    """
    duty = read_duty(path, OperatingPoint.model_fields)
    if duty.time is None:
        raise ValueError(f"{path}: column 'time': missing")
    return duty


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
    start = np.zeros(len(place)) if duty.time is None else duty.time
    figures = {name: table[name].to_numpy()[place] for name in names}
    driving = np.maximum(figures["input_power"], -figures["output_power"])
    peaks = {}
    for name in PEAKS:
        row = int(np.argmax(figures[name]))
        peaks[name] = (float(figures[name][row]), float(start[row]))
    return Summary(
        float(duty.held.sum()),
        float(np.maximum(driving, 0.0) @ duty.held),
        float(figures["power_loss"] @ duty.held),
        peaks,
    )
