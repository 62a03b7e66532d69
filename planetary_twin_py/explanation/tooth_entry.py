"""Peak loads of tooth pairs by how the teeth come into contact, on which they depend most."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..model.gearbox import Gearbox
from ..model.pair_loads import pair_loads
from ..run.result import Result
from ..scene import Scene
from ..simulation.simulate import simulate
from ..units.catalogue import SIDES

FACTORS = (0.5, 1.0, 2.0)  # of mesh.ramp
LONGEST_RAMP = 0.2  # base pitches


class EntryPeaks(NamedTuple):
    """Largest loads of a tooth pair with one kind of entry."""

    entry: str
    """Value of `mesh.ramp`, or of `mesh.entry`."""
    peaks: tuple[float, ...]
    """Of sun-planet and planet-ring meshes, over the static mesh force; none if it is refused."""
    refused: str
    """Why the scene cannot have this entry, "" if it can."""

    def as_figures(self) -> dict[str, Any]:
        """The peaks for JSON."""
        peaks = dict(zip(SIDES, self.peaks or (None, None), strict=True))
        return {"entry": self.entry, **peaks, "refused": self.refused}


def entry_peaks(scene: Scene, duration: float) -> tuple[EntryPeaks, ...]:
    """Peaks with half, the whole and twice the ramp of a scene, and with loaded entry.

    Args:
        scene: the scene.
        duration: simulated time of each run [s].

    Returns:
        Peaks of the samples of each run; none if the scene transmits no torque.
    """
    if Gearbox(scene).mesh_force(scene.operating_point.input_torque) == 0.0:
        return ()
    ramps = sorted({min(factor * scene.mesh.ramp, LONGEST_RAMP) for factor in FACTORS})
    changes: list[tuple[str, dict[str, Any]]] = [
        (f"ramp {ramp:.4g}", {"mesh.entry": "ramp", "mesh.ramp": ramp}) for ramp in ramps
    ]
    changes.append(("loaded", {"mesh.entry": "loaded"}))
    return tuple(_peaks(scene, duration, *change) for change in changes)


def _peaks(scene: Scene, duration: float, entry: str, changes: dict[str, Any]) -> EntryPeaks:
    try:
        changed = scene.replace(**changes)
        run = simulate(changed, duration)
    except ValueError as reason:
        return EntryPeaks(entry, (), str(reason).splitlines()[-1])
    return EntryPeaks(entry, peak_loads(changed, run), "")


def peak_loads(scene: Scene, run: Result) -> tuple[float, float]:
    """Largest load of a tooth pair in the samples of a run, over the static mesh force.

    Args:
        scene: scene of the run, with torque.
        run: its result.

    Returns:
        Of sun-planet and planet-ring meshes.
    """
    gearbox = Gearbox(scene)
    still = np.zeros(len(run.time))
    planets = scene.gearset.planets
    members = ("sun", "ring", "carrier", *(f"planet_{n + 1}" for n in range(planets)))
    angle = dict.fromkeys(members, still) | dict(zip(run.bodies, run.angle.T, strict=True))
    static = abs(gearbox.mesh_force(scene.operating_point.input_torque))
    sun, ring = (
        max(
            float(pair_loads(gearbox, mesh, angle, run.mesh_force[:, mesh]).load.max())
            for mesh in range(kind * planets, (kind + 1) * planets)
        )
        for kind in (0, 1)
    )
    return sun / static, ring / static
