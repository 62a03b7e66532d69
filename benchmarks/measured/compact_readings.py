"""Figures of the COMPAct rig that are computed from its readings, see tests/data/compact.

The rig's motor turns at up to 10 rpm of the output, up and down again, so its speed is taken by
angle (computed order tracking, Fyfe and Munck 1997): the spectrum of one run has a resolution of a
quarter of an order. Runs at 18 torques are averaged.
"""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pyarrow import parquet

RIG = Path(__file__).parents[2] / "tests/data/compact"
RATE = 100.0  # [Hz] of the speeds
SMOOTHED = 51  # samples of a mean speed
TREND = 25  # samples of the mean that is taken off the speed
FASTEST, SLOWEST = 17.0, 2.0  # [rpm]: 155 lines per turn stay below half the sample rate
NEAR = 0.4  # orders within which the largest value is a line
ORDERS = 142.0, 168.0  # cycles per turn of the output
BETWEEN = 0.02  # orders from one value to the next


class MeasuredLine(NamedTuple):
    """A line of the averaged spectrum of the motor speed."""

    order: float
    """Cycles per turn of the output."""
    height: float
    """Over the median of all orders."""


def measured_line(expected: float) -> MeasuredLine:
    """The largest value near an order.

    Args:
        expected: cycles per turn of the output.

    Returns:
        The line.
    """
    order, height = _spectrum()
    near = np.abs(order - expected) < NEAR
    best = int(np.argmax(height[near]))
    return MeasuredLine(float(order[near][best]), float(height[near][best]))


def highest_between() -> float:
    """Height of the highest of some values where neither gears nor motor cause a line."""
    return max(measured_line(place).height for place in (145.0, 160.0, 165.0))


@cache
def _spectrum() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    table = parquet.read_table(RIG / "speed.parquet")
    order = np.arange(*ORDERS, BETWEEN)
    squares = [_of_run(np.asarray(column, dtype=float), order) ** 2 for column in table.columns]
    return order, np.sqrt(np.mean(squares, axis=0))


def _of_run(speed: NDArray[np.float64], order: NDArray[np.float64]) -> NDArray[np.float64]:
    """Amplitude over its median, of a Fourier transform over the angle of the output."""
    mean = np.convolve(speed, np.ones(SMOOTHED) / SMOOTHED, "same")
    used = np.flatnonzero((mean > SLOWEST) & (mean < FASTEST))
    turns = np.cumsum(np.maximum(mean, 0.0)) / 60.0 / RATE
    part = (turns[used] - turns[used[0]]) / (turns[used[-1]] - turns[used[0]])
    window = np.sin(math.pi * part) ** 2 * np.gradient(turns)[used]
    signal = (speed - np.convolve(speed, np.ones(TREND) / TREND, "same"))[used] * window
    found = np.abs(np.exp(-2j * math.pi * np.outer(order, turns[used])) @ signal)
    return np.asarray(found / np.median(found))
