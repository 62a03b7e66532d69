"""Figures of the meshes against closed forms and against what runs."""

import math

import numpy as np
import pytest
from power_flows import FLOWS, flow_name, scene_of

import planetary_twin_py as pt
from planetary_twin_py.explanation.meshes import describe_meshes
from planetary_twin_py.model.stiffness_laws import tooth_pairs

PAPER = pt.load_scene("paper")
COSINE = math.cos(math.radians(21.34))
RIM = {"sun": 0.272 / COSINE**2, "planet": 0.1 / COSINE**2, "ring": 0.759 / COSINE**2}  # [kg]
PAIRS = {"sun_planet": ("sun", "planet"), "planet_ring": ("planet", "ring")}
BOTH = pytest.mark.parametrize("kind", PAIRS)


def of(kind, scene=PAPER, **changes):
    return getattr(describe_meshes(scene.replace(**changes)), kind)


def natural_frequency(kind, stiffness):
    """[Hz] from the eigenvalue of two masses that a spring pushes apart."""
    first, second = (RIM[gear] for gear in PAIRS[kind])
    matrix = np.array([[stiffness / first] * 2, [stiffness / second] * 2])
    return math.sqrt(np.linalg.eigvals(matrix).max()) / (2 * math.pi)


@BOTH
def test_natural_frequency_is_that_of_two_gears_on_one_pair(kind):
    assert of(kind).natural_frequency == pytest.approx(natural_frequency(kind, 2e8))
    softer = of(kind, **{f"mesh.{kind}_stiffness": 1e8})
    assert softer.natural_frequency == pytest.approx(natural_frequency(kind, 1e8))


@BOTH
def test_damping_ratio_is_half_of_tau_times_omega_by_every_law(kind):
    """tau = eta/f_m gives pi eta f/f_m: 0.44 at the sun, 0.40 at the ring, at 500 Hz."""
    f = natural_frequency(kind, 2e8)

    def ratio(**changes):
        return of(kind, **changes).damping_ratio

    law = "mesh.damping.law"
    assert ratio() == pytest.approx(math.pi * 0.009 * f / 500.0)
    assert ratio() == pytest.approx({"sun_planet": 0.44, "planet_ring": 0.40}[kind], abs=0.005)
    assert ratio(input_speed=pt.rpm(2000)) == pytest.approx(math.pi * 0.009 * f / 1000.0)
    assert ratio(input_speed=0.0) == pytest.approx(math.pi * 0.009 * f / 5.0)
    printed = ratio(**{law: "printed_meshing_frequency"})  # which takes 350 Hz for 500
    assert printed == pytest.approx(math.pi * 0.009 * f / 350.0)
    assert ratio(**{law: "natural_frequency"}) == pytest.approx(math.pi * 0.009)
    assert ratio(**{law: "viscous", "mesh.damping.damping_ratio": 0.07}) == pytest.approx(0.07)


@BOTH
@pytest.mark.parametrize("ramp", [0.0, 0.03, 0.1])
def test_mean_stiffness_counts_pairs_by_contact_ratio(kind, ramp):
    """A pair takes its ramp to enter and to leave: it carries as for one base pitch less."""
    figures = of(kind, **{"mesh.ramp": ramp})
    pairs = {"sun_planet": 1.5554, "planet_ring": 1.8092}[kind]
    assert figures.contact_ratio == pytest.approx(pairs, abs=1e-4)
    mean = 2e8 * (1 + 0.75 * (figures.contact_ratio - ramp - 1))
    assert figures.mean_stiffness == pytest.approx(mean)


@pytest.mark.parametrize("kind", [0, 1])
def test_mean_of_computed_stiffness_is_that_of_teeth_over_cycle(kind):
    scene = pt.load_scene("cracked_tooth").replace(**{"mesh.ramp": 0.0})
    figures, pair = describe_meshes(scene)[1 + kind], tooth_pairs(scene)[kind]
    width = scene.gearset.face_width
    path = np.linspace(-2.0, 2.0, 40001) + 1e-9
    begin, end = path_of(scene, kind)
    there = (begin < path) & (path < end)
    stiffness = np.zeros_like(path)
    stiffness[there] = pair.stiffness(path[there], width)
    cycles = stiffness[:-1].reshape(4, -1)  # one pair behind the other
    shared = np.where((cycles > 0.0).sum(axis=0) > 1, pair.shared_body_factor, 1.0)
    mean = (shared * cycles.sum(axis=0)).mean()
    assert figures.mean_stiffness == pytest.approx(mean, rel=1e-3)
    assert figures.single_stiffness == pytest.approx(stiffness.max(), rel=1e-5)


def path_of(scene, kind):
    """Where a pair of teeth meets and parts, base pitches from the pitch point."""
    teeth, angle = scene.gearset.teeth, scene.gearset.pressure_angle

    def reach(z, addendum):
        tip, base = z / 2 + addendum, z / 2 * math.cos(angle)
        return (
            abs(math.sqrt(tip**2 - base**2) - z / 2 * math.sin(angle)) / math.pi / math.cos(angle)
        )

    height = scene.gearset.addendum
    if kind == 0:
        return -reach(teeth.planet, height), reach(teeth.sun, height)
    return -reach(teeth.ring, -height), reach(teeth.planet, height)


@BOTH
def test_force_is_the_torque_over_base_radius_and_planets(kind):
    assert of(kind).static_force == pytest.approx(63.0 / 3 / (0.012 * COSINE))
    assert of(kind, input_torque=-21.0).static_force == pytest.approx(7.0 / (0.012 * COSINE))


@BOTH
def test_pressure_is_that_of_iso_6336(kind):
    """Z_H Z_E sqrt(F_t/(d1 b) (u +- 1)/u), Z_H = sqrt(2/(cos^2 tan)) at the pressure angle."""
    first, second = {"sun_planet": (30, 20), "planet_ring": (20, -70)}[kind]
    gearset, oil = PAPER.gearset, PAPER.lubrication
    zone = math.sqrt(2.0 / (COSINE**2 * math.tan(math.radians(21.34))))
    elasticity = math.sqrt(oil.youngs_modulus / (2.0 * math.pi * (1.0 - oil.poisson_ratio**2)))
    ratio, tangential = second / first, of(kind).static_force * COSINE
    line = tangential / (gearset.module * first * gearset.face_width)
    iso = zone * elasticity * math.sqrt(line * (ratio + 1.0) / ratio)
    assert of(kind).pitch_pressure == pytest.approx(iso)


def tip_lengths(gearset, kind):
    """Path of contact from the pitch point to the tips of both gears [base pitches].

    On the line of action, from the tip radius and the operating triangle of each gear.
    """
    a, lengths = gearset.geometry.centre_distance, []
    gears = [getattr(gearset.geometry, gear) for gear in PAIRS[kind]]
    first, second = (gear.base_radius for gear in gears)
    cosine = (second + first if kind == "sun_planet" else second - first) / a
    pitch = 2.0 * math.pi * first / getattr(gearset.tooth_numbers, PAIRS[kind][0])
    for gear in gears:
        tangent = gear.base_radius * math.sqrt(1.0 / cosine**2 - 1.0)
        lengths.append(abs(math.sqrt(gear.tip_radius**2 - gear.base_radius**2) - tangent) / pitch)
    return lengths


# Whether power goes from the sun over the planets to the ring, seen from the carrier, if it enters
# at the input. A held sun or ring is the support of the planets there: it takes or gives power.
FROM_SUN = {
    ("carrier", "sun", "ring"): True,
    ("carrier", "ring", "sun"): False,
    ("ring", "sun", "carrier"): True,
    ("ring", "carrier", "sun"): False,
    ("sun", "carrier", "ring"): True,
    ("sun", "ring", "carrier"): False,
}


@BOTH
@pytest.mark.parametrize("flow", FLOWS, ids=flow_name)
@pytest.mark.parametrize("reverse", ["input_torque", "input_speed", None])
def test_contact_begins_at_the_tip_of_the_driven_gear(kind, flow, reverse):
    scene = scene_of(flow)
    if reverse is not None:
        scene = scene.replace(**{reverse: -getattr(scene.operating_point, reverse)})
    point = scene.operating_point
    from_sun = FROM_SUN[flow[:3]] is (point.input_torque * point.input_speed > 0.0)
    found, (first, second) = of(kind, scene), tip_lengths(scene.gearset, kind)
    assert found.driver == PAIRS[kind][0 if from_sun else 1]
    expected = (second, first) if from_sun else (first, second)
    assert (found.approach, found.recess) == pytest.approx(expected)


@BOTH
def test_backlash_is_way_between_flanks_on_the_line_of_action(kind):
    assert of(kind, backlash=3e-7).backlash == pytest.approx(3e-7)
    along_arcs = of(kind, backlash=3e-7, **{"mesh.motion": "pitch_arc"})
    assert along_arcs.backlash == pytest.approx(3e-7 * COSINE)
    # The printed law has no force within +-B.
    printed = of(kind, backlash=3e-7, **{"mesh.backlash": "regulatory_factor"})
    assert printed.backlash == pytest.approx(6e-7)


@pytest.mark.parametrize("name", ["paper", "reference_gearbox_stage", "wind_turbine_stage"])
@pytest.mark.parametrize("traction", ["eyring", "evans_johnson", "schlenk"])
def test_tooth_loss_is_that_of_a_run(name, traction):
    """Except for friction, which makes the forces of sun and ring meshes of a run unequal."""
    changes = {"dynamics": "quasi_static", "lubrication.traction": traction}
    scene = pt.load_scene(name).replace(**changes)
    found = describe_meshes(scene)
    run = pt.simulate(scene, 4.0 / found.mesh_frequency, 100.0 * found.mesh_frequency)
    planets, loss = scene.gearset.planets, run.mesh["power_loss"]
    for mesh, of_kind in zip(found[1:], (loss[:planets], loss[planets:]), strict=True):
        assert mesh.tooth_loss == pytest.approx(of_kind.sum(), rel=0.065)
        power = planets * mesh.static_force * found.mesh_frequency * base_pitch(scene)
        assert mesh.tooth_loss == pytest.approx(mesh.friction * mesh.loaded_loss_factor * power)


def base_pitch(scene):
    return math.pi * scene.gearset.module * math.cos(scene.gearset.pressure_angle)


SEVEN = {"lubrication.traction": "table", "lubrication.friction_table": {"coefficient": [0.07]}}


@BOTH
@pytest.mark.parametrize("name", ["paper", "helical_stage", "wind_turbine_stage"])
def test_mean_friction_of_a_constant_coefficient_is_it(kind, name):
    """Whatever loads the pairs have: entering teeth carry less, ends of contact lines more."""
    assert of(kind, pt.load_scene(name), **SEVEN).friction == pytest.approx(0.07, rel=1e-8)


@BOTH
def test_equal_loads_have_the_loss_factor_in_closed_form(kind):
    """As they do with a given stiffness if teeth enter at once."""
    found = of(kind, **{"mesh.ramp": 0.0})
    assert found.loaded_loss_factor == pytest.approx(found.loss_factor, rel=0.01)


@BOTH
def test_loss_factor_of_loads_is_that_of_even_lines(kind):
    """Mean sliding over all lines of contact of helical teeth, by numbers; integer overlap ratio.

    With an overlap ratio of 1, the length of all lines is constant, so each part of the path of
    contact is loaded equally over time: the mean of |position| over the path, times the slip.
    """
    stage = pt.load_scene("helical_stage").replace(**{"mesh.ramp": 0.0})
    gearset = stage.gearset
    pitch = gearset.geometry.meshes[0].base_pitch
    even = stage.replace(**{
        "gearset.face_width": pitch / math.tan(gearset.base_helix),
        "mesh.stiffness": "given", "mesh.double_pair_ratio": 2.0,
        "mesh.sun_planet_stiffness": 3e8, "mesh.planet_ring_stiffness": 3e8,
    })  # fmt: skip
    found = of(kind, even)
    first, second = found.teeth
    sign = 1.0 if kind == "sun_planet" else -1.0
    mean = 0.5 * (found.approach**2 + found.recess**2) / (found.approach + found.recess)
    slip = 2.0 * math.pi * (1.0 / first + sign / second)
    cosine = math.cos(gearset.base_helix)
    assert found.loaded_loss_factor == pytest.approx(slip * mean / cosine, rel=0.01)


@BOTH
@pytest.mark.parametrize("change", [{"input_speed": 0.0}, {"input_torque": 0.0}])
def test_friction_at_standstill_and_without_load_is_a_number(kind, change):
    found = of(kind, **change)
    for value in (found.friction, found.friction_eyring, found.friction_schlenk):
        assert 0.0 <= value < 0.5


def test_root_stresses_are_those_that_a_commercial_program_prints():
    """KISSsoft 03/2017 for stage 1 of the NREL 5 MW gearbox, 829 478.6 N in each mesh."""
    scene = pt.load_scene("reference_gearbox_stage").replace(input_torque=3.945990e6)
    found = describe_meshes(scene)
    assert found.sun_planet.static_force == pytest.approx(829_478.6, abs=0.5)
    in_megapascals = [1e-6 * stress for stress in found.sun_planet.root_stress]
    assert in_megapascals == pytest.approx([113.46, 108.94], abs=0.02)
    assert 1e-6 * found.planet_ring.root_stress[0] == pytest.approx(95.70, abs=0.03)
    assert describe_meshes(pt.load_scene("helical_stage")).sun_planet.root_stress == ()
