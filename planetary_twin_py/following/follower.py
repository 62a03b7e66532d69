"""Estimates friction of a measured gearbox from torques and speeds, and its teeth from encoders."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.given import check_scene
from ..text.object_repr import brief
from ..units.conversion import LARGEST
from .arrival.clock_watch import ClockWatch
from .arrival.stamps import absolute_stamps
from .balance.follower import BalanceFollower
from .channels.all import CHANNELS, OIL
from .channels.encoders import EncoderFormat, EncoderSamples
from .channels.sampled import DEVICES, Samples
from .checks.checked_bins import PERIOD
from .damage.followed import FollowedDamage
from .devices.device import followed
from .readings import Readings
from .sensors import Sensors, check_scale
from .state import Following
from .teeth.baseline_file import SavedBaseline, read_baseline, write_baseline
from .vibration.support import with_support

Array = NDArray[np.float64]

TIMEOUT = 2.0  # [s] without readings, after which estimates are stale


@dataclass
class Follower:
    """Estimates the state of a gearbox as far as its readings determine it.

    The same readings in the same order give the same estimates to the last bit, however they are
    split into blocks: nothing depends on the clock of the computer. Only the order of the readings
    of each sender counts, as long as none lags behind another by 1 s.

    Args:
        scene: scene of the gearbox, with one input.
        sensors: accuracy of the sensors.
        encoders: format of the samples; None: the first samples state it, or there are none.
        scale: factors on the readings, by channel, for other units and signs; magnitudes of 1e-9
            to 1e9.
        period: length of the bins over which readings are averaged [s].
        durability: path of the file with the damage of the gearbox, which the readings continue,
            see `save_damage`; None: damage is not counted.

    Raises:
        SceneError: the scene has two inputs, or cannot be simulated, or damage is requested of a
            scene without its section `durability`.
        ValueError: a channel of `scale` does not exist, or its factor is out of range; the file is
            not the damage of this gear set.
        OSError: the file cannot be read.
    """

    scene: Scene
    sensors: Sensors = field(default_factory=Sensors)
    encoders: EncoderFormat | None = None
    scale: Mapping[str, float] = field(default_factory=dict)
    period: float = PERIOD
    durability: Path | None = None

    def __post_init__(self) -> None:
        check_scene(self.scene)
        check_scale(self.scale)
        if not 0.01 <= self.period <= 60.0:
            raise ValueError(f"period = {self.period!r} s: must be within 0.01 and 60")
        sensors = self.sensors.model_copy(update={"scale": dict(self.scale)})
        self._balance = BalanceFollower(self.scene, sensors, self.period)
        self.damage: FollowedDamage | None = None
        """Damage of the gearbox; None if it is not counted."""
        if self.durability is not None:
            self.damage = FollowedDamage(self.scene, sensors, Path(self.durability))
        self._clocks = ClockWatch()
        self._devices = {
            name: followed(name).follower(self.scene, self.sensors, self._balance)
            for name in DEVICES
        }
        if self.encoders is not None:
            none = np.zeros((0, 2), dtype=np.int64)
            self.add(EncoderSamples(none[:, 0], none, self.encoders))

    @property
    def time(self) -> float:
        """Stamp of the last reading that is used [s]; NaN before the first."""
        return self._balance.time

    @property
    def hunting_periods(self) -> int:
        """Hunting periods that have been judged."""
        return self._devices["encoders"].state().counters.get("hunting_periods", 0)

    def add(self, block: Readings | Samples) -> None:
        """Add readings or samples.

        Args:
            block: any number of readings or samples.

        Raises:
            InputError: readings contradict the scene; names channel, value and correction.
            ValueError: a channel is unknown, or samples have no format.
        """
        if isinstance(block, Readings):
            self._add_readings(block)
        else:
            self._devices[block.device].add(block)
        if math.isfinite(self._balance.time):
            for device in self._devices.values():
                device.judge(self._balance.time)

    def learn(self) -> None:
        """Forget the baselines of teeth and vibration and learn new ones, after a repair.

        Events and the torque balance remain.
        """
        for device in self._devices.values():
            device.learn()

    def save_baseline(self, path: Path) -> None:
        """Write the learned baselines of teeth and vibration.

        Args:
            path: path of the file.

        Raises:
            ValueError: nothing has been learned.
            OSError: the file cannot be written.
        """
        learned: dict[str, Any] = {}
        for device in self._devices.values():
            learned |= device.saved()
        write_baseline(path, self.scene, SavedBaseline(**learned))

    def load_baseline(self, path: Path) -> None:
        """Use saved baselines instead of learning.

        A baseline of teeth needs encoders whose counts, whole turns included, have continued. It is
        compared with the first hunting period, and not used if it belongs to another position.

        Args:
            path: path of a file of `save_baseline`.

        Raises:
            ValueError: the file is no baseline of this scene and of these sensors.
            OSError: the file cannot be read.
        """
        saved = read_baseline(path, self.scene)
        for device in self._devices.values():
            device.restore(saved)

    def save_damage(self) -> None:
        """Write the damage of the gearbox to its file, replacing that file as a whole.

        Raises:
            ValueError: damage is not counted, or another program has changed the file.
            OSError: the file cannot be written; the former one remains.
        """
        self._counted_damage().save()

    def replace_part(self, name: str) -> tuple[str, ...]:
        """Set the damage of a part that was replaced to 0, with an entry in the log of the file.

        Args:
            name: a part, such as "planet_2_bearing", or a gear, such as "planet_2", for its flanks
                and root.

        Returns:
            The parts.

        Raises:
            ValueError: damage is not counted, or there is no such part.
        """
        return self._counted_damage().replace_part(name)

    def _counted_damage(self) -> FollowedDamage:
        if self.damage is None:
            raise ValueError("durability = None: must be the path of a file, to count damage")
        return self.damage

    def finish(self) -> None:
        """Process the readings and samples that are held back, at the end of a recording.

        Raises:
            InputError: see `add`.
        """
        self._balance.finish()
        for device in self._devices.values():
            device.finish()

    def estimate(self, now: float | None = None) -> Following:
        """Return the estimated state of the gearbox.

        Args:
            now: present time by the clock of the stamps [s]; None: that of the last reading.

        Returns:
            Estimates, teeth, events and remarks.
        """
        return replace(self.estimate_alone(now), remarks=tuple(self._remarks()))

    def estimate_alone(self, now: float | None = None) -> Following:
        """Return the state without remarks and without damage, which take longer than the rest.

        Args:
            now: see `estimate`.

        Returns:
            Estimates, teeth and events.
        """
        balance = self._balance
        estimates, events = balance.estimates(), list(balance.events)
        counters = dict(vars(balance.counters), gated=balance.gated)
        judged, fields = {"torque balance": balance.innovation is not None}, dict[str, Any]()
        for shown in (device.state() for device in self._devices.values()):
            estimates, events = (*estimates, *shown.estimates), [*events, *shown.events]
            counters |= shown.counters
            judged |= shown.judged
            fields |= shown.fields
        if now is not None and not now - balance.time <= TIMEOUT:
            estimates = tuple(
                quantity._replace(status="STALE") if quantity.status == "ESTIMATED" else quantity
                for quantity in estimates
            )
        return Following(
            balance.time, estimates, counters=counters, remarks=(),
            events=tuple(sorted(with_support(events), key=lambda event: event.found)),
            operating=balance.operating, innovation=balance.innovation, scatter=balance.scatter,
            judged=judged, **fields,
        )  # fmt: skip

    def _add_readings(self, block: Readings) -> None:
        columns = {}
        for name, values in block.columns.items():
            if name not in CHANNELS:
                raise ValueError(f"{name!r}: must be one of {', '.join(CHANNELS)}")
            columns[name] = np.asarray(values, dtype=float) * self.scale.get(name, 1.0)
        time = np.array(block.time, dtype=float)
        time[~(np.abs(time) <= LARGEST)] = np.nan
        if block.arrival is not None and columns.keys() - {OIL}:  # an oil changes in seconds
            self._clocks.add(block.sender, time, np.asarray(block.arrival, dtype=float))
        self._balance.add(time, columns, block.sender)
        if self.damage is not None:  # not before the readings are known to fit the scene
            stamps = absolute_stamps(time, block.begin)
            self.damage.add(stamps, columns, self._torque_sd(block), block.sender)

    def _torque_sd(self, block: Readings) -> Array | None:
        """Standard deviations of the input torque within readings [N m], (n,)."""
        if block.torque_sd is None:
            return None
        factor = abs(self.scale.get("input_torque", 1.0))
        return np.asarray(block.torque_sd, dtype=float) * factor

    def _remarks(self) -> Iterator[str]:
        yield from self._balance.remarks()
        yield from self._clocks.remarks()
        for device in self._devices.values():
            yield from device.remarks()
        if self.damage is not None:
            yield from self.damage.remarks()

    def __repr__(self) -> str:
        """One line."""
        return brief(self, self.scene.name, f"period {self.period:g} s")
