"""What the channels of measured files are: sensors, speed or tachometer, torques."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated

from pydantic import Field, field_validator

from ...recording.tables.scaling import Scaling
from ...recording.tables.sensor import Wanted
from ...scene.quantity import Section, quantity
from ...scene.yaml_file import read_section

_NAME = re.compile(r"[a-z][a-z0-9_]*")


class Channel(Section):
    """Where the samples of a sensor are."""

    file: str | None = Field(
        None, description="beside this file; default: the file that is imported"
    )
    column: str | int | None = Field(
        None, description="name or number, with a unit if the file states none: acceleration [g]"
    )
    time_column: str | int | None = Field(
        None, description="column of times, if it is not called time"
    )
    sample_rate: float | None = quantity("Hz", "in place of times", None, gt=0.0, le=1e9)
    full_scale: str | None = Field(None, description="of a WAV file: 10 V, or 50 g")
    sensitivity: str | None = Field(None, description="of the sensor: 100 mV/g")

    def wanted(self) -> Wanted:
        """What to read of the file."""
        scaling = Scaling(self.full_scale, self.sensitivity)
        time = None if self.time_column is None else str(self.time_column)
        return Wanted(self.column_name, time, self.sample_rate, scaling)

    @property
    def column_name(self) -> str | None:
        """Name or number as text."""
        return None if self.column is None else str(self.column)


class Shaft(Channel):
    """Where the speed of a shaft is, or the signal of its tachometer."""

    shaft: str = Field("input", description="input, output, sun, ring or carrier")
    pulses_per_turn: int = Field(1, ge=1, description="of a tachometer")
    threshold: float | None = Field(
        None, description="value at which a rising edge counts; default: half-way"
    )


class WaveformMap(Section):
    """What the channels are."""

    sensors: Annotated[dict[str, Channel], Field(min_length=1)]
    speed: Shaft | None = Field(None, description="measured speed; default: that of the scene")
    tachometer: Shaft | None = Field(None, description="pulses, in place of a speed")
    torques: dict[str, Channel] = Field({}, description="`input` and `output`, for `follow`")

    @field_validator("sensors")
    @classmethod
    def _named(cls, given: dict[str, Channel]) -> dict[str, Channel]:
        for name in given:
            if not _NAME.fullmatch(name) or name == "tachometer":
                raise ValueError(
                    f"{name!r}: must be a name of small letters, digits and _, not tachometer"
                )
        return given

    @field_validator("torques")
    @classmethod
    def _of_shafts(cls, given: dict[str, Channel]) -> dict[str, Channel]:
        for name in given:
            if name not in ("input", "output"):
                raise ValueError(f"{name!r}: must be input or output")
        return given


def read_map(path: Path) -> WaveformMap:
    """Read a map.

    Args:
        path: of a YAML file.

    Raises:
        ValueError: a field is invalid.
        OSError: it cannot be read.
    """
    found = read_section(path, WaveformMap)
    if found.speed is not None and found.tachometer is not None:
        raise ValueError(f"{path}: tachometer: replaces speed; give one of them")
    return found
