"""The two timelines of all views: simulated time and ROS time."""

from __future__ import annotations

import numpy as np
import rerun as rr
from numpy.typing import NDArray

SIMULATED_TIME = "simulated_time"
ROS_TIME = "ros_time"


def columns(time: NDArray[np.float64], stamp: NDArray[np.int64]) -> list[rr.TimeColumn]:
    """Time columns for `rr.send_columns`: `time` [s] simulated, `stamp` [ns since the epoch]."""
    simulated = np.rint(time * 1e9).astype("timedelta64[ns]")
    return [
        rr.TimeColumn(SIMULATED_TIME, duration=simulated),
        rr.TimeColumn(ROS_TIME, timestamp=stamp.astype("datetime64[ns]")),
    ]
