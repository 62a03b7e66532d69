"""`planetary-twin fleet`: estimates friction of many gearboxes from readings of a SCADA system."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption, table_option
from ..terminal.console import progress
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, warn
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ._study import executor_of


def fleet(
    scene: SceneArgument,
    from_: Annotated[
        Path,
        typer.Option(
            "--from",
            metavar="FILE",
            help="Readings: a .csv or .parquet table with the columns gearbox, time, input_torque, "
            "output_torque, input_speed and oil_temperature.",
        ),
    ],
    sensors: Annotated[
        Path | None,
        typer.Option(metavar="FILE.yaml", help="Noise and uncertainty of the torque sensors."),
    ] = None,
    durability: Annotated[
        Path | None,
        typer.Option(
            metavar="FOLDER",
            help="Continue the damage of each gearbox in GEARBOX.json of this folder; the scene "
            "needs the section durability.",
        ),
    ] = None,
    set_: SetOption = None,
    out: Annotated[Path | None, table_option("Write a row for each gearbox")] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Address of a Dask scheduler, e.g. tcp://10.0.0.1:8786, whose workers read the "
            "same file.",
            show_default="this machine",
        ),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Estimate friction of many gearboxes of the type SCENE, with one reading in 0.1 s to 600 s.

    Prints changes: steps of the loss torque of a gearbox. --out and --json have the friction level
    of each gearbox with a 95 % interval. The fleet has one false alarm per year. Readings should be
    means over their intervals: where they scatter more than their noise, a warning names the steps
    that may not be found. If no gearbox can be judged, the exit code is 2. With --durability,
    gearboxes with a damage of 0.8 or more are named.

    Example: planetary-twin fleet wind_turbine_stage --from scada.parquet --out state.csv
    """
    need("analysis", "pyarrow")
    from ..fleet.groups import FollowGroup, follow_groups
    from ..fleet.report import state_lines, warnings_of
    from ..fleet.tables import gearboxes_of
    from ..following.sensors import Sensors, read_sensors

    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        known = read_sensors(sensors) if sensors is not None else Sensors()
        names = gearboxes_of(from_)
        work = FollowGroup(
            from_.resolve(), loaded, len(names), known, durability and durability.resolve()
        )
        with (
            # One thread: array operations share the processor already.
            executor_of(scheduler, threads=1) as executor,
            progress("gearboxes", len(names)) as advance,
        ):
            found = follow_groups(work, names, executor, advance)
    for line in state_lines(found):
        console_beside(json_).one_line(line)
    warn(warnings_of(found))
    if out is not None:
        from ..fleet.notes import write_state

        with writing("--out", out):
            write_state(out, found)
    write_json({one.gearbox: one.figures() for one in found}, json_)
    if not any(one.is_judged for one in found):
        fail(
            "no gearbox is judged: readings contradict the scene, are incomplete, or are too few "
            "for their scatter"
        )
