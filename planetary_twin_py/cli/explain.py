"""`planetary-twin explain`: the terms of the model of a scene, their effects and the limits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.console import print_list
from ..terminal.figures import rows
from ..terminal.interruptible import interruptible
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import ignore_remarks, one_line_errors, warn
from ..terminal.names import shown
from ..terminal.settings import scene_with
from ..terminal.unit_options import SECONDS
from ..units.catalogue import FIGURES, MESH, SIDES, Quantity, side_title
from ..units.engineering import figure

if TYPE_CHECKING:
    from rich.table import Table

    from ..explanation.measure import Explanation
    from ..explanation.meshes import Meshes
    from ..run.dynamics_choice import DynamicsChoice
    from ..scene import Scene


def explain(
    scene: SceneArgument = "paper",
    duration: Annotated[
        float | None,
        typer.Option(
            help="Simulated time of each run.",
            show_default="0.1 s, or as many whole mesh cycles as take longer",
            **SECONDS,
        ),
    ] = None,
    set_: SetOption = None,
    json_: JsonOption = None,
) -> None:
    """List the terms that SCENE models, and simulate it without each of them.

    Example: planetary-twin explain cracked_tooth --duration 0.2
    """
    from rich.markup import escape

    from ..explanation.measure import explain as measure
    from ..explanation.meshes import describe_meshes
    from ..explanation.oil import oil_figures
    from ..explanation.terms import limits
    from ..explanation.turning import duration_for_means
    from ..scene.summary import gears
    from ..terminal.tables import table

    console = console_beside(json_)
    ignore_remarks()
    with one_line_errors():
        loaded = scene_with(scene, set_)
        meshes = describe_meshes(loaded)
        span = duration_for_means(loaded) if duration is None else duration
        with console.status("simulating the scene") as status:
            found = interruptible(
                lambda: measure(
                    loaded, span, lambda name: status.update(f"simulating without {name}")
                )
            )
    description = f": {escape(loaded.description)}" if loaded.description else ""
    console.print(f"[bold]{shown(loaded.name)}[/bold]{description}\n")
    print_list(console, "gears: ", gears(loaded))
    console.print()
    console.print(_mesh_table(loaded, meshes))
    oil = oil_figures(loaded)
    for line in oil.lines if oil else ():
        console.print(line, markup=False)
    if loaded.dynamics == "auto":
        console.print(found.dynamics.text)
        loaded = found.dynamics.scene
    console.print(_term_table(found))
    if found.entries:
        console.print(_entry_table(found))
    console.print(_dynamics_table(found.dynamics))
    headings = ("not modelled", "consequence")
    console.print(table(headings, limits(loaded), title="Limits of the model", texts=headings))
    warn(found.remarks)
    of_meshes = {side: getattr(meshes, side)._asdict() for side in SIDES}
    figures = {
        **found.as_figures(),
        "mesh_frequency": meshes.mesh_frequency,
        "meshes": of_meshes,
        "oil": None if oil is None else oil.as_figures(),
    }
    write_json(figures, json_)


def _mesh_table(scene: Scene, meshes: Meshes) -> Table:
    from ..explanation.meshes import MeshFigures
    from ..scene.summary import power_enters_at_output
    from ..terminal.tables import table
    from ..units.conversion import rpm
    from ..units.shown import quantities_of

    point = scene.operating_point
    inputs = (point.input_speed, point.second_input_speed)[: len(scene.drive.inputs)]
    speed = " and ".join(f"{speed / rpm(1.0):.6g} rpm" for speed in inputs)
    caption = [  # one line each, because a caption may be folded between a value and its unit
        f"mesh frequency f_m {meshes.mesh_frequency:.4g} Hz",
        f"input speed {speed}",
        f"input torque {figure(point.input_torque, 'N m')}",
    ]
    if power_enters_at_output(scene):
        caption.append(f"power enters at the output, the {scene.drive.output.member}")
    quantities, missing = quantities_of(MeshFigures), "out of range"
    if meshes.sun_planet.driver is None:
        quantities, missing = quantities | _UNDRIVEN, "none: no power"
    sides = (getattr(meshes, side)._asdict() for side in SIDES)
    return table(
        ("", *map(side_title, SIDES)),
        rows(quantities, *sides, missing=missing),
        title="Meshes at the operating point",
        caption="\n".join(caption),
    )


# In place of those of `MeshFigures` if no power is transmitted.
_UNDRIVEN = {
    "approach": Quantity("path of contact to the tip of the second, base pitches"),
    "recess": Quantity("path of contact to the tip of the first, base pitches"),
}


def _dynamics_table(found: DynamicsChoice) -> Table:
    """Errors and computing time of each dynamics."""
    from ..terminal.tables import table

    return table(
        ("dynamics", *map(_heading, FIGURES), "run time [s]"),
        [
            [
                each.dynamics,
                *(f"{100.0 * each.errors[name]:.2f}" for name in FIGURES),
                f"{each.cost:.2g}",
            ]
            for each in found.candidates
            if not each.refused  # the caption has the reason
        ],
        title=f"Dynamics: error of each against {found.reference} [%], in steady running",
        caption=f"{found.verdict}\nRun time is computing time per simulated second. Bearing "
        "forces and orbits need axes that move: planar, spatial, quasi_static_planar, "
        "quasi_static_spatial.",
    )


def _term_table(found: Explanation) -> Table:
    from ..terminal.tables import table

    whole = found.figures
    values = (f"{_heading(name)} {figure(whole[name], MESH[name].si)}" for name in FIGURES)
    headings = (heading.replace(" ", "\n") for heading in (*map(_heading, FIGURES), "run time"))
    return table(
        ("term: law", *headings),
        [
            [
                f"{effect.term.name}: {effect.term.law}",
                *(_change(whole[name], effect.without[name]) for name in FIGURES),
                f"{-100 * effect.cost:+.0f}",
            ]
            for effect in found.effects
        ],
        title="Modelled terms, and the change of results without each [%]",
        caption="\n".join(("results of the complete scene", *values)),
        whole=True,
    )


def _entry_table(found: Explanation) -> Table:
    """Peak loads of tooth pairs by how teeth come into contact."""
    from ..terminal.tables import table

    return table(
        ("mesh.entry", *map(side_title, SIDES)),
        [
            [each.entry, *(f"{peak:.3f}" for peak in each.peaks)]
            for each in found.entries
            if each.peaks  # the caption has the reason
        ],
        title="Entry of teeth: largest load of a tooth pair over the static mesh force",
        caption="\n".join(
            f"Not possible: {each.entry}: {each.refused}" for each in found.entries if each.refused
        ),
    )


def _heading(name: str) -> str:
    """Short title of one of `FIGURES`."""
    return name.replace("_", " ").replace("dte", "DTE")


def _change(before: float, after: float) -> str:
    return f"{100 * (after / before - 1.0):+.2f}" if before != 0.0 else "-"
