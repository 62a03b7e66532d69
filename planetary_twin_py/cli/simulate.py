"""`planetary-twin simulate`: a whole run without ROS, as fast as it goes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ._arguments import JsonOption, SceneArgument, SetOption, ToleranceOption
from ._fail import fail, need
from ._figures import console_beside, put_figures
from ._interrupt import interruptible
from ._settings import settings

if TYPE_CHECKING:
    from rich.console import Console

    from ..result import Result
    from ..scene import Scene


def simulate(
    scene: SceneArgument = "paper",
    duration: Annotated[float, typer.Option(help="Simulated seconds.")] = 1.0,
    sample_rate: Annotated[float, typer.Option(help="Samples per simulated second.")] = 50_000.0,
    tolerance: ToleranceOption = 1e-4,
    set_: SetOption = None,
    out: Annotated[
        Path | None, typer.Option(help="Write samples (.npz, .csv) or a recording (.mcap, folder).")
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Simulate SCENE and print what it does.

    Example: planetary-twin simulate paper --duration 0.5 --set lambda_ratio=1.5 --out run.npz
    """

    from ..scene import load_scene
    from ..simulation import simulate as run

    console = console_beside(json_)
    try:
        if out is not None and out.suffix not in (*_WRITERS, *_RECORDINGS):
            fail(f"--out = {str(out)!r}: must end in {', '.join(_WRITERS)} or .mcap, or in nothing")
        if out is not None and out.suffix in _RECORDINGS:
            need("recording", "mcap", "rosbags")
        loaded = load_scene(scene).replace(**settings(set_ or []))
        with console.status(f"simulating {duration:g} s of {loaded.name}"):
            result = interruptible(lambda: run(loaded, duration, sample_rate, tolerance=tolerance))
        if out is not None and out.suffix in _RECORDINGS:
            _record(console, out, loaded, duration, sample_rate, tolerance)
        elif out is not None:
            _WRITERS[out.suffix](result, out)
    except (ValueError, OSError) as error:
        fail(error)
    figures = _figures(result)
    for name, value in figures.items():
        console.print(f"{name.replace('_', ' '):28} {value:.6g}")
    put_figures(figures, json_)


def _record(console: Console, out: Path, scene: Scene, *how: float) -> None:
    from rich.progress import Progress

    from ..recording.offline import Plan, record

    plan = Plan(scene, *how)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task("recording", total=plan.duration)
        record(plan, out, lambda time: progress.update(task, completed=time))


def _figures(result: Result) -> dict[str, float]:
    energy = result.energy
    return {
        "efficiency": result.efficiency,
        "mean_power_loss_W": float(result.total_power_loss.mean()),
        "mean_dte_m": float(result.dte.mean()),
        "dte_vibration_rms_m": float(result.dte.std(axis=0).mean()),
        "mean_mesh_force_N": float(result.mesh_force.mean()),
        "energy_residual": energy.residual / energy.put_in if energy.put_in > 0.0 else 0.0,
        "real_time_factor": result.stats.real_time_factor,
    }


def _columns(result: Result) -> dict[str, Any]:
    """Every series of a result by its name."""
    columns: dict[str, Any] = {"time": result.time}
    for names, quantities in (
        (result.bodies, ("angle", "speed")),
        (result.meshes, _MESH_QUANTITIES),
    ):
        for quantity in quantities:
            values = getattr(result, quantity)
            columns |= {f"{quantity}/{name}": values[:, k] for k, name in enumerate(names)}
    return columns


_MESH_QUANTITIES = (
    "dte",
    "mesh_force",
    "film_thickness",
    "lambda_ratio",
    "boundary_friction",
    "viscous_friction",
    "power_loss",
)


def _write_npz(result: Result, path: Path) -> None:
    import numpy as np

    arrays = {name: getattr(result, name) for name in ("time", "angle", "speed", *_MESH_QUANTITIES)}
    np.savez_compressed(path, bodies=result.bodies, meshes=result.meshes, **arrays)


def _write_csv(result: Result, path: Path) -> None:
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
