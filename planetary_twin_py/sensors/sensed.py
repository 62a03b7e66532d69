"""What sensors are given, and what they read."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Sensed(NamedTuple):
    """Consecutive samples of the motion and the loads of a gearbox, at the rate of a bank."""

    first: int
    """Number of the first sample since time 0."""
    angle: Array
    """Absolute angles of the reported bodies [rad], (samples, bodies)."""
    speed: Array
    """Their absolute speeds [rad/s], (samples, bodies)."""
    mesh_force: Array
    """Normal forces of the meshes, negative on coast flanks [N], (samples, meshes)."""
    torque: Array
    """Torques of the machines on their shafts [N m], (samples, machines)."""
    displacement: Array | None
    """Displacements of the axes as in `AxesMotion.displacement` [m], (samples, bearings, 2); None
    where axes are held."""
    oil_temperature: Array | float
    """Temperature of the oil [K], (samples,), or one for all."""

    @property
    def end(self) -> int:
        """Number of the sample after the last one."""
        return self.first + len(self.angle)

    def part(self, begin: int, end: int) -> Sensed:
        """The samples with the numbers from `begin` on, before `end`."""
        rows = slice(begin - self.first, end - self.first)
        fields = self._asdict().items()
        arrays: dict[str, Any] = {n: v[rows] for n, v in fields if isinstance(v, np.ndarray)}
        return self._replace(first=begin)._replace(**arrays)


def joined_samples(parts: Sequence[Sensed]) -> Sensed:
    """Consecutive samples as one, of which there is at least one part."""
    first, *rest = zip(*parts, strict=True)
    return Sensed(first[0], *(_joined(values, parts) for values in rest))


def _joined(values: Sequence[Any], parts: Sequence[Sensed]) -> Any:
    """Values of a field of consecutive samples: arrays, the same for all, or none."""
    if all(not isinstance(value, np.ndarray) and value == values[0] for value in values):
        return values[0]
    whole = zip(values, parts, strict=True)
    return np.concatenate(
        [
            value if isinstance(value, np.ndarray) else np.full(len(part.angle), value)
            for value, part in whole
        ]
    )


class Readings(NamedTuple):
    """What a sensor reads."""

    name: str
    """Name of the sensor."""
    kind: str
    """Kind of the sensor, e.g. "accelerometer"."""
    unit: str
    """SI unit of the values; "counts" of an encoder."""
    first: float
    """Time of the first value [s]."""
    period: float
    """Time between two values [s]; 0 for a tachometer."""
    values: NDArray[Any]
    """Values, (n,): of an encoder whole counts since angle 0, of a tachometer times of pulses
    [s]."""
    clipped: int
    """Number of values beyond the range of the sensor."""
    aliases: float = 0.0
    """Estimate of the largest alias over the largest line, see `alias_share`; only in the readings
    of an accelerometer at the end of a run, or once in a run without end, else 0."""

    @property
    def time(self) -> Array:
        """Time of each value [s], (n,)."""
        if not self.period:
            return np.asarray(self.values, dtype=np.float64)
        return np.asarray(self.first + self.period * np.arange(len(self.values)))


def joined_readings(parts: Sequence[Readings]) -> Readings:
    """Consecutive readings of a sensor as one, of which there is at least one part."""
    filled = [part for part in parts if len(part.values)] or [parts[0]]
    return filled[0]._replace(
        values=np.concatenate([part.values for part in filled]),
        clipped=sum(part.clipped for part in parts),
        aliases=max(part.aliases for part in parts),
    )
