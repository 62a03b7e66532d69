"""Radii and path of contact of involute spur gears."""

from __future__ import annotations

import math
from typing import NamedTuple


class PathOfContact(NamedTuple):
    """Path of contact of a tooth pair on the line of action, relative to the pitch point.

    A pair is in contact from -approach to +recess.
    """

    approach: float
    """Length up to the pitch point [base pitches], limited by the tip of the driven gear."""
    recess: float
    """Length after the pitch point [base pitches], limited by the tip of the driving gear."""

    @property
    def contact_ratio(self) -> float:
        """Mean number of tooth pairs in contact."""
        return self.approach + self.recess

    @property
    def nearest(self) -> float:
        """Position nearest to the pitch point, which shifted gears may have beyond an end."""
        return min(max(0.0, -self.approach), self.recess)


def pitch_radius(teeth: float, module: float) -> float:
    """Pitch radius m z/2 [m].

    Args:
        teeth: number of teeth z.
        module: m [m].
    """
    return 0.5 * module * teeth


def base_pitch(module: float, pressure_angle: float) -> float:
    """Distance between neighbouring flanks on the line of action, pi m cos(alpha) [m].

    Args:
        module: m [m].
        pressure_angle: alpha [rad].
    """
    return math.pi * module * math.cos(pressure_angle)


def external_tip_reach(teeth: float, angle: float, height: float, working: float) -> float:
    """Distance from the pitch point to the tip circle along the line of action [modules].

    ISO 21771:2007, sec. 6.5: sqrt(r_a^2 - r_b^2) - r_b tan(a_w).

    Args:
        teeth: number of teeth.
        angle: pressure angle on the reference circle [rad].
        height: of the tip above the reference circle [modules].
        working: working pressure angle [rad].
    """
    pitch, base, tip = teeth / 2, teeth / 2 * math.cos(angle), teeth / 2 + height
    return math.sqrt(tip**2 - base**2) - _tangent(pitch, angle, working)


def internal_tip_reach(teeth: float, angle: float, height: float, working: float) -> float:
    """Distance from the pitch point to the tip circle of an internal gear [modules].

    Args:
        teeth: number of teeth.
        angle: pressure angle on the reference circle [rad].
        height: of the tip inside the reference circle [modules].
        working: working pressure angle [rad].
    """
    pitch, base, tip = teeth / 2, teeth / 2 * math.cos(angle), teeth / 2 - height
    return _tangent(pitch, angle, working) - math.sqrt(tip**2 - base**2)


def _tangent(pitch: float, angle: float, working: float) -> float:
    """Distance from the pitch point to the base circle along the line of action, r_b tan(a_w)."""
    return pitch * (math.cos(angle) / math.cos(working)) * math.sin(working)


def on_involute(
    reach: float, teeth: float, angle: float, tip: str, flank: str, working: float
) -> float:
    """Check that the tip of the mating gear does not pass the start of the involute.

    The involute starts where the line of action touches the base circle (Buckingham 1949,
    Analytical Mechanics of Gears, ch. 4: involute interference).

    Args:
        reach: of the mating tip along the line of action [modules].
        teeth: number of teeth of the gear.
        angle: pressure angle on the reference circle [rad].
        tip: name of the mating gear, for the message.
        flank: name of the gear, for the message.
        working: working pressure angle [rad].

    Returns:
        `reach`.

    Raises:
        ValueError: the tip passes the start of the involute.
    """
    longest = _tangent(teeth / 2, angle, working)
    if reach >= longest:
        raise ValueError(
            f"gearset.teeth.{flank} = {teeth}: tips of the {tip} reach below the base circle of "
            f"the {flank}, where there is no involute: they reach {reach:.3f} module from the "
            f"pitch point along the line of action, must be below {longest:.3f}; increase the "
            "number of teeth, gearset.pressure_angle or gearset.profile_shift, or reduce "
            "gearset.addendum"
        )
    return reach
