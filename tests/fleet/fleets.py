"""Fleets of simulated gearboxes with hidden friction and sensor errors."""

import numpy as np

import planetary_twin_py as pt
from planetary_twin_py.fleet.fleet import Fleet
from planetary_twin_py.following.loss_map import loss_map

NOISE = 0.1, 0.25  # [N m] of a row
FULL = 100.0, 250.0  # [N m]


def paper(**changes):
    """Scene `paper` with the friction laws of the follower."""
    laws = {"lubrication.boundary": "load_sharing", "lubrication.lambda_ratio": "computed"}
    return pt.load_scene("paper").replace(**(laws | changes))


class Played:
    """A fleet with simulated readings."""

    def __init__(self, count, seed, true_scene=None, period=1.0):
        self.chance = np.random.default_rng(seed)
        normal = self.chance.standard_normal
        self.scene, self.count, self.period = paper(), count, period
        self.table = loss_map(true_scene or self.scene)
        self.zero = 5e-4 * np.array(FULL)[:, None] * normal((2, count))
        self.gain = 1e-3 * normal((2, count))
        self.friction = 1.0 + 0.1 * normal(count)
        self.wander = normal(count)
        self.ratio = Fleet(self.scene, 1).train.ratio

    def row(self, time):
        """Readings of all at a time; the load wanders by 5 %, the oil by 8 K in an hour."""
        torque = self.torque(time)
        speed = np.full(self.count, 104.7)
        oil = np.full(self.count, 343.15 + 8.0 * np.sin(2.0 * np.pi * time / 3600.0))
        losses = self.table(torque, speed, oil)
        lost = self.friction * losses.teeth + losses.rest
        noise = self.chance.standard_normal((2, self.count))
        return {
            "input_torque": torque * (1.0 + self.gain[0]) + self.zero[0] + NOISE[0] * noise[0],
            "output_torque": (lost - torque) / self.ratio * (1.0 + self.gain[1])
            + self.zero[1]
            + NOISE[1] * noise[1],
            "input_speed": speed,
            "oil_temperature": oil,
        }

    def torque(self, time):
        """True input torques at a time [N m]."""
        keep = np.exp(-self.period / 60.0)
        self.wander *= keep
        self.wander += np.sqrt(1.0 - keep**2) * self.chance.standard_normal(self.count)
        return 63.0 * (1.0 + 0.05 * self.wander)

    def level(self):
        """True friction levels at the operating point of the scene."""
        at = [np.full(self.count, value) for value in (63.0, 104.72, 343.15)]
        true, nominal = self.table(*at), loss_map(self.scene)(*at)
        return (self.friction * true.teeth + true.rest - nominal.rest) / nominal.teeth


class Alternating(Played):
    """A fleet whose torque alternates every five minutes, at other times for each gearbox."""

    def torque(self, time):
        phase = np.linspace(0.0, 600.0, self.count, endpoint=False)
        high = (time + phase) % 600.0 < 300.0
        return np.where(high, 80.0, 40.0) + 2.0 * self.chance.standard_normal(self.count)
