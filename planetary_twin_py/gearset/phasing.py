"""Where in its cycle each mesh stands, and where planets can be put at all.

The mesh phase is a delay in mesh cycles behind the sun mesh of planet 1 (Parker and Lin 2004):
Zs psi/2pi at the sun, -Zr psi/2pi at the ring for a planet at the angle psi from planet 1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction

from .clearance import Size, are_clear
from .kinematics import Teeth

ASSEMBLY_TOLERANCE = 1e-6  # [-] of the spacing between two positions that can be assembled


def least_mesh_angle(teeth: Teeth) -> float:
    """Spacing of the positions at which a planet can be put in [rad]: 2 pi/(Zs + Zr)."""
    return 2.0 * math.pi / (teeth.sun + teeth.ring)


def nearest_assembly(teeth: Teeth, angles: Sequence[float]) -> tuple[float, ...]:
    """The angles [rad] nearest to `angles` at which the planets can be put in."""
    step = least_mesh_angle(teeth)
    return tuple(angles[0] + step * place for place in _places(teeth, angles))


def _places(teeth: Teeth, angles: Sequence[float]) -> list[int]:
    """Positions at which planets can be put in, counted from that of the first planet."""
    return [round((angle - angles[0]) / least_mesh_angle(teeth)) for angle in angles]


def check_assembly(teeth: Teeth, angles: Sequence[float], addendum: float = 1.0) -> None:
    """Check that planets at `angles` [rad] fit between sun and ring.

    Raises:
        ValueError: some planet's teeth miss the spaces; the message offers what fits, unless
            planets with this `addendum`, in modules, would then touch each other.
    """
    fitting = nearest_assembly(teeth, angles)
    step = least_mesh_angle(teeth)
    misses = [abs(a - b) / step for a, b in zip(angles, fitting, strict=True)]
    if max(misses) > ASSEMBLY_TOLERANCE:
        offer = f"nearest: {_degrees(fitting)}"
        if not are_clear(Size(teeth, 1.0, addendum), fitting):
            offer = "at the nearest that can, planets touch each other"
        raise ValueError(
            f"planets at {_degrees(angles)} cannot be assembled with "
            f"{teeth.sun}/{teeth.planet}/{teeth.ring} teeth; {offer}"
        )


def _degrees(angles: Sequence[float]) -> str:
    return f"{', '.join(f'{math.degrees(angle):g}' for angle in angles)} deg"


def mesh_phases(teeth: Teeth, angles: Sequence[float]) -> tuple[list[Fraction], list[Fraction]]:
    """Phases of the sun meshes and of the ring meshes [cycles], exact: planets at `angles` [rad]
    stand where they can be put in (see `check_assembly`).

    Whole cycles count teeth: tooth n of the sun is at planet i once `n` + phase cycles have
    passed, and so is tooth n of the ring. Pitch point to pitch point across one planet: half a
    cycle between its sun mesh and its ring mesh if it has an even number of teeth, none if odd.
    """
    offset = Fraction(1 - teeth.planet % 2, 2)
    turns = [Fraction(place, teeth.sun + teeth.ring) for place in _places(teeth, angles)]
    return [teeth.sun * turn for turn in turns], [offset - teeth.ring * turn for turn in turns]
