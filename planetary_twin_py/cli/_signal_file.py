"""The signal that a command analyses: a recording, samples of a run, or a table of a sensor."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from ..terminal.arguments import SetOption, complete_recording, complete_scene
from ..terminal.messages import fail, need
from ..terminal.settings import scene_with
from ..terminal.unit_options import HERTZ, SECONDS

if TYPE_CHECKING:
    from ..analysis.signals import Signal
    from ..recording.tables.sensor import Sensor
    from ..scene import Scene


@dataclass(frozen=True)
class SignalFile:
    """Arguments and options that select a signal."""

    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help="Recording, .npz file from `simulate --out`, or table of a sensor (.csv, "
            ".parquet, .mat).",
            autocompletion=complete_recording,
        ),
    ]
    mesh: Annotated[str, typer.Option(help="Name of the mesh.")] = "sun_planet_1"
    quantity: Annotated[str, typer.Option(help="Such as dte or mesh_force.")] = "dte"
    sensor: Annotated[
        str | None,
        typer.Option(
            help="Sensor in a recording or .npz file whose samples are analysed, instead of "
            "a mesh; `info` lists their names."
        ),
    ] = None
    from_: Annotated[
        float | None, typer.Option("--from", help="Start in simulated time.", **SECONDS)
    ] = None
    to: Annotated[
        float | None,
        typer.Option(
            help="End in simulated time. Default without --from: of a recording, the longest "
            "settled interval at one operating point; of another file, all samples.",
            **SECONDS,
        ),
    ] = None
    column: Annotated[
        str | None,
        typer.Option(
            help="Of a table: the column with the signal, if there are several. If the table "
            "states no unit, as of a MAT file: 'acceleration [g]'."
        ),
    ] = None
    speed: Annotated[
        str | None,
        typer.Option(
            help="Of a table: the column with the measured speed of the input shaft, for orders "
            "while the speed varies; in rad/s without a unit in its heading. A MAT file has no "
            "headings: --speed 'speed [rpm]' states the unit."
        ),
    ] = None
    sample_rate: Annotated[
        float | None,
        typer.Option(help="Of a table: samples per second, in place of a column time.", **HERTZ),
    ] = None
    scene: Annotated[
        str | None,
        typer.Option(
            help="Of a table, or a sensor of a measured gearbox: scene with the gears and the "
            "speed, to identify mesh harmonics.",
            autocompletion=complete_scene,
        ),
    ] = None
    set_: SetOption = None

    @property
    def is_table(self) -> bool:
        """Whether the file is a table of a sensor."""
        from ..recording.container.suffixes import is_table

        return is_table(self.file)

    def check(self) -> None:
        """End the command if an option is not for this kind of file, or a package is missing."""
        of_mesh = (self.mesh, self.quantity) != (SignalFile.mesh, SignalFile.quantity)
        if self.sensor is not None and of_mesh:
            fail("--sensor: replaces --mesh and --quantity")
        if self.set_ and self.scene is None and (self.is_table or self.sensor is not None):
            fail("--set: needs --scene")
        if self.is_table:
            need("analysis", "pyarrow")
            if self.sensor is not None:
                fail(f"{self.file}: --sensor is not for tables; --column selects one")
            if of_mesh:
                fail(f"{self.file}: --mesh and --quantity are not for tables")
            return
        of_tables: dict[str, object] = {
            "--column": self.column, "--speed": self.speed, "--sample-rate": self.sample_rate,
        }  # fmt: skip
        if self.sensor is None:
            of_tables |= {"--scene": self.scene, "--set": self.set_}
        if any(each is not None for each in of_tables.values()):
            from ..recording.container.suffixes import TABLES

            *others, last = of_tables
            options = f"{', '.join(others)} and {last} are for tables"
            fail(f"{self.file}: {options}; {TABLES}")
        if self.file.suffix != ".npz":
            need("recording", "mcap", "rosbags")

    def read(self, one_way: bool) -> Selected:
        """The selected part of the signal.

        Args:
            one_way: whether the shaft must turn in one direction in it.

        Raises:
            ValueError: see `read_signal`, `read_heard`, `read_sensor` and `Signal.within`.
            OSError: the file cannot be read.
        """
        from ..analysis.signals import QUANTITIES, read_signal, settled
        from ..scene import parse_scene

        sensor = None
        if self.sensor is not None:
            return self._heard(self.sensor)
        if self.is_table:
            sensor, signal = self._sensor(one_way)
        else:
            signal = read_signal(self.file, self.mesh, self.quantity)
        if self.from_ is None and self.to is None:
            signal = settled(self.file, signal)
        else:
            signal = signal.within(self.from_, self.to)
        scene = None if signal.scene_yaml is None else parse_scene(signal.scene_yaml)
        if sensor is not None:
            return Selected(signal, scene, None, sensor.name, sensor.unit, sensor)
        return Selected(signal, scene, self.mesh, self.quantity, QUANTITIES[self.quantity], None)

    def _sensor(self, one_way: bool) -> tuple[Sensor, Signal]:
        from ..analysis.sensor import sensor_signal
        from ..recording.tables.sensor import read_sensor

        interval = self.from_, self.to
        sensor = read_sensor(
            self.file, self.column, self.sample_rate, self.speed, *interval, one_way=one_way
        )
        return sensor, sensor_signal(sensor, self._scene())

    def _heard(self, name: str) -> Selected:
        """The samples of a sensor in a recording."""
        from ..analysis.recorded_sensor import Span, read_heard
        from ..scene import parse_scene

        heard = read_heard(self.file, name, Span(self.from_, self.to), self._scene())
        text = heard.signal.scene_yaml
        scene = None if text is None else parse_scene(text)
        return Selected(heard.signal, scene, None, name, heard.unit, heard.sensor)

    def _scene(self) -> Scene | None:
        return None if self.scene is None else scene_with(self.scene, self.set_)


class Selected(NamedTuple):
    """A signal and its names."""

    signal: Signal
    scene: Scene | None
    """The gears; None if they are unknown."""
    mesh: str | None
    """None for a sensor."""
    quantity: str
    unit: str
    sensor: Sensor | None
    """What was read, if no twin states the angles of the gears; None of a twin."""

    @property
    def assumed_speed(self) -> Iterator[str]:
        """A warning if the speed is that of a scene."""
        if self.sensor is None or self.sensor.speed is not None or self.scene is None:
            return
        turns = abs(self.signal.speed) / math.tau
        yield (
            f"the speed is assumed to be constant, {turns:.6g} turns of the sun per second "
            "relative to the carrier; if it varies, give the table of the samples with --speed "
            "COLUMN"
        )

    def aliases(self) -> Iterator[str]:
        """A warning if the sample rate is too low for the waveform of a twin."""
        from ..analysis.aliases import NEGLIGIBLE, alias_remark, alias_share
        from ..analysis.spectrum import amplitude_spectrum

        if self.mesh is None:  # sensors and data loggers have an anti-aliasing filter
            return
        rate = self.signal.sample_rate
        share = alias_share(*amplitude_spectrum(self.signal.samples, rate))
        if share > NEGLIGIBLE:
            yield alias_remark(rate, share, None, None)
