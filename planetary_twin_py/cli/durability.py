"""`planetary-twin durability`: damage and lives under a duty."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import (
    JsonOption,
    NamespaceOption,
    SceneArgument,
    SetOption,
    complete_recording,
    file_option,
    picture_option,
)
from ..terminal.dataclass_options import take_options_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, warn
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ..terminal.unit_options import SECONDS
from ._damage_report import not_in_the_sums

if TYPE_CHECKING:
    from ..durability.damage_state import DamageState
    from ..lifetime.duty_result import DutyLife
    from ..lifetime.duty_table import Duty
    from ..scene import Scene


@dataclass(frozen=True)
class Options:
    """Arguments and options of the command."""

    scene: SceneArgument
    duty: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Duty: .csv or .parquet with torque, speed, and time, duration or share.",
        ),
    ] = None
    from_: Annotated[
        Path | None,
        typer.Option(
            "--from",
            metavar="RECORDING",
            help="Recording in place of a table: an .mcap file, or its folder.",
            autocompletion=complete_recording,
        ),
    ] = None
    state: Annotated[
        Path | None,
        file_option(
            "Start from the damage in this file of follow --durability, which stays as it is.",
            ".json",
            show_default="new",
        ),
    ] = None
    repeat: Annotated[
        float | None,
        typer.Option(
            help="Time over which the duty is repeated, such as 20y.",
            show_default="once",
            **SECONDS,
        ),
    ] = None
    block: Annotated[
        float | None,
        typer.Option(
            help="Length of a mission: blocks of it may come in any order.",
            show_default="a day, of a duty of two days or more",
            **SECONDS,
        ),
    ] = None
    excerpts: Annotated[
        int, typer.Option(help="Direct runs by which the error of the map is measured.")
    ] = 16
    seed: Annotated[int, typer.Option(help="Seed of random choices.")] = 0
    set_: SetOption = None
    out: Annotated[
        Path | None, picture_option("Draw load duration and load revolution distributions.")
    ] = None
    namespace: NamespaceOption = None
    json_: JsonOption = None


def durability(**given: Any) -> None:
    """Sum the damage of SCENE over a duty, and say how long its parts live.

    The duty has the columns torque and speed of the first motor and, if they are known,
    oil_temperature and input_torque_std, with units in the headings (speed [rpm]) or in SI. With
    time, each row holds up to the time of the next one, and the last one ends the duty; otherwise
    rows have a duration or a share of the time. Steady runs on all cores give the damage over
    torque, speed and temperature; direct runs of excerpts measure what this leaves out. SCENE needs
    its section durability. No result is a rating to a standard.

    Example: planetary-twin durability gearbox.yaml --duty duty.csv --repeat 20y --out loads.png
    """
    asked = Options(**given)
    need("analysis", "pyarrow")
    if asked.out is not None:
        need("plots", "matplotlib")
    if (asked.duty is None) == (asked.from_ is None):
        fail("--duty, --from: give one of them")
    from ..explanation.damage import damage_remarks
    from ..lifetime.duty_life import duty_life
    from ._durability_report import Shown, print_life

    with one_line_errors(ArithmeticError):
        loaded = scene_with(asked.scene, asked.set_)
        rows = _rows(asked)
        before = _before(loaded, asked.state)
        reached = None if before is None else dict(zip(before.parts, before.sums, strict=True))
        with Shown() as shown:
            found = duty_life(
                loaded, rows, asked.repeat, reached, asked.block, asked.excerpts, asked.seed,
                shown.report,
            )  # fmt: skip
    print_life(console_beside(asked.json_), loaded.name, found)
    warn((*found.remarks, *damage_remarks(loaded), *_doubts(before)))
    if asked.out is not None:
        _draw(loaded, found, asked.out)
    write_json({"scene": loaded.name} | found.figures(), asked.json_)


take_options_of(Options, durability)


def _rows(asked: Options) -> Duty:
    from ..lifetime.duty_table import read_duty
    from ..lifetime.recorded_duty import recorded_duty

    if asked.duty is not None:
        return read_duty(asked.duty)
    assert asked.from_ is not None
    return recorded_duty(asked.from_, asked.namespace)


def _before(scene: Scene, path: Path | None) -> DamageState | None:
    """The damage at the start of the duty; None of a new gearbox."""
    if path is None:
        return None
    from ..durability.state_file import read_state
    from ..following.damage.followed import rated_parts

    return read_state(path, scene, rated_parts(scene))


def _doubts(before: DamageState | None) -> tuple[str, ...]:
    """What is doubtful about the damage at the start."""
    if before is None:
        return ()
    missing = not_in_the_sums(before)
    return (*before.warnings, *([f"--state: {missing}"] if missing else []))


def _draw(scene: Scene, found: DutyLife, out: Path) -> None:
    from ..plots.durability import load_diagram
    from ..plots.style import save

    with writing("--out", out):
        save(load_diagram(scene, found), str(out))
