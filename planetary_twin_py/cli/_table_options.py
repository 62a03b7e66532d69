"""Options for measured samples in a table or another file: channel, times, units, and speed."""

from __future__ import annotations

from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.messages import fail
from ..terminal.unit_options import HERTZ

if TYPE_CHECKING:
    from ..analysis.shaft_angle import Turned
    from ..analysis.signals import Signal
    from ..recording.tables.sensor import Sensor
    from ..scene import Scene


@dataclass(frozen=True)
class TableOptions:
    """Options that select samples of a table, and the speed that belongs to them."""

    column: Annotated[
        str | None,
        typer.Option(
            help="Of a table: name or number of the column with the signal, if there are several. "
            "If the file states no unit, as of a MAT file: 'acceleration [g]'."
        ),
    ] = None
    time_column: Annotated[
        str | None,
        typer.Option(
            metavar="COLUMN",
            help="Of a table: name or number of the column of times, if it is not called time; "
            "in s without a unit.",
        ),
    ] = None
    sample_rate: Annotated[
        float | None,
        typer.Option(help="Of a table: samples per second, in place of a column time.", **HERTZ),
    ] = None
    full_scale: Annotated[
        str | None,
        typer.Option(help="Of a WAV file: value of its largest number, such as '10 V' or '50 g'."),
    ] = None
    sensitivity: Annotated[
        str | None,
        typer.Option(
            help="Of a table: of the sensor, such as '100 mV/g', for samples in a unit of voltage."
        ),
    ] = None
    speed: Annotated[
        str | None,
        typer.Option(
            metavar="COLUMN|FILE:COLUMN|VALUE",
            help="Of a table: measured speed of the input shaft (--shaft), for orders while the "
            "speed varies: a column, also of another table and at another rate, or a constant such "
            "as 998rpm. Columns are in rad/s without a unit in their heading. A MAT file has no "
            "headings: --speed 'speed [rpm]' states the unit.",
        ),
    ] = None
    tachometer: Annotated[
        str | None,
        typer.Option(
            metavar="COLUMN|FILE:COLUMN",
            help="Of a table: pulses of a tachometer, as a waveform or as a list of their times, "
            "in place of a speed.",
        ),
    ] = None
    pulses_per_turn: Annotated[
        int, typer.Option(min=1, help="Pulses of the tachometer per turn of its shaft.")
    ] = 1
    threshold: Annotated[
        float | None,
        typer.Option(
            help="Value of the tachometer at which a rising edge counts.",
            show_default="half-way between its extremes",
        ),
    ] = None
    shaft: Annotated[
        str,
        typer.Option(help="Shaft of --speed or --tachometer: input, output, sun, ring or carrier."),
    ] = "input"

    @property
    def of_tables(self) -> dict[str, object]:
        """What is given of options that are for tables only, by name."""
        default = TableOptions()
        return {
            f"--{name.replace('_', '-')}": getattr(self, name)
            for name in OF_TABLES
            if getattr(self, name) != getattr(default, name)
        }

    @property
    def has_speed(self) -> bool:
        """Whether a measured speed, or a tachometer, is given."""
        return self.speed is not None or self.tachometer is not None

    def check_speed(self, scene: str | None) -> None:
        """End the command if options of the speed contradict each other."""
        if self.speed is not None and self.tachometer is not None:
            fail("--tachometer: replaces --speed")
        if self.tachometer is None and (self.pulses_per_turn != 1 or self.threshold is not None):
            fail("--pulses-per-turn and --threshold: need --tachometer")
        if self.shaft != "input":
            if not self.has_speed:
                fail("--shaft: needs --speed or --tachometer")
            if scene is None:
                fail("--shaft: needs --scene, which defines how the shafts turn")

    def read_table(
        self,
        file: Path,
        scene: Scene | None,
        interval: tuple[float | None, float | None],
        one_way: bool,
    ) -> tuple[Sensor, Signal]:
        """Samples, and the signal with its angle.

        Args:
            file: of the samples.
            scene: the gears; None if they are unknown.
            interval: begin and end [s]; None is that of the file.
            one_way: whether the shaft must turn in one direction.

        Raises:
            ValueError: see `read_sensor` and `sensor_signal`.
            OSError: a file cannot be read.
        """
        from ..analysis.sensor import sensor_signal
        from ..recording.tables.scaling import Scaling
        from ..recording.tables.sensor import Wanted, read_sensor

        scaling = Scaling(self.full_scale, self.sensitivity)
        wanted = Wanted(self.column, self.time_column, self.sample_rate, scaling, *interval)
        beside = self._column_beside(file)
        sensor = read_sensor(file, wanted, beside, one_way)
        turned = None if beside is not None else self._turned(file, sensor)
        return sensor, sensor_signal(sensor, scene, turned, self.shaft)

    def _column_beside(self, file: Path) -> str | None:
        """The column of the speed if it has the times of the samples; None otherwise."""
        from ..recording.tables.chosen_column import chosen
        from ..recording.tables.measurements import read_channels
        from ..recording.tables.shaft import constant_speed
        from ..recording.tables.source import source_of

        if self.speed is None or constant_speed(self.speed) is not None:
            return None
        source = source_of(self.speed, file)
        if source.file != file:
            return None
        columns = read_channels(file)
        every = list(columns)
        speed = columns[chosen(file, "--speed", source.column, every)]
        if speed.time is None and all(one.time is None for one in columns.values()):
            return self.speed
        signal = columns[chosen(file, "--column", self.column, every)]
        return self.speed if _same_times(signal.time, speed.time) else None

    def _turned(self, file: Path, sensor: Sensor) -> Turned | None:
        """The angle of a shaft that was measured with times of its own; None without."""
        from ..analysis.shaft_angle import (
            Tachometer,
            angle_from_pulses,
            angle_from_speed,
            constant,
        )
        from ..recording.tables.shaft import constant_speed, read_pulses, read_speed
        from ..recording.tables.source import source_of

        if self.tachometer is not None:
            source = source_of(self.tachometer, file)
            pulses = read_pulses(source, self.sample_rate if source.file == file else None)
            tachometer = Tachometer(self.pulses_per_turn, self.threshold)
            return angle_from_pulses(sensor, pulses, tachometer)
        if self.speed is None:
            return None
        if (value := constant_speed(self.speed)) is not None:
            return constant(sensor, value)
        source = source_of(self.speed, file)
        return angle_from_speed(sensor, read_speed(source, None))


OF_TABLES = tuple(each.name for each in fields(TableOptions))
"""Names of these options."""


def _same_times(one: object, other: object) -> bool:
    import numpy as np

    if one is None or other is None:
        return one is other
    return np.array_equal(np.asarray(one), np.asarray(other))
