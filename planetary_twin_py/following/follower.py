"""Estimates friction of a measured gearbox from torques and speeds, and its teeth from encoders."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..scene import Scene
from ..scene.given import check_scene
from ..text.object_repr import brief
from ..units.conversion import LARGEST
from .arrival.clock_watch import ClockWatch
from .arrival.stamps import absolute_stamps
from .balance.filter import Innovation
from .balance.follower import BalanceFollower
from .channels.all import CHANNELS, OIL
from .channels.encoders import EncoderFormat, EncoderSamples
from .channels.sampled import Samples
from .channels.vibration import VibrationSamples
from .checks.checked_bins import PERIOD
from .checks.encoder_speed import EncoderSpeed
from .checks.sample_check import CountCheck
from .checks.whole_turns import WholeTurns
from .damage.followed import FollowedDamage
from .estimate import Estimate, Event
from .input_error import InputError
from .sensors import Sensors, check_scale
from .teeth.baseline import LearnedCell
from .teeth.baseline_file import SavedBaseline, read_baseline, write_baseline
from .teeth.changed import ToothState
from .teeth.follower import TeethFollower
from .vibration.follower import VibrationFollower
from .vibration.heard import with_heard

Array = NDArray[np.float64]

TIMEOUT = 2.0  # [s] without readings, after which estimates are stale


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


@dataclass(frozen=True)
class Following:
    """Estimated state of a gearbox at one time."""

    time: float
    """Stamp of the last reading that is used [s]; NaN before the first."""
    estimates: tuple[Estimate, ...]
    """Estimates of all quantities, each with its interval or status."""
    teeth: tuple[ToothState, ...]
    """Teeth that have changed."""
    events: tuple[Event, ...]
    """Changes, in the order of their detection."""
    counters: dict[str, int]
    """Numbers of readings and samples that were not used, by reason, and of hunting periods."""
    remarks: tuple[str, ...]
    """Reasons why the estimates are less certain than their intervals."""
    operating: tuple[float, float]
    """Speed of the input [rad/s], NaN before one is measured, and oil temperature [K]."""
    innovation: Innovation | None
    """Innovation of the last bin; None before a bin has both torques and a speed."""
    scatter: float
    """Standard deviation of innovations over that of the sensors' noise, at least 1."""
    every_z: tuple[float, ...]
    """Standard deviations with which every tooth stands out in the last hunting period: sun, each
    planet, ring; empty while a baseline is being learned."""
    cells: tuple[LearnedCell, ...]
    """Learning state of the baselines, by operating cell."""
    judged: Mapping[str, bool] = field(default_factory=dict)
    """Whether a change could have been found, by what is measured: "torque balance", "teeth" and
    "vibration"; the remarks say why not."""

    @property
    def unchanged(self) -> str:
        """What it means that there are no events."""
        judged = [f"the {name}" for name, known in self.judged.items() if known]
        others = [name for name, known in self.judged.items() if not known]
        if not others:
            return "no change found"
        if judged:
            return f"no change in {' and '.join(judged)}; not judged: {', '.join(others)}"
        if len(others) == 1:
            return "changes cannot be found without both torques and a speed while the train turns"
        return f"not judged: {', '.join(others)}"

    def __getitem__(self, name: str) -> Estimate:
        """Return the estimate of the quantity `name`."""
        return next(estimate for estimate in self.estimates if estimate.name == name)


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
        SceneError: the scene has two inputs, or cannot be simulated, or damage is asked for of a
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
        self._loaded = SavedBaseline(None, ())  # for samples that have not arrived yet
        sensors = self.sensors.model_copy(update={"scale": dict(self.scale)})
        self._balance = BalanceFollower(self.scene, sensors, self.period)
        self.damage: FollowedDamage | None = None
        """Damage of the gearbox; None if it is not counted."""
        if self.durability is not None:
            self.damage = FollowedDamage(self.scene, sensors, Path(self.durability))
        self._clocks = ClockWatch()
        self._teeth: TeethFollower | None = None
        self._encoder_speed: EncoderSpeed | None = None
        self._turns: WholeTurns | None = None
        self._vibration: dict[tuple[str, ...], VibrationFollower] = {}  # by channels of a device
        if self.encoders is not None:
            self._follow_teeth(self.encoders)

    @property
    def time(self) -> float:
        """Stamp of the last reading that is used [s]; NaN before the first."""
        return self._balance.time

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
            teeth = self._teeth_follower(block)
            if self._turns is None or self._encoder_speed is None:
                raise ValueError("encoders: their format is not known")
            sample, counts = self._turns.add(block.sample, block.counts)
            teeth.add(sample, counts)
            self._encoder_speed.add(sample, counts)
        elif isinstance(block, VibrationSamples):
            self._vibration_follower(block).add(block.time, block.values)
        else:
            self._add_readings(block)
        if math.isfinite(self._balance.time):
            self._judge(self._balance.time)

    def _judge(self, until: float) -> None:
        """Judge the hunting periods that end by a time."""
        if self._encoder_speed is not None:
            self._encoder_speed.judge(until, self._balance.turning_between)
        if self._teeth is not None:
            self._teeth.judge(until, self._balance.torque_between)
        for device in self._vibration.values():
            device.judge(until, self._balance.turning_between)

    def _vibration_follower(self, block: VibrationSamples) -> VibrationFollower:
        """The follower of the device that has these channels."""
        device = self._vibration.get(block.names)
        if device is None:
            train = self._balance.train
            device = VibrationFollower(train, block.names, block.period, self.sensors)
            device.restore_own(self._loaded.vibration)
            self._vibration[block.names] = device
        if block.period != device.period:
            raise InputError(
                f"vibration of {', '.join(block.names)}: a sample period of {block.period:g} s: "
                f"must be {device.period:g} s as before"
            )
        return device

    def _teeth_follower(self, block: EncoderSamples) -> TeethFollower:
        """Return the follower of the teeth, with the format that the first samples state."""
        teeth = self._teeth
        if teeth is None:
            if block.format is None:
                raise ValueError("encoders: their counts per turn and their period are missing")
            self.encoders = block.format
            teeth = self._follow_teeth(block.format)
            if self._loaded.teeth is not None:
                teeth.restore(self._loaded.teeth)
        if block.format not in (None, self.encoders):
            raise InputError(f"encoders: {block.format}: must be {self.encoders} as before")
        return teeth

    def _follow_teeth(self, encoders: EncoderFormat) -> TeethFollower:
        """Start to follow the teeth by encoders whose format is known."""
        self._encoder_speed = EncoderSpeed(*encoders)
        self._turns = WholeTurns(CountCheck(self._balance.train, *encoders))
        self._teeth = TeethFollower(self.scene, *encoders, self.sensors.learning)
        return self._teeth

    def learn(self) -> None:
        """Forget the baselines of teeth and vibration and learn new ones, after a repair.

        Events and the torque balance remain.
        """
        self._loaded = SavedBaseline(None, ())
        for part in (self._teeth, *self._vibration.values()):
            if part is not None:
                part.learn()

    def save_baseline(self, path: Path) -> None:
        """Write the learned baselines of teeth and vibration.

        Args:
            path: path of the file.

        Raises:
            ValueError: nothing has been learned.
            OSError: the file cannot be written.
        """
        write_baseline(
            path, self.scene,
            SavedBaseline(
                None if self._teeth is None else self._teeth.saved,
                tuple(one.saved for one in self._vibration.values() if one.saved is not None),
            ),
        )  # fmt: skip

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
        self._loaded = read_baseline(path, self.scene)
        if self._teeth is not None and self._loaded.teeth is not None:
            self._teeth.restore(self._loaded.teeth)
        for device in self._vibration.values():
            device.restore_own(self._loaded.vibration)

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
        if self._encoder_speed is not None and math.isfinite(self._balance.time):
            self._encoder_speed.judge(self._balance.time, self._balance.turning_between)
        if self._teeth is not None:
            self._teeth.finish()
            self._teeth.judge(math.inf, self._balance.torque_between)
        if math.isfinite(self._balance.time):
            for device in self._vibration.values():
                device.judge(self._balance.time, self._balance.turning_between)

    def estimate(self, now: float | None = None) -> Following:
        """Return the estimated state of the gearbox.

        Args:
            now: present time by the clock of the stamps [s]; None: that of the last reading.

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
        heard = [event for device in self._vibration.values() for event in device.events]
        for device in self._vibration.values():
            for name, count in vars(device.counters).items():
                counters[f"vibration_{name}"] = counters.get(f"vibration_{name}", 0) + count
        if now is not None and not now - balance.time <= TIMEOUT:
            estimates = tuple(
                quantity._replace(status="STALE") if quantity.status == "ESTIMATED" else quantity
                for quantity in estimates
            )
        return Following(
            balance.time, estimates, () if teeth is None else teeth.teeth,
            tuple(sorted(with_heard(events, heard), key=lambda event: event.found)), counters,
            (*balance.remarks(), *self._clocks.remarks(), *self._teeth_remarks(),
             *self._vibration_remarks(),
             *(self.damage.remarks() if self.damage is not None else ())),
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
            judged["vibration"] = all(one.judged for one in self._vibration.values())
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

    def _vibration_remarks(self) -> Iterator[str]:
        for names, device in self._vibration.items():
            of_device = f"vibration of {', '.join(names)}: "
            for line in device.remarks():
                yield line if len(self._vibration) == 1 else line.replace("vibration: ", of_device)

    def _teeth_remarks(self) -> Iterator[str]:
        if self._teeth is None:
            return
        if self._turns is not None:
            yield from self._turns.remarks()
        counters = self._teeth.counters
        if counters.segments > 1:
            yield (
                f"encoders: the count of turns restarted {counters.segments - 1} times; teeth are "
                "numbered from each new start, and baselines are learned again"
            )
        yield from self._teeth.remarks()
        if self._encoder_speed is not None and self._teeth.blocks:
            yield from self._encoder_speed.remarks()

    def __repr__(self) -> str:
        """One line."""
        return brief(self, self.scene.name, f"period {self.period:g} s")
