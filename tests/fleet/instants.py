"""Fleets on a heavy drive whose speed wanders within a few seconds."""

import numpy as np

import planetary_twin_py as pt
from planetary_twin_py.fleet.fleet import Fleet
from planetary_twin_py.following.loss_map import loss_map

STEP = 0.1  # [s] of the simulated speed
GUST, LAG = 5.0, 1.0  # [s] time constants of the wander, and with which the drive follows


class Wandering:
    """Gearboxes of scene `wind_turbine_stage`; T_in - J dw/dt + i T_out is the loss.

    Sensors have the accuracy that `Sensors` states. The speed scatters by `wander` times its mean.
    """

    def __init__(self, count, seed, wander):
        self.chance, self.wander = np.random.default_rng(seed), wander
        normal = self.chance.standard_normal
        self.scene, self.count = pt.load_scene("wind_turbine_stage"), count
        self.train, self.table = Fleet(self.scene, 1).train, loss_map(self.scene)
        full = 1.6 * self.train.torque * np.array([1.0, 1.0 / self.train.ratio])[:, None]
        self.noise, self.zero = 1e-3 * full, 5e-4 * full * normal((2, count))
        self.gain = 1e-3 * normal((2, count))
        self.friction = 1.0 + 0.1 * normal(count)
        self.load, self.gust, self.speed = normal(count), normal(count), np.zeros(count)

    def rows(self, period, duration, mean):
        """Times and readings: means over the period, or instants at its end."""
        steps = round(period / STEP)
        for number in range(1, round(duration / period) + 1):
            course = np.array([self._advance() for _ in range(steps)])
            torque, acceleration, speed = course.mean(axis=0) if mean else course[-1]
            yield number * period, self._row(torque, acceleration, speed)

    def _advance(self):
        """Torque of the train, acceleration and speed after one step, (3, n)."""
        for wander, memory in ((self.load, 60.0), (self.gust, GUST)):
            keep = np.exp(-STEP / memory)
            wander *= keep
            wander += np.sqrt(1.0 - keep**2) * self.chance.standard_normal(self.count)
        scale = self.wander * self.train.speed * np.sqrt(1.0 + LAG / GUST)  # of the lagging speed
        acceleration = (scale * self.gust - self.speed) / LAG
        self.speed = self.speed + STEP * acceleration
        torque = self.train.torque * (0.9 + 0.05 * self.load)
        return np.array([torque, acceleration, self.train.speed + self.speed])

    def _row(self, torque, acceleration, speed):
        oil = np.full(self.count, self.train.oil_temperature)
        losses = self.table(torque, speed, oil)
        lost = self.friction * losses.teeth + losses.rest
        ends = torque + self.train.inertia * acceleration, (lost - torque) / self.train.ratio
        noise = self.noise * self.chance.standard_normal((2, self.count))
        ends = np.array(ends) * (1.0 + self.gain) + self.zero + noise
        return {
            "input_torque": ends[0],
            "output_torque": ends[1],
            "input_speed": speed,
            "oil_temperature": oil,
        }
