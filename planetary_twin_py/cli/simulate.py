"""`planetary-twin simulate`: a run without ROS, as fast as possible."""

from __future__ import annotations

import warnings
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
from ..terminal.console import print_list
from ..terminal.interruptible import interruptible
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, remark
from ..terminal.names import shown
from ..terminal.output_files import check_file, check_recording
from ..terminal.settings import changed_scene, settings
from ..terminal.unit_options import HERTZ, SECONDS
from ..units.engineering import figure, without_rounding
from ._oil import print_oil

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from ..run.axes.motion import AxesMotion
    from ..run.axes.statistics import AxesStatistics
    from ..run.axes.tilting import TiltingMotion
    from ..run.result import Result
    from ..scene import Scene


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
        Path | None, typer.Option(help="Write samples (.npz, .csv) or a recording (.mcap, folder).")
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Simulate SCENE and print the results.

    The integrator computes means, rms and peaks over --duration, so they do not depend on
    --sample-rate. A recording (.mcap, folder) also contains the time of --settling. The operating
    point is constant: `resimulate` makes a step or a reversal in such a recording.

    Example: planetary-twin simulate paper --duration 0.5 --set lambda_ratio=1.5 --out run.npz
    """

    from ..explanation.losses import losses_in_words
    from ..explanation.remarks import remarks
    from ..scene.summary import gears, operating_point
    from ..scene.unused import without_effect
    from ..simulation.simulate import simulate as run
    from ..text.warning_types import AccuracyWarning, LedgerWarning

    console = console_beside(json_)
    for kind in (AccuracyWarning, LedgerWarning):  # printed with the remarks
        warnings.simplefilter("ignore", kind)
    try:
        if out is not None:
            _check(out)
        changes = settings(set_ or [])
        loaded = changed_scene(scene, changes)
        how = duration, sample_rate
        if out is not None and out.suffix in _RECORDINGS:
            result = _record(console, out, loaded, *how, tolerance, settling)
        else:
            with console.status(f"simulating {duration:g} s of {shown(loaded.name)}"):
                result = interruptible(
                    lambda: run(loaded, *how, tolerance=tolerance, settling=settling)
                )
        if result.choice is not None:
            loaded = result.choice.scene
        if out is not None and out.suffix in _WRITERS:
            _WRITERS[out.suffix](result, loaded, out)
    except (ValueError, OSError) as error:
        fail(error)
    chosen = {}
    if result.choice is not None:
        console.print(result.choice.text, highlight=False)
        chosen = {"dynamics": result.choice.figures()}
    lines = _train(loaded, result, settling)
    train = {name: value for name, (value, _, _) in lines.items()}
    meshes = _meshes(result)
    print_list(console, "gears: ", gears(loaded))
    print_list(console, "operating point: ", operating_point(loaded))
    for name, (value, label, unit) in lines.items():
        if name in _SOURCES and not _has_several(train):
            continue
        shown_value = figure(value, unit, digits=6)
        if name == "efficiency":
            shown_value = _efficiency(value, losses_in_words(loaded))
        console.print(f"{label:38} {shown_value}", markup=False)
    if train["mean_mesh_force_N"] < 0.0:
        console.print("Forces and DTE are negative where the coast flanks carry the load.")
    console.print(_table(meshes))
    axes = _print_axes(console, result.axes)
    oil = print_oil(console, loaded)
    warned = [*without_effect(loaded, changes), *remarks(loaded, result, tolerance)]
    for line in warned:
        remark(f"warning: {line}")
    write_json(chosen | train | meshes | axes | oil | {"remarks": warned}, json_)


def _check(out: Path) -> None:
    """End the command if `out` cannot be written."""
    if out.suffix in _WRITERS:
        check_file("--out", out)
    elif out.suffix in _RECORDINGS:
        check_recording("--out", out)
        need("recording", "mcap", "rosbags")
    else:
        fail(f"--out = {str(out)!r}: must end in {', '.join(_WRITERS)} or .mcap, or be a folder")


def _record(console: Console, out: Path, scene: Scene, *how: float) -> Result:
    """Simulate and record; for `how` see `recording.runs.offline.Plan`."""
    from dataclasses import replace

    from rich.progress import Progress

    from ..recording.runs.offline import Plan, record_run
    from ..simulation.simulate import check_run, selected

    scene, choice = selected(scene)
    plan = Plan(scene, *how)
    check_run(plan.duration, plan.sample_rate, "auto", plan.tolerance, plan.settling)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task("recording", total=plan.settling + plan.duration)
        _, result = record_run(plan, out, lambda time: progress.update(task, completed=time))
    return replace(result, choice=choice)


_SOURCES = ("tooth_friction_W", "bearing_loss_W", "churning_loss_W")  # of the power loss


def _efficiency(value: float, losses: str) -> str:
    """Text of an efficiency and of the `losses` that it contains."""
    shown_value = figure(value, "-", digits=6)
    return f"{shown_value if value == value else 'undefined: no machine puts power in'} ({losses})"


def _has_several(train: dict[str, float]) -> bool:
    """Whether more than one source has a loss."""
    return sum(train[name] != 0.0 for name in _SOURCES) > 1


def _train(scene: Scene, result: Result, settling: float) -> dict[str, tuple[float, str, str]]:
    """Results of the whole train: value, label and SI unit by JSON name."""
    from ..gearset.kinematics import mesh_frequency
    from ..studies.measures import summary_of
    from ..units.catalogue import SUMMARY

    energy, seen = result.energy, summary_of(result)
    sun, carrier = (
        float(result.mean_speed[result.bodies.index(member)]) for member in ("sun", "carrier")
    )
    frequency = mesh_frequency(scene.gearset.tooth_numbers, sun, carrier)
    residual = energy.residual / energy.driving_work if energy.driven else 0.0
    bearings, churning = (lost / result.duration for lost in (energy.bearing, energy.churning))
    return {
        "settling_s": (settling, "excluded at the start", "s"),
        "efficiency": (result.efficiency, "efficiency", "-"),
        "mean_power_loss_W": (seen["power_loss"], "power loss, mean", "W"),
        "tooth_friction_W": (energy.friction / result.duration, "- of tooth friction", "W"),
        "bearing_loss_W": (bearings, "- of bearings, seals and grease", "W"),
        "churning_loss_W": (churning, "- of churning", "W"),
        **{f"{key}_{q.si}": (seen[name], q.title, q.si) for name, (key, q) in SUMMARY.items()},
        "mesh_frequency_Hz": (frequency, "mesh frequency, mean", "Hz"),
        "energy_residual": (residual, "energy residual/input energy", "-"),
        "real_time_factor": (result.stats.real_time_factor, "real-time factor", "-"),
    }


def _meshes(result: Result) -> dict[str, dict[str, float]]:
    """Results of the sun meshes and of the ring meshes, by measure with its SI unit."""
    from ..studies.measures import mesh_rows
    from ..units.catalogue import MESH

    keys = {name: f"{name}_{quantity.si}".rstrip("_") for name, quantity in MESH.items()}
    return {
        side: {keys[name]: value for name, value in row.items()}
        for side, row in mesh_rows(result.mesh).items()
    }


def _table(meshes: dict[str, dict[str, float]]) -> Table:
    from rich.table import Table

    from ..units.catalogue import MESH

    table = Table("", title="Meshes by kind", caption="A peak is the largest magnitude")
    for side in meshes:
        table.add_column(side.replace("_", "-"), justify="right")
    rows = (row.values() for row in meshes.values())
    for quantity, *values in zip(MESH.values(), *rows, strict=True):
        table.add_row(quantity.text, *(figure(value, quantity.si) for value in values))
    return table


# Text and SI unit of what a run shows of each axis, by JSON name.
_AXES = {
    "displacement_magnitude_m": ("displacement, mean of its magnitude", "m"),
    "displacement_peak_m": ("displacement, peak", "m"),
    "bearing_force_magnitude_N": ("force on the bearing, mean of its magnitude", "N"),
    "bearing_force_peak_N": ("force on the bearing, peak", "N"),
}


# The same of the load of planets; the largest of the second is K_gamma.
_SHARES = {
    "load_share": "share of the load, mean",
    "largest_load_share": "share of the load, largest mean over a mesh cycle",
}


# The same where axes tilt.
_TILTING = {
    "axial_displacement_mean_m": ("axial displacement, mean", "m"),
    "tilt_magnitude_rad": ("tilt, mean of its magnitude", "rad"),
    "thrust_mean_N": ("thrust on the bearing, mean", "N"),
    "thrust_peak_N": ("thrust on the bearing, peak", "N"),
    "tilting_moment_magnitude_Nm": ("tilting moment on the bearing, mean of its magnitude", "N m"),
    "tilting_moment_peak_Nm": ("tilting moment on the bearing, peak", "N m"),
}


def _print_axes(console: Console, motion: AxesMotion | None) -> dict[str, Any]:
    """Print the results of axes that move, and return them by JSON name; nothing if held."""
    if motion is None or motion.statistics is None:
        return {}
    found = _axes(motion, motion.statistics)
    console.print(_axes_table(motion, found))
    if factor := found.get("load_sharing_factor"):
        console.print(f"load sharing factor K_gamma, largest of these shares: {factor:.4f}")
    return found


def _axes(motion: AxesMotion, seen: AxesStatistics) -> dict[str, Any]:
    """Displacements and bearing forces of all bodies by JSON name, and the shares of planets."""
    import numpy as np

    def of_bodies(values: np.ndarray) -> dict[str, float]:
        sizes = values if values.ndim == 1 else np.linalg.norm(values, axis=1)
        return dict(zip(motion.bodies, sizes.tolist(), strict=True))

    found: dict[str, Any] = {
        "displacement_mean_m": of_bodies(seen.displacement_mean),
        "displacement_magnitude_m": of_bodies(seen.displacement_magnitude),
        "displacement_peak_m": of_bodies(seen.displacement_peak),
        "bearing_force_mean_N": of_bodies(seen.bearing_force_mean),
        "bearing_force_magnitude_N": of_bodies(seen.bearing_force_magnitude),
        "bearing_force_peak_N": of_bodies(seen.bearing_force_peak),
    }
    if seen.tilting is not None:
        found |= {
            "axial_displacement_mean_m": of_bodies(seen.tilting.axial_displacement_mean),
            "tilt_mean_rad": of_bodies(seen.tilting.tilt_mean),
            "tilt_magnitude_rad": of_bodies(seen.tilting.tilt_magnitude),
            "thrust_mean_N": of_bodies(seen.tilting.axial_force_mean),
            "thrust_peak_N": of_bodies(seen.tilting.axial_force_peak),
            "tilting_moment_mean_Nm": of_bodies(seen.tilting.tilting_moment_mean),
            "tilting_moment_magnitude_Nm": of_bodies(seen.tilting.tilting_moment_magnitude),
            "tilting_moment_peak_Nm": of_bodies(seen.tilting.tilting_moment_peak),
        }
    planets = motion.bodies[len(motion.bodies) - motion.load_share.shape[1] :]
    shares, largest = motion.mean_load_share.tolist(), motion.largest_load_share.tolist()
    if all(share == share for share in shares):  # there is a load to share
        found["load_share"] = dict(zip(planets, shares, strict=True))
        found["largest_load_share"] = dict(zip(planets, largest, strict=True))
        found["load_sharing_factor"] = motion.load_sharing_factor
    return found


def _axes_table(motion: AxesMotion, found: dict[str, Any]) -> Table:
    from rich.table import Table

    table = Table("", title="Axes")
    for body in motion.bodies:
        table.add_column(body, justify="right")
    rows = _AXES if motion.tilting is None else _AXES | _TILTING
    for key, (text, unit) in rows.items():
        values = [*found[key].values()]
        scale = max(map(abs, values))
        table.add_row(text, *(figure(without_rounding(value, scale), unit) for value in values))
    for key, text in _SHARES.items():
        share = found.get(key, {})
        shares = (f"{share[body]:.4f}" if body in share else "" for body in motion.bodies)
        table.add_row(text, *shares)
    return table


def _columns(result: Result) -> dict[str, Any]:
    """Every time series of a result, by column name."""
    from ..units.catalogue import SAMPLED

    columns: dict[str, Any] = {"time": result.time}
    for names, quantities in (
        (result.bodies, ("angle", "speed")),
        (result.meshes, SAMPLED),
    ):
        for quantity in quantities:
            values = getattr(result, quantity)
            columns |= {f"{quantity}/{name}": values[:, k] for k, name in enumerate(names)}
    return columns | ({} if result.axes is None else _axes_columns(result.axes))


def _axes_columns(motion: AxesMotion) -> dict[str, Any]:
    """Time series of the axes, by column name."""
    columns: dict[str, Any] = {}
    for k, body in enumerate(motion.bodies):
        names = ("radial", "tangential") if body.startswith("planet") else ("x", "y")
        for quantity in ("displacement", "bearing_force"):
            values = getattr(motion, quantity)
            columns |= {
                f"{quantity}/{body}/{name}": values[:, k, n] for n, name in enumerate(names)
            }
        if motion.tilting is not None:
            columns |= _tilting_columns(motion.tilting, k, body, names)
    for k in range(motion.load_share.shape[1]):
        columns[f"load_share/planet_{k + 1}"] = motion.load_share[:, k]
    return columns


def _tilting_columns(
    motion: TiltingMotion, k: int, body: str, names: tuple[str, str]
) -> dict[str, Any]:
    """Time series of the axial motion and the tilts of body k, by column name."""
    columns = {
        f"{quantity}/{body}": getattr(motion, quantity)[:, k]
        for quantity in ("axial_displacement", "axial_force")
    }
    for quantity in ("tilt", "tilting_moment"):
        values = getattr(motion, quantity)
        columns |= {f"{quantity}/{body}/{name}": values[:, k, n] for n, name in enumerate(names)}
    return columns


def _write_npz(result: Result, scene: Scene, path: Path) -> None:
    import numpy as np
    import yaml

    from ..units.catalogue import SAMPLED

    text = yaml.safe_dump(scene.model_dump(mode="json"), sort_keys=False)
    arrays: dict[str, Any] = {
        name: getattr(result, name) for name in ("time", "angle", "speed", *SAMPLED)
    }
    if result.axes is not None:
        names = ("displacement", "bearing_force", "orbit", "flank_force", "load_share")
        arrays |= {name: getattr(result.axes, name) for name in names}
        arrays["axes"] = result.axes.bodies
        if result.axes.tilting is not None:
            arrays |= result.axes.tilting._asdict()
    arrays |= {"bodies": result.bodies, "meshes": result.meshes, "scene_yaml": text}
    np.savez_compressed(path, **arrays)


def _write_csv(result: Result, _: Scene, path: Path) -> None:
    import numpy as np

    columns = _columns(result)
    np.savetxt(
        path,
        np.column_stack(list(columns.values())),
        delimiter=",",
        header=",".join(columns),
        comments="",
    )


_WRITERS = {".npz": _write_npz, ".csv": _write_csv}
_RECORDINGS = (".mcap", "")
