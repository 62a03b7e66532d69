"""Devices that sample vibration, each with the rate and the channels of its own."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..channels.vibration import VibrationMessages, VibrationSamples, read_vibration
from ..input_error import InputError
from ..sensors import Sensors
from ..teeth.baseline_file import SavedBaseline, VibrationBaseline
from ..vibration.follower import VibrationFollower
from .device import DeviceFollower, DeviceState, FollowedDevice


@dataclass
class VibrationDevices(DeviceFollower):
    """Followers of the vibration by channels of a device, beside the balance that gives speeds."""

    _loaded: tuple[VibrationBaseline, ...] = ()  # also of devices that have sent nothing yet
    _devices: dict[tuple[str, ...], VibrationFollower] = field(default_factory=dict)

    def add(self, block: VibrationSamples) -> None:
        """Add samples; raises `InputError` if those of this device had another period."""
        device = self._devices.get(block.names)
        if device is None:
            train = self.balance.train
            device = VibrationFollower(train, block.names, block.period, self.sensors)
            device.restore_own(self._loaded)
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

    def state(self) -> DeviceState:
        """Growths, and numbers of samples and hunting periods, of all devices."""
        if not (devices := self._devices.values()):
            return DeviceState()
        total: Counter[str] = Counter()
        for device in devices:
            total.update(vars(device.counters))
        return DeviceState(
            events=[event for device in devices for event in device.events],
            counters={f"vibration_{name}": n for name, n in total.items()},
            judged={"vibration": all(device.judged for device in devices)},
        )

    def remarks(self) -> Iterator[str]:
        """Remarks on each device, named by its channels if there are several."""
        for names, device in self._devices.items():
            of_device = f"vibration of {', '.join(names)}: "
            for line in device.remarks():
                yield line if len(self._devices) == 1 else line.replace("vibration: ", of_device)

    def learn(self) -> None:
        """Forget the baselines and learn new ones."""
        self._loaded = ()
        for device in self._devices.values():
            device.learn()

    def saved(self) -> Mapping[str, Any]:
        """Baselines of the vibration."""
        found = (device.saved for device in self._devices.values())
        return {"vibration": tuple(one for one in found if one is not None)}

    def restore(self, saved: SavedBaseline) -> None:
        """Use saved baselines of the vibration instead of learning."""
        self._loaded = saved.vibration
        for device in self._devices.values():
            device.restore_own(saved.vibration)


def _read(path: Path, sensors: Sensors, begin: np.datetime64 | None) -> VibrationSamples:
    return read_vibration(path, sensors.columns, begin)


DEVICE = FollowedDevice(VibrationMessages, _read, VibrationDevices)
