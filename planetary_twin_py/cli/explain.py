"""`planetary-twin explain`: the terms of the model of a scene, their effects and the limits."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.console import print_list
from ..terminal.interruptible import interruptible
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, remark
from ..terminal.names import shown
from ..terminal.settings import changed_scene, settings
from ..terminal.unit_options import SECONDS
from ..units.engineering import figure
from ._oil import print_oil

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
    from ..explanation.turning import duration_for_means
    from ..scene.summary import gears
    from ..text.warning_types import AccuracyWarning, LedgerWarning

    console = console_beside(json_)
    for kind in (AccuracyWarning, LedgerWarning):  # printed with the remarks
        warnings.simplefilter("ignore", kind)
    try:
        loaded = changed_scene(scene, settings(set_ or []))
        meshes = describe_meshes(loaded)
        span = duration_for_means(loaded) if duration is None else duration
        with console.status("simulating the scene") as status:
            found = interruptible(
                lambda: measure(
                    loaded, span, lambda name: status.update(f"simulating without {name}")
                )
            )
    except ValueError as error:
        fail(error)
    description = f": {escape(loaded.description)}" if loaded.description else ""
    console.print(f"[bold]{shown(loaded.name)}[/bold]{description}\n")
    print_list(console, "gears: ", gears(loaded))
    console.print()
    console.print(_mesh_table(loaded, meshes))
    oil = print_oil(console, loaded)
    if loaded.dynamics == "auto":
        console.print(found.dynamics.text, highlight=False)
        loaded = found.dynamics.scene
    console.print(_table(found))
    console.print(_dynamics_table(found.dynamics))
    console.print(_limits(loaded))
    for line in found.remarks:
        remark(f"warning: {line}")
    write_json(_as_figures(found) | _mesh_figures(meshes) | oil, json_)


def _mesh_table(scene: Scene, meshes: Meshes) -> Table:
    from rich.table import Table

    from ..scene.summary import power_enters_at_output
    from ..units.conversion import rpm

    point = scene.operating_point
    inputs = (point.input_speed, point.second_input_speed)[: len(scene.drive.inputs)]
    reverse = power_enters_at_output(scene)
    speed = " and ".join(f"{speed / rpm(1.0):.6g} rpm" for speed in inputs)
    figures = (  # one line each, because a caption may be folded between a value and its unit
        f"mesh frequency f_m {meshes.mesh_frequency:.4g} Hz",
        f"input speed {speed}",
        f"input torque {figure(point.input_torque, 'N m')}",
        *([f"power enters at the output, the {scene.drive.output.member}"] * reverse),
    )
    table = Table(
        "",
        title="Meshes at the operating point",
        caption="\n".join(figures),
    )
    for side in ("sun-planet", "planet-ring"):
        table.add_column(side, justify="right")
    driven = meshes.sun_planet.driver is not None
    missing = "out of range" if driven else "none: no power"
    for (label, unit), *values in zip(
        _MESH_ROWS, meshes.sun_planet, meshes.planet_ring, strict=True
    ):
        table.add_row(
            label if driven else _UNDRIVEN.get(label, label),
            *(_text(value, unit, missing) for value in values),
        )
    return table


# Labels and SI units of the fields of `MeshFigures`, in their order.
_MESH_ROWS = (
    ("teeth", ""),
    ("working pressure angle", "rad"),
    ("contact ratio", ""),
    ("overlap ratio", ""),
    ("driving gear, in the frame of the carrier", "name"),
    ("length of approach in base pitches", ""),
    ("length of recess in base pitches", ""),
    ("backlash by profile shift and centre distance", "m"),
    ("clearance of both tips from the mating root", "m"),
    ("stiffness of one pair, largest on its path", "N/m"),
    ("stiffness, mean over the mesh cycle", "N/m"),
    ("the same of solid discs by ISO 6336-1, c_gamma", "N/m"),
    ("natural frequency of the two gears alone, one pair in contact", "Hz"),
    ("damping ratio of this mode", ""),
    ("static mesh force", "N"),
    ("axial part of the same", "N"),
    ("Hertz pressure at or next to the pitch point, one pair carries the static force", "Pa"),
    ("tooth loss factor H_v, equal loads of the pairs in contact", ""),
    ("the same with the loads of the pairs in this model", ""),
    ("backlash on the line of action", "m"),
    ("friction coefficient, mean over the path of contact", ""),
    ("the same with eyring", ""),
    ("the same with evans_johnson", ""),
    ("the same with schlenk", ""),
    ("tooth loss of all planets: friction coefficient, last H_v and power", "W"),
    ("shear number of the film, above 1 shear-thinning", ""),
    ("film laws within their range", ""),
)
# Labels in place of these if no power is transmitted.
_UNDRIVEN = {
    "length of approach in base pitches": "path of contact to the tip of the second, base pitches",
    "length of recess in base pitches": "path of contact to the tip of the first, base pitches",
}


def _text(value: Any, unit: str, missing: str) -> str:
    if isinstance(value, tuple):
        return "/".join(_text(part, unit, missing) for part in value)
    if value is None:
        return missing
    return figure(value, unit) if isinstance(value, float) else str(value)


def _mesh_figures(meshes: Meshes) -> dict[str, Any]:
    return {
        "mesh_frequency": meshes.mesh_frequency,
        "meshes": {
            "sun_planet": meshes.sun_planet._asdict(),
            "planet_ring": meshes.planet_ring._asdict(),
        },
    }


def _dynamics_table(found: DynamicsChoice) -> Table:
    """Errors and computing time of each dynamics."""
    from rich.table import Table

    from ..units.catalogue import FIGURES

    table = Table(
        title=f"Dynamics: error of each against {found.reference} [%], in steady running",
        caption=f"{_verdict(found)}\nRun time is computing time per simulated second. Bearing "
        "forces and orbits need axes that move: planar, spatial, quasi_static_planar, "
        "quasi_static_spatial.",
    )
    table.add_column("dynamics")
    for name in (*FIGURES, "run time \\[s]"):
        table.add_column(_heading(name), justify="right")
    for each in found.candidates:
        if each.refused:  # the caption has the reason
            continue
        errors = (f"{100.0 * each.errors[name]:.2f}" for name in FIGURES)
        table.add_row(each.dynamics, *errors, f"{each.cost:.2g}")
    return table


def _verdict(found: DynamicsChoice) -> str:
    """The selected dynamics, the errors of the others, and why some are not possible."""
    lines = [
        f"Simplest dynamics within {100.0 * found.allowed:g} % (dynamics_error): {found.dynamics}."
    ]
    others = [
        f"{each.dynamics} {each.largest}"
        for each in found.candidates
        if not each.refused and each.dynamics not in (found.dynamics, found.reference)
    ]
    if others:
        lines[0] += f" Errors of the others: {', '.join(others)}."
    for each in found.candidates:
        if each.refused:
            lines.append(f"Not possible: {each.dynamics}, because {each.refused}.")
    return "\n".join(lines)


def _table(found: Explanation) -> Table:
    from rich.table import Table

    from ..units.catalogue import FIGURES, MESH

    whole = found.figures
    values = (f"{_heading(name)} {figure(whole[name], MESH[name].si)}" for name in FIGURES)
    table = Table(
        title="Modelled terms, and the change of results without each [%]",
        caption="\n".join(("results of the complete scene", *values)),
    )
    table.add_column("term: law")
    for heading in (*map(_heading, FIGURES), "run time"):
        table.add_column(heading.replace(" ", "\n"), justify="right", no_wrap=True)
    for effect in found.effects:
        table.add_row(
            f"{effect.term.name}: {effect.term.law}",
            *(_change(whole[name], effect.without[name]) for name in FIGURES),
            f"{-100 * effect.cost:+.0f}",
        )
    return table


def _heading(name: str) -> str:
    """Short title of one of `FIGURES`."""
    return name.replace("_", " ").replace("dte", "DTE")


def _change(before: float, after: float) -> str:
    return f"{100 * (after / before - 1.0):+.2f}" if before != 0.0 else "-"


def _limits(scene: Scene) -> Table:
    from rich.table import Table

    from ..explanation.terms import limits

    table = Table("not modelled", "consequence", title="Limits of the model")
    for limit in limits(scene):
        table.add_row(*limit)
    return table


def _as_figures(found: Explanation) -> dict[str, Any]:
    return {
        "scene": found.figures,
        "terms": [
            {
                "name": effect.term.name,
                "law": effect.term.law,
                "without": effect.without,
                "cost": effect.cost,
            }
            for effect in found.effects
        ],
        "dynamics": found.dynamics.figures(),
        "remarks": found.remarks,
    }
