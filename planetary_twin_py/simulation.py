"""A whole run, as fast as it goes."""

from __future__ import annotations

import math
import time
import warnings

import numpy as np

from .dynamics.bodies import body_names, mesh_names
from .dynamics.observe import (
    BOUNDARY,
    DTE,
    FILM,
    LAMBDA,
    MESH_FORCE,
    MESH_POWER,
    POWER_LOSS,
    VISCOUS,
)
from .dynamics.state import BEARING, CHURNING, DAMPING, FRICTION, STIFFNESS_WORK, WORK
from .engine import METHODS
from .integrators.interpolant import Samples
from .ledger_check import LedgerWarning, balance_of_run, ledger_warning
from .result import Energy, Result, Stats
from .run import Run, start
from .scene import Scene
from .tolerance import check_tolerance

MOST_SAMPLES = 20_000_000
TOLERANCE = 1e-4  # unless one is given


def simulate(
    scene: Scene,
    duration: float,
    sample_rate: float = 50_000.0,
    method: str = "auto",
    tolerance: float = TOLERANCE,
) -> Result:
    """Simulate `duration` seconds of a scene from steady running.

    Args:
        scene: what to simulate.
        duration: simulated time [s].
        sample_rate: of the result [Hz]; samples lie at whole multiples of its period.
        method: "collocation", "rosenbrock", "march": the first wherever it is fit, or "auto": the
            same, but steady running that repeats itself is not computed again.
        tolerance: relative local error of a step.

    Raises:
        ValueError: an argument is out of range, or the scene cannot be run.
        RunawayError: the train shows what no gearbox can, see `runaway`.

    Warns:
        LedgerWarning: the energy ledger does not close, see `ledger_check`.
    """
    check_run(duration, sample_rate, method, tolerance)
    engine = start(scene, tolerance, method)
    stored = engine.stored()
    room = math.floor(duration * sample_rate + 1e-6)
    begin = time.perf_counter()
    samples = engine.advance(duration, 1, sample_rate, room)
    wall = time.perf_counter() - begin
    result = _result(scene, engine, samples, sample_rate, stored, wall)
    if text := ledger_warning(balance_of_run(result.energy), tolerance):
        warnings.warn(text, LedgerWarning, stacklevel=2)
    return result


def check_run(duration: float, sample_rate: float, method: str, tolerance: float) -> None:
    """Raise the ValueError of an argument of `simulate` that is out of range."""
    if method not in METHODS:
        raise ValueError(f"method = {method!r}: must be one of {', '.join(METHODS)}")
    if not (duration > 0.0 and 1.0 <= duration * sample_rate <= MOST_SAMPLES):
        raise ValueError(
            f"duration = {duration!r} s at sample_rate = {sample_rate!r} Hz: must give between 1 "
            f"and {MOST_SAMPLES} samples"
        )
    check_tolerance(tolerance)


def _result(
    scene: Scene,
    engine: Run,
    samples: Samples,
    sample_rate: float,
    stored: tuple[float, float],
    wall: float,
) -> Result:
    names, meshes = body_names(scene), mesh_names(scene)
    mesh, count = samples.mesh[:, :, meshes.place], engine.control
    ground = np.zeros((len(mesh), 1))
    turned = 2.0 * math.pi * samples.turns @ engine.train.ratio[: engine.train.bodies].T
    return Result(
        duration=float(engine.reached),
        time=np.arange(1, len(mesh) + 1) / sample_rate,
        bodies=names.names,
        meshes=meshes.names,
        angle=np.hstack([turned + samples.angle, ground])[:, names.place],
        speed=np.hstack([samples.speed, ground])[:, names.place],
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
        energy=_energy(engine, stored),
        stats=Stats(
            steps=int(count.steps),
            repeated_steps=int(count.repeated),
            stiff_steps=int(count.stiff_steps),
            rejected_steps=int(count.rejected),
            evaluations=int(count.evaluations),
            pair_events=int(count.pair_events),
            flank_events=int(count.flank_events),
            wall_time=wall,
            real_time_factor=float(engine.reached) / wall,
        ),
    )


def _energy(engine: Run, stored: tuple[float, float]) -> Energy:
    ledger, now = engine.take_ledger(), engine.stored()
    return Energy(
        machines=tuple(float(ledger[WORK + m]) for m in range(int(engine.train.machines))),
        kinetic=now[0] - stored[0],
        elastic=now[1] - stored[1],
        friction=float(ledger[FRICTION]),
        damping=float(ledger[DAMPING]),
        bearing=float(ledger[BEARING]),
        churning=float(ledger[CHURNING]),
        stiffness_work=float(ledger[STIFFNESS_WORK]),
        stored=sum(now),
    )
