"""How strongly meshing forces the modes: harmonics of mesh stiffness and errors of form.

With the mean deflection F/k of a loaded mesh, harmonic h of its stiffness pulls with k_h F/k, and
that of its error of form with k e_h (Parker, Agashe and Vijayakar 2000, J. Mech. Des. 122, 304).
Both act as a transmission error e_h - (k_h/k) F/k would. The modal forces are their sums with the
deflections of the meshes, in the phases of the planets.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..model.layout import Layout
from ..model.mean_stiffness import mean_stiffness
from ..model.teeth import build_teeth, stiffness_at
from ..scene import Scene
from ..units.catalogue import SIDES
from .springs import Spring, SpringModel

POINTS = 8192  # of a mesh cycle
ROUNDING = 1e-9  # of the mean stiffness: less does not vary


class Forcing(NamedTuple):
    """Pull of H harmonics on the meshes."""

    rows: np.ndarray
    """Deflection of each mesh per displacement of each coordinate, (meshes, coordinates)."""
    pull: np.ndarray
    """Complex amplitudes [N], (H, meshes): the real part of pull exp(-i w t) where the teeth pass
    in the sense of the clock's opposite on the sun, seen from the carrier."""

    def answer(self, shapes: np.ndarray, frequency: float) -> tuple[np.ndarray, np.ndarray]:
        """Vibration of the meshes in modes of one frequency, if these followed without inertia.

        In resonance it is larger by 1/(2 damping ratio).

        Args:
            shapes: mass-normalised shapes [kg^-1/2], (coordinates, modes); those of a turning
                carrier vary as exp(-i w t).
            frequency: of the modes [Hz].

        Returns:
            Amplitudes in the mesh that moves most [m], (H,) each: with the phases of the planets,
            and without, as if no forces cancelled.
        """
        deflections = self.rows @ shapes / (2.0 * np.pi * frequency)
        flexibility = deflections @ deflections.conj().T
        forced = self.pull @ flexibility.T, np.abs(self.pull) @ np.abs(flexibility)
        felt, reach = (np.abs(each).max(axis=1) for each in forced)
        return felt, reach

    @property
    def backward(self) -> Forcing:
        """The pull where the teeth pass in the other sense."""
        return self._replace(pull=self.pull.conj())


def forcing(scene: Scene, springs: SpringModel, harmonics: int) -> Forcing:
    """Pull of the harmonics of the mesh frequency at the torque of the scene.

    Args:
        scene: gives teeth, errors of form, torque, and the phases of the planets.
        springs: with the mean stiffness of the meshes.
        harmonics: number of harmonics H.
    """
    meshes = [[s for s in springs.springs if s.kind == kind] for kind in SIDES]
    order = np.arange(1, harmonics + 1)[:, None]
    pulls = []
    for kind, (found, phases) in enumerate(zip(meshes, Layout(scene).phases, strict=True)):
        error = equivalent_error(scene, kind, found, harmonics)[:, None]
        delay = np.array([float(phase % 1) for phase in phases])
        stiffness = np.array([spring.stiffness for spring in found])
        pulls.append(stiffness * error.conj() * np.exp(2j * np.pi * order * delay))
    rows = np.array([spring.row for kind in meshes for spring in kind])
    return Forcing(rows, np.hstack(pulls))


def equivalent_error(scene: Scene, kind: int, meshes: list[Spring], harmonics: int) -> np.ndarray:
    """Transmission error that pulls as the varying stiffness and the errors of form do.

    Args:
        scene: gives teeth, errors of form and torque.
        kind: 0 of sun-planet meshes, 1 of planet-ring meshes.
        meshes: springs of this kind.
        harmonics: number of harmonics H.

    Returns:
        Amplitudes e_h of the real part of e_h exp(2 pi i h u) over the mesh cycle u [m], (H,).
    """
    force = Layout(scene).mesh_force(scene.operating_point.input_torque)
    teeth = build_teeth(scene)
    total = sum(spring.stiffness for spring in meshes)
    deflection = force * len(meshes) / total if total else 0.0
    cycle = (np.arange(POINTS) + 0.5) / POINTS
    if force < 0.0:  # on coast flanks teeth pass in the other order
        cycle = np.mod(scene.gearset.geometry.meshes[kind].coast_lead - cycle, 1.0)
    stiffness = stiffness_at(teeth, kind, cycle) / mean_stiffness(teeth)[kind]
    shifted = np.exp(-1j * np.pi * np.arange(harmonics + 1) / POINTS)
    varying = 2.0 / POINTS * (np.fft.rfft(stiffness)[: harmonics + 1] * shifted)[1:]
    found = np.where(np.abs(varying) > ROUNDING, -deflection * varying, 0.0)
    given = (scene.mesh.sun_planet_error, scene.mesh.planet_ring_error)[kind]
    phases = given.phases or (0.0,) * len(given.amplitudes)
    for h, (size, phase) in enumerate(zip(given.amplitudes, phases, strict=True)):
        if h < harmonics:
            found[h] += -1j * size * np.exp(1j * phase)
    return np.asarray(found)
