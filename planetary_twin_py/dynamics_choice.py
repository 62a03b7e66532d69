"""Selects the dynamics of a scene: compares runs with each of them to the most complete one."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from ._core import BEARING, CHURNING, FRICTION
from .brief import brief_record
from .dynamics.bodies import mesh_names
from .dynamics.mesh_sums import in_order
from .dynamics.static_load import mesh_force
from .engineering_units import percent
from .run import start
from .scene import Scene, SceneError
from .scene.given import check_scene
from .studies.turning import wanted_mesh_frequency
from .window import mesh_statistics

AUTO = "auto"
BY_COST = ("quasi_static", "torsional", "quasi_static_planar", "planar", "spatial")
"""From the simplest dynamics to the most complete one."""
FIGURES = ("dte_mean", "dte_rms", "dte_peak", "mesh_force_mean", "mesh_force_peak", "power_loss")
"""Compared quantities: the power loss, and the others for every mesh."""
TOLERANCE = 1e-4
SHORTEST, LONGEST = 0.1, 2.0  # [s] limits of the measured time, and of the settling before it
CYCLES = 20.0  # smallest number of measured mesh cycles, unless they take longer than LONGEST
NEGLIGIBLE = 0.01  # share of the largest deflection or force below which errors are not relative
NOTHING = 1e-6  # share of torque and speed that is none: less is what rounding leaves


class Candidate(NamedTuple):
    """A dynamics, and its errors in a scene."""

    dynamics: str
    refused: str = ""
    """Reason why the scene does not run with it; empty if it does."""
    errors: Mapping[str, float] = MappingProxyType({})
    """Largest deviation of any mesh from the reference, relative to it, by `FIGURES`; 0 where there
    is nothing to compare: losses at standstill, places of teeth without load."""
    cost: float = float("nan")
    """Computing time per simulated second."""

    @property
    def error(self) -> float:
        """Largest of the errors; infinite if the scene does not run."""
        return max(self.errors.values(), default=float("inf"))

    @property
    def largest(self) -> str:
        """The largest error and its quantity, as text; only if the scene runs."""
        worst = max(self.errors, key=lambda figure: self.errors[figure])
        return f"{percent(self.error)} ({_plain(worst)})"


@dataclass(frozen=True)
class DynamicsChoice:
    """Comparison of all dynamics at the operating point of a scene, and the selected one."""

    scene: Scene
    """The scene with the selected dynamics."""
    allowed: float
    """`dynamics_error` of the scene."""
    reference: str
    """The most complete dynamics with which the scene runs."""
    candidates: tuple[Candidate, ...]
    """In the order of `BY_COST`; spatial for helical teeth only, as spur gears do not tilt."""

    @property
    def dynamics(self) -> str:
        """The selected dynamics."""
        return self.scene.dynamics

    @property
    def reason(self) -> str:
        """Reason for the selection, one sentence."""
        parts = [self._kept()]
        for candidate in self.candidates:
            name = candidate.dynamics
            if candidate.refused:
                parts.append(f"{name} is not possible: {candidate.refused}")
            elif candidate.error > self.allowed:
                parts.append(f"{name} has an error of {candidate.largest}")
        return "; ".join(parts)

    def _kept(self) -> str:
        if self.dynamics == self.reference:
            return f"no simpler dynamics is within {percent(self.allowed)} of {self.reference}"
        (own,) = (each for each in self.candidates if each.dynamics == self.dynamics)
        return (
            f"it is the simplest dynamics within {percent(self.allowed)} of {self.reference}, with "
            f"an error of {own.largest}"
        )

    @property
    def text(self) -> str:
        """The selected dynamics, the operating point, and the reason, one sentence."""
        return (
            f"dynamics = {self.dynamics}, selected by auto at {_point(self.scene)}: {self.reason}"
        )

    def figures(self) -> dict[str, Any]:
        """The comparison for JSON.

        Returns:
            The selected dynamics with the reason, and for each dynamics its errors and computing
            time per simulated second, or the reason why the scene does not run with it.
        """
        return {
            "selected": self.dynamics,
            "allowed_error": self.allowed,
            "reference": self.reference,
            "reason": self.reason,
            "candidates": {
                each.dynamics: {"refused": each.refused or None, "errors": dict(each.errors),
                                "computing_time_per_second": each.cost}
                for each in self.candidates
            },
        }  # fmt: skip

    def __repr__(self) -> str:
        """One line; arrays by their shapes."""
        return brief_record(self)


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
    run = start(scene, TOLERANCE)
    run.advance(duration, 1, 1.0, 0)
    run.pop_mesh_sums(duration)
    before = run.books(duration)
    run.advance(2.0 * duration, 1, 1.0, 0)
    ledger = run.books(2.0 * duration).since(before).ledger
    sums = run.pop_mesh_sums(2.0 * duration)
    spent = time.perf_counter() - begin
    found = mesh_statistics(in_order(sums, mesh_names(scene).place))
    lost = sum(ledger[item] for item in (FRICTION, BEARING, CHURNING))
    found["power_loss"] = np.array([lost / duration])
    return {name: found[name] for name in FIGURES}, spent / (2.0 * duration)


def _duration(scene: Scene) -> float:
    """Measured time [s]."""
    frequency = wanted_mesh_frequency(scene)
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
    return abs(mesh_force(scene, NOTHING * torque)), NOTHING * torque * max(speeds)


def _point(scene: Scene) -> str:
    """Speed and torque of the operating point, as text."""
    point = scene.operating_point
    return f"{point.input_speed * 30.0 / np.pi:.6g} rpm and {point.input_torque:.6g} N m"


def _plain(figure: str) -> str:
    """Name of a compared quantity as text: "dte_rms" is "DTE rms"."""
    return figure.replace("dte", "DTE").replace("_", " ")
