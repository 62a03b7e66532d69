"""What a run with moving axes shows: displacements, forces on bearings, loads of both flanks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._core import (
    BOUNDARY,
    FILM,
    LAMBDA,
    MESH_FORCE,
    MESH_POWER,
    POWER_LOSS,
    VISCOUS,
    Train,
)
from ..dynamics.bodies import CENTRAL, build_bodies
from ..integrators.interpolant import Samples
from ..scene import Scene

SUMMED = (MESH_FORCE, BOUNDARY, VISCOUS, POWER_LOSS, MESH_POWER)  # of both flanks
OF_EITHER = (FILM, LAMBDA)  # of the flanks that carry, or else of the others


@dataclass(frozen=True)
class AxesMotion:
    """Motion of the axes in a run, and what their bearings and both flanks of teeth carry.

    Displacements and forces of sun, ring and carrier are x and y in the frame that turns with the
    carrier, x through the position from which `gearset.planet_angles` count. Those of planets are
    radial (outwards) and tangential (counter-clockwise) from their nominal positions on the
    carrier.
    """

    bodies: tuple[str, ...]
    """"sun", "ring", "carrier", "planet_1" and so on, in the order of arrays over bodies."""
    displacement: np.ndarray
    """Displacement of each axis [m], (samples, bodies, 2)."""
    bearing_force: np.ndarray
    """Force of each body on its bearing [N], (samples, bodies, 2)."""
    orbit: np.ndarray
    """Displacement of sun, ring and carrier, x and y in the housing [m], (samples, 3, 2)."""
    flank_force: np.ndarray
    """Force of the drive flanks, then of the coast flanks of each mesh [N],
    (samples, 2, meshes)."""
    load_share: np.ndarray
    """Torque that each planet takes from the sun over the mean of all planets, NaN where that is
    zero, (samples, planets)."""

    @property
    def mean_load_share(self) -> np.ndarray:
        """Mean torque of each planet over the mean of all planets, (planets,)."""
        planets = self.load_share.shape[1]
        mean = self.flank_force[:, :, :planets].mean(axis=0)
        return _shares(mean[0] - mean[1])

    @property
    def load_sharing_factor(self) -> float:
        """Load sharing factor K_gamma: the largest mean share of a planet."""
        return float(self.mean_load_share.max())


def joined_flanks(mesh: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Samples of the meshes from those of both flanks.

    Args:
        mesh: samples of all flanks, (samples, QUANTITIES, flanks).
        place: of the flanks that carry, (meshes,).

    Returns:
        Transmission errors of those flanks, forces and losses of both, (samples, QUANTITIES,
        meshes).
    """
    other = mesh[:, :, (place + len(place)) % mesh.shape[2]]
    joined: np.ndarray = mesh[:, :, place]
    for row in SUMMED:
        joined[:, row] += other[:, row]
    for row in OF_EITHER:
        joined[:, row] = np.where(np.isnan(joined[:, row]), other[:, row], joined[:, row])
    return joined


def axes_motion(scene: Scene, train: Train, samples: Samples, angle: np.ndarray) -> AxesMotion:
    """What samples of a run show of its axes.

    Args:
        scene: whose axes move.
        train: of `build_train`.
        samples: of its meshes and coordinates.
        angle: of the carrier [rad], (samples,).

    Returns:
        Displacements, forces and shares.
    """
    planets, place = scene.gearset.planets, build_bodies(scene).place
    names = (*CENTRAL, *(f"planet_{i + 1}" for i in range(planets)))
    own = slice(train.bodies)
    moved, moving = (
        _moved(train, len(names), values * train.radius[own])
        for values in (samples.angle, samples.speed)
    )
    turning = _coordinate(samples.speed, place["carrier"])
    count = 2 * planets
    forces = np.abs(samples.mesh[:, MESH_FORCE])
    flanks = np.stack([forces[:, :count], forces[:, count:]], axis=1)
    return AxesMotion(
        names,
        moved,
        _bearing_force(train, moved, moving, turning),
        _in_housing(moved[:, : len(CENTRAL)], angle),
        flanks,
        _shares(flanks[:, 0, :planets] - flanks[:, 1, :planets]),
    )


def _shares(force: np.ndarray) -> np.ndarray:
    """Forces of the sun meshes over their mean, (..., planets)."""
    mean = force.mean(axis=-1, keepdims=True)
    return np.asarray(np.divide(force, mean, out=np.full_like(force, np.nan), where=mean != 0.0))


def _moved(train: Train, bodies: int, x: np.ndarray) -> np.ndarray:
    """Displacements of the axes from coordinates (samples, coordinates), (samples, bodies, 2).

    The way that the carrier turns a planet along is taken out, with all of its rotation.
    """
    axes = train.moving
    place, carried = axes.place[:bodies], axes.carried[:bodies]
    turned = _coordinate(x, int(train.carrier))
    across = x[:, place[:, 1]] - carried * turned[:, None]
    return np.stack([x[:, place[:, 0]], across], axis=2)


def _coordinate(values: np.ndarray, place: int) -> np.ndarray:
    """A coordinate, zero if it is the ground, (samples,)."""
    return values[:, place] if place < values.shape[1] else np.zeros(len(values))


def _bearing_force(
    train: Train, moved: np.ndarray, moving: np.ndarray, turning: np.ndarray
) -> np.ndarray:
    """Force of each body on its bearing [N], (samples, bodies, 2), see core/train/bearings.hpp."""
    axes, bodies = train.moving, moved.shape[1]
    cosine, sine = axes.direction[:bodies].T
    across, rate = (
        values - np.stack([cosine * a + sine * c, cosine * c - sine * a], axis=2)
        for values, (a, c) in (
            (each, (each[:, 2, 0, None], each[:, 2, 1, None])) for each in (moved, moving)
        )
    )
    across = across - axes.centre[:bodies]
    quarter = np.stack([-across[:, :, 1], across[:, :, 0]], axis=2)
    in_housing = (axes.carried[:bodies] == 0.0)[:, None]
    rate = rate + np.where(in_housing, quarter * turning[:, None, None], 0.0)
    stiffness, damping = axes.stiffness[:bodies, None], axes.damping[:bodies, None]
    clearance = axes.clearance[:bodies, None]
    size = np.linalg.norm(across, axis=2, keepdims=True)
    unit = across / np.where(size > 0.0, size, 1.0)
    along = stiffness * (size - clearance) + damping * np.sum(unit * rate, axis=2, keepdims=True)
    pressed = np.where(size > clearance, np.maximum(along, 0.0), 0.0) * unit
    return np.where(clearance > 0.0, pressed, stiffness * across + damping * rate)


def _in_housing(moved: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Displacements turned by the angle of the carrier (samples,), (samples, bodies, 2)."""
    cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
    x, y = moved[:, :, 0], moved[:, :, 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=2)
