"""Lines in the motion of a rigid ring: only those that the phases of equal planets allow.

Turning the set by the angle of a planet and waiting for its mesh phase changes nothing. So in the
frame of the carrier the displacement x + i y of the ring has harmonics k of the mesh frequency, of
either sign, only where k Z_ring + 1 is a multiple of the number of planets: in the housing, at the
orders 90, 183 and 363 of the carrier and others like them.
"""

import math

import numpy as np
from planar.moving_scenes import planar
from power_flows import FLOWS

from planetary_twin_py import simulate

CYCLES, PER_CYCLE, WIDE = 24, 96, 4  # samples in a cycle: a multiple of three, so aliases stay


def test_a_ring_moves_with_the_lines_of_its_planets_alone():
    placed = tuple(2.0 * math.pi * i / 3 for i in range(3))
    teeth = {"sun": 17, "planet": 37, "ring": 91}
    given = planar(
        FLOWS[2],
        **{"gearset.teeth": teeth, "gearset.planet_angles": placed, "lubrication.friction": False},
    )
    mesh = given.operating_point.input_speed / (2.0 * math.pi) * 17 * 91 / (17 + 91)
    run = simulate(
        given,
        CYCLES / mesh,
        sample_rate=PER_CYCLE * mesh,
        settling=3.0 * round(mesh) / mesh,
        tolerance=1e-6,
    )
    moved = run.axes.displacement[:, 1] @ [1.0, 1j]
    hann = 1.0 - np.cos(2.0 * np.pi * np.arange(len(moved)) / len(moved))
    lines = np.abs(np.fft.fft(moved * hann))
    bins = np.fft.fftfreq(len(moved), 1.0 / len(moved))
    harmonic = np.round(bins / CYCLES)
    allowed = ((harmonic - 2) % 3 == 0) & (np.abs(bins - CYCLES * harmonic) <= WIDE)
    assert lines[~allowed].max() < 1e-6 * lines.max()
    assert np.count_nonzero(lines[allowed] > 1e-2 * lines.max()) > 10
