"""Wear of all flanks after hours of operation: profiles, and what they change."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene import Scene

Array = NDArray[np.float64]

DEEP = 0.5  # of the deflection: a worn gap beyond it makes the secant stiffness too low


class WornFlank(NamedTuple):
    """Wear of the flanks of one gear in one kind of mesh, the mean of all of them."""

    name: str
    """Of the gear, and of its mate in the case of a planet: "sun", "planet_sun", ..."""
    position: Array
    """On the path of contact, after the pitch point [base pitches], (points,)."""
    depth: Array
    """Normal to the flank [m], (points,)."""
    first_rate: Array
    """Growth of the depth at the start [m/s], (points,)."""
    rate: Array
    """At the end [m/s], (points,)."""
    mass: float
    """Worn off this flank of all its teeth, of planets off all of them [kg]."""

    @property
    def deepest(self) -> int:
        """Index of the largest depth, or of the largest rate if there is no wear."""
        return int(np.argmax(self.depth if self.depth.any() else self.first_rate))


class WornPairs(NamedTuple):
    """What the wear of one kind of mesh changes."""

    backlash_change: float
    """Mean over the mesh cycle of the distance of unloaded flanks [m], along the line of action."""
    error: tuple[float, float]
    """Peak to peak of the quasi-static transmission error before and after [m]."""
    mean_error: float
    """Change of its mean [m]."""
    deepest: float
    """Largest growth of the gap of a pair [m]."""
    deflection: float
    """Mean static deflection of the mesh before the wear [m]."""
    shares: Array
    """Load of each planet over the mean, after the wear, (planets,)."""

    @property
    def error_per_depth(self) -> float:
        """Change of the transmission error, peak to peak, over `deepest` [-]; NaN without wear."""
        return (self.error[1] - self.error[0]) / self.deepest if self.deepest else math.nan


@dataclass(frozen=True)
class Wear:
    """Wear of all flanks after a duration."""

    scene: Scene
    """With the worn flanks in `mesh.worn`: runs, spectra and `follow` have them."""
    duration: float
    """[s]"""
    coefficient: float
    """Wear coefficient k [1/Pa], of the scene or fitted to a change of the backlash."""
    fitted: bool
    """Whether it is fitted."""
    flanks: tuple[WornFlank, ...]
    """Of sun and planet in mesh, and of planet and ring."""
    meshes: tuple[WornPairs, WornPairs]
    """Sun-planet and planet-ring meshes."""
    steps: int
    """Number of updates of the profile."""

    @property
    def backlash_change(self) -> float:
        """Of both meshes together, along the line of action [m]."""
        return sum(mesh.backlash_change for mesh in self.meshes)

    def remarks(self) -> Iterator[str]:
        """What the wear does not contain, and where runs with its profile are less accurate."""
        for name, mesh in zip(("sun-planet", "planet-ring"), self.meshes, strict=True):
            if mesh.deepest > DEEP * mesh.deflection:
                yield (
                    f"the pairs of the {name} meshes have lost {1e6 * mesh.deepest:.3g} µm, at a "
                    f"deflection of {1e6 * mesh.deflection:.3g} µm: runs with this profile have "
                    "the transmission error and the shares of this load; at other loads, and in "
                    "vibration, their stiffness is too low"
                )
        if self.scene.mesh.entry == "loaded":
            yield "the contact of tips off the path of contact does not wear here"
        if self.scene.faults:
            yield "faults: the wear is that of healthy teeth"

    def figures(self) -> dict[str, Any]:
        """Wear for JSON, in SI."""
        own = ("duration", "coefficient", "fitted", "steps", "backlash_change")
        profile = ("position", "depth", "first_rate", "rate")
        return {name: getattr(self, name) for name in own} | {
            "flanks": {
                each.name: {name: getattr(each, name).tolist() for name in profile}
                | {"mass": each.mass}
                for each in self.flanks
            },
            "meshes": {
                name: {
                    "backlash_change": mesh.backlash_change,
                    "error_before": mesh.error[0],
                    "error_after": mesh.error[1],
                    "mean_error": mesh.mean_error,
                    "deepest": mesh.deepest,
                    "shares": mesh.shares.tolist(),
                }
                for name, mesh in zip(("sun_planet", "planet_ring"), self.meshes, strict=True)
            },
        }
