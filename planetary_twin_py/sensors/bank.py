"""All sensors of a scene, read while a gearbox runs."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..model.layout import Layout
from ..scene.sensors import (
    Accelerometer,
    AnySensor,
    Encoder,
    Proximity,
    Tachometer,
    Torque,
)  # fmt: skip
from ..scene.sensors.rules import sensing_rate
from .accelerometer import accelerometer
from .aliases import alias_share, mean_force
from .encoder import EncoderReader
from .proximity import proximity
from .reader import Reader, Sampling
from .sensed import Readings, Sensed, joined_readings, joined_samples
from .tachometer import TachometerReader
from .thermometer import ThermometerReader
from .torque import torque

BLOCK = 0.02  # [s] of samples that are read at once
RECENT, READINGS = 0.4, 1000  # [s] or readings, at least, from which aliases are estimated


class SensorBank:
    """Reads sensors from the samples of a run, as they arrive.

    Samples are read in blocks whose limits are multiples of the length of a block since time 0, so
    the readings do not depend, to the bit, on how many samples are fed at once.

    Args:
        layout: the gearbox.
        sensors: the sensors; default: those of its scene.
        rate: of the samples [Hz], a multiple of the rates of the sensors; default: the lowest that
            they need, see `sensing_rate`.
        mean_force: mean forces of the ring meshes over all samples [N], (planets,), if they are
            known; default: a filter follows them.
        endless: whether the run has no end at which aliases are estimated: then they are once, as
            soon as the samples of twice the time that an estimate needs are read.
    """

    def __init__(
        self,
        layout: Layout,
        sensors: Sequence[AnySensor] | None = None,
        rate: float | None = None,
        mean_force: NDArray[np.float64] | None = None,
        *,
        endless: bool = False,
    ) -> None:
        self._sensors = tuple(layout.scene.sensors if sensors is None else sensors)
        self._layout, self._mean_force = layout, mean_force
        self.rate = sensing_rate(self._sensors) if rate is None else rate
        """Rate of the samples [Hz]."""
        self._length = math.ceil(BLOCK * self.rate)
        self._readers: list[Reader] = []
        self._waiting: list[Sensed] = []
        kept = math.ceil(self._recent_time / BLOCK)
        self._recent: deque[Sensed] = deque(maxlen=kept)
        self._unjudged = 2 * kept if endless else 0  # blocks until aliases are estimated

    @property
    def _recent_time(self) -> float:
        """Time from whose samples aliases are estimated [s]."""
        rates = [sensor.rate for sensor in self._sensors if isinstance(sensor, Accelerometer)]
        return max(RECENT, READINGS / min(rates)) if rates else BLOCK

    def feed(self, sensed: Sensed) -> tuple[Readings, ...]:
        """Read sensors from samples that follow those before.

        Args:
            sensed: the samples, of any number.

        Returns:
            Readings of each sensor that are complete, in the order of the sensors; those of a
            sensor may be without values.
        """
        if not self._readers:
            samples = Sampling(self._layout, self.rate, sensed.first, self._mean_force)
            self._readers = [_reader(sensor, samples) for sensor in self._sensors]
        self._waiting.append(sensed)
        first, end = self._waiting[0].first, sensed.end
        limits = [first, *range((first // self._length + 1) * self._length, end + 1, self._length)]
        if len(limits) == 1:
            return self._read([])
        whole = joined_samples(self._waiting)
        self._waiting = [whole.part(limits[-1], end)]
        blocks = (whole.part(*pair) for pair in pairwise(limits))
        return self._read([(block, len(block.angle)) for block in blocks])

    def end(self) -> tuple[Readings, ...]:
        """Read sensors from the samples that no block contains yet; nothing can be fed afterwards.

        Returns:
            Readings, see `feed`, with estimates of their aliases.
        """
        if not self._waiting:
            return ()
        rest = joined_samples(self._waiting)
        count, missing = len(rest.angle), self._length - len(rest.angle)
        blocks = []
        if count:
            last = rest.part(rest.end - 1, rest.end)
            blocks = [(joined_samples([rest, *[last] * missing]), count)]
        sensed = joined_samples([*self._recent, rest])
        return self._with_aliases(self._read(blocks), sensed)

    def _with_aliases(self, found: Sequence[Readings], sensed: Sensed) -> tuple[Readings, ...]:
        """Readings with estimates of their aliases."""
        shares = (self._alias_share(sensor, sensed) for sensor in self._sensors)
        return tuple(one._replace(aliases=share) for one, share in zip(found, shares, strict=True))

    def _alias_share(self, sensor: AnySensor, sensed: Sensed) -> float:
        if not isinstance(sensor, Accelerometer):
            return 0.0
        force = mean_force(sensed, self._layout.scene.gearset.planets)
        return alias_share(sensor, Sampling(self._layout, self.rate, sensed.first, force), sensed)

    def _read(self, blocks: Sequence[tuple[Sensed, int]]) -> tuple[Readings, ...]:
        """Readings of blocks, each with the number of its first samples that are valid."""
        self._recent.extend(block for block, _ in blocks)
        found = [[reader.read(*block) for block in blocks] for reader in self._readers]
        if not blocks:
            return tuple(reader.empty for reader in self._readers)
        whole = tuple(map(joined_readings, found))
        before, self._unjudged = self._unjudged, max(self._unjudged - len(blocks), 0)
        if before and not self._unjudged:
            return self._with_aliases(whole, joined_samples(self._recent))
        return whole


def _reader(sensor: AnySensor, samples: Sampling) -> Reader:
    """What reads a sensor."""
    if isinstance(sensor, Accelerometer):
        return accelerometer(sensor, samples)
    if isinstance(sensor, Encoder):
        return EncoderReader(sensor, samples)
    if isinstance(sensor, Tachometer):
        return TachometerReader(sensor, samples)
    if isinstance(sensor, Torque):
        return torque(sensor, samples)
    if isinstance(sensor, Proximity):
        return proximity(sensor, samples)
    return ThermometerReader(sensor, samples)
