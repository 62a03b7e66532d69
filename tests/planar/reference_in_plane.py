"""The reference model of a gearbox with axes that move: vectors, normals and tangents of flanks.

Absolute angles of `Reference`, then displacements of sun, ring and carrier (x, y in a frame that
turns as the carrier would without vibration) and of the planets (radial from their nominal
positions, tangential along the circle with all of its rotation). Each flank is a contact of its own
with a normal along which its first gear pushes the second, and a tangent, the normal turned by a
right angle. Nothing here comes from the package but the numbers of the scene.
"""

import math

import numpy as np
from planar.rolling_law import element
from reference_model import COAST, DRIVE, OPEN, Reference

BEARING_TIME = 1.25e-5  # [s] damping of a bearing over its stiffness
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)  # over the load zone of rolling elements


class PlanarReference(Reference):
    """Meshes: drive flanks of sun meshes and ring meshes, then their coast flanks."""

    def __init__(self, scene):
        super().__init__(scene)
        n, gears = self.n, scene.gearset
        for name in ("phase", "first", "second", "stiffness", "viscous_time"):
            setattr(self, name, np.tile(getattr(self, name), 2))
        for name in ("external", "rho1", "rho2", "approach", "recess"):
            setattr(self, name, np.tile(getattr(self, name), (2, 1)))
        self.flank = np.repeat([DRIVE, COAST], 2 * n)
        self.turns, self.bodies = self.bodies, self.bodies + 2 * (3 + n)
        self.motor, self.load = self.turns - 2, self.turns - 1
        self.radius = gears.module / 2 * (gears.teeth.sun + gears.teeth.planet)
        self.psi = np.array(gears.planet_angles)
        self.sizes = gears.module / 2 * np.array([gears.teeth.sun, gears.teeth.planet,
                                                  gears.teeth.ring])  # fmt: skip
        supports = [getattr(scene.supports, name) for name in ("sun", "ring", "carrier")]
        supports += [scene.supports.planet] * n
        self.masses = np.array([support.mass for support in supports])
        self.bearing = np.array([support.bearing or 0.0 for support in supports])
        self.rolling = [support.rolling for support in supports]
        self.clearance = np.array([support.clearance for support in supports])
        self.pins = np.array([scene.errors.of_planet(i)[:2] for i in range(n)])
        self.inertia[self.carrier] -= n * gears.planet_mass * self.radius**2
        self.inertia = np.append(self.inertia, np.repeat(self.masses, 2))
        self.frame = self.ratio[self.carrier] * scene.operating_point.input_speed
        self.ratio = np.append(self.ratio, np.zeros(2 * (3 + n)))
        for i in range(n):
            self.ratio[self.at(3 + i) + 1] = self.radius * self.ratio[self.carrier]
        self._contacts(math.cos(gears.pressure_angle), math.sin(gears.pressure_angle))

    def at(self, b):
        """Index of the displacements of sun, ring, carrier, or planet b - 3."""
        return self.turns + 2 * b

    def _contacts(self, cosine, sine):
        """Rows of d and of the sliding by displacements, from normals and tangents."""
        n = self.n
        self.rows = np.zeros((4 * n, self.bodies))
        self.slides = np.zeros((4 * n, self.bodies))
        for i in range(4 * n):
            side, ring, p = float(self.flank[i]), (i // n) % 2 == 1, i % n
            out = np.array([math.cos(self.psi[p]), math.sin(self.psi[p])])
            across = np.array([-out[1], out[0]])
            normal = (-side if ring else side) * cosine * across + sine * out
            tangent = np.array([-normal[1], normal[0]])
            # (body, its angle, arm from its centre to the pitch point, is it a planet)
            planet = (3 + p, 1 + p, (self.sizes[1] if ring else -self.sizes[1]) * out, True)
            central = (1, n + 1, self.sizes[2] * out, False) if ring else (
                0, 0, self.sizes[0] * out, False)  # fmt: skip
            first, second = (planet, central) if ring else (central, planet)
            for (body, angle, arm, own), sense in ((first, side), (second, -side)):
                frame = (out, across) if own else (np.array([1.0, 0.0]), np.array([0.0, 1.0]))
                for direction in range(2):
                    place = self.at(body) + direction
                    self.rows[i, place] += sense * (normal @ frame[direction])
                    self.slides[i, place] += sense * side * (tangent @ frame[direction])
                self.rows[i, angle] += sense * (normal @ np.array([-arm[1], arm[0]]))

    def friction_at(self, force, s, weight, speed):
        """Generalised forces of friction."""
        load = np.maximum(force, 0.0)[:, None] * weight / weight.sum(axis=1, keepdims=True)
        used = load > 1e-9
        rho1 = self.rho1 + s * self.base_pitch
        rho2 = self.rho2 - self.external * s * self.base_pitch
        load, rho1, rho2 = np.where(used, [load, rho1, rho2], [[[1.0]], [[1.0]], [[2.0]]])
        w1 = (speed[self.first] - self.frame)[:, None]
        w2 = (speed[self.second] - self.frame)[:, None]
        relative = speed.copy()
        for i in range(self.n):
            relative[self.at(3 + i) + 1] -= self.radius * self.frame
        slip = (self.slides @ relative)[:, None]
        sliding = rho1 * w1 + self.external * rho2 * w2 + slip
        # The contact moves along a line of action that turns, between points that both move.
        share = (rho1 - self.external * rho2) / (rho1 + self.external * rho2)
        total = rho1 * w1 - self.external * rho2 * w2 + share * slip
        entrain = np.maximum(np.abs(total) / 2, 1e-3)
        radius = 1.0 / (1.0 / rho1 + self.external / rho2)
        f = np.where(used, self.friction(load, radius, entrain, sliding), 0.0)
        force = -self.slides.T @ f.sum(axis=1)
        np.add.at(force, self.first, -(f * rho1).sum(axis=1))
        np.add.at(force, self.second, -(f * self.external * rho2).sum(axis=1))
        return force

    def axes_at(self, x, v):
        """Generalised forces of bearings and of the turning frame."""
        force, w = np.zeros(self.bodies), self.frame
        turned, turning = x[self.carrier], v[self.carrier] - w
        for b, mass in enumerate(self.masses):
            a = self.at(b)
            r, rate = x[a : a + 2].copy(), v[a : a + 2].copy()
            if b < 3:
                self._pull(force, b, r, rate + w * np.array([-r[1], r[0]]), None)
                force[a : a + 2] += mass * (2 * w * np.array([rate[1], -rate[0]]) + w * w * r)
                continue
            out = np.array([math.cos(self.psi[b - 3]), math.sin(self.psi[b - 3])])
            axes = np.array([out, [-out[1], out[0]]])
            r[1] -= self.radius * turned
            rate[1] -= self.radius * w
            moved, moving = (y[self.at(2) : self.at(2) + 2] for y in (x, v))
            between = r - axes @ moved - self.pins[b - 3]
            closing = rate - [0.0, self.radius * turning] - axes @ moving
            self._pull(force, b, between, closing, axes)
            force[a] += mass * (2 * w * rate[1] + w * w * (self.radius + r[0]))
            force[a + 1] += mass * (w * w * r[1] - 2 * w * rate[0])
            force[self.carrier] -= mass * w * w * r[1] * self.radius
        return force

    def _pull(self, force, b, r, rate, axes):
        """Pull body b back by its bearing, and push the carrier on if that is on it."""
        k, size = self.bearing[b], math.hypot(*r)
        if self.rolling[b]:
            self._press_on(force, b, self._roll(b, r, rate, size), axes)
            return
        pull = -k * (r + BEARING_TIME * rate)
        if self.clearance[b] > 0.0:
            unit = r / max(size, 1e-300)
            press = k * (size - self.clearance[b] + BEARING_TIME * (unit @ rate))
            pull = -max(press, 0.0) * unit * (size > self.clearance[b])
        self._press_on(force, b, pull, axes)

    def _roll(self, b, r, rate, size):
        """Force of rolling elements, damped in proportion to their stiffness, by differences."""
        rolling, clearance = self.rolling[b], self.clearance[b]
        if size <= clearance:
            return np.zeros(2)
        count, n, load = element(rolling)
        end = math.acos(clearance / size)
        angle = 0.5 * end * (NODES + 1.0)
        part = count * load / math.pi * 0.5 * end * WEIGHTS * np.cos(angle)
        reach = np.maximum(size * np.cos(angle) - clearance, 0.0)
        push = (part * reach**n).sum()
        stiffness = (part * n * reach ** (n - 1.0) * np.cos(angle)).sum()
        unit = r / size
        across = np.array([-unit[1], unit[0]])
        along = max(push + BEARING_TIME * stiffness * (unit @ rate), 0.0)
        return -along * unit - BEARING_TIME * push / size * (across @ rate) * across

    def _press_on(self, force, b, pull, axes):
        force[self.at(b) : self.at(b) + 2] += pull
        if axes is not None:
            force[self.at(2) : self.at(2) + 2] -= axes.T @ pull
            force[self.carrier] -= pull[1] * self.radius

    def rate(self, time, y, side):
        m = self.bodies
        x, v, trim = y[:m], y[m:-1], y[-1]
        tau = self.damping_time(v[self.motor])
        d, rate, k, s, weight = self.stretch(x, v, self.flank)
        force = np.where(side == OPEN, 0.0, k * (side * d - self.half + tau * side * rate))
        on = -self.rows.T @ (side * force) + self.axes_at(x, v)
        if self.scene.lubrication.friction:
            on += self.friction_at(force, s, weight, v)
        for machine, shaft, body in zip(
            self.machines, self.shafts, (self.motor, self.load), strict=True
        ):
            twist = machine.coupling_stiffness * (x[body] - x[shaft])
            twist += machine.coupling_damping * (v[body] - v[shaft])
            on[body] -= twist
            on[shaft] += twist
        point, order = self.point, self.scene.drive.speed_control.ripple_order
        lag = point.input_speed - v[self.motor]
        on[self.motor] += point.input_torque
        on[self.motor] += point.torque_ripple * math.sin(order * x[self.motor])
        on[self.motor] += self.total * self.bandwidth * lag
        trimmed = point.input_torque - self.total * self.bandwidth**2 / 4 * trim
        on[self.load] -= trimmed / self.ratio[self.load]
        on[self.held] = 0.0
        return np.concatenate([v, on / self.inertia, [lag]])

    def margin(self, y, i, side):
        m = self.bodies
        tau = np.broadcast_to(self.damping_time(y[m + self.motor]), self.phase.shape)[i]
        d, rate = self.rows[i] @ y[:m], self.rows[i] @ y[m:-1]
        own = self.flank[i] * d
        push = own + self.flank[i] * tau * rate
        return push - self.half if side[i] != OPEN else self.half - min(own, push)

    def closed_side(self, i, d):
        return self.flank[i]
