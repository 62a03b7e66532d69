"""Errors of form: the static transmission error e that the teeth themselves put into a mesh.

A mesh is squeezed by side (d - e) - b on its side, b half the backlash. e = e_T + side e_R: the
tangential part e_T shifts both flanks of a tooth the same way, the radial part e_R draws them away
from the other gear's and widens the play. Harmonics of the meshing frequency are e_T alone; runout,
which returns with the turn of a gear, has both parts and leans by the pressure angle, the other way
on the other flank. All are sines of the mesh cycle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._compile import kernel
from .._records import REAL, WHOLE, Record
from ..scene import Scene
from ..scene.mesh import TransmissionError
from .cycle import counted_cycle
from .state import DRIVE_SIDE

LINES = 6  # of one mesh: 4 harmonics, the runout of 2 gears

FORM_ERRORS_LAYOUT = {
    "lines": (WHOLE, (2,)),
    "harmonics": (WHOLE, (2,)),  # so many of them, the first, have no radial part
    "line_tangential": (REAL, (2, LINES)),  # amplitude of the sine in e_T [m]
    "line_radial": (REAL, (2, LINES)),  # amplitude of the cosine in e_R [m]
    "line_harmonic": (REAL, (2, LINES)),  # sines ...
    "line_period": (WHOLE, (2, LINES)),  # ... in so many mesh cycles
    "line_phase": (REAL, (2, LINES)),  # [rad]
    "line_of_planet": (WHOLE, (2, LINES)),  # 1: of a planet, whose turns its sun mesh counts
}


class _Line(NamedTuple):
    """A column of `FORM_ERRORS_LAYOUT`."""

    tangential: float
    radial: float
    harmonic: float
    period: int
    phase: float = 0.0
    of_planet: int = 0


def build_form_errors(scene: Scene) -> dict[str, np.ndarray]:
    """Fields of `FORM_ERRORS_LAYOUT`."""
    mesh = scene.mesh
    kinds = (
        _harmonics(mesh.sun_planet_error) + _runout(scene, 0, {"sun": +1.0, "planet": -1.0}),
        _harmonics(mesh.planet_ring_error) + _runout(scene, 1, {"planet": +1.0, "ring": +1.0}),
    )
    columns = np.zeros((len(_Line._fields), 2, LINES))
    columns[3] = 1.0
    for kind, lines in enumerate(kinds):
        for place, line in enumerate(lines):
            columns[:, kind, place] = line
    return {
        "lines": np.array([len(lines) for lines in kinds]),
        "harmonics": np.array([sum(line.radial == 0.0 for line in lines) for lines in kinds]),
        "line_tangential": columns[0],
        "line_radial": columns[1],
        "line_harmonic": columns[2],
        "line_period": columns[3].astype(int),
        "line_phase": columns[4],
        "line_of_planet": columns[5].astype(int),
    }


def _harmonics(error: TransmissionError) -> list[_Line]:
    phases = error.phases or (0.0,) * len(error.amplitudes)
    pairs = zip(error.amplitudes, phases, strict=True)
    return [_Line(a, 0.0, n + 1.0, 1, phase) for n, (a, phase) in enumerate(pairs) if a != 0.0]


def _runout(scene: Scene, kind: int, leans: dict[str, float]) -> list[_Line]:
    """Lines a sin(turn + side lean phi) of the gears of a mesh with working pressure angle phi.

    With the toothing off its axis by a towards phi_g from the planet's radius, the sun has
    e_T = -a cos(phi) sin(phi_g), e_R = -a sin(phi) cos(phi_g); the ring the same with -e_R; the
    planet the opposite of both, in both meshes (first order in a). All turn one way but the sun.
    """
    teeth = scene.gearset.tooth_numbers._asdict()
    angle = scene.gearset.geometry.meshes[kind].pressure_angle
    sizes = {gear: getattr(scene.mesh.runout, gear) for gear in leans}
    return [
        _Line(
            size * math.cos(angle),
            leans[gear] * size * math.sin(angle),
            1.0,
            teeth[gear],
            of_planet=int(gear == "planet"),
        )
        for gear, size in sizes.items()
        if size != 0.0
    ]


@kernel
def place_lines(train: Record, state: Record, i: int, angle: np.ndarray) -> None:
    """Fill angle[i, :] with where the sines of mesh i stand [rad]."""
    kind, planets = train.kind[i], train.meshes // 2
    for n in range(train.lines[kind]):
        counter = i % planets if train.line_of_planet[kind, n] else i
        cycle = counted_cycle(train, state, counter, DRIVE_SIDE, train.line_period[kind, n])
        turn = cycle * train.line_harmonic[kind, n] / train.line_period[kind, n]
        angle[i, n] = 2.0 * math.pi * turn + train.line_phase[kind, n]


@kernel
def form_error(
    train: Record, i: int, side: float, angle: np.ndarray, advance: float, pace: float
) -> tuple[float, float]:
    """e [m] of mesh i and its rate [m/s].

    Args:
        train: the gearbox.
        i: the mesh.
        side: +1: of the drive flanks, -1: of the coast flanks, 0: e_T alone.
        angle: from `place_lines` [rad], (meshes, LINES).
        advance: mesh cycles since then.
        pace: mesh cycles per second.
    """
    kind = train.kind[i]
    error = rate = 0.0
    for n in range(train.lines[kind]):
        order = 2.0 * math.pi * train.line_harmonic[kind, n] / train.line_period[kind, n]
        turned = angle[i, n] + order * advance
        error += train.line_tangential[kind, n] * math.sin(turned)
        rate += train.line_tangential[kind, n] * order * pace * math.cos(turned)
    radial, radial_rate = radial_error(train, i, angle, advance, pace)
    return error + side * radial, rate + side * radial_rate


@kernel
def radial_error(
    train: Record, i: int, angle: np.ndarray, advance: float, pace: float
) -> tuple[float, float]:
    """e_R [m] of mesh i and its rate [m/s], by which the play is wider on each side.

    Args:
        train: the gearbox.
        i: the mesh.
        angle: from `place_lines` [rad], (meshes, LINES).
        advance: mesh cycles since then.
        pace: mesh cycles per second.
    """
    kind = train.kind[i]
    error = rate = 0.0
    for n in range(train.harmonics[kind], train.lines[kind]):
        order = 2.0 * math.pi * train.line_harmonic[kind, n] / train.line_period[kind, n]
        turned = angle[i, n] + order * advance
        error += train.line_radial[kind, n] * math.cos(turned)
        rate -= train.line_radial[kind, n] * order * pace * math.sin(turned)
    return error, rate


@kernel
def form_error_bend(train: Record, i: int, side: float, angle: np.ndarray, pace: float) -> float:
    """Second derivative of e [m/s^2] of mesh i on a side, at `place_lines`, at `pace` cycles/s."""
    kind, bend = train.kind[i], 0.0
    for n in range(train.lines[kind]):
        order = 2.0 * math.pi * train.line_harmonic[kind, n] / train.line_period[kind, n]
        bend -= train.line_tangential[kind, n] * (order * pace) ** 2 * math.sin(angle[i, n])
    for n in range(train.harmonics[kind], train.lines[kind]):
        order = 2.0 * math.pi * train.line_harmonic[kind, n] / train.line_period[kind, n]
        bend -= side * train.line_radial[kind, n] * (order * pace) ** 2 * math.cos(angle[i, n])
    return bend
