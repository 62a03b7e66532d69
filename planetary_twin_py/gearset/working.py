"""Two gears at a given centre distance: working pressure angle, path of contact, backlash."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .geometry import (
    PathOfContact,
    base_pitch,
    external_tip_reach,
    internal_tip_reach,
    on_involute,
    pitch_radius,
)
from .involute import SpurGear
from .shift import involute, working_angle

Position = TypeVar("Position", float, NDArray[np.float64])

ROUNDING = 1e-12  # relative error of sums of shifts and angles


@dataclass(frozen=True)
class WorkingMesh:
    """A mesh of sun and planet, or of planet and ring.

    Equations are those of ISO 21771:2007; the number of teeth of the ring counts negative there.
    """

    first: SpurGear
    """The sun, or the planet in mesh with the ring."""
    second: SpurGear
    centre_distance: float
    """[m]"""

    @property
    def internal(self) -> bool:
        """Whether the second gear is the ring."""
        return self.second.internal

    @property
    def names(self) -> tuple[str, str]:
        """Kinds of both gears."""
        return ("planet", "ring") if self.internal else ("sun", "planet")

    @property
    def teeth(self) -> float:
        """Sum of the numbers of teeth, of the ring their difference."""
        return self.second.teeth + (-1 if self.internal else 1) * self.first.teeth

    @property
    def reference_distance(self) -> float:
        """Centre distance at which the reference circles touch [m]."""
        return pitch_radius(self.teeth, self.first.module)

    @property
    def shift(self) -> float:
        """Sum of the profile shifts [modules]."""
        return self.first.profile_shift + self.second.profile_shift

    @cached_property
    def pressure_angle(self) -> float:
        """Working pressure angle [rad] (eq. 60).

        Raises:
            ValueError: the gears are too close for a line of action.
        """
        angle = working_angle(
            self.reference_distance, self.centre_distance, self.first.pressure_angle
        )
        if angle is None:
            least = self.reference_distance * math.cos(self.first.pressure_angle)
            what = "difference" if self.internal else "sum"
            raise ValueError(
                f"gearset.centre_distance = {1e3 * self.centre_distance:.6g} mm: must be above the "
                f"{what} of the base radii of {' and '.join(self.names)}, {1e3 * least:.6g} mm"
            )
        return angle

    @property
    def base_pitch(self) -> float:
        """Distance between neighbouring flanks on the line of action [m]."""
        return base_pitch(self.first.module, self.first.pressure_angle)

    @property
    def working_pitch(self) -> float:
        """Pitch on the working pitch circles [m]."""
        return self.base_pitch / math.cos(self.pressure_angle)

    @cached_property
    def pitch_radii(self) -> tuple[float, float]:
        """Radii of both working pitch circles r cos(alpha)/cos(a_w) [m]."""
        growth = math.cos(self.first.pressure_angle) / math.cos(self.pressure_angle)
        return self.first.pitch_radius * growth, self.second.pitch_radius * growth

    @cached_property
    def curvatures(self) -> tuple[float, float]:
        """Radii of curvature of both flanks at the pitch point, r_w sin(a_w) [m]."""
        sine = math.sin(self.pressure_angle)
        return self.pitch_radii[0] * sine, self.pitch_radii[1] * sine

    def curvatures_at(self, position: Position) -> tuple[Position, Position]:
        """Radii of curvature of both flanks in contact [m].

        Args:
            position: of the contact after the pitch point [base pitches], any shape.
        """
        (first, second), moved = self.curvatures, self.base_pitch * position
        return first + moved, second + (moved if self.internal else -moved)

    @property
    def rolling_advance(self) -> float:
        """Distance that the flanks roll at the pitch point in a mesh cycle, p_b tan(a_w) [m]."""
        return math.tan(self.pressure_angle) * self.base_pitch

    @cached_property
    def path(self) -> PathOfContact:
        """Lengths of approach and recess [base pitches].

        Raises:
            ValueError: a tip reaches below the base circle of the mating gear.
        """
        first, second, working = self.first, self.second, self.pressure_angle
        angle, (driver, driven) = first.pressure_angle, self.names
        pitch = math.pi * math.cos(angle)
        reach = internal_tip_reach if self.internal else external_tip_reach
        late = external_tip_reach(first.teeth, angle, first.tip_height, working)
        early = reach(second.teeth, angle, second.tip_height, working)
        early = on_involute(early, first.teeth, angle, _several(driven), driver, working)
        if not self.internal:
            late = on_involute(late, second.teeth, angle, driver, driven, working)
        return PathOfContact(early / pitch, late / pitch)

    @property
    def backlash(self) -> float:
        """Backlash along the line of action of teeth without tolerances [m].

        External: m cos(alpha) [(z1 + z2)(inv a_w - inv alpha) - 2 (x1 + x2) tan(alpha)]
        (ISO 21771:2007, eqs. 62 and 98); internal: with z1 - z2. Negative: the teeth are too thick.
        """
        if self.shift == 0.0 and self.centre_distance == self.reference_distance:
            return 0.0
        angle, sense = self.first.pressure_angle, -1.0 if self.internal else 1.0
        opened = sense * self.teeth * (involute(self.pressure_angle) - involute(angle))
        closed = 2.0 * self.shift * math.tan(angle)
        if math.isclose(opened, closed, rel_tol=ROUNDING, abs_tol=ROUNDING * involute(angle)):
            return 0.0
        return self.first.module * math.cos(angle) * (opened - closed)

    @property
    def coast_lead(self) -> float:
        """Mesh cycles from the drive flank to the coast flank of a tooth at the pitch point.

        It is the tooth thickness of the first gear on its working pitch circle over the pitch, with
        half of the backlash: 1/2 + (s_w1 - s_w2)/(2 p_w); exactly 1/2 for gears without shift.
        """
        gears = (self.first, self.second)
        if self.centre_distance == self.reference_distance and not any(
            gear.profile_shift for gear in gears
        ):
            return 0.5  # to the last bit
        thick = [
            2.0 * radius * float(gear.half_thickness(np.array(radius)))
            for gear, radius in zip(gears, self.pitch_radii, strict=True)
        ]
        return 0.5 + 0.5 * (thick[0] - thick[1]) / self.working_pitch

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Clearance of the tips of the first and the second gear from the mating root [m]."""
        distance, (first, second) = self.centre_distance, (self.first, self.second)
        if self.internal:
            return (
                second.root_radius - distance - first.tip_radius,
                second.tip_radius - distance - first.root_radius,
            )
        return (
            distance - first.tip_radius - second.root_radius,
            distance - second.tip_radius - first.root_radius,
        )


def _several(kind: str) -> str:
    """How messages name the gears of a kind: there are several planets."""
    return "planets" if kind == "planet" else kind
