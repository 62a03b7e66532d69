"""Steady temperatures of a scene over load and speed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

from ..run.steady_temperatures import SteadyState, SteadyTemperatures
from ..scene import Scene
from ..scene.thermal import COLDEST, HOTTEST, NODES

STRONG_GAIN = 0.8
"""Feedback gain from which temperatures follow small changes of the losses several times over."""


class AtPoint(NamedTuple):
    """Steady states at an operating point."""

    input_torque: float
    """[N m]"""
    input_speed: float
    """[rad/s]"""
    states: tuple[SteadyState, ...]
    """All of them in the range of temperatures, the coldest first."""

    def rows(self) -> Iterator[dict[str, Any]]:
        """A row of figures for each state, by the names of `STEADY`."""
        for state in self.states:
            yield {
                "input_torque": self.input_torque,
                "input_speed": self.input_speed,
                **{part: state.temperatures[part] for part in NODES},
                "power_loss": state.loss,
                "gain": state.gain,
                "per_ambient": state.per_ambient,
                "time_constant": max(state.time_constants, key=abs),
                "stable": "yes" if state.stable else "no",
            }

    def remark(self) -> str | None:
        """What limits these states, in one line; None if nothing does."""
        at = f"{self.input_torque:.4g} N m, {self.input_speed:.4g} rad/s"
        stable = [state for state in self.states if state.stable]
        if not stable:
            return (
                f"warning: {at}: no steady state is stable within {COLDEST:g} and {HOTTEST:g} K: "
                "the gearbox heats up beyond it; cool it more, or reduce the load"
            )
        if len(stable) > 1:
            return (
                f"warning: {at}: {len(stable)} steady states are stable: which one a run reaches "
                "depends on its start; it jumps where one of them ends"
            )
        if (gain := stable[0].gain) > STRONG_GAIN:
            return (
                f"warning: {at}: the feedback gain is {gain:.2f}: a change of the losses by 1 % "
                f"raises the temperatures by {1.0 / (1.0 - gain):.1f} %"
            )
        return None


def steady_map(
    scene: Scene,
    torques: Sequence[float],
    speeds: Sequence[float],
    report: Callable[[int], None] = lambda done: None,
) -> list[AtPoint]:
    """Find all steady states at every pair of a torque and a speed.

    Args:
        scene: the scene, with the section `thermal`.
        torques: of the input [N m].
        speeds: of the input [rad/s].
        report: called with the number of pairs that are done since the last call.

    Returns:
        The states, a pair after the other.

    Raises:
        SceneError: the scene has no section `thermal`, or a value is out of range.
        ValueError: there is no equilibrium of forces.
    """
    found = []
    for torque in torques:
        for speed in speeds:
            there = scene.replace(input_torque=torque, input_speed=speed)
            found.append(AtPoint(torque, speed, SteadyTemperatures(there).states))
            report(1)
    return found
