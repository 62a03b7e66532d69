"""`planetary-twin durability`: damage and lives under a duty."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import (
    JsonOption,
    NamespaceOption,
    SceneArgument,
    SetOption,
    complete_recording,
    picture_option,
)
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, warn
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ..terminal.unit_options import SECONDS

if TYPE_CHECKING:
    from ..lifetime.duty_table import Duty


def durability(  # noqa: PLR0913 - an argument for each option
    scene: SceneArgument,
    duty: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Duty: .csv or .parquet with torque, speed, and time, duration or share.",
        ),
    ] = None,
    from_: Annotated[
        Path | None,
        typer.Option(
            "--from",
            metavar="RECORDING",
            help="Recording in place of a table: an .mcap file, or its folder.",
            autocompletion=complete_recording,
        ),
    ] = None,
    repeat: Annotated[
        float | None,
        typer.Option(
            help="Time over which the duty goes on and on, such as 20y.",
            show_default="once",
            **SECONDS,
        ),
    ] = None,
    block: Annotated[
        float | None,
        typer.Option(
            help="Length of a mission: blocks of it may come in any order.",
            show_default="a day, of a duty of two days or more",
            **SECONDS,
        ),
    ] = None,
    excerpts: Annotated[
        int, typer.Option(help="Direct runs by which the error of the map is measured.")
    ] = 16,
    seed: Annotated[int, typer.Option(help="Seed of random choices.")] = 0,
    set_: SetOption = None,
    out: Annotated[
        Path | None, picture_option("Draw load duration and load revolution distributions.")
    ] = None,
    namespace: NamespaceOption = None,
    json_: JsonOption = None,
) -> None:
    """Sum the damage of SCENE over a duty, and say how long its parts live.

    The duty has the columns torque and speed of the first motor and, if they are known,
    oil_temperature and input_torque_std, with units in the headings (speed [rpm]) or in SI. With
    time, each row holds up to the time of the next one, and the last one ends the duty; otherwise
    rows have a duration or a share of the time. Steady runs on all cores give the damage over
    torque, speed and temperature; direct runs of excerpts measure what this leaves out. SCENE needs
    its section durability. No result is a rating to a standard.

    Example: planetary-twin durability gearbox.yaml --duty duty.csv --repeat 20y --out loads.png
    """
    need("analysis", "pyarrow")
    if out is not None:
        need("plots", "matplotlib")
    if (duty is None) == (from_ is None):
        fail("--duty, --from: give one of them")
    from ..explanation.damage import damage_remarks
    from ..lifetime.duty_life import duty_life
    from ._durability_report import Shown, print_life

    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        rows = _rows(duty, from_, namespace)
        with Shown() as shown:
            found = duty_life(loaded, rows, repeat, None, block, excerpts, seed, shown.report)
    print_life(console_beside(json_), loaded.name, found)
    warn((*found.remarks, *damage_remarks(loaded)))
    if out is not None:
        from ..plots.durability import load_diagram
        from ..plots.style import save

        with writing("--out", out):
            save(load_diagram(loaded, found), str(out))
    write_json({"scene": loaded.name} | found.figures(), json_)


def _rows(duty: Path | None, recording: Path | None, namespace: str | None) -> Duty:
    from ..lifetime.duty_table import read_duty
    from ..lifetime.recorded_duty import recorded_duty

    if duty is not None:
        return read_duty(duty)
    assert recording is not None
    return recorded_duty(recording, namespace)
