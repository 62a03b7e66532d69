"""Inputs of `planetary-twin follow`: readings, samples of encoders and accelerometers, sensors."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from ..terminal.messages import note, remark
from ..terminal.settings import numbers

if TYPE_CHECKING:
    import numpy as np

    from ..following.channels.encoders import EncoderFormat
    from ..following.channels.sampled import Samples
    from ..following.measured.messages import Block
    from ..following.sensors import Sensors

SensorsOption = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE.yaml",
        help="Sensors: noise, uncertainty, encoders, names of columns and joints.",
    ),
]
ScaleOption = Annotated[
    list[str] | None,
    typer.Option(metavar="NAME=FACTOR", help="Factor on the readings of a channel. Repeatable."),
]


class Files(NamedTuple):
    """Files with the measurements of a gearbox."""

    readings: Path
    encoders: Path | None
    vibration: Path | None


class Measurements(NamedTuple):
    """Measurements of a gearbox, in the order of each file."""

    readings: list[Block]
    samples: list[Samples]

    @property
    def span(self) -> tuple[float, float]:
        """First and last stamp of the readings [s]; NaN without one."""
        import numpy as np

        from ..following.readings import Readings

        stamps = [block.time for block in self.readings if isinstance(block, Readings)]
        known = [time[np.isfinite(time)] for time in stamps if np.isfinite(time).any()]
        if not known:
            return float("nan"), float("nan")
        return min(float(time.min()) for time in known), max(float(time.max()) for time in known)


def described_sensors(path: Path | None, scale: Sequence[str]) -> Sensors:
    """Sensors of a gearbox.

    Args:
        path: file of --sensors; None: the default.
        scale: NAME=FACTOR of --scale, which replaces that of the file.

    Raises:
        ValueError: the file or a factor is invalid.
        OSError: the file cannot be read.
    """
    from ..following.sensors import Sensors, read_sensors

    known = Sensors() if path is None else read_sensors(path)
    return known.model_copy(update={"scale": known.scale | numbers(scale, "--scale")})


def encoder_format(files: Files, sensors: Sensors) -> EncoderFormat | None:
    """Counts per turn and sample period of the encoders; None without encoders.

    Args:
        files: files with the measurements.
        sensors: sensors of the gearbox.
    """
    from ..following.channels.encoders import EncoderFormat

    if files.encoders is None:
        return None
    known = sensors.encoders
    return EncoderFormat((known.input_counts, known.output_counts), 1.0 / known.rate)


def read_measurements(files: Files, sensors: Sensors) -> Measurements:
    """Read all files, and name the columns that are not used.

    Raises:
        ValueError: a file has another format, or lacks a column.
        OSError: a file cannot be read.
    """
    readings, begin, unused = _readings(files.readings, sensors)
    samples = _samples(files, sensors, begin)
    shared = files.readings in (files.encoders, files.vibration)
    _note_unused(unused, samples if shared else ())
    return Measurements(readings, samples)


def _readings(
    path: Path, sensors: Sensors
) -> tuple[list[Block], np.datetime64 | None, tuple[str, ...]]:
    """Blocks of readings, the date of second 0 of their stamps, and columns that are not used."""
    from ..recording.container.suffixes import is_table

    if is_table(path):
        from ..following.measured.tables import read_readings

        found = read_readings(path, sensors.columns)
        for line in found.remarks:
            remark(f"warning: {path}: {line}")
        return [found.readings], found.begin, found.ignored
    from ..following.measured.recording import BEGIN, read_recording

    damaged: list[str] = []
    blocks = read_recording(path, sensors.joints, sensors.scale, damaged)
    for line in damaged:
        remark(f"warning: {line}")
    return blocks, BEGIN, ()


def _samples(files: Files, sensors: Sensors, begin: np.datetime64 | None) -> list[Samples]:
    """Samples of encoders and accelerometers."""
    from ..following.channels.encoders import read_encoders
    from ..following.channels.vibration import read_vibration

    found: list[Samples] = []
    if files.encoders is not None:
        found.append(read_encoders(files.encoders, 1.0 / sensors.encoders.rate, begin))
    if files.vibration is not None:
        found.append(read_vibration(files.vibration, sensors.columns, begin))
    return found


def _note_unused(columns: tuple[str, ...], samples: Sequence[object]) -> None:
    """Name the columns that neither the readings nor the samples use."""
    from ..following.channels.encoders import COUNTS, SAMPLE

    used = {name for one in samples for name in getattr(one, "names", (SAMPLE, *COUNTS))}
    left = [name for name in columns if name not in used]
    if left:
        note(f"columns that are not used: {', '.join(left)}")
