"""The speed loop of the drive: its gains, its default bandwidth, and whether it is stable.

Each motor has a proportional controller of its speed; the integral of its speed error trims the
load of the first input and the motor of the second. With J the inertia of the train at a motor
and w = 2 pi bandwidth, the gains J w and J w^2/4 make the loop critically damped on a rigid train.

The train is not rigid. Between motor and load of inertia J in all on one shaft of stiffness k,
the loop is stable as long as J w^2/4 < k (Routh-Hurwitz), whatever the shares of the inertia: a
faster integrator turns the load while the motor does not yet feel it. For a whole train the same
limit follows from the eigenvalues of

    M x'' + (C + w P) x' + (K + w^2 I) x = 0

in the coordinates of `TRAIN`, with P of the proportional controllers and I of the integrators.
The meshes have their mean stiffness and stay closed; drag and friction of teeth are left out.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .._core import AXES, MACHINES, Train, damping_time
from ..scene import OperatingPoint, Scene, SceneError
from .bodies import LOAD_MACHINE, SECOND_MOTOR
from .mean_stiffness import mean_stiffness
from .static_load import static_torques
from .train import TRAINS_KEPT, build_train, unloaded

FIELD = "drive.speed_control.bandwidth"
FASTEST_DEFAULT = 3.0  # [Hz]
# Bandwidth up to which a loop must be stable, over its own. A factor of sqrt(2) in the bandwidth
# is one of 2 in the integrator: the gain margin of 6 dB that is customary (Astrom and Murray 2008,
# Feedback Systems, section 9.3). At a margin of 4, motor and load on one shaft have real
# eigenvalues of the loop, between -w and -0.38 w; on a rigid train both are -0.5 w.
LEAST_MARGIN = math.sqrt(2.0)
DEFAULT_MARGIN = 4.0
SLOWEST = 1e-9  # [Hz] below it no stable bandwidth is looked for
BISECTIONS = 40
FREQUENCIES_KEPT = 64
ROUNDING = 1e-12  # growth rates below it, over the largest eigenvalue, are rounding


class Gains(NamedTuple):
    """What the speed loop of a train is made of."""

    inertia: np.ndarray  # of the whole train at the motors [kg m^2], (AXES, AXES)
    proportional: np.ndarray  # of each motor [N m s/rad], (AXES,)
    trim: np.ndarray  # torque per integral of a speed error [N m/rad], (MACHINES, AXES)


class Loop(NamedTuple):
    """A linearised train and what its speed loop adds to it, shape (bodies, bodies) each.

    In coordinates of unit mass, the first of which turn the train rigidly.
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
        """Whether nothing grows at a `bandwidth` [Hz]."""
        found = self.eigenvalues(bandwidth)
        return bool(found.real.max() <= ROUNDING * np.abs(found).max())

    def limit(self, highest: float) -> float:
        """Largest stable bandwidth [Hz] up to `highest` [Hz]."""
        if self.is_stable(highest):
            return highest
        low, high = math.log(SLOWEST), math.log(highest)
        for _ in range(BISECTIONS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.is_stable(math.exp(middle)) else (low, middle)
        return math.exp(low)


def bandwidth(scene: Scene) -> float:
    """Bandwidth of the speed loop [Hz]: that of the scene, or one that its train allows.

    The default is 3 Hz, or a quarter of the largest stable bandwidth where that is less, rounded
    down to two digits. Mesh damping that follows the speed is taken at the highest speed that the
    drive allows, where it is least.

    Args:
        scene: the train and its drive. Of its operating point only the torque matters, and only
            where the stiffness of the teeth follows it.

    Raises:
        ValueError: the teeth leave a moment without contact.
    """
    given = scene.drive.speed_control.bandwidth
    return _default(unloaded(scene)) if given is None else given


@lru_cache(maxsize=TRAINS_KEPT)
def _default(scene: Scene) -> float:
    train, fastest = build_train(scene), scene.drive.speed_limit
    loop = linear_loop(scene, train, float(np.abs(train.cycles).sum()) * fastest / (2.0 * math.pi))
    limit = loop.limit(DEFAULT_MARGIN * FASTEST_DEFAULT)
    return _rounded_down(limit / DEFAULT_MARGIN)


def speed_loop_gains(scene: Scene, train: Train, bandwidth: float) -> Gains:
    """Gains of the speed loop.

    Args:
        scene: whose drive it is.
        train: of `build_train`.
        bandwidth: of the loop [Hz].

    Returns:
        The gains, which make the loop critically damped on a rigid train.
    """
    w, axes = 2.0 * math.pi * bandwidth, int(train.axes)
    inertia = np.einsum("j,ja,jb->ab", train.mass * train.radius**2, train.ratio, train.ratio)
    integral = np.diag(inertia) * w**2 / 4.0
    trim = np.zeros((MACHINES, AXES))
    # The first motor gives just its torque; the load is trimmed so that its speed holds.
    trim[LOAD_MACHINE, 0] = -static_torques(scene)[LOAD_MACHINE] * integral[0]
    if axes > 1:
        trim[SECOND_MOTOR, 1] = integral[1]
    return Gains(inertia, np.diag(inertia) * w, trim)


class LinearTrain:
    """The linearised train with its speed loop, at one speed after the other.

    Args:
        scene: whose drive it is.
        train: of `build_train`.
    """

    def __init__(self, scene: Scene, train: Train) -> None:
        meshes, machines = train.meshes, train.machines
        coupling, found = slice(machines), mean_stiffness(train)
        mesh = (train.copies * found[train.kind])[:meshes]
        springs = np.concatenate([mesh, train.coupling_stiffness[coupling]])
        rows = np.zeros((meshes + machines, train.bodies + 1))  # what stretches each of them
        place = meshes + np.arange(machines)[:, None]
        np.add.at(rows, (np.arange(meshes)[:, None], train.body[:meshes]), train.sign[:meshes])
        np.add.at(rows, (place, train.coupling[coupling]), [1.0, -1.0])
        basis = _basis(train)
        stretch = rows[:, :-1] @ basis  # the ground stands still
        stretch[:, : train.axes] = 0.0  # by rigid motion, without what rounding leaves
        self._train, self._mesh, self._stretch = train, mesh, stretch
        self._stiffness = (stretch.T * springs) @ stretch
        self._proportional, self._integral = (
            basis.T @ gain @ basis for gain in _feedback(scene, train)
        )

    def loop(self, mesh_frequency: float) -> Loop:
        """The loop at a speed.

        Args:
            mesh_frequency: rate at which teeth pass [Hz], which mesh damping may follow.

        Returns:
            Its matrices, from which the eigenvalues at any bandwidth follow.
        """
        train, stretch = self._train, self._stretch
        tau = np.array([damping_time(train, kind, mesh_frequency) for kind in range(2)])
        shafts = train.coupling_damping[: train.machines]
        dampers = np.concatenate([self._mesh * tau[train.kind[: train.meshes]], shafts])
        damping = (stretch.T * dampers) @ stretch
        return Loop(damping, self._stiffness, self._proportional, self._integral)


def linear_loop(scene: Scene, train: Train, mesh_frequency: float) -> Loop:
    """The linearised train with its speed loop, see `LinearTrain`."""
    return LinearTrain(scene, train).loop(mesh_frequency)


def _basis(train: Train) -> np.ndarray:
    """Coordinates of `TRAIN` by those of a `Loop`, shape (bodies, bodies)."""
    own, axes = slice(train.bodies), int(train.axes)
    root = np.sqrt(train.mass[own])[:, None]
    rigid = root * train.radius[own, None] * train.ratio[own, :axes]
    return np.asarray(np.linalg.qr(rigid, mode="complete")[0] / root)


def _feedback(scene: Scene, train: Train) -> np.ndarray:
    """P and I [kg] in the coordinates of `TRAIN`, shape (2, bodies, bodies)."""
    gains, machines = speed_loop_gains(scene, train, 0.5 / math.pi), train.coupling[:, 0]
    feedback = np.zeros((2, train.bodies, train.bodies))
    for a in range(train.axes):
        motor = machines[2 * a]
        feedback[0, motor, motor] = gains.proportional[a] * train.inverse_radius[motor] ** 2
        for c in range(train.machines):
            lever = train.inverse_radius[motor] * train.inverse_radius[machines[c]]
            feedback[1, machines[c], motor] += gains.trim[c, a] * lever
    return feedback


class SpeedLoopCheck:
    """Refuses operating points at which the train makes the speed loop unstable, or nearly so.

    Args:
        scene: whose drive it is.
        train: of `build_train`.
    """

    def __init__(self, scene: Scene, train: Train) -> None:
        self._cycles, self._chosen = train.cycles.copy(), bandwidth(scene)
        self._linear = LinearTrain(scene, train)
        self._stable: set[float] = set()  # mesh frequencies [Hz] found stable, the last few

    def check(self, point: OperatingPoint) -> None:
        """Check an operating point: mesh damping may follow its speeds.

        Args:
            point: the operating point.

        Raises:
            SceneError: at sqrt(2) times its bandwidth the loop is not stable.
        """
        speeds = np.zeros(AXES)
        speeds[:] = point.input_speed, point.second_input_speed
        frequency = abs(float(self._cycles @ speeds)) / (2.0 * math.pi)
        if frequency not in self._stable:
            self._check_at(frequency)
            if len(self._stable) >= FREQUENCIES_KEPT:
                self._stable.clear()
            self._stable.add(frequency)

    def _check_at(self, mesh_frequency: float) -> None:
        loop, chosen = self._linear.loop(mesh_frequency), self._chosen
        unstable = [b for b in (chosen, LEAST_MARGIN * chosen) if not loop.is_stable(b)]
        if not unstable:
            return
        limit = loop.limit(unstable[0])
        growing = max(loop.eigenvalues(unstable[0]), key=lambda value: value.real)
        raise SceneError(
            f"{FIELD} = {chosen:g} Hz: must be at most {_rounded_down(limit / LEAST_MARGIN):g} "
            f"Hz: the speed loop is unstable above {limit:.3g} Hz, where motors and load oscillate "
            f"on their couplings at {abs(growing.imag) / (2.0 * math.pi):.3g} Hz; leave it out for "
            "the default, or give the drive stiffer couplings"
        )


def check_speed_loop(scene: Scene, train: Train, point: OperatingPoint) -> None:
    """Refuse a speed loop that the train makes unstable, or hardly stable.

    Args:
        scene: whose drive it is.
        train: of `build_train`.
        point: where the train runs: mesh damping may follow its speeds.

    Raises:
        SceneError: at sqrt(2) times its bandwidth the loop is not stable.
    """
    SpeedLoopCheck(scene, train).check(point)


def _rounded_down(value: float) -> float:
    """To two significant digits."""
    digits = 1 - math.floor(math.log10(value))
    return float(f"{math.floor(value * 10.0**digits) / 10.0**digits:.2g}")
