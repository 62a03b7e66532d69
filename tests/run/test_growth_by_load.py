"""Growth by the load of the faulty tooth, against the forces of runs without growth."""

import numpy as np
import pytest
from paths import sun_planet_path

import planetary_twin_py as pt

PAPER = pt.load_scene("paper")
FORCE = 1000.0  # [N] of the stated pressure
ARCHARD = {
    "law": "archard", "coefficient": 1e-18, "pressure": 1.2e9, "half_width": 2e-4, "slip": 0.5,
    "until": 1e-6, "force": FORCE,
}  # fmt: skip
EACH = 1e-18 * 1.2e9 * 2.0 * 2e-4 * 0.5  # [m] in a passage under FORCE
SUN = {"kind": "wear", "gear": "sun", "tooth": 2, "depth": 0.0, "growth": ARCHARD}
DURATION = 0.3


def wear(planet):
    own = {"gear": "planet", "planet": planet, "tooth": "all", "mesh": "sun"}
    return SUN | own


def loads(scene, **changes):
    """Sum of load over FORCE of each fault in a run, from what has grown."""
    twin = pt.Twin(scene, 1_000.0, 1e-5)
    twin.advance(DURATION, **changes)
    return np.array([*twin.severities.values()]) / EACH


def peaks(scene, tooth=None):
    """Largest force of each mesh of the sun in each passage of `tooth`, or of all teeth.

    While it alone carries the mesh: where the pairs before and after it are beyond the ends of the
    path of contact. A tooth is at the pitch point of planet 1 at a cycle of its number, and at that
    of another planet as much later as that planet is ahead.
    """
    run = pt.simulate(scene, DURATION, 50_000.0, tolerance=1e-5)
    turned = np.unwrap(run.angle[:, run.bodies.index("sun")])
    cycle, angles = 30 * turned / (2 * np.pi), np.array(scene.gearset.planet_angles)
    path = sun_planet_path(scene.gearset.tooth_numbers, scene.gearset.pressure_angle, 1.0)
    teeth, found = range(30) if tooth is None else [tooth], [[], [], []]
    for mesh, ahead in enumerate(30 * (angles - angles[0]) / (2 * np.pi)):
        for middle in [n + ahead % 30 + turn for turn in (0, 30, 60, 90, 120) for n in teeth]:
            past = cycle - middle
            alone = (path.recess - 1.0 < past) & (past < 1.0 - path.approach)
            if cycle[0] < middle - 1.0 and middle + 4.0 < cycle[-1]:  # the last ones grow later
                found[mesh].append(run.mesh_force[alone, mesh].max())
    return found


@pytest.mark.parametrize("speed", [300.0, 1000.0])
def test_wear_follows_the_largest_load_of_its_tooth_in_each_passage(speed):
    """Vibration included: at 1000 rpm, the peaks exceed the mean mesh force by 4 %."""
    scene = PAPER.replace(faults=[SUN], input_speed=pt.rpm(speed))
    expected = peaks(scene.replace(faults=[]), 2)
    (found,) = loads(scene)
    assert found == pytest.approx(sum(map(sum, expected)) / FORCE, rel=0.01)


def test_growth_follows_a_torque_that_is_given():
    """Half the torque of the operating point, at the same speed of the output: half the growth."""
    ports = {"drive.input.port": "torque", "drive.output.port": "motion"}
    found = []
    for torque in (63.0, 31.5):
        twin = pt.Twin(PAPER.replace(faults=[SUN], input_speed=pt.rpm(300.0), **ports))
        begin = twin.advance(DURATION, input_torque=torque).severities  # with the step of torque
        end = twin.advance(0.4).severities  # two turns
        found.append(end["faults.0.depth"] - begin["faults.0.depth"])
    assert found[0] > 5 * EACH
    assert found[1] == pytest.approx(0.5 * found[0], rel=0.03)
