"""Orders of faults against exact fractions, and the rule of lines against simulated mesh forces."""

from fractions import Fraction

import numpy as np
import pytest
from analysis.gear_sets import PAPER, gear_set

import planetary_twin_py as pt

UNEQUAL = ["90 deg", "-28.8 deg", "208.8 deg"]
# Teeth, planets, held: mesh; tooth of sun, planet, ring in one mesh; turns of sun and planet.
TABLE = {
    ((30, 20, 70), "carrier", 3): "30 1 3/2 3/7 1 3/2",
    ((30, 20, 70), "ring", 3): "70 7/3 7/2 1 10/3 5/2",
    ((21, 31, 84), "ring", 3): "84 4 84/31 1 5 53/31",
    ((28, 36, 100), "ring", 4): "100 25/7 25/9 1 32/7 16/9",
    ((21, 39, 99), "ring", 3): "99 33/7 33/13 1 40/7 20/13",
    ((31, 31, 95), "ring", 3): "95 95/31 95/31 1 126/31 64/31",
    ((20, 40, 100), "ring", 3): "100 5 5/2 1 6 3/2",
    ((17, 37, 91), "ring", 3): "91 91/17 91/37 1 108/17 54/37",
    ((25, 65, 155), "ring", 3): "155 31/5 31/13 1 36/5 18/13",
}


def scene_of(teeth, held="ring", planets=3):
    return gear_set(teeth, planets, held, UNEQUAL if teeth == (30, 20, 70) else None)


def orders(*case):
    return pt.fault_orders(scene_of(*case))


@pytest.mark.parametrize("case", TABLE, ids=str)
def test_orders_are_the_exact_fractions_of_willis(case):
    found = orders(*case)
    expected = [Fraction(each) for each in TABLE[case].split()]
    names = ("mesh", "sun_tooth", "planet_tooth", "ring_tooth", "sun_turns", "planet_turns")
    assert [found.rates[name] for name in names] == expected
    planets = case[2]
    assert found.rates["sun_tooth_all_meshes"] == planets * expected[1]
    assert found.rates["planet_tooth_both_meshes"] == 2 * expected[2]
    assert found.rates["ring_tooth_all_meshes"] == planets * expected[3]


def test_a_held_sun_has_no_orders_of_its_own_and_the_ring_has():
    """Zs teeth pass a mesh per turn of the carrier, which turns Zs/Zr relative to the ring."""
    found = pt.fault_orders(gear_set((21, 39, 99), held="sun"))
    assert (found.reference, found.rates["mesh"]) == ("carrier", 21)
    assert found.rates["ring_tooth"] == Fraction(21, 99)
    assert found.rates["ring_turns"] == 1 + Fraction(21, 99)
    sun, _, ring = found.lines
    assert all(order % 3 == 0 for order in sun.present)
    assert not all(order % 3 == 0 for order in ring.present)


def test_frequencies_are_those_of_the_operating_point():
    """The sun turns 40/7 times per turn of the carrier."""
    found = pt.fault_orders(gear_set((21, 39, 99), input_speed=pt.rpm(600.0)))
    assert found.frequency == pytest.approx(10.0 * 7.0 / 40.0)


def test_lines_of_21_39_99_are_those_of_the_rule():
    sun, planet, ring = orders((21, 39, 99)).lines
    assert {Fraction(733, 7), Fraction(712, 7), Fraction(752, 7)} <= set(sun.present)
    assert Fraction(726, 7) in sun.absent  # f_m + f_s - f_c
    middle = 28 * Fraction(33, 13)
    around = 40 * Fraction(33, 13)
    assert around in planet.weak and {around - 1, around + 1} <= set(planet.present)
    assert middle not in planet.present
    assert all(order % 3 == 0 for order in ring.present)
    assert all(order % 3 for order in ring.absent)


def test_feng_and_zuo_have_the_lines_with_one_turn_of_the_window():
    """f_m -+ n N f_m/Zs -+ f_s (2012), with N f_m/Zs = 99/7 and f_s = 40/7, obey q f_s - 3 k."""
    places = [99 + a * Fraction(99, 7) + b * Fraction(40, 7) for a in (-1, 1) for b in (-1, 1)]
    for place in places:
        assert any((q * Fraction(40, 7) - place) % 3 == 0 for q in range(60))


def test_unequal_planets_leave_no_order_without_lines():
    found = orders((30, 20, 70), "ring")
    assert found.symmetry == found.alike == 1
    sun, planet, _ = found.lines
    assert not any(line.absent for line in found.lines)
    # With m = 0, a window weighs the sum of all forces, which is given.
    assert {q * Fraction(7, 3) for q in (28, 29, 31, 32)} & set(sun.present) == set()
    assert planet.weak == tuple(n * Fraction(7, 2) for n in (18, 19, 21, 22))


def test_pairs_of_planets_have_a_symmetry_of_half_a_turn():
    """30/20/70 has 100 places; 0, 20, 50 and 70 come back after a half turn only."""
    angles = ["0 deg", "72 deg", "180 deg", "252 deg"]
    found = pt.fault_orders(gear_set((30, 20, 70), 4, angles=angles))
    assert (found.planets, found.symmetry) == (4, 2)
    _, planet, ring = found.lines
    assert planet.weak == tuple(n * Fraction(7, 2) for n in (18, 19, 21, 22))
    assert all(order % 2 == 0 for order in ring.present)


def test_coincidences_are_named():
    def pairs(*case):
        return {(each.first, each.second) for each in orders(*case).coincidences if not each.apart}

    assert ("sun tooth", "planet tooth") in pairs((31, 31, 95))
    assert ("sun tooth", "2 x planet tooth") in pairs((20, 40, 100))
    assert ("3 x sun tooth", "2 x planet tooth") in pairs((30, 20, 70), "ring")
    assert ("3 x sun tooth", "2 x planet tooth") in pairs((30, 20, 70), "carrier")
    assert ("sun tooth", "4 x carrier") in pairs((21, 31, 84))
    assert not pairs((21, 39, 99)) and not pairs((17, 37, 91))


def test_the_turns_that_separate_close_orders_are_stated():
    """31/31/95: 95/31 and 3 are 2/31 apart, and four bins need 62 turns."""
    (near,) = (
        each for each in orders((31, 31, 95)).coincidences
        if (each.first, each.second) == ("sun tooth", "3 x carrier")
    )  # fmt: skip
    assert (near.apart, near.turns) == (Fraction(2, 31), pytest.approx(62.0))


def test_a_sun_of_20_teeth_hides_behind_its_planets():
    """Lines of the sun are at multiples of gcd(6, 3) = 3, as those of the ring and the planets."""
    shared = {(each.first, each.second): each for each in orders((20, 40, 100)).shared}
    assert not shared["sun", "planet"].first_only and not shared["sun", "ring"].first_only
    assert shared["sun", "planet"].second_only
    assert not orders((21, 39, 99)).shared


@pytest.mark.parametrize(
    ("teeth", "planets", "seen"),
    [
        ((17, 37, 91), 3, "17 1 17 37 1 37"),
        ((31, 31, 95), 3, "31 1 31 31 1 31"),
        ((21, 31, 84), 3, "1 21 1 31 1 31"),
        ((28, 36, 100), 4, "7 4 7 9 4 9"),
        ((21, 39, 99), 3, "7 3 7 13 3 13"),
        ((25, 65, 155), 3, "5 5 5 13 5 13"),
        ((30, 20, 70), 3, "3 10 3 2 10 2"),
        ((20, 40, 100), 3, "1 20 1 2 20 2"),
    ],
)
def test_teeth_seen_are_counted_as_planets_pass_one_by_one(teeth, planets, seen):
    found = orders(teeth, "ring", planets)
    assert [*found.seen["sun"], *found.seen["planet"]] == [int(each) for each in seen.split()]
    for count, gear in zip(teeth, ("sun", "planet"), strict=False):
        met = {n * teeth[2] % count for n in range(count)}
        assert len(met) == found.seen[gear].number


@pytest.mark.parametrize(
    ("case", "expected"),
    [
        (((21, 39, 99), "ring"), (14.215385, 21.323077, 6.092308, 1.523077)),
        (((28, 36, 100), "ring", 4), (15.555556, 23.333333, 6.666667, None)),
        (((21, 31, 84), "ring"), (15.174194, 22.761290, 6.503226, None)),
        (((30, 20, 70), "ring"), (19.6, 29.4, 8.4, None)),
        (((30, 20, 70), "carrier"), (8.4, 12.6, 3.6, None)),
    ],
)
def test_orders_of_a_planet_bearing_are_known(case, expected):
    found = pt.fault_orders(scene_of(*case), rollers=14, ratio="0.2")
    rates = [float(line.rate) for line in found.lines[3:]]
    for rate, known in zip(rates, expected, strict=True):
        assert known is None or rate == pytest.approx(known, abs=1e-6)


def test_only_the_outer_race_has_sidebands_of_the_planet_on_its_pin():
    """The outer race turns through the load zone, the inner race stays in it."""
    *_, outer, inner, _, _ = pt.fault_orders(scene_of((21, 39, 99)), 14, Fraction(1, 5)).lines
    assert [float(order) for order in outer.present] == pytest.approx(
        [10.6769, 11.6769, 12.6769, 13.2154, 14.2154, 15.2154, 15.7538, 16.7538, 17.7538], abs=1e-4
    )
    assert [float(order) for order in inner.present] == pytest.approx(
        [20.3231, 21.3231, 22.3231], abs=1e-4
    )
    assert [float(order) for order in inner.absent] == pytest.approx([18.7846, 23.8615], abs=1e-4)


def test_a_differential_has_the_orders_of_its_two_speeds():
    """30/20/70 with the carrier at -1/2 of the sun: Willis, relative to the carrier."""
    scene = pt.load_scene("differential")
    found = pt.fault_orders(scene)
    assert (found.reference, found.rates["mesh"]) == ("carrier", 30 * 3)
    assert found.rates["sun_turns"] == 2
    assert found.rates["planet_turns"] == Fraction(90, 20) + 1  # against the sun
    assert found.rates["ring_turns"] == Fraction(90, 70) + 1
    assert found.frequency == pytest.approx(500.0 / 60.0)
    assert not found.seen and found.widest_window == 0.0
    held = pt.fault_orders(scene.replace(second_input_speed=0.0))
    assert held.rates == pt.fault_orders(scene_of((30, 20, 70), "carrier")).rates
    with pytest.raises(ValueError, match="sun and carrier turn together, and no tooth meshes"):
        pt.fault_orders(scene.replace(second_input_speed=pt.rpm(1000.0)))


def test_an_invalid_bearing_is_refused():
    for rollers, ratio, message in (
        (2, "0.2", "rollers = 2: must be at least 3"),
        (14, "1.2", "ratio = 1.2: must be above 0 and below 1"),
        (14, "thin", "must be a number such as 0.2"),
        (14, None, "a bearing needs both"),
    ):
        with pytest.raises(ValueError, match=message):
            pt.fault_orders(PAPER, rollers, ratio)


PER_TURN = 8190  # aliases of multiples of 2 or 3 are such multiples, too
SPEED = 200.0  # [rpm] of the sun, so slow that inertia hardly counts


@pytest.fixture(scope="module")
def measured():
    """Amplitudes by order in simulated ring forces, weighed by a window cos^8."""

    def spectrum(gear, turns, *gears):
        crack = {"kind": "crack", "gear": gear, "tooth": 0, "stiffness_loss": 0.1}
        scene = gear_set(
            *(gears or [(21, 39, 99)]),
            faults=[crack],
            input_speed=pt.rpm(SPEED),
            **{"mesh.damping": {"law": "viscous", "damping_ratio": 0.05}},
        )
        carrier = pt.fault_orders(scene).frequency
        rate = PER_TURN * carrier
        run = pt.simulate(
            scene, duration=(turns + 0.01) / carrier, settling=1.0 / carrier, sample_rate=rate
        )
        angles = scene.gearset.planet_angles
        ring = [run.meshes.index(f"planet_ring_{planet}") for planet in range(1, len(angles) + 1)]
        count = turns * PER_TURN
        angle = run.angle[:count, run.bodies.index("carrier")]
        measured = sum(
            np.cos(0.5 * (angle + place)) ** 8 * run.mesh_force[:count, mesh]
            for place, mesh in zip(angles, ring, strict=True)
        )
        amplitude = 2.0 * np.abs(np.fft.rfft(measured)) / count
        return lambda order: float(amplitude[int(turns * Fraction(order))])

    return spectrum


@pytest.mark.slow
def test_simulated_forces_of_a_cracked_sun_obey_the_rule(measured):
    """q f_s - 3 k with |W_(3k - q)|: at q = 22, W_1 : W_2 : W_4 = 56 : 28 : 1 for cos^8."""
    at = measured("sun", 7)  # turns after which the same tooth is at the same place
    first = at(Fraction(733, 7))  # 104.7143
    assert at(Fraction(712, 7)) / first == pytest.approx(28 / 56, rel=0.01)  # 101.7143
    assert at(Fraction(754, 7)) / first == pytest.approx(1 / 56, rel=0.05)  # 107.7143
    assert at(Fraction(752, 7)) / at(Fraction(773, 7)) == pytest.approx(2.0, rel=0.01)  # q = 23
    sun = pt.fault_orders(gear_set((21, 39, 99))).lines[0]
    lowest = min(map(at, sun.present))
    assert max(map(at, sun.absent)) < 0.03 * lowest
    assert at(Fraction(726, 7)) < 0.003 * first  # 103.7143


@pytest.mark.slow
def test_unequally_spaced_planets_share_the_sum_of_their_forces(measured):
    """Two pairs of 36/24/84: with m = 0 the window weighs the sum, which the torque gives."""
    gears = (36, 24, 84), 4, "ring", ["0 deg", "60 deg", "180 deg", "240 deg"]
    at = measured("sun", 3, *gears)
    sun = pt.fault_orders(gear_set(*gears)).lines[0]
    assert sun.weak and sun.absent
    lowest = min(map(at, sun.present))
    assert max(map(at, sun.weak)) < 0.1 * lowest
    assert max(map(at, sun.absent)) < 0.01 * lowest


@pytest.mark.exhaustive
def test_simulated_planets_share_what_a_cracked_one_loses(measured):
    """Around n = 28, order 71.0769, lines +-1 and +-2 are as W_1 : W_2 = 2, others vanish."""
    at = measured("planet", 13)
    middle = 28 * Fraction(33, 13)
    assert at(middle + 1) / at(middle + 2) == pytest.approx(2.0, rel=0.01)
    assert at(middle - 1) / at(middle - 2) == pytest.approx(2.0, rel=0.01)
    assert max(at(middle), at(middle + 3), at(middle - 3)) < 0.03 * at(middle + 1)
    planet = pt.fault_orders(gear_set((21, 39, 99))).lines[1]
    assert max(map(at, planet.weak)) < 0.1 * max(map(at, planet.present))


@pytest.mark.exhaustive
def test_a_simulated_crack_of_the_ring_has_no_order_of_its_own(measured):
    at = measured("ring", 2)
    lines = {half: at(Fraction(half, 2)) for half in range(1, 600)}
    others = [value for half, value in lines.items() if half % 6]
    own = [value for half, value in lines.items() if not half % 6 and 40 < abs(half - 198) < 100]
    assert max(others) < 0.1 * min(own)
