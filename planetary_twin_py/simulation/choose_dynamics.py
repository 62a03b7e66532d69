"""Selects the dynamics of a scene: compares runs with each of them to the most complete one."""

from __future__ import annotations

import time

import numpy as np

from ..model.clock import TICKS
from ..model.layout import Layout
from ..run.commanded_run import CommandedRun
from ..run.dynamics_choice import BY_COST, Candidate, DynamicsChoice
from ..run.run_total import RunTotal
from ..run.samples import Asked
from ..run.windows import Windows
from ..scene import Scene, SceneError
from ..scene.given import check_scene
from ..units.catalogue import FIGURES

TOLERANCE = 1e-4
SHORTEST, LONGEST = 0.1, 2.0  # [s] limits of the measured time, and of the settling before it
CYCLES = 20.0  # smallest number of measured mesh cycles, unless they take longer than LONGEST
NEGLIGIBLE = 0.01  # share of the largest deflection or force below which errors are not relative
UNSENSED = Asked(frozenset(), sensors=False)
NOTHING = 1e-6  # share of torque and speed that is none: less is what rounding leaves


def choose_dynamics(scene: Scene) -> DynamicsChoice:
    """Select the simplest dynamics that stays within `dynamics_error` of the most complete one.

    The scene runs from a steady state with each possible dynamics: first to settle, then equally
    long to measure, for at least 0.1 s and 20 mesh cycles, but at most 2 s. The selection is valid
    at this operating point only.

    Args:
        scene: scene with any dynamics.

    Returns:
        The selection, and the errors of all dynamics.

    Raises:
        ValueError: the scene cannot run with any dynamics.
        RunawayError: a run exceeds physical limits.
    """
    check_scene(scene)
    runs: dict[str, tuple[dict[str, np.ndarray], float]] = {}
    refused: dict[str, str] = {}
    tried = BY_COST if scene.gearset.helix_angle != 0.0 else BY_COST[:-1]
    for dynamics in tried:
        try:
            runs[dynamics] = _measured(scene.replace(dynamics=dynamics))
        except ValueError as reason:
            lines = f"{reason}".splitlines()
            refused[dynamics] = " and ".join(line.strip() for line in lines[1:] or lines)
    if not runs:
        raise SceneError(f"dynamics = 'auto': {refused[BY_COST[1]]}")
    reference = [dynamics for dynamics in tried if dynamics in runs][-1]
    exact = runs[reference][0]
    candidates = tuple(
        Candidate(dynamics, errors=_errors(scene, runs[dynamics][0], exact), cost=runs[dynamics][1])
        if dynamics in runs
        else Candidate(dynamics, refused[dynamics])
        for dynamics in tried
    )
    allowed = scene.dynamics_error
    picked = next(each.dynamics for each in candidates if each.error <= allowed)
    return DynamicsChoice(scene.replace(dynamics=picked), allowed, reference, candidates)


def _measured(scene: Scene) -> tuple[dict[str, np.ndarray], float]:
    """Quantities of a run in steady running, and its computing time per simulated second."""
    if scene.drive.speed_control.start_speed is not None:
        scene = scene.replace(**{"drive.speed_control.start_speed": None})
    duration = _duration(scene)
    begin = time.perf_counter()
    windows = Windows(scene, TOLERANCE, asked=UNSENSED)
    course = CommandedRun(windows, scene, None)
    end = round(duration * TICKS)
    for _ in course.advance(end, 1.0, None, sampled=False):
        pass
    total = RunTotal(windows)
    for _ in course.advance(2 * end, 1.0, None, sampled=False):
        total.add(windows.last, False)
    total.close(duration)
    spent = time.perf_counter() - begin
    found = total.mesh | {"power_loss": np.array([total.energy.loss / duration])}
    return {name: found[name] for name in FIGURES}, spent / (2.0 * duration)


def _duration(scene: Scene) -> float:
    """Measured time [s]."""
    frequency = Layout(scene).mesh_frequency
    return min(max(SHORTEST, CYCLES / frequency if frequency > 0.0 else SHORTEST), LONGEST)


def _errors(
    scene: Scene, found: dict[str, np.ndarray], exact: dict[str, np.ndarray]
) -> dict[str, float]:
    """Largest deviation of any mesh, relative to the largest value of any mesh."""
    force, loss = _nothing(scene)
    least = {"dte": 0.0, "mesh_force": force, "power_loss": loss}
    if max(float(np.abs(run["mesh_force_mean"]).max()) for run in (found, exact)) < force:
        least["dte"] = np.inf  # teeth without load are anywhere in the backlash
    errors = {}
    for name in FIGURES:
        (smallest,) = (value for family, value in least.items() if name.startswith(family))
        scale = max(float(np.abs(exact[name]).max()), smallest)
        for family in ("dte", "mesh_force"):
            if name.startswith(family):
                scale = max(scale, NEGLIGIBLE * float(exact[f"{family}_peak"].max()))
        apart = float(np.abs(found[name] - exact[name]).max())
        errors[name] = apart / scale if scale > 0.0 else 0.0 if apart == 0.0 else float("inf")
    return errors


def _nothing(scene: Scene) -> tuple[float, float]:
    """Force of a mesh [N] and loss [W] below which there is none, at the point of a scene."""
    point, drive = scene.operating_point, scene.drive
    torque = abs(point.input_torque) + abs(point.torque_ripple) or drive.torque_limit
    speeds = (abs(point.input_speed), abs(point.second_input_speed), NOTHING * drive.speed_limit)
    return abs(Layout(scene).mesh_force(NOTHING * torque)), NOTHING * torque * max(speeds)
