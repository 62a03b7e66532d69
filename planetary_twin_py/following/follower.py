"""Estimates friction of a measured gearbox from torques and speeds, and its teeth from encoders."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

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
from .channels.sampled import Samples
from .channels.vibration import VibrationSamples
from .checks.checked_bins import PERIOD
from .damage.followed import FollowedDamage
from .encoders import EncoderFollower
from .input_error import InputError
from .readings import Readings
from .sensors import Sensors, check_scale
from .state import Following
from .teeth.baseline_file import SavedBaseline, TeethBaseline, read_baseline, write_baseline
from .teeth.follower import TeethFollower
from .vibration.devices import VibrationDevices
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
        self._loaded: TeethBaseline | None = None  # for samples that have not arrived yet
        sensors = self.sensors.model_copy(update={"scale": dict(self.scale)})
        self._balance = BalanceFollower(self.scene, sensors, self.period)
        self.damage: FollowedDamage | None = None
        """Damage of the gearbox; None if it is not counted."""
        if self.durability is not None:
            self.damage = FollowedDamage(self.scene, sensors, Path(self.durability))
        self._clocks = ClockWatch()
        self._encoder_follower: EncoderFollower | None = None
        self._vibration = VibrationDevices(self.sensors, self._balance)
        if self.encoders is not None:
            self._follow_encoders(self.encoders)

    @property
    def time(self) -> float:
        """Stamp of the last reading that is used [s]; NaN before the first."""
        return self._balance.time

    @property
    def _teeth(self) -> TeethFollower | None:
        return None if self._encoder_follower is None else self._encoder_follower.teeth

    @property
    def hunting_periods(self) -> int:
        """Hunting periods that have been judged."""
        return 0 if self._teeth is None else self._teeth.blocks

    def add(self, block: Readings | Samples) -> None:
        """Add readings or samples.

        Args:
            block: any number of readings or samples.

        Raises:
            InputError: readings contradict the scene; names channel, value and correction.
            ValueError: a channel is unknown, or samples have no format.
        """
        if isinstance(block, EncoderSamples):
            self._encoders_of(block).add(block)
        elif isinstance(block, VibrationSamples):
            self._vibration.add(block)
        else:
            self._add_readings(block)
        if math.isfinite(self._balance.time):
            if self._encoder_follower is not None:
                self._encoder_follower.judge(self._balance.time)
            self._vibration.judge(self._balance.time)

    def _encoders_of(self, block: EncoderSamples) -> EncoderFollower:
        """Return the follower of the encoders, with the format that the first samples state."""
        follower = self._encoder_follower
        if follower is None:
            if block.format is None:
                raise ValueError("encoders: their counts per turn and their period are missing")
            self.encoders = block.format
            follower = self._follow_encoders(block.format)
            if self._loaded is not None:
                follower.teeth.restore(self._loaded)
        if block.format not in (None, self.encoders):
            raise InputError(f"encoders: {block.format}: must be {self.encoders} as before")
        return follower

    def _follow_encoders(self, encoders: EncoderFormat) -> EncoderFollower:
        learning = self.sensors.learning
        self._encoder_follower = EncoderFollower(self.scene, encoders, learning, self._balance)
        return self._encoder_follower

    def learn(self) -> None:
        """Forget the baselines of teeth and vibration and learn new ones, after a repair.

        Events and the torque balance remain.
        """
        self._loaded = None
        if self._teeth is not None:
            self._teeth.learn()
        self._vibration.learn()

    def save_baseline(self, path: Path) -> None:
        """Write the learned baselines of teeth and vibration.

        Args:
            path: path of the file.

        Raises:
            ValueError: nothing has been learned.
            OSError: the file cannot be written.
        """
        teeth = None if self._teeth is None else self._teeth.saved
        write_baseline(path, self.scene, SavedBaseline(teeth, self._vibration.saved))

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
        self._loaded, vibration = read_baseline(path, self.scene)
        if self._teeth is not None and self._loaded is not None:
            self._teeth.restore(self._loaded)
        self._vibration.restore(vibration)

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
        if self._encoder_follower is not None:
            self._encoder_follower.finish()
        if math.isfinite(self._balance.time):
            self._vibration.judge(self._balance.time)

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
        balance, teeth = self._balance, self._teeth
        estimates, events = balance.estimates(), list(balance.events)
        counters = dict(vars(balance.counters), gated=balance.gated)
        if teeth is not None:
            estimates = (*estimates, *teeth.estimates())
            events += teeth.events
            counters |= {f"encoder_{name}": n for name, n in vars(teeth.counters).items()}
            counters["hunting_periods"] = teeth.blocks
        counters |= {f"vibration_{name}": n for name, n in self._vibration.counters.items()}
        if now is not None and not now - balance.time <= TIMEOUT:
            estimates = tuple(
                quantity._replace(status="STALE") if quantity.status == "ESTIMATED" else quantity
                for quantity in estimates
            )
        events = with_support(events, self._vibration.events)
        return Following(
            balance.time, estimates, () if teeth is None else teeth.teeth,
            tuple(sorted(events, key=lambda event: event.found)), counters, (),
            balance.operating, balance.innovation, balance.scatter,
            () if teeth is None else teeth.every_z, () if teeth is None else teeth.cells,
            self._judged(),
        )  # fmt: skip

    def _judged(self) -> dict[str, bool]:
        """Whether a change could have been found, by what is measured."""
        judged = {"torque balance": self._balance.innovation is not None}
        if self._teeth is not None:
            judged["teeth"] = self._teeth.compared > 0
        if self._vibration:
            judged["vibration"] = self._vibration.judged
        return judged

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
        if self._encoder_follower is not None:
            yield from self._encoder_follower.remarks()
        yield from self._vibration.remarks()
        if self.damage is not None:
            yield from self.damage.remarks()

    def __repr__(self) -> str:
        """One line."""
        return brief(self, self.scene.name, f"period {self.period:g} s")
