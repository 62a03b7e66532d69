"""Lines of vibration that grow together, by their cause.

A fault of a tooth modulates the meshes once per turn of its gear relative to the carrier (McFadden
1986, J. Vib. Acoust. 108(2), 165-170), and planets that pass the sensor modulate them again: see
`analysis.fault_lines`. Planets are never quite alike, so a line of a gear names this gear only if
no other one may have it at any sideband of the carrier. Gears without such lines are named
together.

Rolling elements that strike a fault excite the housing at their rate, above the lines of the teeth.
So the lines of a planet bearing are those of the squared samples (Randall and Antoni 2011, Mech.
Syst. Signal Process. 25, 485-520), in a band, since rolling elements slip.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from ..analysis.bearing_orders import bearing_lines
from ..analysis.fault_lines import FaultLines, central_gear_lines, planet_lines, possible_lines
from ..analysis.turning import Turning
from .train import FollowedTrain

HARMONICS = 3  # of the mesh frequency, and of the rates of a bearing
SLIP = 0.01  # relative distance from its rate at which a bearing may have a line
RESOLVED = 2  # orders of a hunting period: half of the main lobe of a Hann window
GEARS = "sun", "planet", "ring"
TONES = ("wear of all teeth", "a change of the meshes", "the path to the sensor")
INDICATORS = "rms", "kurtosis"


class Line(NamedTuple):
    """A line of a spectrum over the mesh cycles."""

    mesh: int
    """Harmonic of the mesh; 0: a line of the squared samples."""
    offset: float
    """Distance from the harmonic, in mesh orders."""
    beside: float = 0.0
    """Distance from the line on either side at which no cause has one, in mesh orders; 0: none."""

    @property
    def order(self) -> float:
        """Frequency of the line over the mesh frequency."""
        return self.mesh + self.offset


class Pattern(NamedTuple):
    """Lines that grow together."""

    name: str
    lines: tuple[Line, ...]
    causes: tuple[str, ...]
    """Possible causes of a growth; none of an indicator, which has no lines and is evidence only:
    load, path and noise move it as well."""


def patterns_of(train: FollowedTrain, rolling: tuple[int, Fraction] | None) -> list[Pattern]:
    """Mesh harmonics, lines of the gears and of a planet bearing, and indicators.

    Args:
        train: gear train.
        rolling: number of rolling elements of a planet bearing, and their diameter over the pitch
            diameter times the cosine of the contact angle; None: unknown.
    """
    harmonics = range(1, HARMONICS + 1)
    tones = [Pattern(f"mesh harmonic {mesh}", (Line(mesh, 0.0),), TONES) for mesh in harmonics]
    bearings = () if rolling is None else _bearing_patterns(train, *rolling)
    indicators = (Pattern(name, (), ()) for name in INDICATORS)
    return [*tones, *_gear_patterns(train.turning), *bearings, *indicators]


def _gear_patterns(turning: Turning) -> Iterator[Pattern]:
    """Lines that one gear alone may have, or those of gears that no line tells apart."""
    unlike, groups = turning._replace(alike=1), dict[tuple[str, ...], set[Line]]()
    beside = 0.5 / max(turning.teeth)  # between two sidebands
    for mesh in range(1, HARMONICS + 1):
        possible = {gear: possible_lines(unlike, gear, mesh) for gear in GEARS}
        for gear in GEARS:
            found = _lines_of(turning, gear, mesh)
            orders = {*found.present, *found.weak} - {mesh * turning.mesh}
            others = [other for other in GEARS if other != gear]
            own = orders.difference(*(possible[other] for other in others))
            sharing = () if own else [one for one in others if orders & possible[one]]
            named = tuple(one for one in GEARS if one == gear or one in sharing)
            lines = {
                Line(mesh, float(order / turning.mesh) - mesh, beside) for order in own or orders
            }
            groups.setdefault(named, set()).update(lines)
    for gears, lines in groups.items():
        causes = [f"a tooth of the {gear}" for gear in gears]
        if any(not getattr(turning, gear) for gear in gears) and turning.carrier:
            causes.append("planets that are not alike")  # their passing has the lines of this gear
        name = f"sidebands of the {' and the '.join(gears)}"
        yield Pattern(name, tuple(sorted(lines)), (*causes, "a runout"))


def _lines_of(turning: Turning, gear: str, mesh: int) -> FaultLines:
    if gear == "planet":
        return planet_lines(turning, mesh)
    return central_gear_lines(turning, gear, mesh)


def _bearing_patterns(train: FollowedTrain, count: int, ratio: Fraction) -> Iterator[Pattern]:
    """Lines of races and rolling elements, except those that teeth may have."""
    turning, cycles = train.turning, train.hunting_cycles
    steps = [cycles // getattr(turning.teeth, gear) for gear in GEARS]
    for fault in bearing_lines(turning, count, ratio)[:3]:
        lines = []
        for harmonic in range(1, HARMONICS + 1):
            centre = float(harmonic * fault.rate / turning.mesh) * cycles
            half = round(SLIP * centre / RESOLVED)
            for place in (centre + RESOLVED * n for n in range(-half, half + 1)):
                near = [abs((place + 0.5 * step) % step - 0.5 * step) for step in steps]
                if min(near) >= RESOLVED:
                    lines.append(Line(0, place / cycles, 3.0 * SLIP * place / cycles))
        name = fault.fault.partition(" (")[0]
        yield Pattern(f"lines of the {name} of a planet bearing", tuple(lines), (f"the {name}",))
