"""The elastic ring against limits with a closed form and against the fits in the literature."""

import math

import numpy as np
import pytest

from planetary_twin_py.tooth.foundation import GearBody

# Sainsot, Velex and Duverger (2004), table 1: A..F of L*, M*, P*, Q* over (1/t^2, h^2, h/t, 1/t,
# h, 1); the same digits stand in eight public programs.
SAINSOT = np.array(
    [
        [-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045],
        [60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086],
        [-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236],
        [-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904],
    ]
)


def stars(h, half_angle, nu=0.3):
    """L*, M*, P*, Q* of a ring."""
    matrix = GearBody(1 / h, half_angle, nu).compliance()
    root = 2 * half_angle
    return np.array(
        [matrix[0, 0] * root**2, 2 * matrix[0, 1] * root, matrix[1, 1], matrix[2, 2] / matrix[1, 1]]
    )


@pytest.mark.parametrize("nu", [0.0, 0.25, 0.3, 0.45])
def test_narrow_root_turns_as_on_a_half_plane(nu):
    """Weber and Banaschek (1953): 18/pi (1 - nu^2) M/(E b S^2) and 2 (1 - 2 nu)(1 + nu) V/(E b S).

    For nu = 0.3 the well-known 5.2 and 1.04.
    """
    rotation, coupling, *_ = stars(2.0, 0.004, nu)
    assert rotation == pytest.approx(18 / math.pi * (1 - nu**2), rel=2e-3)
    assert coupling == pytest.approx(2 * (1 - 2 * nu) * (1 + nu), abs=0.02)


@pytest.mark.parametrize("h", [2.0, 3.0, 5.0])
@pytest.mark.parametrize("half_angle", [0.03, 0.06, 0.12])
def test_displacement_of_the_root_agrees_with_the_fit_of_sainsot(h, half_angle):
    """P* and Q*. Their L* = 6.9 turns the root by a third more: see the finite elements."""
    fitted = SAINSOT @ [half_angle**-2, h**2, h / half_angle, 1 / half_angle, h, 1]
    *_, shift, ratio = stars(h, half_angle)
    assert shift == pytest.approx(fitted[2], rel=0.09)
    assert ratio == pytest.approx(fitted[3], abs=0.04)


@pytest.mark.parametrize("held", [0.3, 0.5, 0.8, 1.2, 2.0])
def test_teeth_all_around_wind_the_body_up_as_a_disc(held):
    """Equal shear forces on z teeth: the torsion of a ring, z/(4 pi G) |1/held^2 - 1|."""
    teeth, nu = 12, 0.3
    body = GearBody(held, 0.01, nu)
    around = sum(body.compliance(2 * math.pi * k / teeth)[1, 1] for k in range(teeth))
    # Only the mean turns; what is left are the harmonics z, 2z, ... of the tooth itself.
    local = body.compliance()[1, 1]
    disc = teeth * (1 + nu) / (2 * math.pi) * abs(1 - held**-2)
    assert disc < around < disc + local
    fine = GearBody(held, math.pi / teeth * 0.999, nu)
    uniform = sum(fine.compliance(2 * math.pi * k / teeth)[1, 1] for k in range(teeth))
    assert uniform == pytest.approx(disc, rel=0.06)


@pytest.mark.parametrize("held", [0.5, 1.2])
def test_two_teeth_move_one_another_equally(held):
    """Maxwell and Betti: the response at +a to a load at 0 is that at 0 to a load at +a."""
    body = GearBody(held, 0.05, 0.3)
    assert np.allclose(body.compliance(0.2), body.compliance(-0.2).T, rtol=1e-10, atol=1e-12)
    assert np.all(np.linalg.eigvalsh(body.compliance()) > 0)


def test_series_has_converged(monkeypatch):
    coarse = GearBody(1.2, 0.044, 0.3).compliance()
    monkeypatch.setattr("planetary_twin_py.tooth.foundation.HARMONICS", 400.0)
    assert np.allclose(coarse, GearBody(1.2, 0.044, 0.3).compliance(), rtol=1e-3, atol=1e-9)
