"""Rating lives against catalogues, printed examples and the equations' own continuity."""

import math

import pytest

from planetary_twin_py.durability.bearing_life import RatedBearing

BALL = RatedBearing(55.3e3, "ball")
HOUR = 60.0  # minutes


def test_the_life_is_that_of_a_catalogue_example():
    """SKF 6309 with 10 kN at 3000 rpm: 169 million turns, 940 hours."""
    assert BALL.life(10e3) / 1e6 == pytest.approx(169.0, abs=0.5)
    assert BALL.life(10e3) / (3000.0 * HOUR) == pytest.approx(940.0, abs=0.6)


def test_planet_bearings_of_a_wind_turbine_have_their_life():
    """Two SKF NNCF 5080 on a pin with 1531.1 kN, 39.859 rpm on the carrier: 299 174 hours."""
    pair = RatedBearing(5500e3, "roller", 2)
    hours = pair.life(1531.1e3) / (39.859 * HOUR)
    assert hours == pytest.approx(299_174.0, rel=1e-4)


def test_a_duty_has_the_life_of_its_mean_load():
    """10, 6 and 14 kN for 50, 30 and 20 % of the time at 3000, 2000 and 1000 rpm: 1293.86 h."""
    turns = [share * speed * HOUR for share, speed in ((0.5, 3e3), (0.3, 2e3), (0.2, 1e3))]
    damage = BALL.damage([10e3, 6e3, 14e3], turns)
    assert 1.0 / damage == pytest.approx(1293.86, abs=0.01)
    mean = 9.8206e3  # (sum U P^3 / sum U)^(1/3)
    assert damage == pytest.approx(sum(turns) / BALL.life(mean), rel=1e-4)


@pytest.mark.parametrize("amplitude", [0.1, 0.2, 0.3])
def test_ripple_of_the_load_costs_what_its_mean_square_says(amplitude):
    roller = RatedBearing(1e5, "roller")
    loads = [1e4 * (1.0 + amplitude * math.cos(math.tau * i / 64)) for i in range(64)]
    p = roller.exponent
    expected = 1.0 + p * (p - 1.0) * amplitude**2 / 4.0
    assert roller.damage(loads, 1e6 / 64) * roller.life(1e4) / 1e6 == pytest.approx(
        expected, rel=2e-3
    )


@pytest.mark.parametrize("elements", ["ball", "roller"])
@pytest.mark.parametrize("ratio", [0.4, 1.0])
def test_the_factor_for_lubrication_has_no_step(elements, ratio):
    bearing = RatedBearing(1e5, elements)
    below = bearing.modification(1e4, ratio, 0.5, 2e3)
    assert bearing.modification(1e4, ratio * (1 + 1e-9), 0.5, 2e3) == pytest.approx(below, rel=5e-4)


def test_the_factor_rises_with_film_and_cleanliness_up_to_50():
    found = [BALL.modification(10e3, ratio, 0.5, 1.34e3) for ratio in (0.1, 0.5, 1.0, 4.0, 9.0)]
    assert found[:4] == sorted(found[:4])
    assert found[4] == found[3]
    assert BALL.modification(10e3, 1.0, 0.0, 1.34e3) == pytest.approx(0.1)
    assert BALL.modification(1e3, 4.0, 1.0, 5e3) == 50.0
    assert BALL.modification(10e3, 2.45, 0.8, 1.34e3) == pytest.approx(5.5, abs=0.05)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: BALL.life(-1.0), "load = -1.0 N: must be at least 0 and finite"),
        (lambda: BALL.damage([1.0], [-1.0]), "turns = "),
        (lambda: BALL.modification(1e4, 0.05, 0.5, 1e3), "ratio = 0.05: must be at least 0.1"),
        (lambda: BALL.modification(1e4, 1.0, 2.0, 1e3), "cleanliness = 2.0: must be within 0 and"),
    ],
)
def test_what_is_out_of_range_is_refused(call, message):
    with pytest.raises(ValueError) as error:
        call()
    assert str(error.value).startswith(message)


def test_no_load_does_no_damage():
    assert BALL.life(0.0) == math.inf
    assert BALL.damage([0.0], [1e9]) == 0.0
