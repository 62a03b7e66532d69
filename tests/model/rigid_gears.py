"""A drive with rigid gears: motors and load on their couplings, after Willis and Lagrange.

Nothing here comes from the package but the numbers of the scene.
"""

import numpy as np
from scipy.linalg import cholesky, expm, solve_triangular


class RigidGears:
    """M q'' + C q' + K q = 0, q: angles of the driven members, of motors and of the load."""

    def __init__(self, scene, bandwidth):
        gears, drive = scene.gearset, scene.drive
        inputs = [drive.input] + [drive.second_input] * (drive.second_input is not None)
        self.axes, machines = len(inputs), [*inputs, drive.output]
        member = self._members(gears, [machine.member for machine in inputs])
        count = self.axes + len(machines)
        inertia = np.zeros((count, count))
        inertia[: self.axes, : self.axes] = self._gears(gears, member)
        total = inertia[: self.axes, : self.axes].copy()
        self.mass, self.damping, self.stiffness = inertia, *np.zeros((2, count, count))
        for n, machine in enumerate(machines, self.axes):
            inertia[n, n] = machine.inertia
            total += machine.inertia * np.outer(member[machine.member], member[machine.member])
            twist = np.zeros(count)
            twist[n], twist[: self.axes] = 1.0, -member[machine.member]
            self.stiffness += machine.coupling_stiffness * np.outer(twist, twist)
            self.damping += machine.coupling_damping * np.outer(twist, twist)
        self._close(total, self._load_share(gears, machines), 2.0 * np.pi * bandwidth)

    def _close(self, total, share, w):
        """The speed loop: motors have their own gains, the load's torque follows the first."""
        self.scale = self.stiffness + w**2 * self.mass  # of positions, to compare with speeds
        for axis in range(self.axes):
            motor = self.axes + axis
            self.damping[motor, motor] += total[axis, axis] * w
            if axis:
                self.stiffness[motor, motor] += total[axis, axis] * w**2 / 4.0
            else:
                self.stiffness[-1, motor] -= share * total[axis, axis] * w**2 / 4.0

    @staticmethod
    def _members(gears, driven):
        """Speeds of sun, ring and carrier per speed of each driven member, (axes,) each."""
        teeth, names = gears.teeth, ("sun", "ring", "carrier")
        rows = [[teeth.sun, teeth.ring, -(teeth.sun + teeth.ring)]]  # Willis
        fixed = [*driven, *([] if gears.held == "none" else [gears.held])]
        rows += [[float(name == one) for name in names] for one in fixed]
        speeds = np.linalg.solve(np.array(rows), np.eye(3)[:, 1 : 1 + len(driven)])
        return dict(zip(names, speeds, strict=True))

    @staticmethod
    def _gears(gears, member):
        mass, teeth, count = gears.equivalent_mass, gears.teeth, gears.planets
        radius = {
            name: 0.5 * gears.module * getattr(teeth, name) for name in ("sun", "planet", "ring")
        }
        orbit = radius["sun"] + radius["planet"]
        spin = member["carrier"] - teeth.sun / teeth.planet * (member["sun"] - member["carrier"])
        turning = {
            "sun": (mass.sun * radius["sun"] ** 2, member["sun"]),
            "ring": (mass.ring * radius["ring"] ** 2, member["ring"]),
            "carrier": ((mass.carrier + count * gears.planet_mass) * orbit**2, member["carrier"]),
            "planet": (count * mass.planet * radius["planet"] ** 2, spin),
        }
        return sum(inertia * np.outer(speed, speed) for inertia, speed in turning.values())

    @staticmethod
    def _load_share(gears, machines):
        """Torque of the load per torque of the first motor: as the teeth."""
        teeth = gears.teeth
        part = {"sun": teeth.sun, "ring": teeth.ring, "carrier": -(teeth.sun + teeth.ring)}
        return part[machines[-1].member] / part[machines[0].member]

    def growth(self, time):
        """Largest factor by which a motion grows in `time` [s], by its energy."""
        count = len(self.mass)
        matrix = np.zeros((2 * count, 2 * count))
        matrix[:count, count:] = np.eye(count)
        matrix[count:, :count] = -np.linalg.solve(self.mass, self.stiffness)
        matrix[count:, count:] = -np.linalg.solve(self.mass, self.damping)
        root = np.zeros_like(matrix)
        root[:count, :count], root[count:, count:] = cholesky(self.scale), cholesky(self.mass)
        matrix = root @ solve_triangular(root.T, matrix.T, lower=True).T
        halvings = max(int(np.ceil(np.log2(np.abs(matrix).max() * time))), 0)
        step = expm(matrix * time / 2.0**halvings)
        for _ in range(halvings):
            step = step @ step
        return np.linalg.norm(step, 2)
