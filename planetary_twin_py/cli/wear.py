"""`planetary-twin wear`: wear of all flanks after hours of operation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import (
    JsonOption,
    SceneArgument,
    SetOption,
    file_option,
    picture_option,
)
from ..terminal.console import progress_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors, warn
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ..terminal.unit_options import read_quantity
from ._wear_report import HOUR, print_wear

if TYPE_CHECKING:
    from ..studies.wear.result import Wear


def wear(
    scene: SceneArgument,
    hours: Annotated[
        str,
        typer.Option(
            metavar="TIME", help="Time of operation: a number of hours, or with a unit, e.g. 1000h."
        ),
    ] = "1000h",
    measured_backlash_change: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="Fit the coefficient to this growth of the backlash, e.g. 12um: of both kinds of "
            "mesh together, along the line of action.",
        ),
    ] = None,
    vibration: Annotated[
        bool,
        typer.Option(
            "--vibration",
            help="Take the loads from runs with the dynamics of SCENE, not from equilibrium.",
        ),
    ] = False,
    set_: SetOption = None,
    out: Annotated[
        Path | None,
        file_option("Write SCENE with the worn flanks, for all other commands.", ".yaml"),
    ] = None,
    picture: Annotated[Path | None, picture_option("Draw the profiles.")] = None,
    json_: JsonOption = None,
) -> None:
    """Compute the wear of all flanks of SCENE by its law durability.wear.

    The load is that of the operating point. Shape, place and ratios follow from the gears; depths
    are in proportion to a coefficient that has to be measured.

    Example: planetary-twin wear paper --set durability.wear.coefficient='1e-18 1/Pa' --hours 1000h
    """
    if picture is not None:
        need("plots", "matplotlib")
    from ..studies.wear.wear import wear as compute

    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        measured = _length(measured_backlash_change)
        with progress_of("wear") as shown_part:
            found = compute(
                loaded,
                _time("--hours", hours),
                vibration,
                measured,
                report=lambda done: shown_part(done, 1.0),
            )
    print_wear(console_beside(json_), loaded.name, found)
    warn(found.remarks())
    if out is not None:
        _write_scene(found, out)
    if picture is not None:
        _draw(found, picture)
    write_json(found.figures(), json_)


def _write_scene(found: Wear, out: Path) -> None:
    import yaml

    content = found.scene.model_dump(mode="json", exclude_none=True)
    text = yaml.safe_dump(content, sort_keys=False, default_flow_style=None)
    with writing("--out", out):
        out.write_text(text, "utf-8")


def _draw(found: Wear, picture: Path) -> None:
    from ..plots.style import save
    from ..plots.wear import wear_profiles

    with writing("--picture", picture):
        save(wear_profiles(found), str(picture))


def _time(option: str, text: str) -> float:
    """A time [s] from a number of hours or a text with a unit."""
    try:
        return HOUR * float(text)
    except ValueError:
        return read_quantity(option, text, "s")


def _length(text: str | None) -> float | None:
    """A measured change of the backlash [m]."""
    return None if text is None else read_quantity("--measured-backlash-change", text, "m")
