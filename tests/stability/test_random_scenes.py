"""What holds for any scene that can be: finite, dissipative, closed in energy, flanks that push."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from stability.sound import PAPER, turnover

import planetary_twin_py as pt
from planetary_twin_py.gearset.clearance import Size, least_places, most_planets
from planetary_twin_py.gearset.kinematics import Teeth

MEMBERS = ("sun", "ring", "carrier")
QUICK = settings(
    phases=[Phase.explicit, Phase.generate],  # making a failing scene smaller takes minutes
    max_examples=10,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)


def logarithmic(low, high):
    return st.floats(math.log10(low), math.log10(high)).map(lambda x: 10.0**x)


@st.composite
def gears(draw):
    """Tooth numbers, and planets at any places that can be assembled and leave room for all."""
    sun, planet = draw(st.integers(18, 60)), draw(st.integers(18, 45))
    ring = sun + 2 * planet
    size = Size(Teeth(sun, planet, ring), PAPER.gearset.module, PAPER.gearset.addendum)
    count, least = draw(st.integers(2, min(7, most_planets(size)))), least_places(size)
    spare = st.integers(0, sun + ring - count * least)
    shifts = sorted(draw(st.lists(spare, min_size=count, max_size=count)))
    places = [shift + n * least for n, shift in enumerate(shifts)]
    angles = tuple(2 * math.pi * n / (sun + ring) for n in places)
    return {
        "gearset.teeth": {"sun": sun, "planet": planet, "ring": ring},
        "gearset.planet_angles": angles,
    }


@st.composite
def flows(draw):
    """A member held and two machines, or none held and three."""
    held, first, last = draw(st.permutations(MEMBERS))
    load = PAPER.drive.output.model_dump()
    changes = {"drive.input.member": first, "drive.output.member": last}
    if draw(st.booleans()):
        changes |= {"gearset.held": held}
    else:
        changes |= {
            "gearset.held": "none",
            "drive.second_input": load | {"member": held},
            "second_input_speed": draw(st.floats(-150.0, 150.0)),
        }
    return changes


LAWS = st.fixed_dictionaries(
    {
        "mesh.sun_planet_stiffness": logarithmic(1e7, 1e9),
        "mesh.planet_ring_stiffness": logarithmic(1e7, 1e9),
        "mesh.double_pair_ratio": st.floats(1.0, 2.0),
        "mesh.ramp": st.sampled_from([0.0, 0.03, 0.1]),
        "mesh.damping.law": st.sampled_from(
            ["viscous", "meshing_frequency", "printed_meshing_frequency", "natural_frequency"]
        ),
        "lubrication.film": st.sampled_from(["dowson_higginson", "dowson_toyoda", "salagianni"]),
        "lubrication.lambda_ratio": st.sampled_from(["prescribed", "computed"]),
        "lubrication.boundary": st.sampled_from(["greenwood_tripp", "load_sharing"]),
        "lubrication.rolling": st.sampled_from(["none", "goksem_hargreaves"]),
        "backlash": st.sampled_from([0.0, 2e-7, 1e-6, 1e-5]),
        "lambda_ratio": st.floats(0.0, 10.0),
        "oil_temperature": st.floats(253.0, 413.0),
        "input_speed": st.floats(-300.0, 300.0),
        "input_torque": st.sampled_from([1.0, -1.0]).flatmap(
            lambda sign: logarithmic(0.3, 300.0).map(lambda torque: sign * torque)
        ),
        "torque_ripple": st.sampled_from([0.0, 0.0, 5.0]),
    }
)
ERRORS = st.fixed_dictionaries(
    {
        "mesh.sun_planet_error": st.sampled_from([{}, {"amplitudes": ["2 um", "0.5 um"]}]),
        "mesh.runout": st.sampled_from([{}, {"sun": "5 um", "planet": "3 um"}]),
        "faults": st.sampled_from(
            [
                [],
                [{"kind": "crack", "gear": "sun", "tooth": 0, "stiffness_loss": 0.4}],
                [{"kind": "wear", "gear": "planet", "planet": 2, "depth": "2 um"}],
                [{"kind": "spall", "gear": "ring", "tooth": 1, "stiffness_loss": 0.5}],
            ]
        ),
    }
)


def with_play_for_runout(parts):
    """One scene of its parts; runout that closes the backlash is refused."""
    changes = parts[0] | parts[1] | parts[2] | parts[3]
    if changes["mesh.runout"]:
        changes["backlash"] += 6e-6  # 2 sin(phi) (5 + 3) um is 5.8 um
    return changes


SCENES = st.tuples(gears(), flows(), LAWS, ERRORS).map(with_play_for_runout)


def build(changes):
    """The scene, or None where its contact ratio leaves a moment without a full pair."""
    try:
        scene = PAPER.replace(**changes)
        pt.Twin(scene)
    except ValueError as refusal:
        assert "\n" not in str(refusal)
        return None
    return scene


def check(changes):
    scene = build(changes)
    if scene is None:
        return
    run = pt.simulate(scene, 0.004, 20_000.0, tolerance=1e-6)
    for values in (run.dte, run.mesh_force, run.speed, run.angle, run.power_loss):
        assert np.isfinite(values).all()
    assert run.energy.friction >= -1e-9 * turnover(run.energy)
    assert run.energy.damping >= -1e-9 * turnover(run.energy)
    assert (run.power_loss >= 0.0).all()
    # The tolerance refers to deflection and backlash together: of a light load within a wide play
    # a hundredth is left. A wrong sign shows as a share of one.
    assert abs(run.energy.residual) < 2e-4 * turnover(run.energy) + 1e-9
    loaded = run.mesh_force != 0.0
    errors = any(changes[name] for name in ("mesh.sun_planet_error", "mesh.runout"))
    if not errors:  # d beyond the dead zone on the side that pushes
        half = 0.5 * scene.operating_point.backlash
        assert (np.sign(run.mesh_force) * run.dte)[loaded].min() >= half - 1e-9


@QUICK
@given(changes=SCENES)
def test_random_scene_is_finite_dissipative_and_closed_in_energy(changes):
    check(changes)


@QUICK
@given(changes=SCENES)
def test_random_statics_are_dissipative_and_close_in_energy(changes):
    scene = build(changes | {"dynamics": "quasi_static"})
    if scene is None:
        return
    run = pt.simulate(scene, 0.004, 20_000.0)
    for values in (run.dte, run.mesh_force, run.speed, run.angle):
        assert np.isfinite(values).all()
    assert run.energy.friction >= 0.0 and (run.power_loss >= 0.0).all()
    assert abs(run.energy.residual) <= 1e-12 * turnover(run.energy)


@QUICK
@given(parts=st.tuples(gears(), flows(), LAWS))
def test_planets_may_be_renamed(parts):
    """All but the first, which defines angle zero."""
    scene = build(parts[0] | parts[1] | parts[2])
    if scene is None:
        return
    angles = scene.gearset.planet_angles
    renamed = scene.replace(**{"gearset.planet_angles": angles[:1] + angles[:0:-1]})
    one, two = (pt.simulate(s, 0.001, 20_000.0, tolerance=1e-7) for s in (scene, renamed))
    planets = len(angles)
    order = [0, *range(planets - 1, 0, -1)]
    meshes = [*order, *(planets + k for k in order)]
    # Rattling teeth part from rounding on: a thousandth of the motion over a millisecond.
    assert one.dte == pytest.approx(two.dte[:, meshes], abs=1e-3 * np.abs(one.dte).max())
