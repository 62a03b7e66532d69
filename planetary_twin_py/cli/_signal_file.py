"""The signal that a command analyses: a recording, samples of a run, or a table of a sensor."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import typer

from ..terminal.arguments import SetOption, complete_scene
from ..terminal.messages import fail, need
from ..terminal.settings import scene_with
from ..terminal.unit_options import SECONDS
from ._table_options import TableOptions

if TYPE_CHECKING:
    from ..analysis.signals.signal import Signal
    from ..recording.tables.sensor import Sensor
    from ..scene import Scene


OF_SCENE = ("scene", "set_")
FILE_HELP = (
    "Recording, .npz file from `simulate --out`, or measured samples: a table (.csv, .txt, "
    ".parquet, .mat, .npz), .wav, .h5, .tdms or .mcap."
)


@dataclass(frozen=True)
class SignalOptions(TableOptions):
    """Options that select a signal of a file."""

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
    scene: Annotated[
        str | None,
        typer.Option(
            help="Of a table, or a sensor of a measured gearbox: scene with the gears and the "
            "speed, to identify mesh harmonics.",
            autocompletion=complete_scene,
        ),
    ] = None
    set_: SetOption = None

    def is_table(self, file: Path) -> bool:
        """Whether a file has measured samples, and no twin."""
        from ..recording.container.suffixes import is_table

        if is_table(file):
            return True
        if file.suffix == ".npz":
            from ..recording.tables.npz_file import is_of_others

            return is_of_others(file)
        return self.sensor is None and self.column is not None

    def check(self, file: Path) -> None:
        """End the command if an option is not for this kind of file, or a package is missing."""
        of_mesh = (self.mesh, self.quantity) != (SignalOptions.mesh, SignalOptions.quantity)
        if self.sensor is not None and of_mesh:
            fail("--sensor: replaces --mesh and --quantity")
        is_table = self.is_table(file)
        if self.set_ and self.scene is None and (is_table or self.sensor is not None):
            fail("--set: needs --scene")
        self.check_speed(self.scene)
        if is_table:
            need("analysis", "pyarrow")
            if self.sensor is not None:
                fail(f"{file}: --sensor is not for tables; --column selects one")
            if of_mesh:
                fail(f"{file}: --mesh and --quantity are not for tables")
            return
        of_tables = self.of_tables
        if self.sensor is None:
            of_tables |= {"--scene": self.scene, "--set": self.set_}
        if given := [name for name, value in of_tables.items() if value is not None]:
            from ..recording.container.suffixes import TABLES

            names = ", ".join(given) if len(given) > 1 else f"{given[0]} and the like"
            fail(f"{file}: {names} are for tables; {TABLES}")
        if file.suffix != ".npz":
            need("recording", "mcap", "rosbags")

    def read(self, file: Path, one_way: bool) -> Selected:
        """The selected part of the signal of a file.

        Args:
            file: recording, samples of a run, or table.
            one_way: whether the shaft must turn in one direction in it.

        Raises:
            ValueError: see `read_signal`, `read_sensor_signal`, `read_sensor` and `Signal.within`.
            OSError: the file cannot be read.
        """
        from ..analysis.signals.signal import QUANTITIES, read_signal, settled
        from ..scene import parse_scene

        if self.sensor is not None:
            return self._sensor_signal(file, self.sensor)
        if self.is_table(file):
            return self._measured(file, one_way)
        signal = read_signal(file, self.mesh, self.quantity)
        if self.from_ is None and self.to is None:
            signal = settled(file, signal)
        else:
            signal = signal.within(self.from_, self.to)
        scene = None if signal.scene_yaml is None else parse_scene(signal.scene_yaml)
        return Selected(signal, scene, self.mesh, self.quantity, QUANTITIES[self.quantity], None)

    def _measured(self, file: Path, one_way: bool) -> Selected:
        """The samples of a table."""
        from ..recording.tables.measurements import naming

        scene = self._scene()
        interval = self.from_, self.to
        sensor, signal = self.read_table(file, scene, interval, one_way)
        with naming(file):
            signal = signal.within(*interval)
        return Selected(signal, scene, None, sensor.name, sensor.unit, sensor, self.has_speed)

    def _sensor_signal(self, file: Path, name: str) -> Selected:
        """The samples of a sensor in a recording."""
        from ..analysis.signals.recorded_sensor import Span, read_sensor_signal
        from ..scene import parse_scene

        found = read_sensor_signal(file, name, Span(self.from_, self.to), self._scene())
        text = found.signal.scene_yaml
        scene = None if text is None else parse_scene(text)
        return Selected(found.signal, scene, None, name, found.unit, found.sensor)

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
    known_speed: bool = False
    """Whether the speed of a sensor was given."""

    @property
    def assumed_speed(self) -> Iterator[str]:
        """A warning if the speed is that of a scene."""
        if self.sensor is None or self.known_speed or self.scene is None:
            return
        turns = abs(self.signal.speed) / math.tau
        yield (
            f"the speed is assumed to be constant, {turns:.6g} turns of the sun per second "
            "relative to the carrier; if it varies, give --speed COLUMN or --tachometer COLUMN"
        )

    def aliases(self) -> Iterator[str]:
        """A warning if the sample rate is too low for the waveform of a twin."""
        from ..analysis.sampling.aliases import NEGLIGIBLE, alias_remark, alias_share
        from ..analysis.spectra.spectrum import amplitude_spectrum

        if self.mesh is None:  # sensors and data loggers have an anti-aliasing filter
            return
        rate = self.signal.sample_rate
        share = alias_share(*amplitude_spectrum(self.signal.samples, rate))
        if share > NEGLIGIBLE:
            yield alias_remark(rate, share, None, None)
