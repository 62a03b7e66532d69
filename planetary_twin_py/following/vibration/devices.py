"""The devices that sample vibration, each with the rate and the channels of its own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from ..balance.follower import BalanceFollower
from ..channels.vibration import VibrationSamples
from ..estimate import Event
from ..input_error import InputError
from ..sensors import Sensors
from ..teeth.baseline_file import VibrationBaseline
from .follower import VibrationFollower


@dataclass
class VibrationDevices:
    """Followers of the vibration by channels of a device, beside the balance that gives speeds."""

    sensors: Sensors
    balance: BalanceFollower
    loaded: tuple[VibrationBaseline, ...] = ()
    """Saved baselines of all devices, also of those that have sent nothing yet."""
    _devices: dict[tuple[str, ...], VibrationFollower] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self._devices)

    def add(self, block: VibrationSamples) -> None:
        """Add samples; raises `InputError` if those of this device had another period."""
        device = self._devices.get(block.names)
        if device is None:
            train = self.balance.train
            device = VibrationFollower(train, block.names, block.period, self.sensors)
            device.restore_own(self.loaded)
            self._devices[block.names] = device
        if block.period != device.period:
            raise InputError(
                f"vibration of {', '.join(block.names)}: a sample period of {block.period:g} s: "
                f"must be {device.period:g} s as before"
            )
        device.add(block.time, block.values)

    def judge(self, until: float) -> None:
        """Judge the hunting periods that end by a time [s]."""
        for device in self._devices.values():
            device.judge(until, self.balance.turning_between)

    def learn(self) -> None:
        """Forget the baselines and learn new ones."""
        self.loaded = ()
        for device in self._devices.values():
            device.learn()

    def restore(self, saved: tuple[VibrationBaseline, ...]) -> None:
        """Use saved baselines instead of learning."""
        self.loaded = saved
        for device in self._devices.values():
            device.restore_own(saved)

    @property
    def saved(self) -> tuple[VibrationBaseline, ...]:
        """Baselines that have been learned."""
        return tuple(one.saved for one in self._devices.values() if one.saved is not None)

    @property
    def events(self) -> list[Event]:
        """Growths of all devices."""
        return [event for device in self._devices.values() for event in device.events]

    @property
    def judged(self) -> bool:
        """Whether growth could have been found by every device."""
        return all(device.judged for device in self._devices.values())

    @property
    def counters(self) -> dict[str, int]:
        """Numbers of samples and hunting periods of all devices, by name."""
        total: Counter[str] = Counter()
        for device in self._devices.values():
            total.update(vars(device.counters))
        return dict(total)

    def remarks(self) -> Iterator[str]:
        """Remarks on each device, named by its channels if there are several."""
        for names, device in self._devices.items():
            of_device = f"vibration of {', '.join(names)}: "
            for line in device.remarks():
                yield line if len(self._devices) == 1 else line.replace("vibration: ", of_device)
