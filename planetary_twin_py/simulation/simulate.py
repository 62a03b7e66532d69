"""Simulation of a run at maximum speed."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace

from .._core import METHODS
from ..checks.accuracy import accuracy_warnings
from ..checks.ledger import balance_of_run, ledger_warning
from ..run.commands import Commands
from ..run.dynamics_choice import AUTO, DynamicsChoice
from ..run.result import Result
from ..run.tolerance import check_tolerance
from ..run.whole_run import WholeRun
from ..scene import Scene
from ..scene.given import check_scene
from ..text.warning_types import AccuracyWarning, LedgerWarning
from .choose_dynamics import choose_dynamics

MOST_SAMPLES = 20_000_000
TOLERANCE = 1e-4  # unless one is given


def simulate(
    scene: Scene,
    duration: float,
    sample_rate: float = 50_000.0,
    method: str = "auto",
    tolerance: float = TOLERANCE,
    settling: float = 0.0,
    commands: Commands | None = None,
) -> Result:
    """Simulate a scene from a steady state.

    The integrator computes means, rms values and peaks independently of the samples. The equations
    of motion and their sources are in docs/model.md.

    Args:
        scene: the scene; with dynamics: auto, `choose_dynamics` picks one, see `Result.choice`.
        duration: simulated time of the result [s].
        sample_rate: of the result [Hz]; sample times are integer multiples of the sample period.
        method: "collocation", "rosenbrock", "march" (collocation wherever it is applicable) or
            "auto" (as "march", but periodic motion is not computed again). Creeping gears are
            always integrated by "rosenbrock", see `Stats.stiff_steps`.
        tolerance: relative local error tolerance.
        settling: simulated time before the result [s], which excludes the initial transient. The
            times of the result include it.
        commands: commands at the ports over time, from the start of settling on; None: the
            torques and speeds of the operating point, as at the start.

    Returns:
        Samples, energy ledger and statistics of the time after `settling`.

    Raises:
        ValueError: an argument is out of range, the scene is invalid, or a command is not given at
            its port.
        RunawayError: the run exceeds physical limits, see `runaway`.

    Warns:
        LedgerWarning: the energy ledger does not balance, see `ledger_check`.
        AccuracyWarning: results are less accurate than the tolerance, see `accuracy`.
        UserWarning: commands begin to act only after the end.
    """
    check_scene(scene)
    check_run(duration, sample_rate, method, tolerance, settling)
    scene, choice = selected(scene)
    run = WholeRun(scene, tolerance, method, commands)
    result = run.result(duration, sample_rate, settling)
    result = replace(result, choice=choice)
    if (late := run.first_unused) is not None:
        late_ones = f"commands.time: what begins to act at {late:g} s or later has no effect"
        warnings.warn(
            f"{late_ones}: the run ends at {settling + duration:g} s", UserWarning, stacklevel=2
        )
    if text := ledger_warning(balance_of_run(result.energy), tolerance):
        warnings.warn(text, LedgerWarning, stacklevel=2)
    for text in accuracy_warnings(scene, result):
        warnings.warn(text, AccuracyWarning, stacklevel=2)
    return result


def selected(scene: Scene) -> tuple[Scene, DynamicsChoice | None]:
    """The scene with the dynamics that it is simulated with.

    Args:
        scene: the scene, with any dynamics.

    Returns:
        The scene, and the choice if its dynamics are auto.

    Raises:
        ValueError: the scene cannot run with any dynamics.
    """
    if scene.dynamics != AUTO:
        return scene, None
    choice = choose_dynamics(scene)
    return choice.scene, choice


def check_run(
    duration: float, sample_rate: float, method: str, tolerance: float, settling: float = 0.0
) -> None:
    """Check arguments of `simulate`.

    Args:
        duration: simulated time of the result [s].
        sample_rate: of the result [Hz].
        method: name of the method.
        tolerance: relative local error tolerance.
        settling: simulated time before the result [s].

    Raises:
        ValueError: an argument is out of range.
    """
    if method not in METHODS:
        raise ValueError(f"method = {method!r}: must be one of {', '.join(METHODS)}")
    if not duration > 0.0:  # or NaN
        raise ValueError(f"duration = {duration!r} s: must be above 0 s")
    if not 1.0 <= duration * sample_rate <= MOST_SAMPLES:
        raise ValueError(
            f"duration = {duration!r} s at sample_rate = {sample_rate!r} Hz: must give between 1 "
            f"and {MOST_SAMPLES} samples"
        )
    check_tolerance(tolerance)
    if not 0.0 <= settling < math.inf:
        raise ValueError(f"settling = {settling!r} s: must be finite and not negative")
