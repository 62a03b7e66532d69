"""Errors of form: the static transmission error e that the teeth themselves put into a mesh.

A mesh is squeezed by side (d - e) - b on its side, b half the backlash. e = e_T + side e_R: the
tangential part e_T shifts both flanks of a tooth the same way, the radial part e_R draws them away
from the other gear's and widens the play. Harmonics of the meshing frequency are e_T alone; runout,
which returns with the turn of a gear, has both parts and leans by the pressure angle, the other way
on the other flank. All are sines of the mesh cycle.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from .._core import LINES
from ..scene import Scene
from ..scene.mesh import TransmissionError


class _Line(NamedTuple):
    """A column of `Train`."""

    tangential: float
    radial: float
    harmonic: float
    period: int
    phase: float = 0.0
    of_planet: int = 0


def build_form_errors(scene: Scene) -> dict[str, Any]:
    """Fields of `Train`."""
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
