"""Measurements of a manoeuvre: torques and speeds over time, averaged over bins."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...following.measured.tables import read_readings
from ...following.sensors import Sensors, check_scale
from ...following.train import FollowedTrain

Array = NDArray[np.float64]

PERIOD = 0.1  # [s] length of a bin
FEWEST = 20  # smallest number of bins of a fit


class Course(NamedTuple):
    """Means over the bins of a manoeuvre, (n,) each, in SI, with the signs of gearbox_state."""

    time: Array
    """Middle of each bin [s]."""
    input_torque: Array
    output_torque: Array
    speed: Array
    """Speed of the input [rad/s]."""
    acceleration: Array
    """Acceleration of the input [rad/s^2]."""
    oil_temperature: Array

    def between(self, begin: float, end: float) -> Course:
        """The bins from `begin` to `end` [s]."""
        inside = (self.time >= begin) & (self.time <= end)
        return Course(*(values[inside] for values in self))


def read_course(
    path: Path,
    train: FollowedTrain,
    sensors: Sensors | None = None,
    check: Callable[[Array, Mapping[str, Array]], Mapping[str, Array]] = lambda _, columns: columns,
) -> Course:
    """Read a manoeuvre from a table.

    Args:
        path: path of a .csv, .parquet or .mat table with the columns time, input_torque,
            output_torque and input_speed or output_speed, with units in brackets unless they are
            SI.
        train: gear train of the gearbox.
        sensors: headings of columns, and factors on readings; None: those of the table, and 1.
        check: called with stamps [s] and readings by channel before they are averaged, (rows,) each
            in SI; returns them with NaN where one is left out, or raises `ValueError`.

    Returns:
        Means over the bins that have all channels.

    Raises:
        ValueError: the file has another format, a channel is missing, `check` refuses the readings,
            or there are too few bins.
        OSError: the file cannot be read.
    """
    known = sensors or Sensors()
    check_scale(known.scale)
    read = read_readings(path, known.columns).readings
    time = read.time
    columns = {name: values * known.scale.get(name, 1.0) for name, values in read.columns.items()}
    for name in ("input_torque", "output_torque"):
        if name not in columns:
            raise ValueError(f"{path}: column {name!r}: missing")
    columns = dict(check(time, columns))
    if "input_speed" not in columns and "output_speed" in columns:
        columns["input_speed"] = columns["output_speed"] / train.ratio
    if "input_speed" not in columns:
        raise ValueError(f"{path}: column 'input_speed': missing")
    oil = columns.setdefault("oil_temperature", np.full(len(time), train.oil_temperature))
    columns["oil_temperature"] = np.where(np.isfinite(oil), oil, train.oil_temperature)
    names = ("input_torque", "output_torque", "input_speed", "oil_temperature")
    values = np.stack([columns[name] for name in names])
    complete = np.isfinite(values).all(axis=0) & np.isfinite(time)
    first = float(time[complete].min()) if complete.any() else 0.0
    bin_numbers, bin_index = np.unique(
        np.floor((time[complete] - first) / PERIOD), return_inverse=True
    )
    if len(bin_numbers) < FEWEST:
        raise ValueError(
            f"{path}: {len(bin_numbers)} bins of {PERIOD:g} s with all channels, must be at least "
            f"{FEWEST}"
        )
    count = np.bincount(bin_index)
    means = np.stack([np.bincount(bin_index, row) / count for row in values[:, complete]])
    middles = np.asarray(first + (bin_numbers + 0.5) * PERIOD, dtype=float)
    acceleration = np.gradient(means[2], middles)
    slope = np.asarray(acceleration, dtype=float)
    return Course(middles, means[0], means[1], means[2], slope, means[3])
