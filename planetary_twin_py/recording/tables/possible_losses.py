"""Recognises losses that no gearbox has: negative ones, and those above the input power."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene

Array = NDArray[np.float64]

CERTAIN = 4.0  # standard errors by which a mean must be out of range
MEASURED = "power_loss", "efficiency", "input_power"


class ImpossibleLoss(NamedTuple):
    """A row that contradicts the balance of power."""

    row: int
    """Index of the row."""
    statement: str
    """Name, value and range."""


def impossible_loss(columns: Mapping[str, Array], scene: Scene) -> ImpossibleLoss | None:
    """The first impossible loss among the rows of one operating point.

    Single rows are compared with the input power; noise may make single losses negative, so the
    sign of the mean counts.

    Args:
        columns: measured values of `MEASURED` in SI, (rows,) each; NaN where they are missing.
        scene: scene at the operating point.

    Returns:
        The row, or None.
    """
    if "power_loss" in columns:
        loss, power = columns["power_loss"], _input_power(columns, scene)
        for row in np.flatnonzero((power > 0.0) & (loss > power))[:1]:
            return ImpossibleLoss(
                int(row),
                f"power_loss = {loss[row]:.6g} W: must be below the input power, "
                f"{power[row]:.6g} W; is a unit wrong?",
            )
        if (mean := _certain_mean(loss)) is not None and mean < 0.0:
            return ImpossibleLoss(
                0, f"power_loss is {mean:.4g} W on average: must not be negative; is a sign wrong?"
            )
    efficiency = columns.get("efficiency", np.empty(0))
    for row in np.flatnonzero(efficiency < 0.0)[:1]:
        return ImpossibleLoss(
            int(row),
            f"efficiency = {efficiency[row]:.4g}: must be at least 0: the loss exceeds the input "
            "power",
        )
    if (mean := _certain_mean(efficiency - 1.0)) is not None and mean > 0.0:
        return ImpossibleLoss(
            0,
            f"efficiency is {1.0 + mean:.4g} on average: must be at most 1; the heading of a "
            "column in per cent must be efficiency [%]",
        )
    return None


def _input_power(columns: Mapping[str, Array], scene: Scene) -> Array:
    """Power into the train [W], (rows,): measured, or of the operating point; NaN if unknown."""
    point, rows = scene.operating_point, len(columns["power_loss"])
    known = scene.drive.second_input is None
    usual = np.full(rows, point.input_torque * point.input_speed if known else math.nan)
    measured = columns.get("input_power", np.full(rows, math.nan))
    return np.where(np.isfinite(measured), measured, usual)


def _certain_mean(values: Array) -> float | None:
    """Mean of the known values; None if its sign is not certain."""
    values = values[np.isfinite(values)]
    if not len(values):
        return None
    mean, error = float(values.mean()), float(values.std()) / math.sqrt(len(values))
    return mean if abs(mean) > CERTAIN * error else None
