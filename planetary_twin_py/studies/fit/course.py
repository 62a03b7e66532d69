"""Measurements of a manoeuvre: torques and speeds over time, averaged over bins."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...following.bins import CHANNELS
from ...following.measured_tables import read_readings
from ...following.train import FollowedTrain
from ...printable import one_line
from ...units import LARGEST

Array = NDArray[np.float64]

SUFFIXES = (".csv", ".parquet", ".mat")
PERIOD = 0.1  # [s] length of a bin
FEWEST = 20  # smallest number of bins of a fit
TIME = "time"
_LONGEST_REASON = 200  # characters


class Course(NamedTuple):
    """Means over the bins of a manoeuvre, (n,) each, in SI, with the signs of gearbox_state."""

    time: Array
    """Middle of each bin [s]."""
    input_torque: Array
    output_torque: Array
    speed: Array
    """Of the input."""
    acceleration: Array
    """Acceleration of the input [rad/s^2]."""
    oil_temperature: Array

    def between(self, begin: float, end: float) -> Course:
        """The bins from `begin` to `end` [s]."""
        inside = (self.time >= begin) & (self.time <= end)
        return Course(*(values[inside] for values in self))


def read_course(path: Path, train: FollowedTrain, period: float = PERIOD) -> Course:
    """Read a manoeuvre from a table or a MAT file.

    Args:
        path: a .csv or .parquet table with the columns time, input_torque, output_torque and
            input_speed or output_speed, with units in brackets unless they are SI; or a .mat file
            with vectors of these names, in SI.
        train: gear train of the gearbox.
        period: length of the bins [s].

    Returns:
        Means over the bins that have all channels.

    Raises:
        ValueError: the file has another format, a channel is missing, or there are too few bins.
        OSError: the file cannot be read.
    """
    time, columns = _read_mat(path) if path.suffix == ".mat" else read_readings(path, {})[0][:2]
    columns = dict(columns)
    if "input_speed" not in columns and "output_speed" in columns:
        columns["input_speed"] = columns["output_speed"] / train.ratio
    for name in ("input_torque", "output_torque", "input_speed"):
        if name not in columns:
            raise ValueError(f"{path}: column {name!r}: missing")
    oil = columns.setdefault("oil_temperature", np.full(len(time), train.oil_temperature))
    columns["oil_temperature"] = np.where(np.isfinite(oil), oil, train.oil_temperature)
    names = ("input_torque", "output_torque", "input_speed", "oil_temperature")
    values = np.stack([columns[name] for name in names])
    good = np.isfinite(values).all(axis=0) & np.isfinite(time)
    first = float(time[good].min()) if good.any() else 0.0
    filled, place = np.unique(np.floor((time[good] - first) / period), return_inverse=True)
    if len(filled) < FEWEST:
        raise ValueError(
            f"{path}: {len(filled)} bins of {period:g} s with all channels, must be at least "
            f"{FEWEST}"
        )
    count = np.bincount(place)
    means = np.stack([np.bincount(place, row) / count for row in values[:, good]])
    middles = np.asarray(first + (filled + 0.5) * period, dtype=float)
    acceleration = np.gradient(means[2], middles)
    slope = np.asarray(acceleration, dtype=float)
    return Course(middles, means[0], means[1], means[2], slope, means[3])


def _read_mat(path: Path) -> tuple[Array, dict[str, Array]]:
    from scipy.io import loadmat

    if path.exists() and not path.is_file():
        raise ValueError(f"{path}: must be a file")
    try:
        found = loadmat(path, squeeze_me=True, variable_names=(TIME, *CHANNELS))
    except Exception as reason:  # of many kinds, if the file is damaged
        if isinstance(reason, OSError) and reason.errno is not None:  # of the system
            raise
        line = one_line(str(reason) or type(reason).__name__, _LONGEST_REASON)
        raise ValueError(f"{path}: not a MAT file of version 4 to 7.2: {line}") from None
    if TIME not in found:
        raise ValueError(f"{path}: variable {TIME!r}: missing")
    vectors = {}
    for name in (TIME, *CHANNELS):
        if name in found:
            values = np.asarray(found[name])
            if values.dtype.kind not in "iuf":
                raise ValueError(f"{path}: {name}: must be a vector of real numbers")
            values = values.astype(float)
            if (np.abs(values[np.isfinite(values)]) > LARGEST).any():
                raise ValueError(f"{path}: {name}: magnitudes must be at most {LARGEST:.0e}")
            if values.ndim != 1 or len(values) != np.size(found[TIME]):
                raise ValueError(f"{path}: {name}: must be a vector as long as {TIME}")
            vectors[name] = values
    return vectors.pop(TIME), vectors
