"""Wear of all teeth and single pitch deviations, against statics, tooth numbers and ISO 1328."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.model.pitch import material, pitch_tolerances

PAPER = pt.load_scene("paper")
# Every pair is as stiff, so deflections of a mesh are those of one spring.
EVEN = {"mesh.double_pair_ratio": 1.0}
ZS, ZP, ZR = 30, 20, 70


def mean_dte(faults, **changes):
    """Mean over a turn of the sun, without vibration."""
    scene = PAPER.replace(faults=faults, dynamics="quasi_static", **changes)
    return pt.simulate(scene, 0.06, 500.0, tolerance=1e-7).mesh["dte_mean"]


@pytest.mark.parametrize(("mesh", "place"), [("sun", 0), ("ring", 3)])
def test_wear_of_all_planet_teeth_turns_the_gears_by_its_depth(mesh, place):
    """All planets are equally worn: loads are shared as before, and only backlash changes."""
    wear = {"kind": "wear", "gear": "planet", "tooth": "all", "planet": "all", "mesh": mesh}
    change = mean_dte([wear | {"depth": 3e-6}]) - mean_dte([])
    expected = np.zeros(6)
    expected[place : place + 3] = 3e-6
    assert change == pytest.approx(expected, abs=3e-9)


def test_wear_of_all_teeth_does_not_tell_planets_or_teeth_apart():
    """The period is that of the healthy mesh, and planets in phase stay one."""
    scene = pt.load_scene("wind_turbine_stage").replace(
        faults=[{"kind": "wear", "gear": gear, "tooth": "all", "planet": "all", "depth": 1e-5}
                for gear in ("sun", "planet", "ring")],
    )  # fmt: skip
    run = pt.simulate(scene, 0.5, 500.0, settling=5.0, tolerance=1e-5)
    force = np.abs(run.mesh["mesh_force_mean"][:3])
    assert np.ptp(force) < 1e-9 * force[0]


@pytest.mark.parametrize(
    ("gear", "mesh", "teeth", "planet"),
    [("sun", 0, ZS, 1), ("ring", 4, ZR, 1), ("planet", 1, ZP, 2)],
)
def test_pitch_deviations_have_lines_at_every_turn_of_their_gear(gear, mesh, teeth, planet):
    """Lines at n f_m/Z only, and everywhere below the mesh frequency."""
    fault = {"kind": "pitch", "gear": gear, "planet": planet, "grade": 5, "seed": 2}
    scene = PAPER.replace(faults=[fault], **EVEN)
    frequency = ZS * PAPER.operating_point.input_speed / (2 * math.pi)
    turns, rate = 4, 16 * frequency
    run = pt.simulate(scene, (turns * teeth + 1) / frequency, rate, settling=0.4, tolerance=1e-5)
    dte = run.dte[-16 * turns * teeth :, mesh]
    spectrum = np.abs(np.fft.rfft(dte - dte.mean())) / len(dte)
    bins = np.arange(1, turns * teeth)  # below the mesh frequency
    lines, between = bins[bins % turns == 0], bins[bins % turns != 0]
    assert len(lines) == teeth - 1
    assert np.sum(spectrum[lines] ** 2) > 3e2 * np.sum(spectrum[between] ** 2)


@pytest.mark.parametrize("flank", ["drive", "coast"])
def test_a_slow_mesh_follows_the_teeth_that_carry_the_load(flank):
    """Stiff teeth under a small load: the one pair in contact tells the deviation of its tooth.

    The three planets of a tooth that stands back share its gap w: its mesh yields by w less w/3 of
    it, as the others bear its load, until it carries nothing.
    """
    deviations = np.zeros(ZS)
    deviations[7], deviations[8] = -0.2e-6, 0.2e-6  # tooth 7 stands back
    fault = {"kind": "pitch", "gear": "sun", "flank": flank, "deviations": deviations.tolist()}
    wear = {"kind": "wear", "gear": "sun", "tooth": 7, "flank": flank, "depth": 0.2e-6}
    torque = 6.3 if flank == "drive" else -6.3
    slow = PAPER.replace(
        input_speed=2 * math.pi * 2.0 / ZS, input_torque=torque, lambda_ratio=3.0, **EVEN
    )
    runs = [
        pt.simulate(slow.replace(faults=[each]), 6.0, 200.0, settling=0.5, tolerance=1e-6).dte
        for each in (fault, wear)
    ]
    healthy = pt.simulate(slow, 6.0, 200.0, settling=0.5, tolerance=1e-6).dte
    assert np.abs(runs[0] - runs[1]).max() < 1e-3 * np.abs(runs[1] - healthy).max()


def test_drawn_deviations_are_as_large_as_their_class_allows():
    """f_pT and F_pT of ISO 1328-1:2013: d = 100 mm, m = 2 mm, class 5: 5.9 and 19.1 um."""
    single, total = pitch_tolerances(5, 2e-3, 0.1)
    assert (single, total) == pytest.approx((5.9e-6, 19.1e-6), rel=1e-3)
    assert pitch_tolerances(7, 2e-3, 0.1)[0] == pytest.approx(2 * single)
    scene = PAPER.replace(faults=[{"kind": "pitch", "gear": "ring", "grade": 5, "seed": 4}])
    standing = material(scene, scene.faults[0])
    pitches = np.abs(np.diff(standing, append=standing[0])).max()
    module = scene.gearset.transverse.module
    allowed = pitch_tolerances(5, module, module * ZR)
    reached = pitches / allowed[0], float(np.ptp(standing)) / allowed[1]
    assert max(reached) == pytest.approx(1.0) and len(standing) == ZR
    assert standing.mean() == pytest.approx(0.0, abs=1e-15)
    other = material(scene, scene.faults[0].model_copy(update={"seed": 5, "scale": 2.0}))
    assert not np.allclose(other, 2.0 * standing)


def test_sixty_cracks_soften_all_teeth_of_a_gear():
    """Two cracks in each of 30 teeth leave sqrt(0.8) of the stiffness each."""
    cracks = [
        {"kind": "crack", "gear": "sun", "tooth": n % ZS, "stiffness_loss": 1.0 - math.sqrt(0.8)}
        for n in range(2 * ZS)
    ]
    soft = mean_dte([], **{"mesh.sun_planet_stiffness": 0.8 * PAPER.mesh.sun_planet_stiffness})
    assert mean_dte(cracks) == pytest.approx(soft, rel=1e-6)
    assert mean_dte([])[0] < 0.9 * soft[0]


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ({"kind": "pitch", "gear": "sun"}, "deviations, grade: pitch deviations need exactly one"),
        ({"kind": "pitch", "gear": "sun", "deviations": [1e-6, 0]}, "has 2 entries: must have 30"),
        ({"kind": "pitch", "gear": "sun", "deviations": [1.0]}, "each must be within -0.001 and"),
        ({"kind": "pin", "planet": 5}, "faults.0.planet = 5: must be at most 3"),
        (
            {"kind": "wear", "gear": "sun", "tooth": "some", "depth": 0},
            "faults.0.tooth = 'some': must be a whole number within 0 and 2999, or all",
        ),
        ({"kind": "crack", "gear": "sun", "depth": 0}, "requires mesh.stiffness = involute"),
        (
            {"kind": "wear", "gear": "sun", "depth": 0, "growth": {"time": [0, 1]}},
            "depth, stiffness_loss: a table needs exactly one of them",
        ),
        (
            {"kind": "wear", "gear": "sun", "depth": 0,
             "growth": {"time": [1, 0], "depth": [0, 1e-6]}},
            "time or meshes: must be at least 0, in increasing order",
        ),
        (
            {"kind": "wear", "gear": "sun", "depth": 0,
             "growth": {"time": [0, 1], "depth": [1e-6, 2e-6]}},
            "growth.depth: must begin with depth = 0",
        ),
    ],
)  # fmt: skip
def test_what_is_no_fault_is_refused_in_one_line(fault, message):
    with pytest.raises(pt.SceneError) as refusal:
        PAPER.replace(faults=[fault])
    assert message in str(refusal.value) and "\n" not in str(refusal.value)


def test_growth_is_refused_where_nothing_is_integrated_over_time():
    wear = {"kind": "wear", "gear": "sun", "depth": 0.0,
            "growth": {"time": [0, 1], "depth": [0, 1e-6]}}  # fmt: skip
    with pytest.raises(pt.SceneError, match=r"^faults\.0\.growth: requires dynamics other than"):
        PAPER.replace(faults=[wear], dynamics="quasi_static")
