"""`planetary-twin load-sharing`: static load of each planet, and what moves to share it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from ..terminal.arguments import JsonOption, SceneArgument, SetOption, picture_option
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors, warn
from ..terminal.names import shown
from ..terminal.output_files import writing
from ..terminal.settings import scene_with
from ..units.engineering import figure, without_rounding

if TYPE_CHECKING:
    from rich.table import Table

    from ..scene import Scene
    from ..scene.supports import Support
    from ..statics.load_sharing import LoadSharing


def load_sharing(
    scene: SceneArgument,
    set_: SetOption = None,
    picture: Annotated[Path | None, picture_option("Draw shares and orbits.")] = None,
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
    from ..checks.load_sharing import load_sharing_remarks

    with one_line_errors():
        loaded = scene_with(scene, set_)
        found = compute(loaded)
    console = console_beside(json_)
    console.print(_planets(loaded, found))
    console.print(_members(loaded, found))
    console.print(
        f"load sharing factor K_gamma, largest mean over a mesh cycle: {found.mean_factor:.4f}"
    )
    console.print(f"with the ripple of the tooth pairs, largest share: {found.factor:.4f}")
    remarks = [*load_sharing_remarks(loaded, found)]
    warn(remarks)
    if picture is not None:
        from ..plots.load_sharing import load_sharing_diagram
        from ..plots.style import save

        with writing("--picture", picture):
            save(load_sharing_diagram(loaded, found), str(picture))
    write_json({"scene": loaded.name} | found.figures() | {"remarks": remarks}, json_)


def _planets(scene: Scene, found: LoadSharing) -> Table:
    """Shares of the torque, largest mesh forces and pin forces of each planet."""
    import numpy as np

    from ..model.planar_rows import CENTRAL
    from ..terminal.tables import table

    drive, coast = found.mesh_force.max(axis=0)[:2]
    pins = np.linalg.norm(found.planet_bearing, axis=2).max(axis=0)
    elements = found.element_load[:, len(CENTRAL) :].max(axis=0)
    rolling = not np.isnan(found.element_load[:, len(CENTRAL) :]).all()
    headings = ["planet", "share, mean", "smallest", "largest", "drive flank", "coast flank", "pin"]
    rows = []
    for i, share in enumerate(found.share.T):
        shares = (f"{value:.4f}" for value in (share.mean(), share.min(), share.max()))
        forces = [drive[i], coast[i], pins[i]] + ([] if np.isnan(elements[i]) else [elements[i]])
        rows.append([f"{i + 1}", *shares, *(figure(float(force), "N") for force in forces)])
    return table(
        [heading.replace(" ", "\n") for heading in headings + ["rolling element"] * rolling],
        rows,
        title=f"{shown(scene.name)}: static load sharing, {len(found.turns)} positions",
        caption="Share: torque of a planet over the mean of all planets. Largest forces: on drive "
        "flanks and coast flanks of the sun mesh, on the pin (with the centrifugal force of the "
        "planet)" + ", on an element of a rolling bearing" * rolling,
        whole=True,
    )


def _members(scene: Scene, found: LoadSharing) -> Table:
    """Displacements and bearing forces of sun, ring and carrier."""
    import numpy as np

    from ..model.planar_rows import CENTRAL
    from ..terminal.tables import table

    largest_force = float(found.mesh_force.max())
    size = scene.gearset.transverse.module  # of the lengths that displacements change
    rows = []
    for k, body in enumerate(CENTRAL):
        moved = found.displacement[:, k]
        vectors = (  # with their units, and the size of what they are sums of
            (moved, "m", size),
            (moved - moved.mean(axis=0), "m", size),
            (found.bearing[:, k], "N", largest_force),
        )
        largest = (
            figure(without_rounding(float(np.linalg.norm(vector, axis=1).max()), scale), unit)
            for vector, unit, scale in vectors
        )
        rows.append([body, _bearing_text(getattr(scene.supports, body, None)), *largest])
    return table(
        ("member", "bearing", "largest displacement", "orbit", "largest bearing force"),
        rows,
        title="Axes",
        caption="Orbit: largest distance of the axis from its mean place. Bearing forces are "
        "without tooth friction, which can multiply them where a member floats; runs with "
        "dynamics = quasi_static_planar include it",
    )


def _bearing_text(support: Support | None) -> str:
    if support is None:
        return "held"
    if support.rolling is not None:
        return support.rolling.text
    return figure(support.bearing, "N/m") if support.bearing else "none: floats"
