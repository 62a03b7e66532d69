"""Simulation of a run at maximum speed."""

from __future__ import annotations

import math
import time
import warnings
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from .._core import (
    BEARING,
    BOUNDARY,
    CHURNING,
    DAMPING,
    DTE,
    FILM,
    FRICTION,
    LAMBDA,
    MESH_FORCE,
    MESH_POWER,
    METHODS,
    POWER_LOSS,
    STIFFNESS_WORK,
    VISCOUS,
    WEIGHT,
    WORK,
)
from ..checks.accuracy import accuracy_warnings
from ..checks.ledger import balance_of_run, ledger_warning
from ..model.clock import samples_until
from ..model.mesh_sums import MeshSums, in_order
from ..run.axes.motion import axes_motion, joined_flanks
from ..run.commanded_run import DrivenRun
from ..run.commands import Commands
from ..run.dynamics_choice import AUTO
from ..run.energy import EnergyBooks
from ..run.interface import Run
from ..run.result import Energy, Result, Stats
from ..run.samples import Samples
from ..run.start import start
from ..run.tolerance import check_tolerance
from ..run.window import mesh_statistics
from ..scene import Scene
from ..scene.given import check_scene
from ..text.warning_types import AccuracyWarning, LedgerWarning
from .choose_dynamics import choose_dynamics
from .simulate_axes import read_axes

MOST_SAMPLES = 20_000_000
TOLERANCE = 1e-4  # unless one is given
ROUNDING = 8.0 * np.finfo(float).eps  # of an angle, relative


def simulate(
    scene: Scene,
    duration: float,
    sample_rate: float = 50_000.0,
    method: str = "auto",
    tolerance: float = TOLERANCE,
    settling: float = 0.0,
    commands: Commands | None = None,
) -> Result:
    """Simulate a scene from a steady state.

    The integrator computes means, rms values and peaks independently of the samples. The equations
    of motion and their sources are in docs/model.md.

    Args:
        scene: the scene; with dynamics: auto, `choose_dynamics` picks one, see `Result.choice`.
        duration: simulated time of the result [s].
        sample_rate: of the result [Hz]; sample times are integer multiples of the sample period.
        method: "collocation", "rosenbrock", "march" (collocation wherever it is applicable) or
            "auto" (as "march", but periodic motion is not computed again). Creeping gears are
            always integrated by "rosenbrock", see `Stats.stiff_steps`.
        tolerance: relative local error tolerance.
        settling: simulated time before the result [s], which excludes the initial transient. The
            times of the result include it.
        commands: commands at the ports over time, from the start of settling on; None: the
            torques and speeds of the operating point, as at the start.

    Returns:
        Samples, energy ledger and statistics of the time after `settling`.

    Raises:
        ValueError: an argument is out of range, the scene is invalid, or a command is not given at
            its port.
        RunawayError: the run exceeds physical limits, see `runaway`.

    Warns:
        LedgerWarning: the energy ledger does not balance, see `ledger_check`.
        AccuracyWarning: results are less accurate than the tolerance, see `accuracy`.
        UserWarning: commands begin to act only after the end.
    """
    check_scene(scene)
    check_run(duration, sample_rate, method, tolerance)
    choice = choose_dynamics(scene) if scene.dynamics == AUTO else None
    scene = scene if choice is None else choice.scene
    if not 0.0 <= settling < math.inf:
        raise ValueError(f"settling = {settling!r} s: must be finite and not negative")
    engine = start(scene, tolerance, method)
    driven = DrivenRun(engine, scene, commands)
    begin = time.perf_counter()
    until = settling + duration
    passed, end = (samples_until(t, sample_rate) for t in (settling, until))
    driven.advance(settling, passed + 1, sample_rate, 0)
    engine.pop_mesh_sums(settling)
    books, turned = engine.books(settling), _turned(engine, settling)
    work = driven.work.copy()
    axes = None
    if scene.moving_axes:
        samples, axes = read_axes(driven, scene, (settling, until), sample_rate)
    else:
        samples = driven.advance(until, passed + 1, sample_rate, end - passed)
    found = _Found(
        samples=samples,
        times=np.arange(passed + 1, end + 1) / sample_rate,
        mean_speed=_travel(turned, _turned(engine, until)) / duration,
        sums=engine.pop_mesh_sums(until),
        energy=_energy(engine, books, engine.books(until), driven.work - work),
        duration=duration,
        simulated=until,
        wall=time.perf_counter() - begin,
    )
    result = _result(scene, engine, found)
    if result.axes is not None and axes is not None:
        result = replace(result, axes=replace(result.axes, statistics=axes))
    result = replace(result, choice=choice)
    if (late := driven.first_unused) is not None:
        late_ones = f"commands.time: what begins to act at {late:g} s or later has no effect"
        warnings.warn(f"{late_ones}: the run ends at {until:g} s", UserWarning, stacklevel=2)
    if text := ledger_warning(balance_of_run(result.energy), tolerance):
        warnings.warn(text, LedgerWarning, stacklevel=2)
    for text in accuracy_warnings(scene, result):
        warnings.warn(text, AccuracyWarning, stacklevel=2)
    return result


class _Found(NamedTuple):
    """What a run has found after it has settled."""

    samples: Samples
    times: np.ndarray  # of the samples [s]
    mean_speed: np.ndarray  # of the integrated bodies [rad/s]
    sums: MeshSums
    energy: Energy
    duration: float  # [s]
    simulated: float  # [s], settling included
    wall: float  # [s] that took


def _turned(engine: Run, time: float) -> np.ndarray:
    """Angles of the integrated bodies [rad] at `time` [s], the end of the last window."""
    return _angles(engine, engine.sample(time))[0]


def _travel(begin: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Rotations between angles [rad], (bodies,); 0 where they differ by rounding only."""
    return np.where(np.isclose(begin, end, rtol=ROUNDING, atol=0.0), 0.0, end - begin)


def _angles(engine: Run, samples: Samples) -> np.ndarray:
    """Angles of the integrated bodies [rad], (samples, bodies)."""
    train = engine.train
    turned = 2.0 * math.pi * samples.turns @ train.ratio[: train.bodies].T
    return np.asarray(turned + samples.angle)


def check_run(duration: float, sample_rate: float, method: str, tolerance: float) -> None:
    """Check arguments of `simulate`.

    Args:
        duration: simulated time of the result [s].
        sample_rate: of the result [Hz].
        method: name of the method.
        tolerance: relative local error tolerance.

    Raises:
        ValueError: an argument is out of range.
    """
    if method not in METHODS:
        raise ValueError(f"method = {method!r}: must be one of {', '.join(METHODS)}")
    if not duration > 0.0:  # or NaN
        raise ValueError(f"duration = {duration!r} s: must be above 0 s")
    if not 1.0 <= duration * sample_rate <= MOST_SAMPLES:
        raise ValueError(
            f"duration = {duration!r} s at sample_rate = {sample_rate!r} Hz: must give between 1 "
            f"and {MOST_SAMPLES} samples"
        )
    check_tolerance(tolerance)


def _result(scene: Scene, engine: Run, found: _Found) -> Result:
    names, meshes = engine.gearbox.body_names, engine.gearbox.mesh_names
    samples, sums = found.samples, in_order(found.sums, meshes.place)
    joined = joined_flanks if scene.moving_axes else _of_places
    mesh, count = joined(samples.mesh, meshes.place), engine.control
    statistics = mesh_statistics(sums)
    ground = np.zeros((len(mesh), 1))
    angle = np.hstack([_angles(engine, samples), ground])[:, names.place]
    return Result(
        duration=found.duration,
        time=found.times,
        bodies=names.names,
        meshes=meshes.names,
        angle=angle,
        speed=np.hstack([samples.speed, ground])[:, names.place],
        mean_speed=np.append(found.mean_speed, 0.0)[names.place],
        dte=mesh[:, DTE],
        mesh_force=mesh[:, MESH_FORCE],
        film_thickness=mesh[:, FILM],
        lambda_ratio=mesh[:, LAMBDA],
        boundary_friction=mesh[:, BOUNDARY],
        viscous_friction=mesh[:, VISCOUS],
        power_loss=mesh[:, POWER_LOSS],
        mesh_power=mesh[:, MESH_POWER],
        bearing_loss=samples.drag[:, 0],
        churning_loss=samples.drag[:, 1],
        energy=found.energy,
        mesh=statistics,
        mesh_efficiency=_mesh_efficiency(sums),
        axes=axes_motion(scene, samples, meshes.place, angle[:, -1], statistics["mesh_force_mean"])
        if scene.moving_axes
        else None,
        stats=Stats(
            steps=int(count.steps),
            repeated_steps=int(count.repeated),
            stiff_steps=int(count.stiff_steps),
            rejected_steps=int(count.rejected),
            evaluations=int(count.evaluations),
            pair_events=int(count.pair_events),
            flank_events=int(count.flank_events),
            reversals=int(count.reversals),
            both_flanks=int(count.both_flanks),
            wall_time=found.wall,
            real_time_factor=found.simulated / found.wall,
        ),
        start_warning=engine.start_warning,
    )


def _of_places(mesh: np.ndarray, place: np.ndarray) -> np.ndarray:
    """Samples of the meshes at `place`."""
    return mesh[:, :, place]


def _mesh_efficiency(sums: MeshSums) -> tuple[float, float]:
    """Efficiency of the sun meshes and of the ring meshes."""
    lost, rolled = (
        sums.integral[row].reshape(2, -1).sum(axis=1) for row in (POWER_LOSS, MESH_POWER)
    )
    with np.errstate(invalid="ignore"):
        sun, ring = 1.0 - lost / rolled
    return float(sun), float(ring)


def _energy(engine: Run, begin: EnergyBooks, end: EnergyBooks, work: np.ndarray) -> Energy:
    """Ledger between two times; `work` is that put in and taken out by each machine between."""
    ledger, kinetic, elastic = end.since(begin)
    return Energy(
        machines=tuple(float(ledger[WORK + m]) for m in range(int(engine.train.machines))),
        kinetic=kinetic,
        elastic=elastic,
        friction=float(ledger[FRICTION]),
        damping=float(ledger[DAMPING]),
        bearing=float(ledger[BEARING]),
        churning=float(ledger[CHURNING]),
        stiffness_work=float(ledger[STIFFNESS_WORK]),
        weight=float(ledger[WEIGHT]),
        stored=end.kinetic + end.elastic,
        both_ways=float(work.min(axis=0).sum()),
    )
