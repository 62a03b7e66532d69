"""Cost of windows of a live twin, with and without sensors, and how many twins run on one core.

python benchmarks/windows.py [ROUNDS]: processor time; the median of the rounds, and their spread.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from statistics import median

import planetary_twin_py as pt

WINDOW = 0.01  # [s]
COPIES = (1, 16, 64)
PAPER = pt.load_scene("paper")
ACCELEROMETER = {"name": "top", "kind": "accelerometer", "rate": 25_600.0}
CHANGED = {"lambda_ratio": (1.0, 1.5), "input_torque": (56.7, 69.3), "backlash": (1.8e-7, 2.2e-7)}


def spread(values: list[float], digits: str) -> str:
    """Median, and smallest and largest value."""
    return f"{median(values):{digits}} ({min(values):{digits}} to {max(values):{digits}})"


def seconds(work: Callable[[], object], times: int) -> float:
    """Processor time of this process for one of so many calls [s]."""
    begin = time.process_time()
    for _ in range(times):
        work()
    return (time.process_time() - begin) / times


def measure_windows(rounds: int) -> None:
    """Cost of one window while steady running repeats itself, and before that."""
    repeated = pt.Twin(PAPER)
    while not repeated.advance(WINDOW).repeated:
        pass
    for rate in (50_000.0, 1.0):
        repeated.set_sample_rate(rate)
        found = [1e6 * seconds(lambda: repeated.advance(WINDOW), 300) for _ in range(rounds)]
        print(f"window of 10 ms that repeats, {rate:g} Hz: {spread(found, '.0f')} us")
    for rate in (50_000.0, 1.0):
        found = []
        for _ in range(rounds):
            computed = pt.Twin(PAPER, rate)
            found.append(1e6 * seconds(lambda twin=computed: twin.advance(WINDOW), 90))
        print(f"window of 10 ms that is computed, {rate:g} Hz: {spread(found, '.0f')} us")


def scenes(count: int) -> list[pt.Scene]:
    """`paper`, its operating point and backlash spread over 10 % and more."""
    shares = [n / max(count - 1, 1) for n in range(count)]
    return [
        PAPER.replace(**{name: low + (high - low) * share for name, (low, high) in CHANGED.items()})
        for share in shares
    ]


def measure_copies(rounds: int) -> None:
    """Real-time factor of every one of many copies on one core."""
    for count in COPIES:
        computed, repeated, set_up = [], [], []
        for _ in range(rounds):
            begin = time.process_time()
            twins = pt.Twins(scenes(count), 100.0, workers=1)
            set_up.append(1e3 * (time.process_time() - begin) / count)
            twins.advance(WINDOW)
            computed.append(WINDOW / seconds(lambda of=twins: of.advance(WINDOW), 30))
            while not all(window and window.repeated for window in twins.advance(0.1)):
                pass
            repeated.append(WINDOW / seconds(lambda of=twins: of.advance(WINDOW), 30))
        print(
            f"{count} copies on one core, times real time each: computed {spread(computed, '.2f')},"
            f" repeating {spread(repeated, '.1f')}; set-up of one {spread(set_up, '.0f')} ms"
        )


def measure_sensors(rounds: int) -> None:
    """Cost of an accelerometer, by twins with and without one that run in turn."""
    for name in ("paper", "floating_sun"):
        scene = pt.load_scene(name)
        spent: dict[str, list[float]] = {"without": [], "with": []}
        for _ in range(rounds):
            for kind, sensors in (("without", []), ("with", [ACCELEROMETER])):
                twin = pt.Twin(scene.replace(sensors=sensors), 1000.0)
                twin.advance(WINDOW)
                spent[kind].append(seconds(lambda of=twin: of.advance(WINDOW), 30) / WINDOW)
        texts = (f"{kind} {spread(values, '.3f')}" for kind, values in spent.items())
        print(f"{name}, accelerometer at 25.6 kHz, s per simulated s: {', '.join(texts)}")


def main() -> None:
    """Measure all."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    measure_windows(rounds)
    measure_sensors(rounds)
    measure_copies(rounds)


if __name__ == "__main__":
    main()
