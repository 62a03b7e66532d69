"""Wear of all flanks against involute geometry, closed forms, and other ways to the same gap."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.studies.wear.course import Course

PAPER = pt.load_scene("paper").replace(**{"durability.wear": {"coefficient": 1e-18}})
# Planets in phase have constant forces.
TWO = PAPER.replace(**{"gearset.planet_angles": (0.0, math.pi)})
HOUR = 3600.0
FORCE = 63.0 / (2.0 * 0.5 * 30 * 0.8e-3 * math.cos(math.radians(21.34)))  # of a mesh [N]
WIDTH, FREQUENCY = 20e-3, 1000.0 / 60.0 * 30  # [m], [Hz]


def sliding_ratios(teeth, internal, position):
    """|1 - V2/V1| and |1 - V1/V2| from the velocities of both gears at the point of contact.

    The centre of the first gear is at 0, the pitch point below it, and the contact moves to the
    right and away from the first gear; the gears turn at speeds in the ratio of their teeth.
    """
    angle, module = math.radians(21.34), 0.8e-3
    normal = np.array([math.cos(angle), -math.sin(angle)])
    pitch = np.array([0.0, -0.5 * module * teeth[0]])
    point = pitch + math.pi * module * math.cos(angle) * position[:, None] * normal
    centre = np.array([0.0, pitch[1] + (1.0 if internal else -1.0) * 0.5 * module * teeth[1]])
    tangent = np.array([-normal[1], normal[0]])
    turns = 1.0, (teeth[0] / teeth[1]) * (1.0 if internal else -1.0)

    def along(arm, turn):
        velocity = turn * np.stack([-arm[:, 1], arm[:, 0]], axis=1)
        assert np.ptp(velocity @ normal) < 1e-12  # both move along the line of action
        return velocity @ tangent

    first, second = along(point, turns[0]), along(point - centre, turns[1])
    return np.abs(1.0 - second / first), np.abs(1.0 - first / second)


def load_share(path, ramp, position):
    """Share of a pair whose weight rises and falls over the ramp."""

    def weight(s):
        ends = np.minimum(s + path.approach, path.recess - s)
        return np.clip(ends / ramp, 0.0, 1.0)

    return weight(position) / sum(weight(position + n) for n in range(-2, 3))


@pytest.mark.parametrize("kind", [0, 1])
def test_depth_of_a_passage_is_that_of_involute_geometry(kind):
    found = pt.wear(TWO, HOUR)
    first, second = found.flanks[2 * kind : 2 * kind + 2]
    teeth, meshes = ((20, 70), (1, 2)) if kind else ((30, 20), (2, 1))
    path = TWO.gearset.geometry.meshes[kind].path
    line = FORCE / WIDTH * load_share(path, 0.03, first.position)
    for flank, z, n, slip in zip(
        (first, second), teeth, meshes, sliding_ratios(teeth, bool(kind), first.position),
        strict=True,
    ):  # fmt: skip
        each = flank.first_rate / (FREQUENCY * n / z)
        expected = 1e-18 * line * slip
        assert each == pytest.approx(expected, rel=1e-9, abs=1e-9 * expected.max())


def test_depth_of_a_passage_depends_on_the_speed_by_the_film_alone():
    rates = {}
    for film in ("constant", "priest_taylor"):
        for speed in (50.0, 100.0):
            scene = PAPER.replace(
                **{"durability.wear.film": film, "input_speed": speed,
                   "lubrication.lambda_ratio": "computed"}
            )  # fmt: skip
            rates[film, speed] = pt.wear(scene, 1.0).flanks[0].first_rate / speed
    slow, fast = (rates["constant", speed] for speed in (50.0, 100.0))
    assert fast == pytest.approx(slow, rel=1e-9)
    slow, fast = (rates["priest_taylor", speed].max() for speed in (50.0, 100.0))
    assert 0.0 < fast < 0.99 * slow


LEVELLING = TWO.replace(**{"mesh.ramp": 0.0, "mesh.double_pair_ratio": 2.0})
STIFFNESS = 2e8  # of a pair [N/m]


def growths(position):
    """Growth of the gap of a pair of the sun mesh per load and time [m/(N s)]."""
    first, second = sliding_ratios((30, 20), False, position)
    return 1e-18 / WIDTH * FREQUENCY * (first * 2 / 30 + second / 20)


def test_two_pairs_level_as_the_closed_form():
    """F1 = F (a + (1/2 - a) exp(-k/2 (c1 + c2) t)), a = c2/(c1 + c2), of two equal springs."""
    sun = pt.wear(LEVELLING, 400.0 * HOUR).flanks[0]
    inner = np.arange(5, 20)  # both pairs of them are inside the zone of two pairs
    position = sun.position[inner]
    slip = sliding_ratios((30, 20), False, sun.position)[0]
    rate = 1e-18 / WIDTH * FREQUENCY * 2 / 30 * slip
    load = sun.rate[inner] / rate[inner]
    one, two = growths(position), growths(position + 1.0)
    final, decay = two / (one + two), np.exp(-0.5 * STIFFNESS * (one + two) * 400.0 * HOUR)
    assert decay.max() < 0.6
    assert load / FORCE == pytest.approx(final + (0.5 - final) * decay, rel=2e-4)


def test_a_step_that_does_not_let_loads_level_is_refused():
    course = Course(LEVELLING, False)
    position = course.flanks[0].position[5:20]
    levelling = 0.5 * STIFFNESS * (growths(position) + growths(position + 1.0))  # [1/s]
    longest = course.longest / 1e-18
    assert 0.02 * 2.0 / levelling.max() < longest <= 0.1 * 2.0 / levelling.max()
    coarse = pt.wear(LEVELLING, 19.9 * longest, step=longest)
    assert coarse.steps == 20
    fine = pt.wear(LEVELLING, 19.9 * longest)
    assert coarse.flanks[0].depth == pytest.approx(fine.flanks[0].depth, rel=0.02, abs=1e-9)
    with pytest.raises(ValueError, match=r"step = .* s: must be above 0 and at most"):
        pt.wear(LEVELLING, 19.9 * longest, step=1.01 * longest)


def test_mass_grows_linearly_with_time():
    """As measured on the sun of a planetary set (Zhao et al. 2018): R^2 = 0.990."""
    scene, mass = PAPER, [0.0]
    for _ in range(4):
        found = pt.wear(scene, 100.0 * HOUR)
        scene, mass = found.scene, [*mass, mass[-1] + found.flanks[0].mass]
    assert np.corrcoef(np.arange(5.0), mass)[0, 1] ** 2 > 0.999


def test_both_flanks_lose_the_same_volume():
    """k F times the sliding way, which both have in common (Archard 1953)."""
    sun, with_sun, with_ring, ring = pt.wear(PAPER, 50.0 * HOUR).flanks
    assert sun.mass == pytest.approx(with_sun.mass, rel=1e-12)
    assert with_ring.mass == pytest.approx(ring.mass, rel=1e-12)


def test_wear_goes_on_from_a_worn_scene():
    half = pt.wear(PAPER, 50.0 * HOUR)
    rest = pt.wear(half.scene, 50.0 * HOUR)
    whole = pt.wear(PAPER, 100.0 * HOUR)
    for first, second, both in zip(half.flanks, rest.flanks, whole.flanks, strict=True):
        assert first.depth + second.depth == pytest.approx(both.depth, rel=2e-3, abs=1e-10)


def test_no_coefficient_no_wear():
    found = pt.wear(PAPER.replace(**{"durability.wear.coefficient": 0.0}), 1000.0 * HOUR)
    assert not any(flank.depth.any() or flank.rate.any() for flank in found.flanks)
    assert found.backlash_change == 0.0


def test_the_coefficient_is_fitted_to_a_measured_backlash():
    fitted = pt.wear(PAPER, 60.0 * HOUR, backlash_change=6e-7)
    assert fitted.backlash_change == pytest.approx(6e-7, rel=1e-3)
    scene = PAPER.replace(**{"durability.wear.coefficient": fitted.coefficient})
    assert pt.wear(scene, 60.0 * HOUR).backlash_change == pytest.approx(6e-7, rel=1e-3)


@pytest.mark.parametrize("dynamics", ["quasi_static", "torsional"])
def test_a_run_has_the_error_of_its_worn_profile(dynamics):
    worn = pt.wear(TWO, 100.0 * HOUR)
    slow = worn.scene.replace(
        dynamics=dynamics, input_speed=2.0 * math.pi / 3.0, **{"lubrication.friction": False}
    )
    run = pt.simulate(slow, 0.5, 10_000.0, settling=0.2)  # five mesh cycles
    assert abs(run.energy.residual) < 1e-6 * run.energy.driving_work
    for mesh, pairs in ((0, worn.meshes[0]), (2, worn.meshes[1])):
        assert np.ptp(run.dte[:, mesh]) == pytest.approx(pairs.error[1], rel=0.015)
        mean = pairs.deflection + pairs.mean_error + 0.5 * 0.2e-6
        assert run.dte[:, mesh].mean() == pytest.approx(mean, rel=0.003)


def test_vibration_changes_the_rates():
    """Slow gears without friction are in equilibrium; fast ones are not."""
    still = {}
    for speed in (2.0, 300.0):
        scene = PAPER.replace(input_speed=speed, **{"lubrication.friction": False})
        with_, without = (pt.wear(scene, 1.0, vibration=v).flanks[0].first_rate for v in (1, 0))
        still[speed] = np.abs(with_ - without).max() / without.max()
    assert still[2.0] < 0.03
    assert still[300.0] > 0.05


def test_a_stiffer_planet_wears_more_until_it_carries_less():
    scene = PAPER.replace(**{"errors.planet_stiffness": (0.8, 1.0, 1.2)})
    found = pt.wear(scene, 300.0 * HOUR)
    worn = found.scene.mesh.worn.sun_planet.planets
    assert worn[0] < worn[1] < worn[2]
    before = pt.wear(scene, 1.0).meshes[0].shares
    assert before == pytest.approx([0.8, 1.0, 1.2], abs=0.01)
    after = found.meshes[0].shares
    assert after[0] > 0.81 and after[2] < 1.19


@pytest.mark.parametrize(
    "changes, message",
    [
        ({"durability": None}, r"durability\.wear: missing"),
        ({"input_torque": 0.0}, r"input_torque = 0\.0: must be other than 0"),
        ({"mesh.double_pair_ratio": 1.0}, r"mesh\.double_pair_ratio = 1\.0: must be above 1"),
    ],
)
def test_what_does_not_wear_is_refused(changes, message):
    with pytest.raises(ValueError, match=message):
        pt.wear(PAPER.replace(**changes), HOUR)
