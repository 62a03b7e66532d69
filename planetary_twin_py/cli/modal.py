"""`planetary-twin modal`: natural frequencies and the speeds at which the meshing meets them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ._arguments import JsonOption, SceneArgument, SetOption
from ._fail import fail, need
from ._figures import console_beside, put_figures
from ._settings import settings


def modal(
    scene: SceneArgument = "paper",
    model: Annotated[
        str, typer.Option(help="torsional, machines, printed, planar or spatial.")
    ] = "torsional",
    set_: SetOption = None,
    campbell: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="Draw the Campbell diagram.")
    ] = None,
    json_: JsonOption = None,
) -> None:
    """List the natural modes of SCENE, how stiffnesses move them, and resonant speeds.

    Example: planetary-twin modal wind_turbine_stage --model planar --campbell campbell.png
    """
    if campbell is not None:
        need("plots", "matplotlib")
    from rich.table import Table

    from ..modal.campbell import resonances
    from ..modal.modes import modes_of
    from ..modal.natural import spring_model
    from ..modal.sensitivity import frequency_sensitivities
    from ..scene import load_scene

    try:
        loaded = load_scene(scene).replace(**settings(set_ or []))
        springs = spring_model(loaded, model)
    except ValueError as error:
        fail(error)
    modes, slopes = modes_of(springs), frequency_sensitivities(springs)
    found = resonances(loaded, modes, loaded.drive.speed_limit)
    table = Table(
        title=f"{loaded.name}, {model} model", caption="change of f [Hz] by 1 % of stiffness"
    )
    for heading in ("mode", "f [Hz]", "kind", *slopes):
        table.add_column(heading.replace("_", " "), justify="right")
    stiffness = {spring.kind: spring.stiffness for spring in springs.springs}
    for m, (frequency, kind) in enumerate(zip(modes.frequencies, modes.kinds, strict=True)):
        changes = [slopes[name][m] * 0.01 * stiffness[name] for name in slopes]
        shown = ["-" if change != change else f"{change:+.2f}" for change in changes]
        table.add_row(str(m + 1), f"{frequency:.2f}", kind, *shown)
    console = console_beside(json_)
    console.print(table)
    for resonance in found:
        console.print(
            f"{resonance.speed * 30 / 3.141592653589793:10.1f} rpm: harmonic {resonance.harmonic} "
            f"of the meshing meets mode {resonance.mode + 1} at {resonance.frequency:.1f} Hz"
        )
    if campbell is not None:
        from ..plots.campbell import campbell_diagram
        from ..plots.style import save

        try:
            save(campbell_diagram(loaded, modes, found, loaded.drive.speed_limit), str(campbell))
        except (OSError, ValueError) as error:
            fail(f"--campbell = {str(campbell)!r}: {error}")
    if json_ is not None:
        figures = {
            "frequencies_hz": modes.frequencies.tolist(),
            "kinds": list(modes.kinds),
            "resonances": [resonance._asdict() for resonance in found],
        }
        put_figures(figures, json_)
