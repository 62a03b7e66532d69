"""Counters of a run, and the time until friction no longer depends on its start."""

from __future__ import annotations

import math
from typing import NamedTuple

from .._core import CREEPING, Control
from ..model.layout import Layout
from ..scene import OperatingPoint

SETTLED = 50.0  # presliding displacements of rolling after which the initial state has no effect


class Course(NamedTuple):
    """Counters of a run, or of a part of it, from which its accuracy is estimated."""

    flank_events: int = 0
    """Engagements and separations of flanks."""
    reversals: int = 0
    """Steps in which vibration stops gears, or slows them strongly."""
    repeated_steps: int = 0
    """Steps that were not computed because the motion is periodic."""
    unsettled: float = 0.0
    """Remaining time until friction no longer depends on the initial state [s]."""
    both_flanks: int = 0
    """Steps in which both flanks of a mesh touch; the model has a force on one of them only."""
    start_warning: str = ""
    """Why the start of the run is no equilibrium, "" if it is one."""

    @property
    def unrepeated_flank_events(self) -> int:
        """Engagements and separations of flanks, 0 if the motion has become periodic."""
        return 0 if self.repeated_steps else self.flank_events

    def since(self, before: Course) -> Course:
        """Counters of the part of the run after `before`."""
        return Course(
            self.flank_events - before.flank_events,
            self.reversals - before.reversals,
            self.repeated_steps - before.repeated_steps,
            self.unsettled,
            self.both_flanks - before.both_flanks,
            self.start_warning,
        )

    def joined(self, later: Course) -> Course:
        """Counters of this part of a run together with the `later` part."""
        return Course(
            self.flank_events + later.flank_events,
            self.reversals + later.reversals,
            self.repeated_steps + later.repeated_steps,
            later.unsettled,
            self.both_flanks + later.both_flanks,
            self.start_warning or later.start_warning,
        )


def course_so_far(control: Control, unsettled: float) -> Course:
    """Counters of a run from its start.

    Args:
        control: counters of the run, see `core/integrators/control.hpp`.
        unsettled: remaining time until friction no longer depends on the initial state [s].
    """
    return Course(
        int(control.flank_events),
        int(control.reversals),
        int(control.repeated),
        unsettled,
        int(control.both_flanks),
    )


class Settling:
    """How fast friction of creeping gears becomes independent of the initial state."""

    def __init__(self, layout: Layout) -> None:
        scene = layout.scene
        gearset, friction = scene.gearset, scene.lubrication
        self._remembers = not scene.quasi_static and friction.friction
        self._distance = SETTLED * friction.presliding_displacement
        angle = min(mesh.pressure_angle for mesh in gearset.geometry.meshes)
        lever = gearset.geometry.sun.base_radius * math.tan(angle)
        ratios = layout.ratios
        self._rolling = [
            lever * float(sun - carrier)
            for sun, carrier in zip(ratios["sun"], ratios["carrier"], strict=True)
        ]

    def rate(self, point: OperatingPoint) -> float:
        """Rate at which it does.

        Returns:
            The rate [1/s]: infinite if gears do not creep, 0 if they stand or friction has no
            memory.
        """
        if not self._remembers:
            return 0.0
        inputs = point.input_speed, point.second_input_speed
        # Of both flanks at the pitch point [m/s], by the speed of the sun relative to the carrier.
        rolling = abs(sum(per * speed for per, speed in zip(self._rolling, inputs, strict=False)))
        return math.inf if rolling >= CREEPING else rolling / self._distance


def unsettled(share: float, rate: float) -> float:
    """Time until friction no longer depends on the initial state [s].

    Args:
        share: rolled share of the distance after which it has.
        rate: present rate of that share [1/s], see `Settling`.
    """
    return (1.0 - share) / rate if 0.0 < rate < math.inf and share < 1.0 else 0.0
