"""`planetary-twin simulate`: a run without ROS, as fast as possible."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import (
    DurationOption,
    JsonOption,
    SceneArgument,
    SetOption,
    ToleranceOption,
)
from ..terminal.console import print_list, progress_of
from ..terminal.figures import keyed, print_lines, rows, text_of
from ..terminal.interruptible import interruptible
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, ignore_remarks, need, one_line_errors, warn
from ..terminal.names import shown
from ..terminal.output_files import check_file, check_recording
from ..terminal.settings import changed_scene, settings
from ..terminal.unit_options import HERTZ, SECONDS
from ..units.engineering import figure, without_rounding

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from ..run.axes.motion import AxesMotion
    from ..run.result import Result
    from ..scene import Scene
    from ..terminal.tables import TableConsole


def simulate(
    scene: SceneArgument = "paper",
    duration: DurationOption = 1.0,
    sample_rate: Annotated[float, typer.Option(help="Samples per simulated second.", **HERTZ)] = (
        50_000.0
    ),
    settling: Annotated[
        float,
        typer.Option(help="Simulated time before, excluded from results and samples.", **SECONDS),
    ] = 0.0,
    tolerance: ToleranceOption = 1e-4,
    set_: SetOption = None,
    out: Annotated[
        Path | None,
        typer.Option(
            help="Write samples (.npz, or .csv without sensors) or a recording (.mcap, folder)."
        ),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Simulate SCENE and print the results.

    The integrator computes means, rms and peaks over --duration, so they do not depend on
    --sample-rate. A recording (.mcap, folder) also contains the time of --settling. The operating
    point is constant: `resimulate` makes a step or a reversal in such a recording.

    Example: planetary-twin simulate paper --duration 0.5 --set lambda_ratio=1.5 --out run.npz
    """
    from ..explanation.remarks import remarks
    from ..scene.unused import without_effect
    from ..simulation.simulate import simulate as run

    console = console_beside(json_)
    ignore_remarks()
    with one_line_errors():
        write = None if out is None else _writer(out)
        changes = settings(set_ or [])
        loaded = changed_scene(scene, changes)
        how = duration, sample_rate
        if out is not None and write is None:
            result = _record(out, loaded, (*how, tolerance, settling))
        else:
            with console.status(f"simulating {duration:g} s of {shown(loaded.name)}"):
                result = interruptible(
                    lambda: run(loaded, *how, tolerance=tolerance, settling=settling)
                )
        if result.choice is not None:
            loaded = result.choice.scene
        if out is not None and write is not None:
            write(result, loaded, out)
    at_end = _at_end(loaded, result)
    figures = {
        **_print_choice(console, result),
        **_print_train(console, loaded, result, settling),
        **_print_meshes(console, result),
        **_print_axes(console, result.axes),
        **_print_temperatures(console, result),
        **_print_damage(console, at_end, result),
        **_print_oil(console, at_end),
        "remarks": [*without_effect(at_end, changes), *remarks(at_end, result, tolerance)],
    }
    warn(figures["remarks"])
    write_json(figures, json_)


def _writer(out: Path) -> Callable[[Result, Scene, Path], None] | None:
    """What writes the samples to `out`; None for a recording. Ends if `out` cannot be written."""
    from ..recording.tables.result_files import WRITERS

    if out.suffix in WRITERS:
        check_file("--out", out)
    elif out.suffix in _RECORDINGS:
        check_recording("--out", out)
        need("recording", "mcap", "rosbags")
    else:
        fail(f"--out = {str(out)!r}: must end in {', '.join(WRITERS)} or .mcap, or be a folder")
    return WRITERS.get(out.suffix)


_RECORDINGS = (".mcap", "")


def _record(out: Path, scene: Scene, how: Sequence[float]) -> Result:
    """Simulate and record; for `how`, four numbers, see `recording.runs.offline.Plan`."""
    from dataclasses import replace

    from ..recording.runs.offline import Plan, record_run
    from ..simulation.simulate import check_run, selected

    scene, choice = selected(scene)
    duration, sample_rate, tolerance, settling = how
    plan = Plan(scene, duration, sample_rate, tolerance, settling)
    check_run(plan.duration, plan.sample_rate, "auto", plan.tolerance, plan.settling)
    whole = plan.settling + plan.duration
    with progress_of("recording") as show:
        _, result = record_run(plan, out, lambda time: show(time, whole))
    return replace(result, choice=choice)


def _at_end(scene: Scene, result: Result) -> Scene:
    """The scene with the temperature of the oil at the end, where that is a state."""
    if not result.temperatures:
        return scene
    oil = {"oil_temperature": result.temperatures["oil"]}
    point = scene.operating_point.model_copy(update=oil)
    return scene.model_copy(update={"operating_point": point})


def _print_choice(console: TableConsole, result: Result) -> dict[str, Any]:
    """Print which dynamics were chosen, and return it; nothing if the scene states them."""
    if result.choice is None:
        return {}
    console.print(result.choice.text)
    return {"dynamics": result.choice.figures()}


def _print_oil(console: TableConsole, scene: Scene) -> dict[str, Any]:
    """Print what is known of the oil, and return it."""
    from ..explanation.oil import oil_figures

    oil = oil_figures(scene)
    for line in oil.lines if oil else ():
        console.print(line, markup=False)
    return {"oil": None if oil is None else oil.as_figures()}


def _print_train(
    console: TableConsole, scene: Scene, result: Result, settling: float
) -> dict[str, Any]:
    """Print the scene and the results of the whole train, and return them by JSON name."""
    from ..explanation.losses import losses_in_words
    from ..scene.summary import gears, operating_point
    from ..simulation.figures import figures_of_run
    from ..units.shown import RUN, SOURCES

    print_list(console, "gears: ", gears(scene))
    print_list(console, "operating point: ", operating_point(scene))
    found = figures_of_run(scene, result, settling)
    value = text_of(found["efficiency"], "", digits=6)
    if value == "-":
        value = "undefined: no machine puts power in"
    lines = found | {"efficiency": f"{value} ({losses_in_words(scene)})"}
    if sum(found[source] != 0.0 for source in SOURCES) < 2:
        for source in SOURCES:
            del lines[source]
    print_lines(console, RUN, lines)
    if found["mean_mesh_force"] < 0.0:
        console.print("Forces and DTE are negative where the coast flanks carry the load.")
    return keyed(RUN, found)


def _print_meshes(console: TableConsole, result: Result) -> dict[str, Any]:
    """Print the results of the sun meshes and of the ring meshes, and return them by JSON name."""
    from ..simulation.figures import mesh_rows
    from ..terminal.tables import table
    from ..units.catalogue import MESH, side_title

    found = mesh_rows(result.mesh)
    headings = ("", *map(side_title, found))
    caption = "A peak is the largest magnitude"
    cells = rows(MESH, *found.values())
    console.print(table(headings, cells, title="Meshes by kind", caption=caption))
    return {side: keyed(MESH, values) for side, values in found.items()}


def _print_temperatures(console: TableConsole, result: Result) -> dict[str, Any]:
    """Print temperatures and heat by source, and return them; nothing unless they are states."""
    from ..units.shown import HEAT, TEMPERATURES

    if not result.temperatures:
        return {}
    print_lines(console, TEMPERATURES, result.temperatures)
    if any(result.heat.values()):
        print_lines(console, HEAT, {name: heat for name, heat in result.heat.items() if heat})
    return {
        "temperatures": keyed(TEMPERATURES, result.temperatures),
        "heat": keyed(HEAT, result.heat),
    }


def _print_axes(console: TableConsole, motion: AxesMotion | None) -> dict[str, Any]:
    """Print the results of axes that move, and return them by JSON name; nothing if held."""
    if motion is None or motion.statistics is None:
        return {}
    from ..simulation.figures import axes_figures, share_figures
    from ..terminal.tables import table
    from ..units.shown import AXES_OF_RUN, SHARES_OF_RUN

    found, shares = axes_figures(motion), share_figures(motion)
    cells = []
    for name in found:
        quantity = AXES_OF_RUN[name]
        scale = max(map(abs, found[name].values()))
        values = (without_rounding(value, scale) for value in found[name].values())
        cells.append([quantity.text, *(figure(value, quantity.si) for value in values)])
    for name, quantity in SHARES_OF_RUN.items():
        share = shares.get(name, {})
        texts = (f"{share[body]:.4f}" if body in share else "" for body in motion.bodies)
        cells.append([quantity.text, *texts])
    console.print(table(("", *motion.bodies), cells, title="Axes"))
    if not shares:
        return keyed(AXES_OF_RUN, found)
    factor = motion.load_sharing_factor
    console.print(f"load sharing factor K_gamma, largest of these shares: {factor:.4f}")
    return keyed(AXES_OF_RUN, found) | shares | {"load_sharing_factor": factor}


def _print_damage(console: TableConsole, scene: Scene, result: Result) -> dict[str, Any]:
    """Print the damage of the parts, and return it by JSON name; nothing if it is not counted."""
    if result.damage is None:
        return {}
    from ..explanation.damage import damage_figures
    from ..terminal.tables import table
    from ..units.shown import DAMAGE

    found, parts = damage_figures(scene, result.damage), result.damage.parts
    hourly, passages = found["per_hour"], found["passages_per_hour"]
    cells = [
        [part.replace("_", " "), f"{passages[part]:.5g}" if passages[part] else "",
         f"{hourly[part]:.4g}"]
        for part in parts
    ]  # fmt: skip
    headings = ("", "passages of a tooth per hour", "damage per hour")
    console.print(table(headings, cells, title="Damage at the dynamic load; no rating"))
    shown_ones = {name: found[name] for name in DAMAGE if found[name] is not None}
    if shown_ones:
        print_lines(console, DAMAGE, shown_ones)
    return {"damage": found}
