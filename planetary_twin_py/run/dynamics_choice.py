"""The dynamics selected for a scene, and those it is compared with."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from ..scene import Scene
from ..text.object_repr import brief_record
from ..units.engineering import percent

AUTO = "auto"


BY_COST = ("quasi_static", "torsional", "quasi_static_planar", "planar", "spatial")
"""From the simplest dynamics to the most complete one."""


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

    @property
    def verdict(self) -> str:
        """The selected dynamics, the errors of the others, and why some are not possible: lines."""
        chosen = (self.dynamics, self.reference)
        others = ", ".join(
            f"{each.dynamics} {each.largest}"
            for each in self.candidates
            if not each.refused and each.dynamics not in chosen
        )
        errors = f" Errors of the others: {others}." if others else ""
        allowed = f"{100.0 * self.allowed:g} % (dynamics_error)"
        return "\n".join(
            (
                f"Simplest dynamics within {allowed}: {self.dynamics}.{errors}",
                *(
                    f"Not possible: {each.dynamics}, because {each.refused}."
                    for each in self.candidates
                    if each.refused
                ),
            )
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


def _point(scene: Scene) -> str:
    """Speed and torque of the operating point, as text."""
    point = scene.operating_point
    return f"{point.input_speed * 30.0 / np.pi:.6g} rpm and {point.input_torque:.6g} N m"


def _plain(figure: str) -> str:
    """Name of a compared quantity as text: "dte_rms" is "DTE rms"."""
    return figure.replace("dte", "DTE").replace("_", " ")
