"""Helical teeth in torsional and quasi-static runs, against slices of the face."""

import math

import numpy as np
import pytest

import planetary_twin_py as pt

SLICES = 2001
PAIRS = np.arange(-4, 5)


def helical(**changes):
    """Equal planets in phase, slow, without friction: each mesh has a constant force."""
    return pt.load_scene("paper").replace(
        **{
            "dynamics": "quasi_static",
            "gearset.helix_angle": "18 deg",
            "lubrication.friction": False,
            "backlash": 0.0,
        }
        | changes
    )


def stiffness(scene, kind, cycle):
    """Mean over the slices of what trapezoids of spur teeth give [N/m]."""
    gears, mesh = scene.gearset, scene.mesh
    path = gears.geometry.meshes[kind].path
    pitch = math.pi * gears.module * math.cos(gears.pressure_angle)
    lean = math.tan(gears.helix_angle) * math.cos(gears.pressure_angle) / pitch
    z = gears.face_width * ((np.arange(SLICES) + 0.5) / SLICES - 0.5)
    s = cycle + z[:, None] * lean + PAIRS
    rise = np.minimum(s + path.approach, path.recess - s) / mesh.ramp
    pairs = np.clip(rise, 0.0, 1.0).sum(axis=1)
    single = (mesh.sun_planet_stiffness, mesh.planet_ring_stiffness)[kind]
    ratio = mesh.double_pair_ratio
    return single * (2.0 - ratio + (ratio - 1.0) * pairs).mean()


WIDE = {"gearset.module": "1.379 mm", "gearset.face_width": "30 mm"}  # normal module 1.25 mm


@pytest.mark.parametrize(("angle", "changes"), [("4 deg", {}), ("-18 deg", {}), ("25 deg", WIDE)])
def test_transmission_error_is_force_over_the_mean_of_the_slices(angle, changes):
    scene = helical(**{"gearset.helix_angle": angle}, **changes)
    run = pt.simulate(scene, 0.002, sample_rate=50e3)
    teeth = scene.gearset.teeth.sun
    sun, carrier = run.bodies.index("sun"), run.bodies.index("carrier")
    # Quasi-static angles are those of the motor: the sun is behind by what its shaft winds up.
    wound_up = scene.operating_point.input_torque / scene.drive.input.coupling_stiffness
    turned = run.angle[:, sun] - run.angle[:, carrier] - wound_up
    cycles = teeth * turned / (2.0 * math.pi)
    for n in range(0, len(cycles), 7):
        expected = run.mesh_force[n, 0] / stiffness(scene, 0, cycles[n])
        assert run.dte[n, 0] == pytest.approx(expected, rel=2e-4)


def test_the_sense_of_the_helix_does_not_matter_to_rotations():
    one, two = (
        pt.simulate(helical(dynamics="torsional", **{"gearset.helix_angle": angle}), 0.01).dte
        for angle in ("12 deg", "-12 deg")
    )
    assert np.array_equal(one, two)


def test_ledger_closes_with_friction_on_parts_of_contact_lines():
    scene = helical(dynamics="torsional", **{"lubrication.friction": True})
    run = pt.simulate(scene, 0.02, tolerance=1e-5)
    assert abs(run.energy.residual) < 1e-6 * abs(run.energy.input)


@pytest.mark.parametrize("overlap", [3.4, 4.0])
def test_whole_overlap_of_a_wide_face_does_not_excite_the_gears(overlap):
    pitch = math.pi * 1.379e-3  # of the transverse section; the overlap is L tan(beta)/pitch
    width = overlap * pitch / math.tan(math.radians(25.0))
    wide = WIDE | {"gearset.helix_angle": "25 deg", "gearset.face_width": width}
    run = pt.simulate(helical(dynamics="torsional", **wide), 0.02, tolerance=1e-6)
    ripple = run.dte[:, 0].std() / abs(run.dte[:, 0].mean())
    assert (ripple < 1e-5) if overlap == 4.0 else (ripple > 1e-4)


@pytest.mark.parametrize(("angle", "changes"), [("18 deg", {}), ("25 deg", WIDE)])
def test_losses_are_those_of_an_even_load_along_contact_lines(angle, changes):
    """Friction at the sliding of every slice: (e1^2 + e2^2)/e with lengths of approach and recess
    e1 and e2 and the contact ratio e. Spur teeth have 1 - e + e1^2 + e2^2 (Ohlendorf 1958), as two
    pairs at their ends have half the load. The friction coefficient is that of either line load,
    and the normal load is larger by 1/cos(beta_b)."""
    friction = {"lubrication.friction": True, "lubrication.rolling": "none"}
    scene = helical(**friction, **changes)
    losses, factors = [], np.zeros((2, 2))
    for helix in (0.0, angle):
        run = pt.simulate(scene.replace(**{"gearset.helix_angle": helix}), 0.006)
        losses.append(run.energy.loss)
    for kind, mesh in enumerate(scene.gearset.geometry.meshes):
        first, second = mesh.path
        both = first**2 + second**2
        factors[kind] = 1.0 - first - second + both, both / (first + second)
    even = factors[:, 1].sum() / factors[:, 0].sum()
    base_helix = scene.replace(**{"gearset.helix_angle": angle}).gearset.base_helix
    assert even > 1.1
    assert losses[1] / losses[0] == pytest.approx(even / math.cos(base_helix), rel=0.05)


def test_a_crack_on_helical_teeth_softens_less_at_once_and_runs():
    """The cracked tooth enters along the face: its mesh deflects less at its worst instant."""
    crack = {"kind": "crack", "gear": "sun", "tooth": 2, "stiffness_loss": 0.3}
    peaks = []
    for angle in ("0 deg", "12 deg"):
        scene = helical(**{"gearset.helix_angle": angle, "faults": [crack]})
        healthy = scene.replace(faults=[])
        cracked, sound = (
            pt.simulate(s, 0.06, sample_rate=20e3).dte[:, 0] for s in (scene, healthy)
        )
        peaks.append(np.abs(cracked - sound).max())
    assert 0.0 < peaks[1] < peaks[0]


def test_tip_relief_is_for_spur_teeth():
    with pytest.raises(ValueError, match=r"mesh\.tip_relief: requires spur teeth"):
        helical(**{"mesh.tip_relief.sun": {"amount": "5 um", "length": "0.3 mm"}})


def test_a_face_too_wide_is_refused_with_the_largest_allowed():
    scene = helical(**{"gearset.face_width": "300 mm"})
    with pytest.raises(ValueError, match=r"gearset.face_width = 300 mm: must be at most") as error:
        pt.simulate(scene, 0.001)
    allowed = str(error.value).split(" at most ")[1].split(" with gearset.helix_angle = 18 deg")[0]
    run = pt.simulate(scene.replace(**{"gearset.face_width": allowed}), 0.001)
    assert np.isfinite(run.dte).all()
    wider = f"{1.01 * float(allowed.removesuffix(' mm'))} mm"
    with pytest.raises(ValueError, match="17 parts of tooth pairs"):
        pt.simulate(scene.replace(**{"gearset.face_width": wider}), 0.001)
