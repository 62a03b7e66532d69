"""The scene `paper` as a linear system: one stiffness per mesh, flanks that stay together.

Bodies in absolute angles: sun, planets, ring, motor, load; the carrier stands. Nothing here comes
from the package but the numbers of the scene.
"""

import numpy as np
from scipy.linalg import expm
from stability.sound import base_radius, per_mesh, stiffnesses


class LinearTrain:
    """M th'' + C th' + K th = torque, with d = rows @ th."""

    def __init__(self, scene):
        gears, drive = scene.gearset, scene.drive
        n, teeth, mass = gears.planets, gears.teeth, gears.equivalent_mass
        radii = [base_radius(scene, z) for z in (teeth.sun, teeth.planet, teeth.ring)]
        pitch = [0.5 * gears.module * z for z in (teeth.sun, teeth.planet, teeth.ring)]
        sun, ring, motor, load = 0, n + 1, n + 2, n + 3
        self.bodies, self.motor, self.load, self.scene = n + 4, motor, load, scene
        self.rows = np.zeros((2 * n, self.bodies))
        for i in range(n):
            self.rows[i, [sun, 1 + i]] = radii[0], radii[1]
            self.rows[n + i, [1 + i, ring]] = -radii[1], radii[2]
        inertia = [mass.sun * pitch[0] ** 2, *[mass.planet * pitch[1] ** 2] * n]
        inertia += [mass.ring * pitch[2] ** 2, drive.input.inertia, drive.output.inertia]
        self.inertia = np.array(inertia)
        self.mesh_stiffness = stiffnesses(scene)
        self.mesh_tau = self._damping_times(mass)
        self.shafts = np.zeros((2, self.bodies))
        self.shafts[0, [motor, sun]] = self.shafts[1, [load, ring]] = 1.0, -1.0
        machines = (drive.input, drive.output)
        self.shaft_stiffness = np.array([m.coupling_stiffness for m in machines])
        self.shaft_damping = np.array([m.coupling_damping for m in machines])
        self.ratio = -teeth.sun / teeth.ring

    def _damping_times(self, mass):
        """tau of c = tau k, viscous: of each mesh on its own two gears."""
        law, slant = self.scene.mesh.damping, np.cos(self.scene.gearset.pressure_angle) ** 2
        sun, planet, ring = mass.sun / slant, mass.planet / slant, mass.ring / slant
        pairs = per_mesh(self.scene, sun * planet / (sun + planet), planet * ring / (planet + ring))
        return 2.0 * law.damping_ratio * np.sqrt(pairs / self.mesh_stiffness)

    def matrices(self):
        """K and C."""
        k, c = self.mesh_stiffness, self.mesh_stiffness * self.mesh_tau
        stiffness = self.rows.T * k @ self.rows
        damping = self.rows.T * c @ self.rows
        stiffness += self.shafts.T * self.shaft_stiffness @ self.shafts
        damping += self.shafts.T * self.shaft_damping @ self.shafts
        return stiffness, damping

    def system(self):
        """A of y' = A y + b, y = (angles, speeds)."""
        stiffness, damping = self.matrices()
        n = self.bodies
        a = np.zeros((2 * n, 2 * n))
        a[:n, n:] = np.eye(n)
        a[n:, :n], a[n:, n:] = -stiffness / self.inertia[:, None], -damping / self.inertia[:, None]
        return a

    def push(self, torque):
        """b for a torque of the motor that the load balances [N m]."""
        b = np.zeros(2 * self.bodies)
        b[self.bodies + self.motor] = torque / self.inertia[self.motor]
        b[self.bodies + self.load] = -torque / self.ratio / self.inertia[self.load]
        return b

    def after_step(self, torque, times):
        """Growth of d of every mesh at equally spaced `times` after a step of the torque."""
        n = 2 * self.bodies
        augmented = np.zeros((n + 1, n + 1))
        augmented[:n, :n], augmented[:n, n] = self.system(), self.push(torque)
        advance, y = expm(augmented * (times[1] - times[0])), np.append(np.zeros(n), 1.0)
        y = expm(augmented * times[0]) @ y
        result = []
        for _ in times:
            result.append(self.rows @ y[: self.bodies])
            y = advance @ y
        return np.array(result)
