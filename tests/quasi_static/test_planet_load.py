"""The load of planets against play and springs solved by bisection."""

import math

import numpy as np
import pytest
from planetary_twin_core_parts import planet_force, ring_force, windup_at
from scipy.optimize import brentq

from planetary_twin_py._core import Springs, solve_windup

MESH = 1e8  # [N/m] of both meshes


def dead_zone(squeeze, drive, coast):
    """Force of a mesh with play to both sides."""
    return MESH * (max(squeeze - drive, 0.0) + min(squeeze + coast, 0.0))


def steps_of(rub, sun, ring):
    """What `ring_force` takes, from the plays (drive, coast) of both meshes."""
    middle = sun[0] - ring[1] if rub > 0.0 else ring[0] - sun[1]
    return -sun[1] - ring[1], middle, sun[0] + ring[0]


@pytest.mark.parametrize("rub", [-3.0, 2.0])
@pytest.mark.parametrize("sun", [(0.0, 0.0), (1e-7, 1e-7), (1e-7, 3e-7)])
@pytest.mark.parametrize("ring", [(0.0, 0.0), (2e-7, 1e-7)])
def test_planet_is_in_equilibrium_with_both_meshes_and_friction(rub, sun, ring):
    steps = steps_of(rub, sun, ring)
    for w in np.linspace(-1e-6, 1e-6, 41):

        def unbalanced(d, w=w):
            return dead_zone(d, *sun) - dead_zone(w - d, *ring) - rub

        d = brentq(unbalanced, -1e-4, 1e-4, xtol=1e-20, rtol=1e-14)
        force, growth = ring_force(w - rub / MESH, 2.0 / MESH, rub, steps)
        assert force == pytest.approx(dead_zone(w - d, *ring), abs=1e-9)
        assert growth in (0.0, 0.5 * MESH)


def test_wind_up_at_a_force_gives_that_force():
    steps = steps_of(2.0, (1e-7, 1e-7), (2e-7, 1e-7))
    for force in np.linspace(-10.0, 10.0, 41):
        w = windup_at(force, 2.0 / MESH, 2.0, steps)
        assert ring_force(w, 2.0 / MESH, 2.0, steps)[0] == pytest.approx(force, abs=1e-9)


@pytest.mark.parametrize("total", [-500.0, -1.0, 0.0, 1e-3, 1.0, 80.0, 1e5])
@pytest.mark.parametrize("play", [0.0, 1e-12, 1e-7, 1e-3])
def test_planets_and_their_copies_carry_the_total_together(total, play):
    random = np.random.default_rng(7)
    for _ in range(200):
        planets = int(random.integers(2, 8))
        springs = Springs(
            copies=random.integers(1, 4, size=planets),
            error=random.normal(scale=random.choice([0.0, 1e-7, 1e-4]), size=planets),
            compliance=10.0 ** random.uniform(-12.0, -6.0, size=planets),
            friction=random.normal(scale=random.choice([0.0, 1e-3, 5.0]), size=planets),
        )
        for p in range(planets):
            springs.steps[p] = steps_of(springs.friction[p], (play, play), (play, play))
        w = solve_windup(total, planets, springs)
        forces = [
            force
            for p in range(planets)
            for force in [planet_force(springs, p, w)[0]] * int(springs.copies[p])
        ]
        size = abs(total) + sum(map(abs, forces))
        # w and the errors are known to their last digits only
        digits = 2e-16 * (abs(w) + np.abs(springs.error[:planets]))
        last = float((springs.copies[:planets] * digits / springs.compliance[:planets]).sum())
        assert math.fsum(forces) == pytest.approx(total, abs=1e-12 * size + 2.0 * last)
