"""Inputs of `planetary-twin follow`: readings, samples of devices, sensors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from ..following.channels.sampled import DEVICES
from ..terminal.messages import note, remark
from ..terminal.settings import numbers

if TYPE_CHECKING:
    import numpy as np

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


def read_measurements(file: Path, tables: Mapping[str, Path], sensors: Sensors) -> Measurements:
    """Read all files, and name the columns that are not used.

    Args:
        file: readings.
        tables: samples by device.
        sensors: sensors of the gearbox.

    Raises:
        ValueError: a file has another format, or lacks a column.
        OSError: a file cannot be read.
    """
    from ..following.devices.device import followed

    readings, begin, unused = _readings(file, sensors)
    samples = [followed(name).read(path, sensors, begin) for name, path in tables.items()]
    _note_unused(unused, samples if file in tables.values() else ())
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


def _note_unused(columns: tuple[str, ...], samples: Sequence[Samples]) -> None:
    """Name the columns that neither the readings nor the samples use."""
    used = {name for one in samples for name in (*one.names, *DEVICES[one.device].columns)}
    left = [name for name in columns if name not in used]
    if left:
        note(f"columns that are not used: {', '.join(left)}")
