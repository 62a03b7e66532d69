"""`planetary-twin lost-motion`: twist of the output under slow torques, with the input held."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption, picture_option
from ..terminal.console import progress
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors, warn
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ..terminal.unit_options import read_quantity

if TYPE_CHECKING:
    from ..scene import Scene


def lost_motion(
    scene: SceneArgument,
    torque: Annotated[
        str | None,
        typer.Option(
            metavar="TORQUE",
            help="Largest torque on the output, e.g. '20 N m'; default: that of the operating "
            "point.",
        ),
    ] = None,
    share: Annotated[
        float,
        typer.Option(help="Part of the torque at which lost motion is measured, below 0.5."),
    ] = 0.03,
    set_: SetOption = None,
    picture: Annotated[Path | None, picture_option("Draw the loop.")] = None,
    json_: JsonOption = None,
) -> None:
    """Measure lost motion, hysteresis and torsional stiffness of SCENE.

    The input is held, and the output is loaded slowly from 0 to TORQUE, to its opposite and back.
    Angles are those of the members of the gear set, without the couplings; the last stiffness is
    that from the motor to the load. The stiffness is the mean of both senses, and that of each, at
    one position of the mesh. Bearings, shafts and the carrier are rigid, also those of a scene with
    supports.

    Example: planetary-twin lost-motion paper --torque '100 N m' --picture loop.png
    """
    if picture is not None:
        need("plots", "matplotlib")
    from ..studies.lost_motion import LEVELS
    from ..studies.lost_motion import lost_motion as measure

    with one_line_errors(ArithmeticError):
        loaded = scene_with(scene, set_)
        largest = _torque(loaded, torque)
        with progress("torques", 5 * LEVELS + 3) as advance:
            found = measure(loaded, largest, share, report=advance)
    console = console_beside(json_)
    for heading, text in found.lines():
        console.print(f"{heading:<52}{text}", markup=False)
    console.print(_HELD)
    warn(found.remarks())
    if picture is not None:
        from ..plots.lost_motion import lost_motion_diagram
        from ..plots.style import save

        with writing("--picture", picture):
            save(lost_motion_diagram(loaded, found), str(picture))
    write_json(found.figures(), json_)


_HELD = (
    "Of the teeth alone: bearings, shafts and the carrier are rigid, so a measured gearbox is "
    "softer. The compliance of the contacts is that at the largest torque. The stiffness is that "
    "at one position of the mesh: other tooth pairs carry in the other sense and at other positions"
)


def _torque(scene: Scene, text: str | None) -> float:
    """Largest torque on the output [N m]."""
    from ..model.layout import LOAD_MACHINE, Layout

    if text is None:
        torque = abs(
            scene.operating_point.input_torque * Layout(scene).machine_torques[LOAD_MACHINE]
        )
        if not torque > 0.0:
            raise ValueError("--torque: required, as input_torque = 0")
        return float(torque)
    return read_quantity("--torque", text, "N m")
