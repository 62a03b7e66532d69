"""Results of one run as a table row: the quantities that a study stores for each point."""

from __future__ import annotations

import math

from ..checks.ledger import balance_of_window
from ..run.axes.motion import AxesMotion
from ..run.axes.window_statistics import axes_statistics
from ..run.result import Result
from ..run.twin import Twin
from ..run.window import Window
from ..scene import Scene
from ..simulation.figures import Row, mesh_rows
from ..statics.error_turns import fewest_turns
from ..units.catalogue import (
    CLIPPED,
    COURSE,
    ERROR_TURNS,
    EXCESS,
    MEMBERS,
    SIDES,
    SPEED_SHARE,
    STUDIED,
    STUDIED_OF_AXES,
)
from .plan import Settings
from .turning import speed_share

FEW_SAMPLES = 64  # in the evaluated time: a quasi-static run checks the deflection at its samples


def measure(scene: Scene, settings: Settings) -> Row:
    """Simulate `scene` and evaluate the last `settings.duration` seconds.

    Returns:
        Values in SI by the names of `STUDY_RESULTS`, and of `AXES_RESULTS` where axes move.

    Raises:
        ValueError: the scene is invalid.
        ArithmeticError: the integration failed.
    """
    few = min(settings.sample_rate, FEW_SAMPLES / settings.duration)
    twin = Twin(scene, few, settings.tolerance)
    if settings.settling:
        twin.advance(settings.settling)
    if scene.moving_axes:  # statistics of axes are those of samples; of meshes, of the integrator
        twin.set_sample_rate(settings.sample_rate)
    return row(scene, twin.advance(settings.duration))


def row(scene: Scene, window: Window) -> Row:
    """Values of `STUDY_RESULTS` over a window of a run of `scene`, in SI.

    Where axes move, those of `AXES_RESULTS`, too.
    """
    figures = {name: float(getattr(window, name)) for name in STUDIED}
    for side, values in mesh_rows(window.mesh).items():
        figures |= {f"{side}_{name}": value for name, value in values.items()}
    shares = clipped_friction(scene, window)
    figures |= {f"{side}_{CLIPPED}": share for side, share in shares.items()}
    figures |= {name: float(getattr(window.course, name)) for name in COURSE}
    figures[SPEED_SHARE] = speed_share(scene, window.mesh_frequency)
    figures[EXCESS] = balance_of_window(window).excess
    if window.axes is None:
        return figures
    return figures | {ERROR_TURNS: _error_turns(scene, window)} | axes_row(window.axes)


def _error_turns(scene: Scene, window: Window) -> float:
    """Turns of the error that turns least; NaN if none turns."""
    duration, carrier = window.end - window.start, abs(window.mean_speed[-1]) / (2.0 * math.pi)
    found = fewest_turns(scene, window.mesh_frequency * duration, carrier * duration)
    return math.nan if found is None else found.turns


def axes_row(motion: AxesMotion) -> Row:
    """Values of `AXES_RESULTS` that depend on the motion of axes alone, in SI.

    Args:
        motion: statistics of the axes over a window.
    """
    statistics, members = axes_statistics(motion), len(MEMBERS)
    figures = {"load_sharing_factor": motion.load_sharing_factor}
    for name in STUDIED_OF_AXES:
        figures |= {f"{body}_{name}": float(statistics[name][k]) for k, body in enumerate(MEMBERS)}
        figures[f"planet_{name}"] = float(statistics[name][members:].max())
    return figures


def clipped_friction(scene: Scene, run: Result | Window) -> dict[str, float]:
    """Fraction of the time in contact in which viscous friction is clipped to zero.

    A mesh is clipped while no loaded tooth pair has viscous friction. The sign change at the pitch
    point does not count, because `viscous_friction` is the value of the plateau there.

    Returns:
        Fraction by `SIDES`; 0 without friction, with a law that does not clip, or without contact.
    """
    oil, planets, mesh, shares = scene.lubrication, len(run.meshes) // 2, run.mesh, []
    clips = oil.friction and oil.traction == "evans_johnson"
    for meshes in (slice(planets), slice(planets, None)):
        touching = float(mesh["contact_fraction"][meshes].sum())
        clipped = float(mesh["without_viscous"][meshes].sum())
        shares.append(clipped / touching if clips and touching else 0.0)
    return dict(zip(SIDES, shares, strict=True))
