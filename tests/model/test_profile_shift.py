"""Trains with profile shift: kinematics of the rows, forces, energy, and natural modes."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py._core import TOTAL
from planetary_twin_py.explanation.meshes import describe_meshes
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.stiffness_laws import tooth_pairs

PAPER = pt.load_scene("paper")
STAGE = pt.load_scene("reference_gearbox_stage")


def rig(held, driver, driven, **changes):
    """31/31/95 teeth, whose ring has two teeth more than sun + 2 planet, in any power flow."""
    gears = {
        "teeth": {"sun": 31, "planet": 31, "ring": 95},
        "planet_angles": ["0 deg", "120 deg", "240 deg"],
        "module": "0.8 mm",
        "pressure_angle": "20 deg",
        "centre_distance": "25.2 mm",
        "profile_shift": {"sun": 0.26, "planet": 0.25, "ring": -0.2},
        "held": held,
    }
    return PAPER.replace(
        **{f"gearset.{name}": value for name, value in gears.items()},
        **{"drive.input.member": driver, "drive.output.member": driven},
        **{"mesh.damping.law": "viscous"},
        **changes,
    )


FLOWS = [("carrier", "sun", "ring"), ("ring", "sun", "carrier"), ("sun", "ring", "carrier")]
SCENES = pytest.mark.parametrize(
    "scene",
    [STAGE, *(rig(*flow) for flow in FLOWS)],
    ids=lambda scene: f"{scene.name}-{scene.gearset.held}",
)


@SCENES
def test_rigid_turning_moves_no_mesh(scene):
    train = Gearbox(scene).train
    for i in range(train.meshes):
        kind, bodies = train.mesh.kind[i], train.mesh.body[i]
        moved = train.mesh.sign[i] * train.body.radius[bodies] * train.body.ratio[bodies, 0]
        assert abs(moved.sum()) < 1e-12 * np.abs(moved).max()
        speeds = train.body.ratio[bodies, 0] - train.body.ratio[bodies[2], 0]
        rolled = train.geometry.pitch_curvature[kind] * speeds[:2]
        assert rolled[0] + train.geometry.external[kind] * rolled[1] == pytest.approx(
            0.0, abs=1e-12 * abs(rolled[0])
        )


@SCENES
def test_radii_of_curvature_end_on_the_line_of_action(scene):
    """r1 + r2 = a sin(a_w) at the sun, r2 - r1 = a sin(a_w) at the ring."""
    train, gears = Gearbox(scene).train, scene.gearset.geometry
    for kind, mesh in enumerate(gears.meshes):
        first, second = train.geometry.pitch_curvature[kind]
        length = gears.centre_distance * math.sin(mesh.pressure_angle)
        assert second + (first if kind == 0 else -first) == pytest.approx(length, rel=1e-12)


@pytest.mark.parametrize("flow", FLOWS, ids=str)
def test_forces_and_energy_of_a_dynamic_run(flow):
    scene = rig(*flow)
    run = pt.simulate(scene, 0.1, tolerance=1e-5)
    assert abs(run.energy.residual) < 1e-6 * run.energy.driving_work
    lossless = pt.simulate(scene.replace(**{"lubrication.friction": False}), 0.1, tolerance=1e-5)
    teeth = scene.gearset.teeth
    torque = {"sun": teeth.sun, "ring": teeth.ring}[flow[1]]
    base = scene.gearset.geometry.sun.base_radius
    expected = 63.0 * teeth.sun / torque / (3 * base)
    means = np.abs(lossless.mesh_force.mean(axis=0))
    assert means == pytest.approx(np.full(6, expected), rel=2e-3)


def test_stiffness_of_shifted_teeth_is_that_of_steel_gears():
    """Of one pair, over the face width; ISO 6336-1 has about 14 to 20 N/(mm um)."""
    figures = describe_meshes(STAGE)
    width = STAGE.gearset.face_width
    single = figures.sun_planet.single_stiffness / width
    assert 12e9 < single < 22e9


@pytest.mark.parametrize("model", ["planar", "spatial"])
@pytest.mark.parametrize("held", ["ring", "carrier"])
def test_free_bodies_have_the_rigid_modes_of_their_motions(model, held):
    """Without bearings and held members every rigid motion of the set deforms no spring."""
    body = {"mass": 1.0, "bearing": 0.0, "axial": 0.0, "tilting": 0.0}
    supports = dict.fromkeys(("sun", "ring", "carrier"), body)
    supports["planet"] = {"mass": 0.1, "bearing": 1e8, "axial": 1e7, "tilting": 1e6}
    flow = {"ring": FLOWS[1], "carrier": FLOWS[0]}[held]
    scene = rig(*flow, supports=supports)
    kinds = pt.natural_modes(scene, model).kinds
    # Held is one rotation; the set moves in x and y, and on its teeth; in space along z and tilts.
    members = {"gearset.held": held, "drive.input.member": flow[1], "drive.output.member": flow[2]}
    standard = PAPER.replace(supports=supports, **members)
    assert kinds.count("rigid") == pt.natural_modes(standard, model).kinds.count("rigid")


def test_working_angles_decide_hertz_pressure_film_and_sliding():
    """p = sqrt(F E*/(pi L R)) with 1/R = 1/(r_b1 tan a_w) +- 1/(r_b2 tan a_w) (Johnson 1985)."""
    figures, oil = describe_meshes(STAGE), STAGE.lubrication
    modulus = 0.5 * oil.youngs_modulus / (1.0 - oil.poisson_ratio**2)
    alpha, m = math.radians(20.0), 0.045
    for mesh, first, second in ((figures.sun_planet, 19, 17), (figures.planet_ring, 17, -56)):
        cosine = 0.5 * m * abs(first + second) * math.cos(alpha) / 0.863
        base = 0.5 * m * math.cos(alpha) * math.tan(math.acos(cosine))
        curvature = 1.0 / (base * first) + 1.0 / (base * second)
        line = mesh.static_force / STAGE.gearset.face_width
        assert mesh.pitch_pressure == pytest.approx(
            math.sqrt(line * modulus * curvature / math.pi), rel=1e-9
        )


# Second stage of the same gearbox: the path of contact of planet and ring ends 0.012 base pitches
# from the pitch point.
OFF = STAGE.replace(
    **{
        "gearset.teeth": {"sun": 18, "planet": 36, "ring": 93},
        "gearset.module": 0.021,
        "gearset.profile_shift": {"sun": 0.389, "planet": 0.504, "ring": 0.117},
        "gearset.centre_distance": 0.584,
        "gearset.face_width": 0.55,
        "input_torque": 1.06e6,
    }
)


def test_the_largest_stiffness_is_that_of_one_pair():
    """c' of ISO 6336-1, its maximum: it is that of the modes and of the damping."""
    figures, width = describe_meshes(OFF).planet_ring, OFF.gearset.face_width
    assert min(figures.approach, figures.recess) == pytest.approx(-0.012, abs=1e-4)
    train = Gearbox(OFF).train
    carried = [
        train.teeth.stiffness_gain[1] * train.teeth.weight[1, j, TOTAL, 0]
        for j in range(train.teeth.segments[1])
        if train.teeth.present[1, j] == 1
    ]
    assert max(carried) <= figures.single_stiffness < 1.02 * max(carried)
    pair = tooth_pairs(OFF)[1]
    path = np.linspace(-pair.path.approach, pair.path.recess, 5001)
    stiffness = pair.stiffness(path, width)
    assert figures.single_stiffness == pytest.approx(stiffness.max(), rel=1e-5)
    assert figures.single_stiffness > 1.4 * pair.stiffness(np.zeros(1), width)[0]
    time = train.damping.time[1] * 2.0 * math.pi * figures.natural_frequency
    assert 0.5 * time == pytest.approx(OFF.mesh.damping.damping_ratio)
    given = {"mesh.stiffness": "given", "mesh.sun_planet_stiffness": train.teeth.stiffness[0],
             "mesh.planet_ring_stiffness": stiffness.max()}  # fmt: skip
    modes, expected = (pt.natural_modes(scene).frequencies for scene in (OFF, OFF.replace(**given)))
    assert modes == pytest.approx(expected, rel=1e-5, abs=1e-6)


@pytest.mark.parametrize("shift, tip", [(0.0, 1.906), (0.6, 1.94)])
def test_hertz_pressure_is_that_of_the_end_of_the_path(shift, tip):
    """The planets touch the ring's tips there: rho = sqrt(r_a^2 - r_b^2), a sin(a_w) less."""
    scene = OFF.replace(**{
        "gearset.profile_shift": {"sun": 0.389 - shift, "planet": 0.504 + shift,
                                  "ring": 0.117 - shift},
        "gearset.tip_diameter": {"ring": tip},
    })  # fmt: skip
    figures, oil = describe_meshes(scene).planet_ring, scene.lubrication
    assert min(figures.approach, figures.recess) < 0.0
    base = 0.5 * 0.021 * 93 * math.cos(math.radians(20.0))
    ring = math.sqrt(0.25 * tip**2 - base**2)
    cosine = 0.5 * 0.021 * (93 - 36) * math.cos(math.radians(20.0)) / 0.584
    planet = ring - 0.584 * math.sin(math.acos(cosine))
    modulus = 0.5 * oil.youngs_modulus / (1.0 - oil.poisson_ratio**2)
    line = figures.static_force / scene.gearset.face_width
    expected = math.sqrt(line * modulus * (1.0 / planet - 1.0 / ring) / math.pi)
    assert figures.pitch_pressure == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("flow", FLOWS[:2], ids=str)
@pytest.mark.parametrize("dynamics", ["quasi_static", "torsional"])
def test_the_mirrored_set_runs_equally_on_its_coast_flanks(flow, dynamics):
    """Mirroring swaps drive and coast flanks: their phases must follow from the thickness."""
    scene = rig(*flow, dynamics=dynamics, **{"lubrication.friction": False})
    mirrored = scene.replace(
        input_speed=-scene.operating_point.input_speed,
        input_torque=-scene.operating_point.input_torque,
        **{"gearset.planet_angles": tuple(-psi for psi in scene.gearset.planet_angles)},
    )
    cycles, found = 20.0, []
    frequency = describe_meshes(scene).mesh_frequency
    for one in (scene, mirrored):
        run = pt.simulate(one, (40.0 + cycles) / frequency, 1000.0 * frequency, tolerance=1e-5)
        tail = slice(-int(1000 * cycles), None)
        force = np.abs(run.mesh_force[tail])
        both = force[:, 0] * force[:, 3]  # how the two meshes of planet 1 stand to each other
        found.append([*force.mean(axis=0), *(10.0 * force.std(axis=0)), both.mean() / 1500.0])
    assert found[1] == pytest.approx(found[0], rel=1e-3, abs=0.5)
