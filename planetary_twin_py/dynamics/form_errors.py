"""Errors of form: the static transmission error e that the teeth themselves put into a mesh.

A mesh is squeezed by d - e. Every error is a sine of the mesh cycle x: harmonics n of the
meshing frequency, and runout, which returns with the turn of a gear, so at the order 1/Z.
"""

from __future__ import annotations

import math

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
    "line_amplitude": (REAL, (2, LINES)),  # [m]
    "line_harmonic": (REAL, (2, LINES)),  # sines ...
    "line_period": (WHOLE, (2, LINES)),  # ... in so many mesh cycles
    "line_phase": (REAL, (2, LINES)),  # [rad]
}

Line = tuple[float, float, int, float]  # amplitude, harmonic, period, phase


def build_form_errors(scene: Scene) -> dict[str, np.ndarray]:
    """Fields of `FORM_ERRORS_LAYOUT`."""
    mesh = scene.mesh
    kinds = (
        _harmonics(mesh.sun_planet_error) + _runout(scene, ("sun", "planet"), +1.0),
        _harmonics(mesh.planet_ring_error) + _runout(scene, ("planet", "ring"), -1.0),
    )
    columns = np.zeros((4, 2, LINES))
    columns[2] = 1.0
    for kind, lines in enumerate(kinds):
        for place, line in enumerate(lines):
            columns[:, kind, place] = line
    return {
        "lines": np.array([len(lines) for lines in kinds]),
        "line_amplitude": columns[0],
        "line_harmonic": columns[1],
        "line_period": columns[2].astype(int),
        "line_phase": columns[3],
    }


def _harmonics(error: TransmissionError) -> list[Line]:
    phases = error.phases or (0.0,) * len(error.amplitudes)
    pairs = zip(error.amplitudes, phases, strict=True)
    return [(a, float(n + 1), 1, phase) for n, (a, phase) in enumerate(pairs) if a != 0.0]


def _runout(scene: Scene, gears: tuple[str, str], side: float) -> list[Line]:
    """Eccentricity along the line of action, which leans by the pressure angle, and for a planet
    to the one side at the sun and to the other at the ring."""
    lean = side * scene.gearset.pressure_angle
    teeth = scene.gearset.tooth_numbers._asdict()
    sizes = {gear: getattr(scene.mesh.runout, gear) for gear in gears}
    return [(size, 1.0, teeth[gear], lean) for gear, size in sizes.items() if size != 0.0]


@kernel
def place_lines(train: Record, state: Record, i: int, angle: np.ndarray) -> None:
    """Fill angle[i, :] with where the sines of mesh i stand [rad]."""
    kind = train.kind[i]
    for n in range(train.lines[kind]):
        cycle = counted_cycle(train, state, i, DRIVE_SIDE, train.line_period[kind, n])
        turn = cycle * train.line_harmonic[kind, n] / train.line_period[kind, n]
        angle[i, n] = 2.0 * math.pi * turn + train.line_phase[kind, n]


@kernel
def form_error(
    train: Record, i: int, angle: np.ndarray, advance: float, pace: float
) -> tuple[float, float]:
    """e [m] of mesh i and its rate, `advance` cycles after `place_lines`, at `pace` cycles/s."""
    kind = train.kind[i]
    error = rate = 0.0
    for n in range(train.lines[kind]):
        order = 2.0 * math.pi * train.line_harmonic[kind, n] / train.line_period[kind, n]
        turned = angle[i, n] + order * advance
        error += train.line_amplitude[kind, n] * math.sin(turned)
        rate += train.line_amplitude[kind, n] * order * pace * math.cos(turned)
    return error, rate


@kernel
def form_error_bend(train: Record, i: int, angle: np.ndarray, pace: float) -> float:
    """Second derivative of e [m/s^2] of mesh i at `place_lines`, at `pace` cycles/s."""
    kind, bend = train.kind[i], 0.0
    for n in range(train.lines[kind]):
        order = 2.0 * math.pi * train.line_harmonic[kind, n] / train.line_period[kind, n]
        bend -= train.line_amplitude[kind, n] * (order * pace) ** 2 * math.sin(angle[i, n])
    return bend
