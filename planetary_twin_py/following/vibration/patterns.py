"""Lines of vibration that grow together, by their cause.

A fault of a tooth modulates the meshes once per turn of its gear relative to the carrier (McFadden
1986, J. Vib. Acoust. 108(2), 165-170), and planets that pass the sensor modulate them again: see
`analysis.faults.fault_lines`. Planets are never quite equal, so a line of a gear names this gear
only if no other one may have one there, at any sideband of the carrier, or so near that a hunting
period does not resolve both. Gears without such lines are named together.

The squared samples have the modulation of all harmonics together, at the rate of a tooth: it shows
short impacts, whose energy is above the harmonics that are resolved one by one.

Rolling elements that strike a fault excite the housing at their rate, above the lines of the teeth.
So the lines of a planet bearing are those of the squared samples (Randall and Antoni 2011, Mech.
Syst. Signal Process. 25, 485-520), in a band, since rolling elements slip.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...analysis.faults.bearing_orders import bearing_lines
from ...analysis.faults.fault_lines import (
    FAR,
    NEAR,
    central_gear_lines,
    planet_lines,
    possible_lines,
)
from ..train import FollowedTrain

HARMONICS = 3  # of the mesh frequency, and of the rates of a bearing
SLIP = 0.01  # relative distance from its rate at which a bearing may have a line
RESOLVED = 2  # orders of a hunting period: half of the main lobe of a Hann window
FLOOR = 3, 20  # such orders from a line, from and up to which the floor beside it is measured
SIDEBANDS = -3, -2, -1, 1, 2, 3  # of a gear; every third one turns three planets together
GEARS = "sun", "planet", "ring"
OTHERS = "a runout", "a bearing"  # its rolling elements slip, so its lines may be anywhere
TONES = ("wear of all teeth", "a change of the meshes", "the path to the sensor")
INDICATORS = "rms", "kurtosis"


class Line(NamedTuple):
    """A line of a spectrum over the mesh cycles."""

    mesh: int
    """Harmonic of the mesh; 0: a line of the squared samples, near frequency 0."""
    offset: float
    """Distance from the harmonic, in mesh orders."""
    beside: tuple[float, ...] = ()
    """Offsets near it at which a healthy gearbox and its own causes have no line."""

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

    `rolling` is the number of rolling elements of a planet bearing, and their diameter over the
    pitch diameter times the cosine of the contact angle.
    """
    harmonics = range(1, HARMONICS + 1)
    tones = [Pattern(f"mesh harmonic {mesh}", (Line(mesh, 0.0),), TONES) for mesh in harmonics]
    bearings = () if rolling is None else _bearing_patterns(train, *rolling)
    indicators = (Pattern(name, (), ()) for name in INDICATORS)
    return [*tones, *_gear_patterns(train), *bearings, *indicators]


def _gear_patterns(train: FollowedTrain) -> Iterator[Pattern]:
    """Lines that one gear alone may have, or those that some gears share."""
    turning = train.turning
    groups: dict[tuple[str, tuple[str, ...]], set[Line]] = {}
    for mesh in range(HARMONICS + 1):
        for gear in GEARS:
            named, lines = _own_lines(train, gear, mesh)
            groups.setdefault(("sidebands" if mesh else "modulation", named), set()).update(lines)
    for (kind, gears), of_group in groups.items():
        causes = [f"a tooth of the {gear}" for gear in gears]
        if any(not getattr(turning, gear) for gear in gears) and turning.carrier:
            causes.append("unequal planets")  # their passing has the lines of this gear
        name = f"{kind} of the {' and the '.join(gears)}"
        yield Pattern(name, tuple(sorted(of_group)), (*causes, *OTHERS))


def _own_lines(train: FollowedTrain, gear: str, mesh: int) -> tuple[tuple[str, ...], set[Line]]:
    """Gears that the lines of one name, and the lines, around a harmonic of the mesh."""
    turning = train.turning
    unequal = turning._replace(symmetry=1)
    if gear == "planet":
        found = planet_lines(turning, mesh, SIDEBANDS)
    else:
        found = central_gear_lines(turning, gear, mesh, SIDEBANDS)
    places = _bins({*found.present, *found.weak} - {mesh * turning.mesh}, train)
    places = places[places >= RESOLVED]
    passing = {abs(mesh * turning.mesh + m * turning.carrier) for m in range(-FAR, FAR + 1)}
    possible = {one: _bins(possible_lines(unequal, one, mesh), train) for one in GEARS}
    own, sharing = np.ones(len(places), dtype=bool), []
    for other in GEARS:
        if other == gear:
            continue
        near = _bins(possible_lines(unequal, other, mesh, NEAR), train)
        shared = np.isin(places, possible[other])
        shared |= np.abs(places[:, None] - near).min(axis=1) < RESOLVED
        own &= ~shared
        sharing += [other] if shared.any() else []
    named = tuple(one for one in GEARS if one == gear or (one in sharing and not own.any()))
    used = places[own] if own.any() else places
    strong = np.concatenate([_bins(passing, train), *(possible[one] for one in named)])
    return named, {_line(mesh, place, train.hunting_cycles, strong) for place in used.tolist()}


def _bins(orders: set[Fraction], train: FollowedTrain) -> NDArray[np.int64]:
    """Cycles per hunting period of some orders: whole numbers; those of -f are those of f."""
    per_mesh = train.hunting_cycles / train.turning.mesh
    return np.unique([abs(int(each * per_mesh)) for each in orders])


def _line(mesh: int, place: int, cycles: int, strong: NDArray[np.int64]) -> Line:
    """A line, with the nearest places on both sides that are clear of strong ones."""
    beside = []
    for side in (-1, 1):
        near = place + side * np.arange(*FLOOR)
        clear = near[(np.abs(near[:, None] - strong).min(axis=1) >= RESOLVED) & (near > RESOLVED)]
        beside += [float(clear[0] - mesh * cycles) / cycles] if len(clear) else []
    return Line(mesh, (place - mesh * cycles) / cycles, tuple(beside))


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
                    offset = place / cycles
                    beside = tuple(offset * (1.0 + 3.0 * side * SLIP) for side in (-1, 1))
                    lines.append(Line(0, offset, beside))
        name = fault.fault.partition(" (")[0]
        yield Pattern(f"lines of the {name} of a planet bearing", tuple(lines), (f"the {name}",))
