"""`planetary-twin modal`: natural frequencies, and the speeds at which meshing meets them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import need, one_line_errors, warn
from ..terminal.names import shown
from ..terminal.output_files import output_file, writing
from ..terminal.settings import scene_with
from ..terminal.unit_options import read_quantity

if TYPE_CHECKING:
    from rich.table import Table

    from ..modal.modes import NaturalModes
    from ..modal.springs import SpringModel
    from ..scene import Scene

LEAST_CHANGE = 0.005  # [Hz]


def modal(
    scene: SceneArgument = "paper",
    model: Annotated[
        str | None,
        typer.Option(
            help="One of torsional, machines, printed, planar, spatial.",
            show_default="that of the dynamics of SCENE",
        ),
    ] = None,
    set_: SetOption = None,
    input_speed: Annotated[
        str | None,
        typer.Option(
            metavar="SPEED",
            help="Speed of the first motor for planar and spatial modes, in the frame of the "
            "carrier, e.g. 1000rpm; a second motor has that of SCENE.",
            show_default="nothing turns",
        ),
    ] = None,
    campbell: Annotated[
        Path | None,
        typer.Option(
            "--campbell",
            "--picture",
            metavar="FILE.png",
            help="Draw the Campbell diagram.",
            callback=output_file,
        ),
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
    from ..modal.natural import model_of, natural_modes, spring_model
    from ..modal.remarks import modal_remarks
    from ..modal.resonance_text import resonance_lines
    from ..simulation.natural_modes import chosen

    with one_line_errors():
        loaded = chosen(scene_with(scene, set_), model)
        model = model_of(loaded) if model is None else model
        speed = _speed(input_speed, model)
        single, mean = (natural_modes(loaded, model, k, speed) for k in ("single", "mean"))
        springs = spring_model(loaded, model, "mean")
    limit = loaded.drive.speed_limit
    found = resonances(loaded, mean, springs, limit, input_speed=speed)
    console = console_beside(json_)
    turning = _turning(loaded, speed)
    title = f"{shown(loaded.name)}, {model} model{turning}"
    console.print(_mode_table(title, single, mean, None if turning else springs))
    for line in resonance_lines(loaded, found):
        console.print(line)
    warn(modal_remarks(loaded, model, speed if turning else None))
    if campbell is not None:
        from ..plots.campbell import campbell_diagram
        from ..plots.style import save

        with writing("--campbell", campbell):
            save(campbell_diagram(loaded, mean, found, limit, model=model), str(campbell))
    speeds = {"input_speed": speed or 0.0, "speed_limit": limit}
    resonant = {"resonances": [resonance._asdict() for resonance in found]}
    write_json(_frequencies(single, mean) | speeds | resonant, json_)


def _speed(text: str | None, model: str) -> float | None:
    """Speed of the first motor [rad/s] from an option."""
    if text is None:
        return None
    from ..modal.natural import MOVING_AXES

    speed = read_quantity("--input-speed", text, "rad/s")
    if speed and model not in MOVING_AXES:
        raise ValueError(
            f"--input-speed = {text!r}: has an effect with --model planar and spatial only"
        )
    return speed if model in MOVING_AXES else None


def _turning(scene: Scene, speed: float | None) -> str:
    """Part of a title that states the speeds [rad/s] of the motors unless nothing turns."""
    from ..modal.resonance_text import in_rpm

    if speed is None:
        return ""
    speeds = (speed, scene.operating_point.second_input_speed)[: len(scene.drive.inputs)]
    if not any(speeds):
        return ""
    inputs = "inputs" if len(speeds) > 1 else "input"
    return f", {inputs} at {' and '.join(map(in_rpm, speeds))}, frame of the carrier"


def _frequencies(single: NaturalModes, mean: NaturalModes) -> dict[str, Any]:
    """Natural modes for `--json`, with one pair in every mesh and with the mean stiffness."""
    first, second = (
        {"frequencies_hz": modes.frequencies.tolist(), "kinds": list(modes.kinds)}
        for modes in (single, mean)
    )
    return first | {"mean_stiffness": second}


def _mode_table(
    title: str, single: NaturalModes, mean: NaturalModes, springs: SpringModel | None
) -> Table:
    """Modes in ascending order of frequency; with the sensitivity to `springs` if given."""
    from ..terminal.tables import table

    # The order of two modes may differ between the two stiffnesses.
    both = zip(single.kinds, mean.kinds, strict=True)
    kinds = [", then ".join(dict.fromkeys(pair)) for pair in both]
    modes = zip(single.frequencies, mean.frequencies, kinds, strict=True)
    rows = [[f"{m}", f"{one:.2f}", f"{f:.2f}", kind] for m, (one, f, kind) in enumerate(modes, 1)]
    headings = ["mode", "f, one pair [Hz]", "f, mean [Hz]", "kind"]
    caption = "Frequency f with one tooth pair in every mesh, and with the mean mesh stiffness"
    if springs is not None:
        headings.append(_CHANGE)
        caption += (
            ", and its change if the stiffness of one kind of spring rises by 1 %; "
            f"changes below {LEAST_CHANGE:g} Hz are omitted"
        )
        for row, changes in zip(rows, _changes(springs), strict=True):
            row.append(_text(changes))
    if single.kinds != mean.kinds:
        caption += ". Two kinds: that with one pair, then that with the mean"
    return table(headings, rows, title=title, caption=caption, texts=(_CHANGE,))


_CHANGE = "change per 1 % of stiffness [Hz]"


def _changes(springs: SpringModel) -> list[dict[str, float]]:
    """For each mode, the change of its frequency [Hz] by kind of spring that is 1 % stiffer."""
    from ..modal.sensitivity import frequency_sensitivities

    slopes = frequency_sensitivities(springs)
    stiffness = {spring.kind: spring.stiffness / spring.factor for spring in springs.acting}
    return [
        {kind: slopes[kind][mode] * 0.01 * size for kind, size in stiffness.items()}
        for mode in range(len(springs.mass))
    ]


def _text(changes: dict[str, float]) -> str:
    """Changes [Hz] by kind of spring, largest first, without those that round to 0."""
    ordered = sorted(changes.items(), key=lambda change: -abs(change[1]))
    felt = (
        f"{name.replace('_', ' ')} {change:+.2f}"
        for name, change in ordered
        if abs(change) >= LEAST_CHANGE
    )
    return ", ".join(felt) or "-"
