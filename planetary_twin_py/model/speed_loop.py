"""The speed loop of the drive: gains, default bandwidth, stability.

Each motor has a proportional controller of its speed; the integral of its speed error trims the
load of the first input and the motor of the second. Where a torque is given at one port, the
machine at the other has both parts; where a motion is given, it has none. The second motor has
both, unless the motions of both other shafts are given. With J the
inertia of the train at a motor and w = 2 pi bandwidth, the gains J w and J w^2/4 make the loop
critically damped on a rigid train.

The train is not rigid. For motor and load of total inertia J on one shaft of stiffness k, the loop
is stable if J w^2/4 < k (Routh-Hurwitz), for any division of the inertia: a faster integrator moves
the load before the motor responds. For a whole train the limit follows from the eigenvalues of

    M x'' + (C + w P) x' + (K + w^2 I) x = 0

in the coordinates of `Train`, with P of the proportional controllers and I of the integrators.
The meshes have their mean stiffness and stay in contact; drag and tooth friction are omitted.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from .._core import AXES, MACHINES, Train, damping_time
from ..scene import Scene
from ..scene.drive import MOVED
from .layout import LOAD_MACHINE, MOTOR, SECOND_MOTOR, Layout
from .mean_stiffness import mean_stiffness

FASTEST_DEFAULT = 3.0  # [Hz]
# Bandwidth up to which a loop must be stable, relative to its own. A factor of sqrt(2) in the
# bandwidth is a factor of 2 in the integrator: the usual gain margin of 6 dB (Astrom and Murray
# 2008, Feedback Systems, section 9.3). At a margin of 4, motor and load on one shaft have real
# eigenvalues of the loop, between -w and -0.38 w; on a rigid train both are -0.5 w.
LEAST_MARGIN = math.sqrt(2.0)
DEFAULT_MARGIN = 4.0
SLOWEST = 1e-9  # [Hz] lower limit of the search for a stable bandwidth
BISECTIONS = 40
IMMOVABLE = 1e6  # mass of a shaft whose motion is given, over that of the train
ROUNDING = 1e-12  # growth rates below it, over the largest eigenvalue, are rounding


class Gains(NamedTuple):
    """Gains of the speed loop of a train."""

    inertia: np.ndarray  # of the whole train at the motors [kg m^2], (AXES, AXES)
    proportional: np.ndarray  # of each motor [N m s/rad], (AXES,)
    trim: np.ndarray  # torque per integral of a speed error [N m/rad], (MACHINES, AXES)
    load_proportional: float  # of a load that holds the speed alone [N m s/rad]


class Loop(NamedTuple):
    """Matrices of a linearised train and of its speed loop, (bodies, bodies) each.

    In coordinates of unit mass; the first of them are rigid rotations of the train.
    """

    damping: np.ndarray  # C [1/s]
    stiffness: np.ndarray  # K [1/s^2]
    proportional: np.ndarray  # P [-]
    integral: np.ndarray  # I [-]

    def eigenvalues(self, bandwidth: float) -> np.ndarray:
        """Eigenvalues [1/s] of the closed loop at a `bandwidth` [Hz], shape (2 bodies,)."""
        w, n = 2.0 * math.pi * bandwidth, len(self.stiffness)
        matrix = np.zeros((2 * n, 2 * n))
        matrix[:n, n:] = np.eye(n)
        matrix[n:, :n] = -self.stiffness - w**2 * self.integral
        matrix[n:, n:] = -self.damping - w * self.proportional
        return np.asarray(np.linalg.eigvals(matrix))

    def is_stable(self, bandwidth: float) -> bool:
        """Whether no eigenvalue at a `bandwidth` [Hz] has a positive real part."""
        found = self.eigenvalues(bandwidth)
        return bool(found.real.max() <= ROUNDING * np.abs(found).max())

    def limit(self, highest: float) -> float:
        """Largest stable bandwidth [Hz] up to `highest` [Hz]; 0 if none of the search is."""
        if self.is_stable(highest):
            return highest
        slowest = min(SLOWEST, highest)
        if not self.is_stable(slowest):
            return 0.0
        low, high = math.log(slowest), math.log(highest)
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.is_stable(math.exp(middle)) else (low, middle)
        return math.exp(low)


def default_bandwidth(layout: Layout, train: Train) -> float:
    """Bandwidth of the speed loop where a scene gives none.

    It is 3 Hz, or a quarter of the largest stable bandwidth if that is lower, rounded down to two
    digits. Mesh damping that depends on speed is taken at the highest speed that the drive allows,
    where it is lowest.

    Args:
        layout: of the scene. Of its operating point only the torque has an effect, and only if the
            stiffness of the teeth depends on it.
        train: of the scene, with held axes.

    Returns:
        The bandwidth [Hz].
    """
    if not holds_a_speed(layout.scene):
        return FASTEST_DEFAULT  # of no effect
    fastest = layout.scene.drive.speed_limit
    loop = LinearTrain(layout, train).loop(
        float(np.abs(train.cycles).sum()) * fastest / (2.0 * math.pi)
    )
    # Growth at a high bandwidth may be less than the rounding of its fast decay.
    tried = [margin * FASTEST_DEFAULT for margin in (DEFAULT_MARGIN, LEAST_MARGIN, 1.0)]
    limit = min([found for high in tried if (found := loop.limit(high)) < high] or tried[:1])
    return rounded_down(max(limit / DEFAULT_MARGIN, SLOWEST))


def holds_a_speed(scene: Scene) -> bool:
    """Whether a machine controls a speed.

    Args:
        scene: scene of the drive.
    """
    ports = scene.drive.ports
    second = scene.drive.second_input is not None and ports.hold_second_speed
    return ports.hold_speed or second


def speed_loop_gains(layout: Layout, train: Train, bandwidth: float) -> Gains:
    """Gains of the speed loop.

    Args:
        layout: of the scene.
        train: of the layout.
        bandwidth: of the loop [Hz].

    Returns:
        The gains, which make the loop critically damped on a rigid train.
    """
    w, axes = 2.0 * math.pi * bandwidth, int(train.axes)
    inertia = np.einsum("j,ja,jb->ab", train.mass * train.radius**2, train.ratio, train.ratio)
    integral = np.diag(inertia) * w**2 / 4.0
    trim = np.zeros((MACHINES, AXES))
    if layout.scene.drive.ports.given:
        return _gains_with_ports(layout.scene, train, inertia, w)
    # The first motor gives its torque only; the load is trimmed to hold the speed.
    trim[LOAD_MACHINE, 0] = -layout.machine_torques[LOAD_MACHINE] * integral[0]
    if axes > 1:
        trim[SECOND_MOTOR, 1] = integral[1]
    return Gains(inertia, np.diag(inertia) * w, trim, 0.0)


def _gains_with_ports(scene: Scene, train: Train, inertia: np.ndarray, w: float) -> Gains:
    """Gains where torque or motion is given at a port; w = 2 pi bandwidth [rad/s]."""
    ports, total = scene.drive.ports, float(inertia[0, 0])
    gains = Gains(np.zeros((AXES, AXES)), np.zeros(AXES), np.zeros((MACHINES, AXES)), 0.0)
    if train.axes > 1 and ports.hold_second_speed:
        gains.inertia[1, 1] = inertia[1, 1]
        gains.proportional[1] = inertia[1, 1] * w
        gains.trim[SECOND_MOTOR, 1] = inertia[1, 1] * w**2 / 4.0
    if not ports.hold_speed:
        return gains
    if ports.input == "machine":
        gains.inertia[0, 0], gains.proportional[0] = total, total * w
        gains.trim[MOTOR, 0] = total * w**2 / 4.0
        return gains
    ratio = float(train.ratio[train.coupling[LOAD_MACHINE, 0], 0])
    gains.trim[LOAD_MACHINE, 0] = total * w**2 / 4.0 / ratio
    return gains._replace(load_proportional=total * w / ratio**2)


class LinearTrain:
    """The linearised train with its speed loop, at any speed.

    Args:
        layout: of the scene.
        train: of the layout, with held axes.
    """

    def __init__(self, layout: Layout, train: Train) -> None:
        meshes, machines = train.meshes, train.machines
        coupling, found = slice(machines), mean_stiffness(train)
        mesh = (train.copies * train.stiffness_factor * found[train.kind])[:meshes]
        springs = np.concatenate([mesh, train.coupling_stiffness[coupling]])
        rows = np.zeros((meshes + machines, train.bodies + 1))  # elongation of each spring
        place = meshes + np.arange(machines)[:, None]
        np.add.at(rows, (np.arange(meshes)[:, None], train.body[:meshes]), train.sign[:meshes])
        np.add.at(rows, (place, train.coupling[coupling]), [1.0, -1.0])
        basis = _basis(train, _masses(layout.scene, train))
        stretch = rows[:, :-1] @ basis  # the ground is at rest
        stretch[:, : train.axes] = 0.0  # rigid motion: exactly zero, without rounding
        self._train, self._mesh, self._stretch = train, mesh, stretch
        self._stiffness = (stretch.T * springs) @ stretch
        self._proportional, self._integral = (
            basis.T @ gain @ basis for gain in _feedback(layout, train)
        )

    def loop(self, mesh_frequency: float) -> Loop:
        """The loop at a speed.

        Args:
            mesh_frequency: meshing frequency [Hz], on which mesh damping may depend.

        Returns:
            Matrices, which give the eigenvalues at any bandwidth.
        """
        train, stretch = self._train, self._stretch
        tau = np.array([damping_time(train, kind, mesh_frequency) for kind in range(2)])
        shafts = train.coupling_damping[: train.machines]
        dampers = np.concatenate([self._mesh * tau[train.kind[: train.meshes]], shafts])
        damping = (stretch.T * dampers) @ stretch
        return Loop(damping, self._stiffness, self._proportional, self._integral)


def _masses(scene: Scene, train: Train) -> np.ndarray:
    """Masses of the bodies [kg], (bodies,); very large where motion is given."""
    mass = train.mass[: train.bodies].copy()
    for place, port in enumerate(scene.drive.ports):
        if port in MOVED:
            mass[train.coupling[place, 0]] = IMMOVABLE * mass.sum()
    return mass


def _basis(train: Train, mass: np.ndarray) -> np.ndarray:
    """Coordinates of `TRAIN` by those of a `Loop`, shape (bodies, bodies)."""
    own, axes = slice(train.bodies), int(train.axes)
    root = np.sqrt(mass)[:, None]
    rigid = root * train.radius[own, None] * train.ratio[own, :axes]
    return np.asarray(np.linalg.qr(rigid, mode="complete")[0] / root)


def _feedback(layout: Layout, train: Train) -> np.ndarray:
    """P and I [kg] in the coordinates of `Train`, shape (2, bodies, bodies)."""
    gains, machines = speed_loop_gains(layout, train, 0.5 / math.pi), train.coupling[:, 0]
    feedback = np.zeros((2, train.bodies, train.bodies))
    load = machines[LOAD_MACHINE]
    feedback[0, load, load] = gains.load_proportional * train.inverse_radius[load] ** 2
    for a in range(train.axes):
        motor = machines[2 * a]
        feedback[0, motor, motor] = gains.proportional[a] * train.inverse_radius[motor] ** 2
        for c in range(train.machines):
            lever = train.inverse_radius[motor] * train.inverse_radius[machines[c]]
            feedback[1, machines[c], motor] += gains.trim[c, a] * lever
    return feedback


def rounded_down(value: float) -> float:
    """A positive value rounded down to two significant digits.

    Args:
        value: above 0.
    """
    digits = 1 - math.floor(math.log10(value))
    return float(f"{math.floor(value * 10.0**digits) / 10.0**digits:.2g}")
