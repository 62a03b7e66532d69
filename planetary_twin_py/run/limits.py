"""Limits at which a run is stopped, because no real gearbox can exceed them.

With an unstable drive or an extreme load, the motion grows until numbers overflow. The equations
are invalid long before: at a mesh deflection of a base pitch, teeth have broken or jumped.
"""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import IMPULSE, Integrator, Operation, Train, WindowEnd
from ..model.bodies import MeshNames
from ..model.gearbox import Gearbox
from ..model.layout import MACHINE_NAMES
from ..model.limits import Limit, displacement_limit
from .samples import Waves

EXCESS = 10.0  # allowed ratio of speeds and torques to those at the limits of the drive


class RunawayError(ArithmeticError):
    """A run exceeded a physical limit and was stopped; the message states time and reason."""


def _deflection_limit(gearbox: Gearbox) -> Limit:
    train = gearbox.train
    return Limit(
        "deflection",
        "m",
        _mesh_names(gearbox.mesh_names, int(train.meshes)),
        np.full(train.meshes, train.geometry.base_pitch),
        "a base pitch, at which teeth break or jump; reduce the torques or increase the stiffness",
    )


def _speed_limit(gearbox: Gearbox) -> Limit:
    drive, train, bodies = gearbox.scene.drive, gearbox.train, gearbox.bodies.names
    ratios = np.abs(train.body.ratio[: train.bodies]).sum(axis=1)
    displaces = ["." in name for name in bodies]  # axes, which have no speed of rotation
    fastest = max(drive.speed_limit, abs(drive.speed_control.start_speed or 0.0))
    return Limit(
        "speed",
        "rad/s",
        bodies,
        np.where(displaces, np.inf, EXCESS * fastest * ratios),
        f"{EXCESS:g} times the speed at drive.speed_limit = {drive.speed_limit:g} rad/s",
    )


def _torque_limit(gearbox: Gearbox) -> Limit:
    drive, train = gearbox.scene.drive, gearbox.train
    accelerating = drive.speed_control.slew_rate * _inertia(train)
    return Limit(
        "torque",
        "N m",
        MACHINE_NAMES[: train.machines],
        EXCESS * (drive.torque_limit + accelerating) * np.abs(gearbox.machine_torques),
        f"{EXCESS:g} times the torque at drive.torque_limit = {drive.torque_limit:g} N m and "
        f"drive.speed_control.slew_rate = {drive.speed_control.slew_rate:g} rad/s^2",
    )


def _axial_limit(gearbox: Gearbox) -> Limit:
    names = gearbox.bearings
    return Limit(
        "axial displacement",
        "m",
        names,
        np.full(len(names), gearbox.scene.gearset.face_width),
        "gearset.face_width, at which teeth no longer meet; reduce the torque, or increase the "
        "axial stiffness of the bearings (supports.*.axial)",
    )


class Limits:
    """Limits of a run."""

    def __init__(self, gearbox: Gearbox) -> None:
        train = gearbox.train
        size = np.hypot(train.errors.tangential, train.errors.radial)
        self._errors = size.sum(axis=1)[: train.meshes]
        self._train = train
        self.deflection = _deflection_limit(gearbox)
        """Of the mesh deflection, see `check_deflection`."""
        self.speed = _speed_limit(gearbox)
        """Of the speeds of the bodies."""
        self.torque = _torque_limit(gearbox)
        """Of the torques of the machines."""
        self.displacement = displacement_limit(gearbox)
        """Of the displacements of axes that move, see `check_displacements`."""
        self.axial = _axial_limit(gearbox)
        """The same along the axes."""
        self.record: _core.Limits = gearbox.core.Limits(
            deflection=self.deflection.largest,
            error=self._errors,
            speed=self.speed.largest,
            torque=self.torque.largest,
        )
        """All of them for the core, which finds whether a window exceeds one."""

    def check_deflection(self, largest: np.ndarray, operation: Operation) -> None:
        """Check the mesh deflection along the line of action.

        Its lower bound is |DTE| minus half the backlash and the largest form errors.

        Args:
            largest: magnitudes of the transmission errors [m], (meshes,).
            operation: gives the backlash.

        Raises:
            ArithmeticError: a deflection exceeds its limit, or is NaN.
        """
        least = largest - operation.backlash.half - self._errors
        self.deflection.check(np.maximum(least, 0.0)[None])

    def check_displacements(self, moved: np.ndarray, tilting: np.ndarray) -> None:
        """Check the displacements of axes, if these move.

        Args:
            moved: displacements in the plane [m], (samples, bearings, 2).
            tilting: as in `Samples`, (samples, bearings, 6 or 0).

        Raises:
            ArithmeticError: a displacement exceeds its limit, or is NaN.
        """
        if moved.shape[1]:
            self.displacement.check(np.hypot(moved[:, :, 0], moved[:, :, 1]))
        if tilting.shape[2]:
            self.axial.check(tilting[:, :, 0])

    def check_waves(self, waves: Waves) -> None:
        """Check the displacements of axes in the samples of a window, see `check_displacements`."""
        rows, axes = len(waves.time), waves.axes
        if rows and axes is not None:
            moved = axes.displacement.reshape(rows, -1, 2)
            self.check_displacements(moved, axes.tilting.reshape(rows, moved.shape[1], -1))

    def check_progress(self, integrator: Integrator, operation: Operation) -> None:
        """Check a run that the core has stopped: whether it runs away, or makes no progress.

        Args:
            integrator: of the run, after its last step.
            operation: gives the backlash.

        Raises:
            ArithmeticError: a deflection exceeds its limit, or steps advance the run by hardly any
                time.
        """
        if integrator.control.next_step != 0.0:  # it has found no finite state
            return
        train, begin, end = self._train, integrator.begin, integrator.end
        meshes = int(train.meshes)
        motions = (train.mesh.sign[:meshes] * end.x[train.mesh.body[:meshes]]).sum(axis=1)
        self.check_deflection(np.abs(motions), operation)
        parted = np.flatnonzero(begin.side[:meshes] != end.side[:meshes])
        keeps = (
            f"flanks of {self.deflection.names[parted[0]]} engage and separate again and again; "
            "reduce the backlash, load the train more, or choose dynamics = 'planar' or 'torsional'"
            if len(parted)
            else "errors of longer steps exceed the tolerance; loosen the tolerance, soften "
            "bearings and couplings, or give light bodies more inertia"
        )
        raise ArithmeticError(
            f"the run makes no progress, its last step is {integrator.control.step:.2g} s long: "
            f"{keeps}"
        )

    def check_window(self, end: WindowEnd, operation: Operation) -> None:
        """Check deflections and speeds of the samples of a window, and the torques at its end.

        Args:
            end: of the window.
            operation: gives the backlash.

        Raises:
            ArithmeticError: one of them exceeds its limit, or is NaN.
        """
        machines = len(self.torque.largest)
        self.check_deflection(end.peaks.dte[: len(self._errors)], operation)
        self.speed.check(end.peaks.speed[None, : len(self.speed.largest)])
        self.torque.check(end.power[None, IMPULSE : IMPULSE + machines])


def _inertia(train: Train) -> float:
    """Largest inertia of the whole train, referred to a motor [kg m^2]."""
    squares = train.body.mass * train.body.radius**2
    return float((squares[:, None] * train.body.ratio**2).sum(axis=0).max())


def _mesh_names(meshes: MeshNames, count: int) -> list[str]:
    """Names of the entries of the meshes; where each flank has one, both have the same name."""
    names, places = list(meshes.names), meshes.place.tolist()
    named = {place % count: name for name, place in zip(names[::-1], places[::-1], strict=True)}
    half = count // 2
    return [named[at] if at in named else named[(at + half) % count] for at in range(count)]
