"""Figures of a run by the names of the catalogue: of the train, of meshes, axes and planets."""

from __future__ import annotations

import numpy as np

from ..gearset.kinematics import mesh_frequency
from ..run.axes.motion import AxesMotion
from ..run.result import Result
from ..scene import Scene
from ..units.catalogue import MESH, SIDES, SUMMARY
from ..units.shown import AXES_OF_RUN

Row = dict[str, float]


def summary_of(result: Result) -> Row:
    """Summary of a run over its duration and over all meshes.

    Args:
        result: result of the run.

    Returns:
        Mean power loss, and the statistics of `SUMMARY`, in SI.
    """
    figures = {"power_loss": result.mean_power_loss}
    for name, (_, quantity) in SUMMARY.items():
        figures[name] = quantity.of_meshes(result.mesh[name])
    return figures


def figures_of_run(scene: Scene, result: Result, settling: float) -> Row:
    """Figures of the whole train.

    Args:
        scene: the gearbox.
        result: result of the run.
        settling: simulated time before [s].

    Returns:
        Values in SI by the names of `RUN`.
    """
    energy, seen = result.energy, summary_of(result)
    sun, carrier = (
        float(result.mean_speed[result.bodies.index(member)]) for member in ("sun", "carrier")
    )
    return {
        "settling": settling,
        "efficiency": result.efficiency,
        "mean_power_loss": seen["power_loss"],
        "tooth_friction": energy.friction / result.duration,
        "bearing_loss": energy.bearing / result.duration,
        "churning_loss": energy.churning / result.duration,
        **{key: seen[name] for name, (key, _) in SUMMARY.items()},
        "mesh_frequency": mesh_frequency(scene.gearset.tooth_numbers, sun, carrier),
        "energy_residual": energy.residual / energy.driving_work if energy.driven else 0.0,
        "real_time_factor": result.stats.real_time_factor,
    }


def mesh_rows(mesh: dict[str, np.ndarray]) -> dict[str, Row]:
    """Values of `MESH` for both `SIDES`, from statistics of the meshes, shape (meshes,) each.

    Args:
        mesh: statistics of the meshes by name, (meshes,) each, in SI.
    """
    planets = len(next(iter(mesh.values()))) // 2
    return {
        side: {name: quantity.of_meshes(mesh[name][meshes]) for name, quantity in MESH.items()}
        for side, meshes in zip(SIDES, (slice(planets), slice(planets, None)), strict=True)
    }


def axes_figures(motion: AxesMotion) -> dict[str, Row]:
    """Statistics of axes that move, of vectors their magnitudes.

    Args:
        motion: of a run with statistics.

    Returns:
        Values in SI by body, by the names of `AXES_OF_RUN`; those of tilting only if axes tilt.
    """
    assert motion.statistics is not None
    statistics = motion.statistics._asdict()
    if motion.statistics.tilting is not None:
        statistics |= motion.statistics.tilting._asdict()
    found = {}
    for name in AXES_OF_RUN:
        values = statistics.get(name.replace("thrust", "axial_force"))
        if values is not None:
            sizes = values if values.ndim == 1 else np.linalg.norm(values, axis=1)
            found[name] = dict(zip(motion.bodies, sizes.tolist(), strict=True))
    return found


def share_figures(motion: AxesMotion) -> dict[str, Row]:
    """Shares of the load of planets whose axes move.

    Args:
        motion: of a run with statistics.

    Returns:
        Shares by planet, by the names of `SHARES_OF_RUN`; nothing if there is no load to share.
    """
    planets = motion.bodies[len(motion.bodies) - motion.load_share.shape[1] :]
    mean, largest = motion.mean_load_share, motion.largest_load_share
    if np.isnan(mean).any():
        return {}
    return {
        "load_share": dict(zip(planets, mean.tolist(), strict=True)),
        "largest_load_share": dict(zip(planets, largest.tolist(), strict=True)),
    }
