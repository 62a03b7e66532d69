"""`planetary-twin modal`: natural frequencies, and the speeds at which meshing excites them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, put_figures
from ..terminal.messages import fail, need
from ..terminal.output_files import output_file
from ..terminal.settings import changed_scene, settings

if TYPE_CHECKING:
    from rich.table import Table

    from ..modal.campbell import Resonance
    from ..modal.modes import NaturalModes
    from ..modal.springs import SpringModel

LEAST_CHANGE = 0.005  # [Hz]


def modal(
    scene: SceneArgument = "paper",
    model: Annotated[
        str, typer.Option(help="One of torsional, machines, printed, planar, spatial.")
    ] = "torsional",
    set_: SetOption = None,
    campbell: Annotated[
        Path | None,
        typer.Option(metavar="FILE.png", help="Draw the Campbell diagram.", callback=output_file),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """List the natural modes of SCENE, their sensitivity to stiffness, and the resonant speeds.

    Frequencies are given for one tooth pair in every mesh and for the mean mesh stiffness;
    resonant speeds and the Campbell diagram use the mean mesh stiffness.

    Example: planetary-twin modal wind_turbine_stage --model planar --campbell campbell.png
    """
    if campbell is not None:
        need("plots", "matplotlib")
    from ..modal.campbell import resonances
    from ..modal.modes import modes_of
    from ..modal.natural import natural_modes, spring_model

    try:
        loaded = changed_scene(scene, settings(set_ or []))
        single = natural_modes(loaded, model)
        springs = spring_model(loaded, model, "mean")
    except ValueError as error:
        fail(error)
    mean, limit = modes_of(springs), loaded.drive.speed_limit
    found = resonances(loaded, mean, limit)
    console = console_beside(json_)
    console.print(_mode_table(f"{loaded.name}, {model} model", single, mean, springs))
    console.print(_heading(limit), highlight=False)
    for resonance in found:
        console.print(_line(resonance))
    if not found:
        console.print("none")
    if campbell is not None:
        from ..plots.campbell import campbell_diagram
        from ..plots.style import save

        try:
            save(campbell_diagram(loaded, mean, found, limit), str(campbell))
        except (OSError, ValueError) as error:
            fail(f"--campbell = {str(campbell)!r}: {error}")
    if json_ is not None:
        figures = {
            "frequencies_hz": single.frequencies.tolist(),
            "kinds": list(single.kinds),
            "mean_stiffness": {
                "frequencies_hz": mean.frequencies.tolist(),
                "kinds": list(mean.kinds),
            },
            "speed_limit": limit,
            "resonances": [resonance._asdict() for resonance in found],
        }
        put_figures(figures, json_)


def _mode_table(
    title: str, single: NaturalModes, mean: NaturalModes, springs: SpringModel
) -> Table:
    """Modes in ascending order of frequency; `springs` is the model of `mean`."""
    from rich.table import Table

    from ..modal.sensitivity import frequency_sensitivities

    slopes = frequency_sensitivities(springs)
    stiffness = {spring.kind: spring.stiffness for spring in springs.springs}
    table = Table(
        title=title,
        caption="Frequency f with one tooth pair in every mesh, with the mean mesh stiffness, and "
        "its change if the stiffness of one kind of spring rises by 1 %; changes below "
        f"{LEAST_CHANGE:g} Hz are omitted",
    )
    for heading in ("mode", r"f, one pair \[Hz]", r"f, mean \[Hz]", "kind"):
        table.add_column(heading, justify="right")
    table.add_column(r"change per 1 % of stiffness \[Hz]")
    for m, kinds in enumerate(zip(single.kinds, mean.kinds, strict=True)):
        changes = {name: slopes[name][m] * 0.01 * stiffness[name] for name in slopes}
        frequencies = (f"{modes.frequencies[m]:.2f}" for modes in (single, mean))
        # The order of two modes may differ between the two stiffnesses.
        table.add_row(
            str(m + 1), *frequencies, ", then ".join(dict.fromkeys(kinds)), _shown(changes)
        )
    return table


def _shown(changes: dict[str, float]) -> str:
    """Changes [Hz] by kind of spring, largest first, without those that round to 0."""
    ordered = sorted(changes.items(), key=lambda change: -abs(change[1]))
    felt = (
        f"{name.replace('_', ' ')} {change:+.2f}"
        for name, change in ordered
        if abs(change) >= LEAST_CHANGE
    )
    return ", ".join(felt) or "-"


def _heading(limit: float) -> str:
    from ..modal.campbell import HARMONICS
    from ..units import rpm

    return (
        f"Resonances at mean mesh stiffness, harmonics 1 to {HARMONICS} of the mesh frequency, "
        f"speeds up to {limit / rpm(1.0):.0f} rpm (drive.speed_limit):"
    )


def _line(resonance: Resonance) -> str:
    from ..units import rpm

    numbers = range(resonance.mode + 1, resonance.mode + 1 + resonance.multiplicity)
    modes = f"mode{'s' * (len(numbers) > 1)} {', '.join(map(str, numbers))}"
    return (
        f"{resonance.speed / rpm(1.0):10.1f} rpm: harmonic {resonance.harmonic} "
        f"of the mesh frequency excites {modes} at {resonance.frequency:.1f} Hz"
    )
