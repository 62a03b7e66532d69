"""Readings of torques, speeds and temperature, in the order of their arrival."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Readings(NamedTuple):
    """Torques, speeds and temperature, in the order of their arrival."""

    time: Array
    """Stamps [s], (n,)."""
    columns: Mapping[str, Array]
    """Readings by channel, (n,) each in SI: input_speed, input_torque, output_speed, output_torque
    and oil_temperature, with the signs of gearbox_state; NaN where a reading is missing."""
    arrival: Array | None = None
    """Times of arrival by the receiver's clock [s], (n,); None if unknown."""
    sender: str = "readings"
    """Name of the device whose clock made the stamps."""
    torque_sd: Array | None = None
    """Standard deviations of the input torque within each reading [N m], (n,); None if unknown.
    Only damage needs them."""
    begin: float = 0.0
    """Second 0 of the stamps, from 1970 [s], of a table with dates: they count from its first."""

    def part(self, rows: slice | NDArray[Any]) -> Readings:
        """Some rows, or all in another order."""
        return self._replace(
            time=self.time[rows],
            columns={name: values[rows] for name, values in self.columns.items()},
            arrival=None if self.arrival is None else self.arrival[rows],
            torque_sd=None if self.torque_sd is None else self.torque_sd[rows],
        )
