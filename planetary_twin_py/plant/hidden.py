"""Hidden state of a plant: its laws, its changes, its duty, and errors of its sensors."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import Field, create_model

from ..following.channels.sampled import DEVICES
from ..scene import Scene, SceneError
from ..scene.faults import Fault
from ..scene.quantity import Section, listed, quantity
from ..scene.sensors.torque import TorqueErrors
from ..scene.yaml_file import read_section
from .changes import Change, Duty
from .device import DeviceErrors, simulated

MOST_CHANGES = 1000


class ReadingErrors(Section):
    """Errors of the sensors of one value."""

    rate: float = quantity("Hz", "readings of torque and speed per second", 100.0, gt=0, le=1e5)
    input_torque: TorqueErrors = Field(TorqueErrors(), description="at the input")
    output_torque: TorqueErrors = Field(TorqueErrors(), description="at the output")
    speed_noise: float = quantity("rad/s", "standard deviation of a speed", 0.0, ge=0.0, le=1e4)
    clock_offset: float = quantity(
        "s", "time of a reading of the output torque minus its stamp", 0.0, ge=-10.0, le=10.0
    )
    lost: float = quantity(
        "", "share of readings of each channel that are lost", 0.0, ge=0.0, lt=1.0
    )
    outlying: float = quantity(
        "", "share of readings of torque that are outliers", 0.0, ge=0.0, lt=0.5
    )


if TYPE_CHECKING:
    SensorErrors = ReadingErrors
else:
    SensorErrors = create_model(
        "SensorErrors",
        __base__=ReadingErrors,
        __doc__="Errors of all sensors.",
        **{
            name: (errors := simulated(name).errors, Field(errors(), description=device.sensors))
            for name, device in DEVICES.items()
        },
    )


class Hidden(Section):
    """Everything about a plant that a follower does not know."""

    scene: dict[str, Any] = Field(
        {}, description="fields in which the plant differs from the scene, by dotted name"
    )
    duty: Duty = Field(Duty(), description="course of torque and speed")
    sensors: SensorErrors = Field(SensorErrors(), description="errors of the sensors")
    changes: tuple[Change, ...] = Field(
        (), max_length=MOST_CHANGES, description="changes, each from its time on"
    )
    seed: int = Field(0, ge=0, description="seed of all random numbers")

    def device(self, name: str) -> DeviceErrors:
        """Errors of a device of `DEVICES`."""
        errors: DeviceErrors = getattr(self.sensors, name)
        return errors

    @property
    def changes_in_order(self) -> tuple[Change, ...]:
        """The changes, in order of time."""
        return tuple(sorted(self.changes, key=lambda change: change.at))

    def late_changes(self, duration: float) -> str:
        """Line on changes that start only after a duration [s]; empty if there are none."""
        late = [change.at for change in self.changes if change.at >= duration]
        if not late:
            return ""
        return (
            f"changes: those at {min(late):g} s or later have no effect: the simulation ends at "
            f"{duration:g} s"
        )

    def check(self, scene: Scene) -> Scene:
        """The scene with the laws of the plant.

        Raises `SceneError` if a field, tooth or planet of it does not exist.
        """
        try:
            true_scene = scene.replace(**self.scene)
        except SceneError as error:
            raise SceneError(f"scene: {error}") from None
        errors = [
            f"changes.{n}.{line}"
            for n, change in enumerate(self.changes)
            for line in true_scene.errors_of_faults(change.faults or ())
        ]
        errors += [
            f"{place}.growth: a plant has no growing faults; give changes with other severities"
            for place, fault in self._faults(true_scene)
            if fault.growing is not None
        ]
        errors += [
            f"{place}.kind = 'bearing': must be a fault that repeats with the teeth in a plant"
            for place, fault in self._faults(true_scene)
            if fault.kind == "bearing"
        ]
        if errors:
            raise SceneError(listed(errors, "the hidden state"))
        return true_scene

    def _faults(self, true_scene: Scene) -> Iterator[tuple[str, Fault]]:
        """Names and faults of the scene and of all changes."""
        yield from ((f"scene.faults.{n}", fault) for n, fault in enumerate(true_scene.faults))
        for n, change in enumerate(self.changes):
            yield from ((f"changes.{n}.faults.{f}", x) for f, x in enumerate(change.faults or ()))


def read_hidden(path: Path, scene: Scene | None = None) -> Hidden:
    """Read a YAML file with fields of `Hidden`.

    Args:
        path: path of the file.
        scene: scene that its faults and differences must fit; None: they are not checked.

    Returns:
        The hidden state.

    Raises:
        SceneError: the file is not in YAML, or a field is invalid; the message starts with the
            path.
        OSError: the file cannot be read.
    """
    hidden = read_section(path, Hidden)
    if scene is not None:
        try:
            hidden.check(scene)
        except SceneError as error:
            raise SceneError(f"{path}: {error}") from None
    return hidden
