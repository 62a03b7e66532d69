"""`planetary-twin lost-motion`: twist of the output under slow torques, with the input held."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, remark
from ..terminal.output_files import PICTURES, file_ending_in, writing
from ..terminal.settings import changed_scene, settings
from ._study import progress

LARGE_SHARE = 0.45  # of the torque; a share must be below 0.5
if TYPE_CHECKING:
    from rich.console import Console

    from ..scene import Scene
    from ..studies.lost_motion import LostMotion


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
    picture: Annotated[
        Path | None,
        typer.Option(metavar="FILE.png", help="Draw the loop.", callback=file_ending_in(*PICTURES)),
    ] = None,
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

    try:
        loaded = changed_scene(scene, settings(set_ or []))
        largest = _torque(loaded, torque)
        with progress("torques", 5 * LEVELS + 3) as advance:
            found = measure(loaded, largest, share, report=advance)
    except (ValueError, ArithmeticError) as error:
        fail(error)
    console = console_beside(json_)
    _print(console, found, largest)
    console.print(_HELD, highlight=False)
    if not found.settled:
        remark(
            "warning: the twist had not come to rest at some torques: the loop is wider than that "
            "of a slower test"
        )
    if not found.hysteresis_resolved:
        remark(
            f"warning: the hysteresis is not resolved: twists are read to "
            f"{math.degrees(found.resolution):.2g} deg; {_better(found)}"
        )
    if picture is not None:
        from ..plots.lost_motion import lost_motion_diagram
        from ..plots.style import save

        with writing("--picture", picture):
            save(lost_motion_diagram(loaded, found), str(picture))
    if json_ is not None:
        write_json(_figures(found), json_)


_HELD = (
    "Of the teeth alone: bearings, shafts and the carrier are rigid, so a measured gearbox is "
    "softer. The compliance of the contacts is that at the largest torque. The stiffness is that "
    "at one position of the mesh: other tooth pairs carry in the other sense and at other positions"
)


def _print(console: Console, found: LostMotion, largest: float) -> None:
    positive, negative = found.stiffness_by_sense
    for name, value in (
        ("largest torque on the output [N m]", largest),
        (f"lost motion at {100 * found.share:g} % of it [deg]", math.degrees(found.lost_motion)),
        (f"hysteresis at {100 * found.share:g} % of it [deg]", _hysteresis(found)),
        ("torsional stiffness, half to full torque [N m/rad]", found.stiffness),
        ("- under positive torque [N m/rad]", positive),
        ("- under negative torque [N m/rad]", negative),
        ("stiffness, motor to load with couplings [N m/rad]", found.stiffness_with_couplings),
    ):
        shown = value if isinstance(value, str) else f"{value:.6g}"
        console.print(f"{name:<52}{shown}", highlight=False, markup=False)


def _hysteresis(found: LostMotion) -> float | str:
    """Hysteresis [deg], or its upper bound if it is not resolved."""
    if found.hysteresis_resolved:
        return math.degrees(found.hysteresis)
    return f"below {math.degrees(found.hysteresis + 2.0 * found.resolution):.2g}"


def _better(found: LostMotion) -> str:
    """What would resolve the hysteresis: it grows with the share, and the resolution does not."""
    if found.share < LARGE_SHARE:
        return f"measure it at a larger --share, up to {LARGE_SHARE:g}"
    return "this friction is too small for this test"


def _figures(found: LostMotion) -> dict[str, object]:
    return {
        "lost_motion": found.lost_motion,
        "hysteresis": found.hysteresis,
        "hysteresis_resolved": found.hysteresis_resolved,
        "stiffness": found.stiffness,
        "stiffness_by_sense": found.stiffness_by_sense,
        "stiffness_with_couplings": found.stiffness_with_couplings,
        "settled": found.settled,
        "torque": found.torque.tolist(),
        "twist": found.twist.tolist(),
    }


def _torque(scene: Scene, text: str | None) -> float:
    """Largest torque on the output [N m]."""
    from ..model.layout import LOAD_MACHINE, Layout
    from ..units.conversion import to_si

    if text is None:
        torque = abs(
            scene.operating_point.input_torque * Layout(scene).machine_torques[LOAD_MACHINE]
        )
        if not torque > 0.0:
            raise ValueError("--torque: required, as input_torque = 0")
        return float(torque)
    try:
        return float(str(to_si(text, "N m")))
    except ValueError as error:
        raise ValueError(f"--torque = {text!r}: {error}") from None
