"""Which dynamics a scene needs: runs with each of them, against the one that leaves out least."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from ._core import BEARING, CHURNING, FRICTION
from .dynamics.bodies import mesh_names, rigid_ratios
from .dynamics.mesh_sums import in_order
from .gearset.kinematics import mesh_cycles_per_turn
from .run import start
from .scene import Scene, SceneError
from .window import mesh_statistics

AUTO = "auto"
BY_COST = ("quasi_static", "torsional", "planar", "spatial")
"""From the dynamics that leaves out most to the one that leaves out least."""
FIGURES = ("dte_mean", "dte_rms", "dte_peak", "mesh_force_mean", "mesh_force_peak", "power_loss")
"""Those that are compared, of every mesh but for the power loss."""
TOLERANCE = 1e-4
SHORTEST, LONGEST = 0.1, 2.0  # [s] of what is measured, and of the time before it
CYCLES = 20.0  # mesh cycles that it has at least, if it is not longer than LONGEST
NEGLIGIBLE = 0.01  # of the largest deflection or force: less does not count as a reference


class Candidate(NamedTuple):
    """A dynamics, and what it gives for a scene."""

    dynamics: str
    refused: str = ""
    """Why the scene does not run with it; empty if it does."""
    errors: Mapping[str, float] = MappingProxyType({})
    """Largest deviation of any mesh from the reference over the reference, by `FIGURES`."""
    cost: float = float("nan")
    """Computing time per simulated second."""

    @property
    def error(self) -> float:
        """Largest of the errors; infinite if the scene does not run."""
        return max(self.errors.values(), default=float("inf"))


@dataclass(frozen=True)
class DynamicsChoice:
    """Dynamics measured against one another at the operating point of a scene."""

    scene: Scene
    """The scene with the dynamics that is picked."""
    allowed: float
    """`dynamics_error` of the scene."""
    reference: str
    """The dynamics that leaves out least, of those with which the scene runs."""
    candidates: tuple[Candidate, ...]
    """In the order of `BY_COST`; spatial for helical teeth only, as spur teeth never tilt."""

    @property
    def dynamics(self) -> str:
        """The dynamics that is picked."""
        return self.scene.dynamics

    @property
    def reason(self) -> str:
        """Why it is picked, in a sentence."""
        parts = [self._kept()]
        for candidate in self.candidates:
            name = candidate.dynamics
            if candidate.refused:
                parts.append(f"{name} is not possible: {candidate.refused}")
            elif candidate.error > self.allowed:
                worst = max(candidate.errors, key=lambda figure: candidate.errors[figure])
                parts.append(f"{name} is off by {candidate.error:.2g} ({worst})")
        return "; ".join(parts)

    def _kept(self) -> str:
        if self.dynamics == self.reference:
            return f"{self.dynamics} leaves out least, and less would exceed {self.allowed:g}"
        (own,) = (each for each in self.candidates if each.dynamics == self.dynamics)
        worst = max(own.errors, key=lambda figure: own.errors[figure])
        return (
            f"{self.dynamics} is the least within {self.allowed:g} of {self.reference} "
            f"(largest error {own.error:.2g}, {worst})"
        )

    @property
    def text(self) -> str:
        """What is picked, at which operating point, and why."""
        return f"dynamics = {self.dynamics}, picked by auto at {_point(self.scene)}: {self.reason}"

    def figures(self) -> dict[str, Any]:
        """All of this for JSON.

        Returns:
            What is picked and why, and of each dynamics its errors and computing time per
            simulated second, or why the scene does not run with it.
        """
        return {
            "picked": self.dynamics,
            "allowed_error": self.allowed,
            "reference": self.reference,
            "reason": self.reason,
            "candidates": {
                each.dynamics: {"refused": each.refused or None, "errors": dict(each.errors),
                                "computing_time_per_second": each.cost}
                for each in self.candidates
            },
        }  # fmt: skip


def choose_dynamics(scene: Scene) -> DynamicsChoice:
    """Pick the least dynamics that stays within `dynamics_error` of the most complete one.

    The scene runs from a steady state with each dynamics that it can have, for at least 0.1 s and,
    up to 2 s, 20 mesh cycles, after a time as long before. What is picked holds at this operating
    point only.

    Args:
        scene: with any dynamics.

    Returns:
        What is picked, and the errors of all.

    Raises:
        ValueError: the scene cannot run with any dynamics.
        RunawayError: a run exceeds physical limits.
    """
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
        Candidate(dynamics, errors=_errors(runs[dynamics][0], exact), cost=runs[dynamics][1])
        if dynamics in runs
        else Candidate(dynamics, refused[dynamics])
        for dynamics in tried
    )
    allowed = scene.dynamics_error
    picked = next(each.dynamics for each in candidates if each.error <= allowed)
    return DynamicsChoice(scene.replace(dynamics=picked), allowed, reference, candidates)


def _measured(scene: Scene) -> tuple[dict[str, np.ndarray], float]:
    """Figures of a run in steady running, and its computing time per simulated second."""
    if scene.drive.speed_control.start_speed is not None:
        scene = scene.replace(**{"drive.speed_control.start_speed": None})
    duration = _duration(scene)
    begin = time.perf_counter()
    run = start(scene, TOLERANCE)
    run.advance(duration, 1, 1.0, 0)
    run.take_ledger()
    run.take_mesh_sums(duration)
    before = run.reached
    run.advance(2.0 * duration, 1, 1.0, 0)
    ledger, sums = run.take_ledger(), run.take_mesh_sums(2.0 * duration)
    spent = time.perf_counter() - begin
    found = mesh_statistics(in_order(sums, mesh_names(scene).place))
    lost = sum(ledger[item] for item in (FRICTION, BEARING, CHURNING))
    found["power_loss"] = np.array([lost / float(run.reached - before)])
    return {name: found[name] for name in FIGURES}, spent / (2.0 * duration)


def _duration(scene: Scene) -> float:
    """Time that is measured [s]."""
    point, ratios = scene.operating_point, rigid_ratios(scene)
    teeth = scene.gearset.tooth_numbers
    speeds = (point.input_speed, point.second_input_speed)
    frequency = abs(
        sum(
            float(mesh_cycles_per_turn(teeth, {name: ratio[k] for name, ratio in ratios.items()}))
            * speed
            for k, speed in zip(range(len(ratios["sun"])), speeds, strict=False)
        )
    ) / (2.0 * np.pi)
    return min(max(SHORTEST, CYCLES / frequency if frequency > 0.0 else SHORTEST), LONGEST)


def _errors(found: dict[str, np.ndarray], exact: dict[str, np.ndarray]) -> dict[str, float]:
    """Largest deviation of any mesh, relative to the largest value of any mesh."""
    errors = {}
    for name in FIGURES:
        scale = float(np.abs(exact[name]).max())
        for family in ("dte", "mesh_force"):
            if name.startswith(family):
                scale = max(scale, NEGLIGIBLE * float(exact[f"{family}_peak"].max()))
        apart = float(np.abs(found[name] - exact[name]).max())
        errors[name] = apart / scale if scale > 0.0 else 0.0 if apart == 0.0 else float("inf")
    return errors


def _point(scene: Scene) -> str:
    """The part of an operating point that matters most, in words."""
    point = scene.operating_point
    return f"{point.input_speed * 30.0 / np.pi:.6g} rpm and {point.input_torque:.6g} N m"
