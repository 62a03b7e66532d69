"""Cost of a step of a twin whose ports are given, with and without a new command.

python benchmarks/driven_steps.py [ROUNDS]: processor time of steps of 1 ms, median of the rounds
and spread; the real-time factor, the error of the DTE, and the memory that steps leave.

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
STEPS = 200  # of a round
SWINGS = (1e-6, 0.1, 1.0)  # of 10 % of torques and 0.1 % of speeds
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


def measure(ports: tuple[str, str], swing: float, rounds: int) -> tuple[list[float], list[float]]:
    """Processor time of unchanged steps and of commanded ones [us], alternately, (rounds,) each."""
    twins = [pt.Twin(scene_of(ports), tolerance=TOLERANCE) for _ in range(2)]
    courses = [course(ports, STEPS, share) for share in (0.0, swing)]
    found: tuple[list[float], list[float]] = ([], [])
    for twin in twins:
        seconds_per_step(twin, courses[0][:100])
    for _ in range(rounds):
        for twin, commands, times in zip(twins, courses, found, strict=True):
            times.append(1e6 * seconds_per_step(twin, commands))
    return found


def main() -> None:
    """Measure each causality."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    for ports in CAUSALITIES:
        for swing in SWINGS:
            plain, changed = measure(ports, swing, rounds)
            ratios = sorted(b / a for a, b in zip(plain, changed, strict=True))
            print(
                f"{ports[0]:>7}, {ports[1]:<6} swing of torques {10.0 * swing:g} %: unchanged "
                f"{median(plain):.1f} us, new command {median(changed):.1f} us, ratio "
                f"{median(ratios):.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f}), "
                f"{1e6 * DT / median(changed):.0f} times real time"
            )
        left = allocated(pt.Twin(scene_of(ports), tolerance=TOLERANCE), course(ports, 100, 1.0))
        print(f"{'':>9}DTE error {error(ports):.1e}, {left} bytes left by 100 steps")


if __name__ == "__main__":
    main()
