"""A run in a row of figures: what a study keeps of each of its points."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ..ledger_check import balance_of_window
from ..result import Result
from ..scene import Scene
from ..twin import Twin
from ..window import Window
from .plan import Settings

Row = dict[str, float]


class Measure(NamedTuple):
    """A figure over the measured part of a run."""

    unit: str
    description: str


class MeshMeasure(NamedTuple):
    """A statistic of each mesh, and how one figure is made of those of alike meshes."""

    unit: str
    description: str
    over_meshes: Callable[[np.ndarray], np.float64]


# Of the whole train, by the names of a window's properties.
TRAIN = {
    "efficiency": Measure("", "1 - power loss over the power of the machines that drive"),
    "power_loss": Measure("W", "tooth friction, bearings and churning, mean"),
    "input_power": Measure("W", "from the motors into the train, mean"),
    "output_power": Measure("W", "from the train into the load, mean"),
    "mesh_frequency": Measure("Hz", "rate at which teeth pass a mesh"),
}
# Of the sun meshes and of the ring meshes, by the names of a window's statistics.
MESH = {
    "dte_mean": MeshMeasure("m", "DTE, mean", np.mean),
    "dte_rms": MeshMeasure("m", "DTE, rms of the deviation from the mean, largest", np.max),
    "dte_peak": MeshMeasure("m", "DTE, largest magnitude", np.max),
    "mesh_force_mean": MeshMeasure("N", "mesh force, mean", np.mean),
    "mesh_force_peak": MeshMeasure("N", "mesh force, largest magnitude", np.max),
    "contact_fraction": MeshMeasure("", "share of time in contact, smallest", np.min),
    "film_thickness": MeshMeasure("m", "film thickness in contact, mean", np.mean),
    "lambda_ratio": MeshMeasure(
        "", "lambda ratio (specific film thickness) in contact, mean", np.mean
    ),
    "boundary_friction": MeshMeasure("N", "boundary friction of a mesh, mean", np.mean),
    "viscous_friction": MeshMeasure("N", "viscous friction of a mesh, mean", np.mean),
    "power_loss": MeshMeasure("W", "tooth friction of all these meshes, mean", np.sum),
}
SIDES = ("sun_planet", "planet_ring")
EXCESS = "ledger_excess"  # column of a table, see `ledger_check`
CLIPPED = "viscous_friction_clipped"  # column of a table, after the kind of mesh

MEASURES: dict[str, Measure] = TRAIN | {
    f"{side}_{name}": Measure(
        measure.unit, f"{side.replace('_', '-')} meshes: {measure.description}"
    )
    for side in SIDES
    for name, measure in MESH.items()
}
MEASURES |= {
    f"{side}_{CLIPPED}": Measure(
        "",
        f"{side.replace('_', '-')} meshes: share of the time in contact in which viscous friction "
        "is clipped to zero, as the pressure is too low for its law",
    )
    for side in SIDES
}
MEASURES |= {
    EXCESS: Measure(
        "",
        "residual of the energy ledger over what is allowed; above 1, losses are uncertain",
    )
}
COURSE = {
    "unsettled": Measure("s", "time that is missing until creeping gears forget the start"),
    "reversals": Measure("", "steps in which vibration stops gears, or nearly so"),
    "both_flanks": Measure("", "steps in which both flanks of a tooth touch"),
    "unrepeated_flank_events": Measure(
        "", "flanks that meet or part in a motion that does not come to repeat itself"
    ),
}
"""What the accuracy of a point is judged by, by the names of `accuracy.Course`."""
MEASURES |= COURSE
"""Every figure of a row, in its order."""


def measure(scene: Scene, settings: Settings) -> Row:
    """Run `scene` and measure it over the last `settings.duration`.

    Raises:
        ValueError: the scene cannot be run.
        ArithmeticError: its integration does not succeed.
    """
    twin = Twin(scene, settings.sample_rate, settings.tolerance)
    if settings.settling:
        twin.advance(settings.settling)
    return row(scene, twin.advance(settings.duration))


class Glance(NamedTuple):
    """A whole run in a few figures: over its time, and over all its meshes."""

    power_loss: float  # tooth friction, bearings and churning, mean [W]
    dte_mean: float  # mean over the meshes of each one's mean [m]
    dte_rms: float  # mean over the meshes of the rms about each one's mean [m]
    dte_peak: float  # largest magnitude in any mesh [m]
    mesh_force_mean: float  # mean over the meshes of each one's mean [N]
    mesh_force_peak: float  # largest magnitude in any mesh [N]


def glance(result: Result) -> Glance:
    """The figures of a whole run."""
    mesh = result.mesh
    means = {name: float(mesh[name].mean()) for name in ("dte_mean", "dte_rms", "mesh_force_mean")}
    peaks = {name: float(mesh[name].max()) for name in ("dte_peak", "mesh_force_peak")}
    return Glance(power_loss=result.mean_power_loss, **means, **peaks)


def row(scene: Scene, window: Window) -> Row:
    """The figures of a window of a run of `scene`."""
    figures = {name: float(getattr(window, name)) for name in TRAIN}
    for side, values in mesh_rows(window.mesh).items():
        figures |= {f"{side}_{name}": value for name, value in values.items()}
    shares = clipped_friction(scene, window)
    figures |= {f"{side}_{CLIPPED}": share for side, share in shares.items()}
    figures |= {name: float(getattr(window.course, name)) for name in COURSE}
    return figures | {EXCESS: balance_of_window(window).excess}


def clipped_friction(scene: Scene, run: Result | Window) -> dict[str, float]:
    """Share of the time in contact in which viscous friction is clipped to zero, by `SIDES`.

    Then no tooth pair of a mesh has any though they carry load. That friction fades out at the
    pitch point does not count: `viscous_friction` is that of the plateau there, too. 0 of a scene
    without friction or with a law that does not clip it, or a run without contact.
    """
    oil, planets, mesh, shares = scene.lubrication, len(run.meshes) // 2, run.mesh, []
    clips = oil.friction and oil.traction == "evans_johnson"
    for meshes in (slice(planets), slice(planets, None)):
        touching = float(mesh["contact_fraction"][meshes].sum())
        clipped = float(mesh["without_viscous"][meshes].sum())
        shares.append(clipped / touching if clips and touching else 0.0)
    return dict(zip(SIDES, shares, strict=True))


def mesh_rows(mesh: dict[str, np.ndarray]) -> dict[str, Row]:
    """The figures of `MESH` for both `SIDES`, from statistics of the meshes, (meshes,) each."""
    planets = len(mesh["dte_mean"]) // 2
    return {
        side: {
            name: float(measure.over_meshes(mesh[name][meshes])) for name, measure in MESH.items()
        }
        for side, meshes in zip(SIDES, (slice(planets), slice(planets, None)), strict=True)
    }
