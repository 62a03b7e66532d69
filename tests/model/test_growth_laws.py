"""Growth of faults against the closed forms of its laws."""

import math

import pytest

from planetary_twin_py.model.growth_laws import archard_depth, paris_depth, table_severity
from planetary_twin_py.scene.growth import Archard, Paris, Table


def paris(exponent, until=1e-3):
    return Paris(law="paris", constant=1e-11, exponent=exponent, stress_range=2e8, until=until)


ARCHARD = Archard(
    law="archard", coefficient=1e-18, pressure=1.2e9, half_width=2e-4, slip=0.5, until=1e-3
)


@pytest.mark.parametrize(("exponent", "cycles"), [(3.0, 218_511), (2.0, 1_460_729)])
def test_a_crack_of_a_tenth_of_a_millimetre_reaches_one_after(exponent, cycles):
    """N from the integral of da/(C (Y ds sqrt(pi a))^m), Y = 1.12, ds = 200 MPa."""
    assert paris_depth(paris(exponent), 1e-4, 0.999999 * cycles) == pytest.approx(1e-3, rel=1e-4)
    assert paris_depth(paris(exponent), 1e-4, 1.00001 * cycles) == 1e-3


def test_half_of_the_cycles_pass_below_a_quarter_of_the_depth():
    assert paris_depth(paris(3.0), 1e-4, 218_511 / 2) == pytest.approx(0.23089e-3, rel=1e-4)


@pytest.mark.parametrize("exponent", [1.0, 2.0, 3.0])
def test_the_law_does_not_depend_on_how_cycles_are_divided(exponent):
    depth = 1e-4
    for _ in range(100):
        depth = paris_depth(paris(exponent), depth, 1e3)
    assert depth == pytest.approx(paris_depth(paris(exponent), 1e-4, 1e5), rel=1e-12)


def test_small_steps_follow_the_rate_of_the_law():
    law = paris(3.0)
    rate = 1e-11 * (1.12 * 200.0 * math.sqrt(math.pi * 1e-4)) ** 3  # [m] per cycle
    assert paris_depth(law, 1e-4, 1.0) - 1e-4 == pytest.approx(rate, rel=1e-5)
    assert paris_depth(law, 1e-4, 1.0, 2.0) - 1e-4 == pytest.approx(8.0 * rate, rel=1e-4)
    assert paris_depth(law, 0.0, 1e9) == 0.0


def test_a_million_meshes_wear_a_quarter_of_a_micrometre():
    assert archard_depth(ARCHARD, 0.0, 1e6) == pytest.approx(0.24e-6, rel=1e-12)
    assert archard_depth(ARCHARD, 1e-6, 1e6, 2.0) == pytest.approx(1.48e-6, rel=1e-12)
    assert archard_depth(ARCHARD, 0.0, 1e12) == 1e-3


def test_a_table_is_linear_between_its_points():
    table = Table(time=(1.0, 2.0), depth=(1e-6, 3e-6))
    assert [table_severity(table, at) for at in (0.0, 1.5, 9.0)] == pytest.approx(
        [1e-6, 2e-6, 3e-6]
    )
