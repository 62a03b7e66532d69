"""`planetary-twin plant`: simulates measurements of a gearbox with hidden changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..following.channels.sampled import DEVICES
from ..terminal.arguments import DurationOption, SceneArgument, SetOption, table_option
from ..terminal.console import make_console
from ..terminal.dataclass_options import take_options_of
from ..terminal.messages import need, one_line_errors, remark
from ..terminal.settings import scene_with

if TYPE_CHECKING:
    from ..plant.hidden import Hidden
    from ..scene import Scene


@dataclass(frozen=True)
class Options:
    """Arguments and options of the command."""

    scene: SceneArgument
    out: Annotated[Path, table_option("Write readings of torque and speed")]
    hidden: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.yaml",
            help="Duty, changes, sensor errors, and fields that differ from SCENE.",
        ),
    ] = None
    duration: DurationOption = 60.0
    set_: SetOption = None


def plant(**given: Any) -> None:
    """Simulate sensor readings of the gearbox of SCENE, with hidden changes, for `follow`.

    --hidden states changes of the gearbox, its duty, and noise, errors and lost readings of the
    sensors. By default the gearbox does not change and torque sensors are exact, but the torque
    wanders by 3 % and the speed by 0.3 % (duty.torque_wander, duty.speed_wander).

    Example: planetary-twin plant paper --hidden crack.yaml --out readings.csv
    """
    tables = {name: path for name in DEVICES if (path := given.pop(name)) is not None}
    asked = Options(**given)
    need("analysis", "pyarrow")
    from ..plant.hidden import Hidden, read_hidden

    with one_line_errors(ArithmeticError):
        loaded, duration = scene_with(asked.scene, asked.set_), asked.duration
        truth = Hidden() if asked.hidden is None else read_hidden(asked.hidden, loaded)
        if not 0.0 < duration <= 1e6:
            raise ValueError(f"--duration = {duration!r}: must be above 0 and at most 1e6 s")
        for name in tables:
            if truth.device(name).rate == 0.0:
                raise ValueError(f"--{name}: requires sensors.{name}.rate in --hidden")
        if line := truth.late_changes(duration):
            remark(f"warning: {line}")
        if names := ", ".join(sensor.name for sensor in loaded.sensors):
            remark(
                f"warning: sensors of the scene are not read here: {names}; those of a plant are "
                "in --hidden, and `simulate` reads these"
            )
        with make_console().status("simulating"):
            lines = list(_written(loaded, truth, asked, tables))
    for line in lines:
        make_console().print(line, highlight=False, markup=False, soft_wrap=True)


take_options_of(
    Options,
    plant,
    {
        name: Annotated[
            Path | None, table_option(f"Write samples of {device.sensors}", "to a table.")
        ]
        for name, device in DEVICES.items()
    },
)


def _written(
    scene: Scene, truth: Hidden, asked: Options, tables: Mapping[str, Path]
) -> Iterator[str]:
    """Write all files; a line on each."""
    from ..plant.readings import Plant
    from ..plant.tables import readings_table, samples_table, write_table

    plant = Plant(scene, truth, asked.duration)
    yield f"{asked.out}: {write_table(readings_table(plant), asked.out)} readings"
    for name, path in tables.items():
        yield f"{path}: {write_table(samples_table(plant, name), path)} samples"
