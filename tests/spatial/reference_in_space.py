"""The reference model of a gearbox with helical teeth whose axes tilt: vectors in space.

It adds to `PlanarReference` an axial displacement and two tilts [rad] of sun, ring, carrier and
planets (about x and y, or radial and tangential). Nothing here comes from the package but the
numbers of the scene.
"""

import math

import numpy as np
from planar.reference_in_plane import BEARING_TIME, PlanarReference
from reference_model import OPEN

UP = np.array([0.0, 0.0, 1.0])


class SpatialReference(PlanarReference):
    """Meshes as in `PlanarReference`; friction is left out."""

    def __init__(self, scene):
        gears = scene.gearset
        self.lean = math.tan(gears.helix_angle) * math.cos(gears.pressure_angle)
        super().__init__(scene)
        cosine, n = math.cos(gears.pressure_angle), self.n
        self.overlap = gears.face_width * abs(self.lean) / self.base_pitch
        self.face = gears.face_width**2 / 12.0
        radii = [self.sizes[0] * cosine, self.sizes[2] * cosine, self.radius]
        radii += [self.sizes[1] * cosine] * n
        rim = gears.equivalent_mass
        polar = [rim.sun * self.sizes[0] ** 2, rim.ring * self.sizes[2] ** 2]
        polar += [rim.carrier * self.radius**2] + [rim.planet * self.sizes[1] ** 2] * n
        self.polar, squares = np.array(polar), np.array(radii) ** 2
        supports = [getattr(scene.supports, name) for name in ("sun", "ring", "carrier")]
        supports += [scene.supports.planet] * n
        self.axial = np.array([support.axial for support in supports])
        self.tilting = np.array([support.tilting for support in supports]) * squares
        speeds = np.array([self.ratio[place] for place in (0, n + 1, n + 2, *range(1, n + 1))])
        self.spin = speeds * scene.operating_point.input_speed
        more = [[mass, 0.5 * j, 0.5 * j] for mass, j in zip(self.masses, polar, strict=True)]
        self.inertia = np.append(self.inertia, np.ravel(more))
        self.ratio = np.append(self.ratio, np.zeros(3 * (3 + n)))

    def out(self, b):
        """Index of the axial displacement and the tilts of sun, ring, carrier, or planet b - 3."""
        return self.turns + 2 * (3 + self.n) + 3 * b

    def _contacts(self, cosine, sine):
        super()._contacts(cosine, sine)
        n = self.n
        self.bodies += 3 * (3 + n)
        room = np.zeros((4 * n, 3 * (3 + n)))
        self.rows, self.slides = np.hstack([self.rows, room]), np.hstack([self.slides, room])
        self.slopes = np.zeros_like(self.rows)
        for i in range(4 * n):
            side, ring, p = float(self.flank[i]), (i // n) % 2 == 1, i % n
            outwards = np.array([math.cos(self.psi[p]), math.sin(self.psi[p]), 0.0])
            across = np.cross(UP, outwards)
            flat = (-side if ring else side) * cosine * across + sine * outwards
            normal = flat + side * self.lean * UP
            planet = (3 + p, (self.sizes[1] if ring else -self.sizes[1]) * outwards, True)
            central = (1, self.sizes[2] * outwards, False) if ring else (
                0, self.sizes[0] * outwards, False)  # fmt: skip
            first, second = (planet, central) if ring else (central, planet)
            for (body, arm, own), sense in ((first, side), (second, -side)):
                axes = (outwards, across) if own else np.eye(3)[:2]
                place = self.out(body)
                self.rows[i, place] = sense * normal[2]
                for k, axis in enumerate(axes):
                    self.rows[i, place + 1 + k] = sense * (normal @ np.cross(axis, arm))
                    self.slopes[i, place + 1 + k] = sense * (normal @ np.cross(axis, UP))

    def pairs(self, cycle):
        """Positions and weights of the pairs: means of the trapezoid over the face."""
        s = (cycle - np.floor(cycle))[:, None] + np.arange(-5, 6)
        ramp, half = self.mesh.ramp, 0.5 * self.overlap

        def integral(at):
            corners = (at + self.approach, at + self.approach - ramp,
                       at - self.recess + ramp, at - self.recess)  # fmt: skip
            up, top, falls, ends = (0.5 * np.maximum(corner, 0.0) ** 2 for corner in corners)
            return (up - top - falls + ends) / ramp

        return s, (integral(s + half) - integral(s - half)) / self.overlap

    def stretch(self, angle, speed, side):
        found = super().stretch(angle, speed, side)
        self.stiffness_now = found[2]
        return found

    def rate(self, time, y, side):
        self.side = side
        return super().rate(time, y, side)

    def axes_at(self, x, v):
        """The forces of the plane, then those of axial bearings, tilts and gyroscopes."""
        force, w = super().axes_at(x, v), self.frame
        tau = np.broadcast_to(self.damping_time(v[self.motor]), self.phase.shape)
        slope, rate = self.slopes @ x, self.slopes @ v
        moment = np.where(self.side == OPEN, 0.0, self.stiffness_now * self.face)
        force -= self.slopes.T @ (moment * (slope + tau * rate))
        carrier = self.out(2)
        for b in range(3 + self.n):
            a, polar, diametral = self.out(b), self.polar[b], 0.5 * self.polar[b]
            tilt, turning = complex(*x[a + 1 : a + 3]), complex(*v[a + 1 : a + 3])
            gyration = 1j * (2 * w * diametral - polar * self.spin[b]) * turning
            gyration += (polar * self.spin[b] * w - diametral * w * w) * tilt
            force[a + 1 : a + 3] -= gyration.real, gyration.imag
            lift, lifting, against = x[a], v[a], turning + (1j * w * tilt if b < 3 else 0.0)
            if b > 2:
                by = np.exp(-1j * self.psi[b - 3])  # from x and y to radial and tangential
                base, basing = (by * complex(*y[carrier + 1 : carrier + 3]) for y in (x, v))
                lift += self.radius * base.imag - x[carrier]
                lifting += self.radius * basing.imag - v[carrier]
                tilt, against = tilt - base, against - basing
            push = -self.axial[b] * (lift + BEARING_TIME * lifting)
            turn = -self.tilting[b] * (tilt + BEARING_TIME * against)
            force[a] += push
            force[a + 1 : a + 3] += turn.real, turn.imag
            if b > 2:
                back = (1j * self.radius * push - turn) / by
                force[carrier] -= push
                force[carrier + 1 : carrier + 3] += back.real, back.imag
        return force
