"""Static loads against closed forms, and against equations of motion without acceleration."""

import numpy as np
import pytest
from reference_model import Reference
from scipy.optimize import root

import planetary_twin_py as pt
from planetary_twin_py.model.layout import Layout

PAPER = pt.load_scene("paper").replace(dynamics="quasi_static")
OMEGA = PAPER.operating_point.input_speed
FORCE = Layout(PAPER).mesh_force(63.0)  # mean [N]
STIFFNESS = 2e8  # of one pair [N/m]


def twisted(reference, angle):
    """All angles where the motor is at `angle`, rigid but for the coupling of the motor."""
    scene = reference.scene
    angles = reference.ratio * angle
    twist = scene.operating_point.input_torque / scene.drive.input.coupling_stiffness
    return angles - np.append(reference.ratio[:-2] * twist, [0.0, 0.0])


@pytest.mark.parametrize("backlash", [0.0, 2e-7, 1e-3])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_rectangular_stiffness_has_the_closed_form(backlash, sense):
    """Planets in parallel, the two meshes of each in series, half the backlash on the flank."""
    changes = {"mesh.ramp": 0.0, "lubrication.friction": False}
    scene = PAPER.replace(**changes, backlash=backlash, input_torque=sense * 63.0)
    run = pt.simulate(scene, 0.01)
    reference = Reference(scene.replace(**{"mesh.ramp": 0.03}))  # for where the pairs are
    side = np.full(6, int(sense))
    for row, time in enumerate(run.time):
        cycle = reference.cycle(twisted(reference, OMEGA * time), side)
        s, _ = reference.pairs(cycle)
        count = ((s > -reference.approach) & (s < reference.recess)).sum(axis=1)
        k = STIFFNESS * (1.0 + 0.75 * (count - 1.0))
        spring = 1.0 / (1.0 / k[:3] + 1.0 / k[3:])
        force = sense * np.tile(3.0 * FORCE * spring / spring.sum(), 2)
        assert run.mesh_force[row] == pytest.approx(force, rel=1e-9)
        dte = sense * 0.5 * backlash + force / k
        assert run.dte[row] == pytest.approx(dte, rel=1e-9)


def test_equal_planets_share_equally():
    scene = PAPER.replace(**{"mesh.double_pair_ratio": 1.0, "lubrication.friction": False})
    run = pt.simulate(scene, 0.01)
    assert run.mesh_force == pytest.approx(np.full((500, 6), FORCE), rel=1e-12)
    assert run.dte == pytest.approx(np.full((500, 6), 1e-7 + FORCE / STIFFNESS), rel=1e-12)


class Still(Reference):
    """Where no body is accelerated, by a root of the equations of motion."""

    def __init__(self, scene):
        super().__init__(scene)
        # The motor stays at its angle; held is the carrier.
        self.free = [j for j in range(self.bodies) if j not in (self.held, self.bodies - 2)]
        self.driven = [j for j in range(self.bodies) if j != self.held]
        self.guess = None

    def at(self, time):
        """Angles and friction torques."""
        angles, speed = self.ratio * OMEGA * time, self.ratio * OMEGA
        unit = 1e-6 / self.base_pitch

        def state(z):
            moved = angles.copy()
            moved[self.free] += unit * z[:-1]
            return np.concatenate([moved, speed, [1e-3 * z[-1]]])

        def torques(z):
            rate = self.rate(time, state(z), np.ones(2 * self.n, dtype=int))
            return (rate[self.bodies : -1] * self.inertia)[self.driven]

        start = np.zeros(len(self.free) + 1) if self.guess is None else self.guess
        if self.guess is None:
            twist = twisted(self, 0.0)[self.free] / unit
            start[:-1] = twist
        found = root(torques, start, method="hybr", options={"xtol": 1e-13})
        assert np.abs(found.fun).max() < 1e-7
        self.guess = found.x
        return state(found.x)

    def seen(self, time):
        """DTE, mesh forces, and the power that friction takes."""
        y = self.at(time)
        d, _, k, s, weight = self.stretch(y[: self.bodies], y[self.bodies : -1], np.ones(6))
        force = k * (d - self.half)
        speed = y[self.bodies : -1]
        return d, force, -(self.friction_torques(force, s, weight, speed) @ speed)


def test_forces_are_those_of_bodies_that_do_not_accelerate():
    run, still = pt.simulate(PAPER, 0.004, tolerance=1e-8), Still(PAPER)
    for row in range(0, len(run.time), 7):
        dte, force, loss = still.seen(run.time[row])
        assert run.dte[row] == pytest.approx(dte, rel=1e-8)
        assert run.mesh_force[row] == pytest.approx(force, rel=1e-7)
        assert run.power_loss[row].sum() == pytest.approx(loss, rel=1e-7)
