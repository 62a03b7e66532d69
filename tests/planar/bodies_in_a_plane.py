"""Another model of a planetary gear set in the plane: bodies with positions, forces at points.

Sun, ring, carrier and planets have a displacement (x, y) and a rotation each, in a frame that turns
at a constant speed. Gears push each other at the pitch point along the normals of their flanks;
pins pull planets to points of the carrier that turn with it. Forces act at points, their moments
follow from the arms: no row, no base radius coordinate, no matrix.
"""

from dataclasses import dataclass, field

import numpy as np


@dataclass
class Bodies:
    """Data in SI; arrays over sun, ring, carrier, then planets."""

    planet_angles: tuple
    pressure_angle: float
    pitch_radius: dict  # sun, planet, ring
    mass: np.ndarray
    inertia: np.ndarray
    bearing: np.ndarray  # of sun, ring, carrier to the housing, of each planet to its pin [N/m]
    mesh: float  # [N/m]
    half_backlash: float = 0.0
    torsion: np.ndarray = field(default_factory=lambda: np.zeros(3))  # of the first three [N m/rad]
    speed: float = 0.0  # of the frame and the carrier [rad/s]
    torque: np.ndarray = field(default_factory=lambda: np.zeros(3))
    pin_error: np.ndarray | None = None  # (planets, 2) x, y [m]
    damping_time: float = 0.0  # of meshes and bearings [s]
    linear: bool = False  # flanks push and pull, as in small vibration about a load

    @property
    def radius(self):
        """Of the circle of the planets' centres [m]."""
        return self.pitch_radius["sun"] + self.pitch_radius["planet"]


def cross(turn, arm):
    """k x arm times turn."""
    return turn * np.array([-arm[1], arm[0]])


def moment(arm, force):
    return arm[0] * force[1] - arm[1] * force[0]


class Forces:
    """Forces and moments on all bodies at displacements q (bodies, 3) and rates."""

    def __init__(self, data, q, v):
        self.data, self.q, self.v = data, q, v
        self.on = np.zeros_like(q)
        self.flank = np.zeros((2, 2 * len(data.planet_angles)))  # drive and coast, each mesh [N]
        for i, psi in enumerate(data.planet_angles):
            out = np.array([np.cos(psi), np.sin(psi)])
            self.push(i, 0, 3 + i, out, data.pitch_radius["sun"], ring=False)
            self.push(i, 3 + i, 1, out, data.pitch_radius["ring"], ring=True)
            self.pin(i, out)
        for b in range(3):
            spring = data.bearing[b]
            pull = -spring * (q[b, :2] + data.damping_time * v[b, :2])
            pull -= spring * data.damping_time * cross(data.speed, q[b, :2])  # in the housing
            self.on[b, :2] += pull
            self.on[b, 2] += data.torque[b] - data.torsion[b] * q[b, 2]
        self.inertial()

    def push(self, i, first, second, out, pitch, ring):
        data = self.data
        across = np.array([-out[1], out[0]])
        point = pitch * out
        arms = [point - (data.radius * out if b >= 3 else 0.0) for b in (first, second)]
        for row, side in enumerate((1.0, -1.0)):
            lean = -side if ring else side
            normal = lean * np.cos(data.pressure_angle) * across
            normal = normal + np.sin(data.pressure_angle) * out

            def closing(x, arms=arms, normal=normal):
                a = x[first, :2] + cross(x[first, 2], arms[0])
                b = x[second, :2] + cross(x[second, 2], arms[1])
                return normal @ (a - b)

            squeeze = closing(self.q) - data.half_backlash
            if data.linear:
                squeeze = closing(self.q) if side > 0.0 else 0.0
            elif squeeze <= 0.0:
                continue
            if data.linear and side < 0.0:
                continue
            force = data.mesh * (squeeze + data.damping_time * closing(self.v))
            if not data.linear:
                force = max(force, 0.0)
            self.flank[row, i + (len(data.planet_angles) if ring else 0)] = force
            for body, arm, sense in ((first, arms[0], -1.0), (second, arms[1], 1.0)):
                self.on[body, :2] += sense * force * normal
                self.on[body, 2] += moment(arm, sense * force * normal)

    def pin(self, i, out):
        data, planet = self.data, 3 + i
        turn = self.q[2, 2]
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        arm = rotation @ (data.radius * out)
        error = np.zeros(2) if data.pin_error is None else data.pin_error[i]
        stretch = data.radius * out + self.q[planet, :2] - (self.q[2, :2] + arm + error)
        rate = self.v[planet, :2] - self.v[2, :2] - cross(self.v[2, 2], arm)
        pull = data.bearing[planet] * (stretch + data.damping_time * rate)
        self.on[planet, :2] -= pull
        self.on[2, :2] += pull
        self.on[2, 2] += moment(arm, pull)

    def inertial(self):
        """Coriolis and centrifugal forces."""
        data = self.data
        for b in range(len(data.mass)):
            place = self.q[b, :2].copy()
            if b >= 3:
                psi = data.planet_angles[b - 3]
                place += data.radius * np.array([np.cos(psi), np.sin(psi)])
            coriolis = -2.0 * cross(data.speed, self.v[b, :2])
            self.on[b, :2] += data.mass[b] * (coriolis + data.speed**2 * place)

    def accelerations(self):
        inertia = np.column_stack([self.data.mass, self.data.mass, self.data.inertia])
        return self.on / inertia


def rates(data, state, free):
    """Time derivative of the free coordinates and their rates, (2 free,)."""
    count = len(data.mass)
    q, v = np.zeros(3 * count), np.zeros(3 * count)
    q[free], v[free] = np.split(np.asarray(state), 2)
    found = Forces(data, q.reshape(count, 3), v.reshape(count, 3)).accelerations().ravel()
    return np.concatenate([v[free], found[free]])


def jacobian(data, state, free, step):
    """Central differences; `step` (2 free,) of each entry."""
    columns = []
    for k, h in enumerate(step):
        up, down = state.copy(), state.copy()
        up[k] += h
        down[k] -= h
        columns.append((rates(data, up, free) - rates(data, down, free)) / (2.0 * h))
    return np.array(columns).T
