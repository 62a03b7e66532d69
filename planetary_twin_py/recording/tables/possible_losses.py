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
FEWEST = 3  # rows of an operating point whose scatter shows the error of their mean
ACCURACY = 0.002  # of the input power: errors of power analysers and torque sensors
EXCESS = 0.15  # of the input power, by which a single row must be out of range
MEASURED = "power_loss", "efficiency", "input_power"


class ImpossibleLoss(NamedTuple):
    """A row that contradicts the balance of power."""

    row: int
    """Index of the row."""
    statement: str
    """Name, value and range."""


def impossible_loss(columns: Mapping[str, Array], scene: Scene) -> ImpossibleLoss | None:
    """The first impossible loss among the rows of one operating point.

    Noise may put single rows out of range, and loss and input power are equal without load, so the
    mean of several rows counts, or a row that is far out of range.

    Args:
        columns: measured values of `MEASURED` in SI, (rows,) each; NaN where they are missing.
        scene: scene at the operating point.

    Returns:
        The row, or None.
    """
    if "power_loss" in columns:
        loss, power = columns["power_loss"], _input_power(columns, scene)
        driven = np.where(power > 0.0, power, math.nan)
        if (row := _exceeding((loss - driven) / driven)) is not None:
            return ImpossibleLoss(
                row,
                f"power_loss = {loss[row]:.6g} W: must be below the input power, "
                f"{power[row]:.6g} W; is a unit wrong?",
            )
        if (row := _exceeding(-loss / np.abs(power))) is not None:
            return ImpossibleLoss(
                row,
                f"power_loss = {loss[row]:.6g} W: must not be negative on average; is a sign "
                "wrong?",
            )
    efficiency = columns.get("efficiency", np.empty(0))
    if (row := _exceeding(-efficiency)) is not None:
        return ImpossibleLoss(
            row,
            f"efficiency = {efficiency[row]:.6g}: must be at least 0: the loss exceeds the input "
            "power",
        )
    if (row := _exceeding(efficiency - 1.0)) is not None:
        return ImpossibleLoss(
            row,
            f"efficiency = {efficiency[row]:.6g}: must be at most 1 on average; the heading of a "
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


def _exceeding(excess: Array) -> int | None:
    """Index of the row that is farthest out of range; None if noise may explain all rows.

    Args:
        excess: amounts by which rows are out of range, relative to the input power, (rows,);
            negative in range, NaN if unknown.
    """
    known = excess[np.isfinite(excess)]
    if not len(known):
        return None
    certain = len(known) >= FEWEST and known.mean() > ACCURACY + CERTAIN * float(
        known.std(ddof=1)
    ) / math.sqrt(len(known))
    return int(np.nanargmax(excess)) if certain or known.max() > EXCESS else None
