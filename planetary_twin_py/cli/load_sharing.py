"""`planetary-twin load-sharing`: static load of each planet, and what moves to share it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, remark
from ..terminal.names import shown
from ..terminal.output_files import PICTURES, file_ending_in, writing
from ..terminal.settings import changed_scene, settings
from ..units.engineering import figure, without_rounding

if TYPE_CHECKING:
    from rich.table import Table

    from ..scene import Scene
    from ..scene.supports import Support
    from ..statics.load_sharing import LoadSharing


def load_sharing(
    scene: SceneArgument,
    set_: SetOption = None,
    picture: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.png", help="Draw shares and orbits.", callback=file_ending_in(*PICTURES)
        ),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Compute how the planets of SCENE share the static load.

    Errors of pins, planets and gears (errors, mesh.runout) make planets carry unequal loads;
    members without a bearing (supports) float and even them out. Friction, inertia at changing
    speeds and faults are left out.

    Example: planetary-twin load-sharing floating_sun --picture sharing.png
    """
    if picture is not None:
        need("plots", "matplotlib")
    from ..checks.load_sharing import load_sharing as compute

    try:
        loaded = changed_scene(scene, settings(set_ or []))
        found = compute(loaded)
    except ValueError as error:
        fail(error)
    console = console_beside(json_)
    console.print(_planets(loaded, found))
    console.print(_members(loaded, found))
    console.print(
        f"load sharing factor K_gamma, largest mean over a mesh cycle: {found.mean_factor:.4f}"
    )
    console.print(f"with the ripple of the tooth pairs, largest share: {found.factor:.4f}")
    remarks = _remarks(loaded, found)
    for line in remarks:
        remark(f"warning: {line}")
    if picture is not None:
        from ..plots.load_sharing import load_sharing_diagram
        from ..plots.style import save

        with writing("--picture", picture):
            save(load_sharing_diagram(loaded, found), str(picture))
    if json_ is not None:
        write_json(_figures(loaded, found) | {"remarks": remarks}, json_)


def _planets(scene: Scene, found: LoadSharing) -> Table:
    """Shares of the torque, largest mesh forces and pin forces of each planet."""
    import numpy as np
    from rich.table import Table

    from ..model.planar_rows import CENTRAL

    planets = scene.gearset.planets
    largest = found.mesh_force.max(axis=0)
    pins = np.linalg.norm(found.planet_bearing, axis=2)
    rolling = not np.isnan(found.element_load[:, len(CENTRAL) :]).all()
    table = Table(
        title=f"{shown(scene.name)}: static load sharing, {len(found.turns)} positions",
        caption="Share: torque of a planet over the mean of all planets. Largest forces: on drive "
        "flanks and coast flanks of the sun mesh, on the pin (with the centrifugal force of the "
        "planet)" + ", on an element of a rolling bearing" * rolling,
    )
    for heading in (
        "planet", "share, mean", "smallest", "largest", "drive flank", "coast flank", "pin"
    ):  # fmt: skip
        table.add_column(heading.replace(" ", "\n"), justify="right", no_wrap=True)
    if rolling:
        table.add_column("rolling\nelement", justify="right", no_wrap=True)
    for i in range(planets):
        share, element = found.share[:, i], found.element_load[:, len(CENTRAL) + i].max()
        figures = (f"{value:.4f}" for value in (share.mean(), share.min(), share.max()))
        forces = (figure(v, "N") for v in (largest[0, i], largest[1, i], pins[:, i].max()))
        elements = [] if np.isnan(element) else [figure(float(element), "N")]
        table.add_row(str(i + 1), *figures, *forces, *elements)
    return table


def _members(scene: Scene, found: LoadSharing) -> Table:
    """Displacements and bearing forces of sun, ring and carrier."""
    import numpy as np
    from rich.table import Table

    from ..model.planar_rows import CENTRAL

    table = Table(
        title="Axes",
        caption="Orbit: largest distance of the axis from its mean place. Bearing forces are "
        "without tooth friction, which can multiply them where a member floats; runs with "
        "dynamics = quasi_static_planar include it",
    )
    for heading in ("member", "bearing", "largest displacement", "orbit", "largest bearing force"):
        table.add_column(heading, justify="right")
    largest_force = float(found.mesh_force.max())
    size = scene.gearset.transverse.module  # of the lengths that displacements change
    for k, body in enumerate(CENTRAL):
        moved = found.displacement[:, k]
        displaced = float(np.linalg.norm(moved, axis=1).max())
        orbit = float(np.linalg.norm(moved - moved.mean(axis=0), axis=1).max())
        force = float(np.linalg.norm(found.bearing[:, k], axis=1).max())
        support = getattr(scene.supports, body, None)
        table.add_row(
            body,
            _bearing_text(support),
            figure(without_rounding(displaced, size), "m"),
            figure(without_rounding(orbit, size), "m"),
            figure(without_rounding(force, largest_force), "N"),
        )
    return table


def _bearing_text(support: Support | None) -> str:
    if support is None:
        return "held"
    if support.rolling is not None:
        return support.rolling.text
    return figure(support.bearing, "N/m") if support.bearing else "none: floats"


def _remarks(scene: Scene, found: LoadSharing) -> list[str]:
    lines = []
    if found.both_flanks:
        lines.append(
            "both flanks of a mesh touch at some positions: the backlash is used up, "
            "and planets are wedged between sun and ring"
        )
    if scene.faults:
        lines.append("faults: are left out, teeth are healthy here")
    if scene.tilting_axes:
        lines.append(
            f"dynamics = {scene.dynamics}: these statics are planar, without the axial "
            "motion and tilting of axes (supports.*.axial, tilting), which change shares and "
            "bearing forces; simulate with dynamics = quasi_static_spatial"
        )
    if scene.mesh.backlash == "regulatory_factor":
        lines.append("mesh.backlash = regulatory_factor: forces grow from no deflection")
    return lines


def _figures(scene: Scene, found: LoadSharing) -> dict[str, object]:
    import numpy as np

    from ..model.planar_rows import CENTRAL
    from ..run.axes.motion import axes_names

    return {
        "scene": scene.name,
        "factor": found.factor,
        "mean_factor": found.mean_factor,
        "both_flanks": found.both_flanks,
        "turns": found.turns.tolist(),
        "share": found.share.tolist(),
        "mesh_force": found.mesh_force.tolist(),
        "planet_bearing": found.planet_bearing.tolist(),
        "element_load": {
            body: found.element_load[:, k].tolist()
            for k, body in enumerate(axes_names(scene.gearset.planets))
            if not np.isnan(found.element_load[:, k]).all()
        },
        "bearing": {body: found.bearing[:, k].tolist() for k, body in enumerate(CENTRAL)},
        "displacement": {body: found.displacement[:, k].tolist() for k, body in enumerate(CENTRAL)},
    }
