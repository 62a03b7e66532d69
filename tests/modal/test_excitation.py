"""Modes that the phases of equal planets let the meshing excite, and those that they suppress."""

import math

import numpy as np
import pytest
from planar.moving_scenes import planar, supports
from power_flows import FLOWS

import planetary_twin_py as pt
from planetary_twin_py.modal.campbell import resonances
from planetary_twin_py.modal.excitation import EXCITED, NO_MESH, SUPPRESSED, excitation
from planetary_twin_py.modal.modes import clusters
from planetary_twin_py.modal.natural import natural_modes, spring_model
from planetary_twin_py.modal.turning import turning_terms
from planetary_twin_py.model.layout import Layout

AWAY = 1e-4  # relative distance of a frequency from a natural frequency


def evenly_spaced(teeth, planets, flow=FLOWS[0]):
    """A set of equal planets at equal angles."""
    sun, ring = teeth
    return planar(
        flow,
        **{
            "gearset.teeth": {"sun": sun, "planet": (ring - sun) // 2, "ring": ring},
            "gearset.planet_angles": tuple(2.0 * math.pi * k / planets for k in range(planets)),
        },
    )


def excited_kind(teeth, planets, harmonic):
    """Kind of the modes that a harmonic excites (Kahraman 1994; Parker 2000)."""
    rest = harmonic * teeth[0] % planets
    return {0: "rotational", 1: "translational", planets - 1: "translational"}.get(rest, "planet")


@pytest.mark.parametrize("model", ["planar", "spatial"])
@pytest.mark.parametrize(
    "teeth, planets",
    [((21, 99), 3), ((20, 70), 3), ((30, 70), 4), ((29, 71), 4), ((36, 74), 5), ((31, 71), 6)],
)
def test_equally_spaced_planets_excite_modes_of_published_rule(teeth, planets, model):
    scene = evenly_spaced(teeth, planets)
    modes, springs = natural_modes(scene, model, "mean"), spring_model(scene, model, "mean")
    found = resonances(scene, modes, springs, 1e9, harmonics=7)
    assert {r.kind for r in found} >= {"rotational", "translational"}
    for resonance in found:
        if resonance.excitation != NO_MESH:
            wanted = excited_kind(teeth, planets, resonance.harmonic) == resonance.kind
            assert resonance.excitation == (EXCITED if wanted else SUPPRESSED), resonance


def test_equal_planets_excite_rotational_modes_alone():
    scene = pt.load_scene("wind_turbine_stage")
    modes, springs = (make(scene, "planar", "mean") for make in (natural_modes, spring_model))
    found = resonances(scene, modes, springs, pt.rpm(60.0))
    assert {(r.kind, r.excitation) for r in found} == {
        ("rotational", EXCITED),
        ("translational", SUPPRESSED),
    }


def test_unequal_spacing_excites_every_mode_of_the_paper():
    scene = pt.load_scene("paper")
    modes, springs = natural_modes(scene), spring_model(scene)
    assert {r.excitation for r in resonances(scene, modes, springs, 1e9)} == {EXCITED}


def test_opposed_planets_keep_the_axes_still_with_an_even_sun():
    """The forces of a pair on the sun cancel if h Zs is even (Lin and Parker 2000)."""
    angles = tuple(math.radians(a) for a in (0.0, 79.2, 180.0, 259.2))
    scene = planar(**{"gearset.planet_angles": angles})  # 30/20/70 teeth
    found = excitations(scene)
    assert (found["rotational"], found["translational"]) == ({EXCITED}, {SUPPRESSED})


def test_unequal_planets_excite_modes_that_equal_ones_suppress():
    scene = evenly_spaced((21, 99), 3)
    uneven = scene.replace(**{"errors.planet_stiffness": (0.8, 1.0, 1.0)})
    assert excitations(scene) == {"rotational": {EXCITED}, "translational": {SUPPRESSED}}
    assert excitations(uneven)["mixed"] == {EXCITED}


def excitations(scene):
    """What the mesh frequency does to the kinds of modes."""
    modes, springs = (make(scene, "planar", "mean") for make in (natural_modes, spring_model))
    found = {}
    for resonance in resonances(scene, modes, springs, 1e9, harmonics=1):
        found.setdefault(resonance.kind, set()).add(resonance.excitation)
    return found


def test_axial_modes_of_spur_gears_deform_no_mesh():
    scene = evenly_spaced((21, 99), 3)
    axial = {body: {**data, "axial": 1e8, "tilting": 1e8} for body, data in supports().items()}
    scene = scene.replace(supports=axial)
    modes, springs = (make(scene, "spatial", "mean") for make in (natural_modes, spring_model))
    place = modes.coordinates.index("sun.z")
    moved = [c for c in clusters(modes.frequencies) if abs(modes.shapes[place, c]).max() > 0.1]
    assert moved
    for cluster in moved:
        assert excitation(scene, springs, modes.shapes[:, cluster], 1) == NO_MESH


def forced_response(scene, speed, harmonic, frequency):
    """Largest displacement under harmonic pulls of the sun meshes on the lines of action."""
    springs = spring_model(scene, "planar", "mean")
    layout = Layout(scene)
    speeds = layout.speeds(speed)
    terms = turning_terms(springs, speeds["carrier"], speeds, scene.gearset.planet_angles)
    omega = 2.0 * np.pi * frequency
    # Mesh cycles grow with the turns of the motor; force is the real part of f exp(-i omega t).
    forward = np.sign(speed * float(layout.cycles[0]))
    delays = np.array([float(phase) for phase in layout.phases[0]])
    pulls = np.exp(2j * np.pi * forward * harmonic * delays)
    rows = [spring.row for spring in springs.springs if spring.kind == "sun_planet"]
    dynamic = (
        springs.stiffness
        - terms.centripetal
        - 1j * omega * terms.gyroscopic
        - omega**2 * np.diag(springs.mass)
    )
    return np.abs(np.linalg.solve(dynamic, np.array(rows).T @ pulls)).max()


@pytest.mark.parametrize("speed", [pt.rpm(2000.0), pt.rpm(-2000.0)])
def test_a_harmonic_excites_one_of_two_whirling_modes(speed):
    scene = evenly_spaced((20, 70), 3, FLOWS[2])
    springs = spring_model(scene, "planar", "mean")
    modes = natural_modes(scene, "planar", "mean", speed)
    found = resonances(scene, modes, springs, 1e9, harmonics=2, input_speed=speed)
    whirling = [r for r in found if r.kind == "translational"]
    assert {r.excitation for r in whirling} == {EXCITED, SUPPRESSED}
    for r in whirling:
        beside, away = (
            forced_response(scene, speed, r.harmonic, r.frequency * (1.0 + k * AWAY))
            for k in (0.01, 1.0)
        )
        assert (beside > 50.0 * away) == (r.excitation == EXCITED), r
