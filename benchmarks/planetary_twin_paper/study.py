"""Runs of the dynamic model from which tables and figures are computed.

The study of the paper varies backlash, lambda ratio and speed (section 7); Fig. 7 also requires
different loads. Every point is a separate run that starts in a steady state; only the settled part
is evaluated.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any, NamedTuple

import numpy as np

from planetary_twin_py.run.result import Result
from planetary_twin_py.scene import load_scene
from planetary_twin_py.simulation.simulate import simulate
from planetary_twin_py.units.conversion import rpm

DURATION = 0.12  # [s]
SETTLED = 0.04  # [s] start of means, which cover whole mesh cycles at every speed of the study
TOLERANCE = 1e-4
SAMPLE_RATE = 400_000.0  # [Hz] for largest forces, see `largest`
RESOLVED = 1e-3  # largest relative difference of a largest force with every other sample
REFERENCE_TORQUE = 63.0  # [N m] section 8.3


class Grid(NamedTuple):
    """Values that the study combines."""

    backlashes: tuple[float, ...] = (2.0e-7, 2.5e-7, 3.0e-7, 3.5e-7)
    """[m]"""
    lambda_ratios: tuple[float, ...] = (1.0, 1.25, 1.5, 1.75, 2.0)
    speeds: tuple[float, ...] = (1000.0, 2000.0, 3000.0)
    """[rpm]"""
    torques: tuple[float, ...] = (42.0, 52.5, 63.0, 73.5, 84.0)
    """Of Fig. 7 [N m]."""

    @property
    def shape(self) -> tuple[int, int, int]:
        """Number of backlashes, lambda ratios and speeds."""
        return len(self.backlashes), len(self.lambda_ratios), len(self.speeds)


class Point(NamedTuple):
    """One run."""

    scene: str
    """Name of the scene."""
    backlash: float
    """[m]"""
    lambda_ratio: float
    speed: float
    """Input speed [rpm]."""
    torque: float
    """Input torque [N m]."""


class MeshMeans(NamedTuple):
    """Means of the meshes of one kind, over planets and settled time."""

    dte: float
    """[m]"""
    force: float
    """[N]"""
    largest_force: float
    """Largest of all planets and samples [N]."""
    film: float
    """Film thickness [m]."""
    boundary: float
    """Boundary friction [N]."""
    viscous: float
    """Viscous friction [N]."""
    power_loss: float
    """Of one mesh [W]."""


class Outcome(NamedTuple):
    """Results of one run."""

    sun: MeshMeans
    """Of the sun-planet meshes."""
    ring: MeshMeans
    """Of the planet-ring meshes."""
    input_power: float
    """[W]"""
    sliding_loss: float
    """f Vs of all meshes [W]."""
    ledger_efficiency: float
    """By the energy ledger of the whole run."""
    residual: float
    """Of the ledger, over the work of the driving machines."""


class Study(NamedTuple):
    """All runs of one scene."""

    grid: Grid
    points: tuple[Point, ...]
    """Points of the grid in the order of its axes, then those of the torques."""
    outcomes: tuple[Outcome, ...]
    """Results of the points."""

    def over_grid(self, quantity: Callable[[Outcome], float]) -> np.ndarray:
        """A quantity of every point of the grid, (backlashes, lambda ratios, speeds).

        Args:
            quantity: function of the results of a point.
        """
        count = math.prod(self.grid.shape)
        return np.array([quantity(o) for o in self.outcomes[:count]]).reshape(self.grid.shape)

    def over_torques(self, quantity: Callable[[Outcome], float]) -> np.ndarray:
        """A quantity at the torques, for the first backlash, lambda ratio and speed, (torques,).

        Args:
            quantity: function of the results of a point.
        """
        return np.array([quantity(o) for o in self.outcomes[math.prod(self.grid.shape) :]])


def run_studies(
    scenes: Sequence[str],
    grid: Grid,
    jobs: int,
    progress: Callable[[Iterable[Any], int], Iterable[Any]] = lambda runs, _: runs,
) -> dict[str, Study]:
    """Run the study of every scene.

    Args:
        scenes: names of the scenes.
        grid: values of the study.
        jobs: number of processes.
        progress: wrapper of the iterable of completed runs; its second argument is their number.

    Returns:
        Study by name of the scene.
    """
    points = {scene: _points(scene, grid) for scene in scenes}
    every = [point for scene in scenes for point in points[scene]]
    if jobs == 1:
        outcomes = list(progress(map(run, every), len(every)))
    else:
        with ProcessPoolExecutor(jobs, get_context("spawn")) as pool:
            outcomes = list(progress(pool.map(run, every, chunksize=4), len(every)))
    studies, first = {}, 0
    for scene, own in points.items():
        studies[scene] = Study(grid, own, tuple(outcomes[first : first + len(own)]))
        first += len(own)
    return studies


def _points(scene: str, grid: Grid) -> tuple[Point, ...]:
    study = [
        Point(scene, backlash, ratio, speed, REFERENCE_TORQUE)
        for backlash in grid.backlashes
        for ratio in grid.lambda_ratios
        for speed in grid.speeds
    ]
    first = study[0]
    return tuple(study + [first._replace(torque=torque) for torque in grid.torques])


def simulate_point(point: Point) -> Result:
    """Simulate one point.

    Args:
        point: of the study.

    Returns:
        The result.
    """
    scene = load_scene(point.scene).replace(
        backlash=point.backlash,
        lambda_ratio=point.lambda_ratio,
        input_speed=rpm(point.speed),
        input_torque=point.torque,
    )
    return simulate(scene, DURATION, SAMPLE_RATE, tolerance=TOLERANCE)


def run(point: Point) -> Outcome:
    """Simulate one point and evaluate its settled part.

    Args:
        point: of the study.

    Returns:
        Means and power balance.
    """
    result = simulate_point(point)
    settled = result.time > SETTLED
    planets = len(result.meshes) // 2
    return Outcome(
        _means(result, settled, slice(0, planets)),
        _means(result, settled, slice(planets, None)),
        input_power=abs(point.torque * rpm(point.speed)),
        sliding_loss=float(result.total_power_loss[settled].mean()),
        ledger_efficiency=result.efficiency,
        residual=result.energy.residual / result.energy.driving_work,
    )


def _means(result: Result, settled: np.ndarray, meshes: slice) -> MeshMeans:
    def mean(samples: np.ndarray) -> float:
        return float(samples[settled, meshes].mean())

    return MeshMeans(
        dte=mean(result.dte),
        force=mean(result.mesh_force),
        largest_force=largest(result.mesh_force[settled, meshes]),
        film=mean(result.film_thickness),
        boundary=mean(result.boundary_friction),
        viscous=mean(result.viscous_friction),
        power_loss=mean(result.power_loss),
    )


def largest(samples: np.ndarray) -> float:
    """Largest of all samples, if their rate resolves it.

    Args:
        samples: over time in any unit, (samples, ...).

    Returns:
        The largest value.

    Raises:
        ArithmeticError: the largest value of every other sample is smaller by more than `RESOLVED`.
    """
    whole, half = float(samples.max()), float(min(samples[k::2].max() for k in (0, 1)))
    if not half >= (1.0 - RESOLVED) * whole:
        raise ArithmeticError(
            f"largest value {whole:g}: {half:g} at half the sample rate, which does not resolve it"
        )
    return whole
