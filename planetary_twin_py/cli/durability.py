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
from ..terminal.output_files import file_ending_in, writing
from ..terminal.settings import scene_with
from ..terminal.unit_options import SECONDS
from ._damage_report import not_in_the_sums

if TYPE_CHECKING:
    from ..durability.damage_state import DamageState
    from ..lifetime.duty_result import DutyLife
    from ..lifetime.duty_table import Duty
    from ..scene import Scene

_Duty = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Duty: .csv or .parquet with torque, speed, and time, duration or share.",
    ),
]
_From = Annotated[
    Path | None,
    typer.Option(
        "--from",
        metavar="RECORDING",
        help="Recording in place of a table: an .mcap file, or its folder.",
        autocompletion=complete_recording,
    ),
]
_State = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE.json",
        help="Start from the damage in this file of follow --durability, which stays as it is.",
        show_default="new",
        callback=file_ending_in(".json"),
    ),
]
_Repeat = Annotated[
    float | None,
    typer.Option(
        help="Time over which the duty is repeated, such as 20y.", show_default="once", **SECONDS
    ),
]
_Block = Annotated[
    float | None,
    typer.Option(
        help="Length of a mission: blocks of it may come in any order.",
        show_default="a day, of a duty of two days or more",
        **SECONDS,
    ),
]
_Excerpts = Annotated[
    int, typer.Option(help="Direct runs by which the error of the map is measured.")
]
_Out = Annotated[
    Path | None, picture_option("Draw load duration and load revolution distributions.")
]


def durability(  # noqa: PLR0913 - an argument for each option
    scene: SceneArgument,
    duty: _Duty = None,
    from_: _From = None,
    state: _State = None,
    repeat: _Repeat = None,
    block: _Block = None,
    excerpts: _Excerpts = 16,
    seed: Annotated[int, typer.Option(help="Seed of random choices.")] = 0,
    set_: SetOption = None,
    out: _Out = None,
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
        before = _before(loaded, state)
        reached = None if before is None else dict(zip(before.parts, before.sums, strict=True))
        with Shown() as shown:
            found = duty_life(loaded, rows, repeat, reached, block, excerpts, seed, shown.report)
    print_life(console_beside(json_), loaded.name, found)
    warn((*found.remarks, *damage_remarks(loaded), *_doubts(before)))
    if out is not None:
        _draw(loaded, found, out)
    write_json({"scene": loaded.name} | found.figures(), json_)


def _rows(duty: Path | None, recording: Path | None, namespace: str | None) -> Duty:
    from ..lifetime.duty_table import read_duty
    from ..lifetime.recorded_duty import recorded_duty

    if duty is not None:
        return read_duty(duty)
    assert recording is not None
    return recorded_duty(recording, namespace)


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
