"""Hidden state of a plant: its laws, its changes, its duty, and errors of its sensors."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

from pydantic import Field

from ..scene import Scene, SceneError
from ..scene.faults import MOST_FAULTS, Fault
from ..scene.quantity import Section, listed, quantity
from ..scene.sensors.torque import TorqueErrors
from ..scene.yaml_file import read_section

MOST_CHANGES = 1000


class Change(Section):
    """A change at an instant.

    A value replaces the one before and does not add to it. Quantities that are not given do not
    change.
    """

    at: float = quantity("s", "time of the change", ge=0.0, le=1e9)
    friction: float | None = quantity(
        "", "factor on the tooth friction of the scene", None, gt=0.0, le=100.0
    )
    drag: float | None = quantity(
        "N m", "drag at the input in addition to the losses of the scene", None, ge=0.0, le=1e6
    )
    torque_zero: float | None = quantity(
        "N m",
        "zero of the torque sensor at the input, in place of that of sensors",
        None,
        ge=-1e6,
        le=1e6,
    )
    load: float | None = quantity("", "factor on the torque of the duty", None, ge=-10.0, le=10.0)
    faults: tuple[Fault, ...] | None = Field(
        None,
        max_length=MOST_FAULTS,
        description="all faulty teeth from this time on; [] repairs them",
    )


class Duty(Section):
    """Course of torque and speed at the input."""

    kind: Literal["steady", "varied", "reversing", "four_quadrant"] = Field(
        "steady",
        description="steady: the operating point of the scene; varied: another torque and speed "
        "every 5 s; reversing: the torque changes its sign every 5 s; four_quadrant: the "
        "speed also changes its sign, every 10 s",
    )
    torque_wander: float = quantity(
        "", "standard deviation of its random changes over the torque", 0.03, ge=0
    )
    speed_wander: float = quantity(
        "", "standard deviation of its random changes over the speed", 0.003, ge=0
    )


class EncoderErrors(Section):
    """Errors of both encoders, which one device reads."""

    rate: float = quantity("Hz", "sample rate; 0: no encoders", 0.0, ge=0.0, le=1e6)
    bits: int = Field(20, ge=8, le=32, description="counts per turn, as a power of two")
    noise: float = quantity("rad", "standard deviation of a sample", 1e-6, ge=0.0, le=1.0)
    long_wave: float = quantity("rad", "error once per turn, amplitude", 30e-6, ge=0.0, le=1.0)
    mesh_wave: float = quantity(
        "rad", "error at the mesh order of the encoder's shaft, amplitude", 1e-6, ge=0.0, le=1.0
    )
    jitter: float = quantity(
        "s", "standard deviation of the delay between both channels", 0.0, ge=0.0, le=1.0
    )
    delay: float = quantity("s", "constant delay between both channels", 2e-6, ge=-1.0, le=1.0)
    packet: int = Field(200, ge=1, le=100_000, description="samples of a packet")
    lost: float = quantity("", "share of packets that are lost", 0.0, ge=0.0, lt=1.0)


class Accelerometer(Section):
    """An accelerometer behind a path from the teeth that differs between harmonics."""

    rate: float = quantity("Hz", "sample rate; 0: no accelerometer", 0.0, ge=0.0, le=1e6)
    noise: float = quantity("m/s^2", "standard deviation of a sample", 0.5, ge=0.0, le=1e6)
    path: float = quantity(
        "", "largest factor by which the path amplifies or attenuates a mesh harmonic", 3.0,
        ge=1.0, le=1e3,
    )  # fmt: skip
    packet: int = Field(200, ge=1, le=100_000, description="samples of a packet")
    lost: float = quantity("", "share of packets that are lost", 0.0, ge=0.0, lt=1.0)


class SensorErrors(Section):
    """Errors of all sensors."""

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
    encoders: EncoderErrors = Field(EncoderErrors(), description="encoders on input and output")
    vibration: Accelerometer = Field(Accelerometer(), description="accelerometer")


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
