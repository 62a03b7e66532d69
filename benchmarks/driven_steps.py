"""Cost of a step of a twin whose ports are given, with and without a new command.

python benchmarks/driven_steps.py [ROUNDS]: processor time of steps of 1 ms; median of the rounds
and their spread, the real-time factor, the error of the DTE, and the memory that Python allocates per step.

An unchanged step has the commands of the step before: the torques act already, and the integrator
does not end a step for them. Errors are those of a commanded run at tolerance 1e-3 against 1e-7,
relative to the rms of the DTE, of the worst mesh.
"""

from __future__ import annotations

import sys
import time
import tracemalloc
from collections.abc import Callable
from statistics import median

import numpy as np

import planetary_twin_py as pt

DT = 1e-3  # [s]
STEPS = 1000  # of a round
TOLERANCE, CONVERGED = 1e-3, 1e-7
CAUSALITIES = (("machine", "torque"), ("torque", "motion"), ("motion", "torque"))
TORQUE, LOAD, SPEED = 63.0, 147.0, pt.rpm(1000)


def scene_of(ports: tuple[str, str]) -> pt.Scene:
    """`paper` with these ports."""
    return pt.load_scene("paper").replace(
        **{"drive.input.port": ports[0], "drive.output.port": ports[1]}
    )


def course(ports: tuple[str, str], count: int, swing: float) -> list[dict[str, float]]:
    """Commands around the operating point, which swing by a share of it."""
    names = {"torque": "torque", "motion": "speed"}
    mean = {
        "input_torque": TORQUE,
        "output_torque": LOAD,
        "input_speed": SPEED,
        "output_speed": -3.0 / 7.0 * SPEED,
    }
    # A new speed acts at once, on a shaft that it deflects for the whole step.
    size = {name: swing * (0.1 if name.endswith("torque") else 1e-3) for name in mean}
    sides = zip(("input", "output"), ports, strict=True)
    used = [f"{side}_{names[port]}" for side, port in sides if port != "machine"]
    return [
        {name: mean[name] * (1.0 + size[name] * np.sin(0.3 * n + len(name))) for name in used}
        for n in range(count)
    ]


def seconds_per_step(twin: pt.Twin, commands: list[dict[str, float]]) -> float:
    """Processor time of one step [s]."""
    step: Callable[..., object] = twin.step
    begin = time.process_time()
    for command in commands:
        step(DT, **command)
    return (time.process_time() - begin) / len(commands)


def allocated(twin: pt.Twin, commands: list[dict[str, float]]) -> int:
    """Memory that steps leave allocated [bytes]."""
    for command in commands:
        twin.step(DT, **command)
    tracemalloc.start()
    before = tracemalloc.take_snapshot()
    for command in commands:
        twin.step(DT, **command)
    after = tracemalloc.take_snapshot()
    tracemalloc.stop()
    inside = tracemalloc.Filter(True, "*planetary_twin_py*")
    grown = after.filter_traces([inside]).compare_to(before.filter_traces([inside]), "lineno")
    return sum(change.size_diff for change in grown)


def error(ports: tuple[str, str]) -> float:
    """Error of the DTE of a commanded run."""
    every = course(ports, 50, 1.0)
    names = every[0]
    commands = pt.Commands(
        np.arange(len(every)) * DT,
        **{name: np.array([command[name] for command in every]) for name in names},
    )
    runs = [
        pt.simulate(scene_of(ports), len(every) * DT, 50_000.0, "auto", tol, commands=commands).dte
        for tol in (TOLERANCE, CONVERGED)
    ]
    missed = np.sqrt(np.mean((runs[0] - runs[1]) ** 2, axis=0))
    return float((missed / np.sqrt(np.mean(runs[1] ** 2, axis=0))).max())


def main() -> None:
    """Measure each causality."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    for ports in CAUSALITIES:
        plain, changed = [], []
        for _ in range(rounds):
            twins = [pt.Twin(scene_of(ports), tolerance=TOLERANCE) for _ in range(2)]
            for twin in twins:
                seconds_per_step(twin, course(ports, 100, 0.0))
            plain.append(1e6 * seconds_per_step(twins[0], course(ports, STEPS, 0.0)))
            changed.append(1e6 * seconds_per_step(twins[1], course(ports, STEPS, 1.0)))
        ratios = [b / a for a, b in zip(plain, changed, strict=True)]
        grown = allocated(pt.Twin(scene_of(ports), tolerance=TOLERANCE), course(ports, 100, 1.0))
        print(
            f"{ports[0]:>6}, {ports[1]:<6}: unchanged {median(plain):.1f} us, new command "
            f"{median(changed):.1f} us ({min(changed):.1f} to {max(changed):.1f}), ratio "
            f"{median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f}), "
            f"{1e6 * DT / median(changed):.0f} times real time, DTE error {error(ports):.1e}, "
            f"{grown} bytes left by 100 steps"
        )


if __name__ == "__main__":
    main()
