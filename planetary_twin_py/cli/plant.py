"""`planetary-twin plant`: simulates measurements of a gearbox with hidden changes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import DurationOption, SceneArgument, SetOption, table_option
from ..terminal.console import make_console
from ..terminal.messages import need, one_line_errors, remark
from ..terminal.settings import scene_with

if TYPE_CHECKING:
    from ..plant.hidden import Hidden
    from ..scene import Scene


def plant(
    scene: SceneArgument,
    out: Annotated[Path, table_option("Write readings of torque and speed")],
    hidden: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.yaml",
            help="Duty, changes, sensor errors, and fields that differ from SCENE.",
        ),
    ] = None,
    encoders: Annotated[
        Path | None, table_option("Write samples of both encoders", "to a table.")
    ] = None,
    vibration: Annotated[
        Path | None, table_option("Write samples of the accelerometer", "to a table.")
    ] = None,
    duration: DurationOption = 60.0,
    set_: SetOption = None,
) -> None:
    """Simulate sensor readings of the gearbox of SCENE, with hidden changes, for `follow`.

    --hidden states changes of the gearbox, its duty, and noise, errors and lost readings of the
    sensors. By default the gearbox does not change and torque sensors are exact, but the torque
    wanders by 3 % and the speed by 0.3 % (duty.torque_wander, duty.speed_wander).

    Example: planetary-twin plant paper --hidden crack.yaml --out readings.csv
    """
    need("analysis", "pyarrow")
    from ..plant.hidden import Hidden, read_hidden

    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        truth = read_hidden(hidden, loaded) if hidden is not None else Hidden()
        if not 0.0 < duration <= 1e6:
            raise ValueError(f"--duration = {duration!r}: must be above 0 and at most 1e6 s")
        if encoders is not None and truth.sensors.encoders.rate == 0.0:
            raise ValueError("--encoders: requires sensors.encoders.rate in --hidden")
        if vibration is not None and truth.sensors.vibration.rate == 0.0:
            raise ValueError("--vibration: requires sensors.vibration.rate in --hidden")
        if line := truth.late_changes(duration):
            remark(f"warning: {line}")
        if names := ", ".join(sensor.name for sensor in loaded.sensors):
            remark(
                f"warning: sensors of the scene are not read here: {names}; those of a plant are "
                "in --hidden, and `simulate` reads these"
            )
        with make_console().status("simulating"):
            lines = list(_write(loaded, truth, duration, (out, encoders, vibration)))
    for line in lines:
        make_console().print(line, highlight=False, markup=False, soft_wrap=True)


def _write(
    scene: Scene, truth: Hidden, duration: float, files: tuple[Path, Path | None, Path | None]
) -> list[str]:
    from ..plant.readings import Plant
    from ..plant.tables import readings_table, samples_table, write_table

    plant = Plant(scene, truth, duration)
    lines = [f"{files[0]}: {write_table(readings_table(plant), files[0])} readings"]
    for path, name in zip(files[1:], ("encoders", "vibration"), strict=True):
        if path is not None:
            lines.append(f"{path}: {write_table(samples_table(plant, name), path)} samples")
    return lines
