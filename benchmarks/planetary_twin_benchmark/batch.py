"""Operating points per second of `simulate_many`, with set-up."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from statistics import median
from textwrap import fill
from typing import NamedTuple

from rich.table import Table

from planetary_twin_py.scene import Scene, load_scene
from planetary_twin_py.simulation.batch import simulate_many

SIZES = ((0.05, 40), (1.0, 8))  # simulated time of a point [s], number of points
WORKERS = (1, 2)
ROUNDS = 5  # the median is reported
TOLERANCE = 1e-4

_TITLES = ("points of", "workers", "points/s", "spread", "ratio")


class Throughput(NamedTuple):
    """Throughput of a number of workers for points of one length."""

    duration: float  # simulated, of a point [s]
    workers: int
    rates: tuple[float, ...]  # points per second of wall time, in every round
    ratio: float  # of the median to that of one worker

    @property
    def rate(self) -> float:
        """Median of the rounds."""
        return median(self.rates)


def measure_batch(
    sizes: Sequence[tuple[float, int]] = SIZES, progress: Callable[[str], None] = lambda text: None
) -> list[Throughput]:
    """Measure every size with every number of workers, in turns, so that other loads slow all."""
    found = []
    for duration, count in sizes:
        scenes, rates = operating_points(count), dict[int, list[float]]()
        for n in range(ROUNDS):
            progress(f"{count} points of {duration:g} s: round {n + 1} of {ROUNDS}")
            for workers in WORKERS:
                rates.setdefault(workers, []).append(count / _seconds(scenes, duration, workers))
        single = median(rates[1])
        found += [
            Throughput(duration, workers, tuple(of), median(of) / single)
            for workers, of in rates.items()
        ]
    return found


def operating_points(count: int) -> list[Scene]:
    """The scene `paper` at `count` pairs of load and lambda ratio."""
    scene, side = load_scene("paper"), math.ceil(math.sqrt(count))
    grid = [divmod(n, side) for n in range(count)]
    return [
        scene.replace(input_torque=20.0 + 60.0 * i / side, lambda_ratio=1.0 + j / side)
        for i, j in grid
    ]


def _seconds(scenes: Sequence[Scene], duration: float, workers: int) -> float:
    begin = time.perf_counter()
    for outcome in simulate_many(scenes, duration, tolerance=TOLERANCE, workers=workers):
        _ = outcome.result
    return time.perf_counter() - begin


def _cells(row: Throughput) -> tuple[str, ...]:
    spread = f"{min(row.rates):.3g}-{max(row.rates):.3g}"
    return (f"{row.duration:g} s", f"{row.workers}", f"{row.rate:.3g}", spread, f"{row.ratio:.2f}")


def batch_table(rows: Sequence[Throughput]) -> Table:
    """Table for the terminal."""
    table = Table(box=None, header_style="bold", pad_edge=False)
    for title in _TITLES:
        table.add_column(title, justify="right")
    for row in rows:
        table.add_row(*_cells(row))
    return table


def batch_markdown(rows: Sequence[Throughput]) -> str:
    """A paragraph for the page `docs/speed-and-accuracy.md`."""
    said = "; ".join(
        f"{row.rate:.3g} runs of {row.duration:g} s by {row.workers} (ratio {row.ratio:.2f})"
        for row in rows
    )
    text = f"`simulate_many` at tolerance {TOLERANCE:g}, with set-up and samples at 50 kHz, "
    return f"\n{fill(f'{text}computes in a second, by its number of workers, {said}.', 100)}\n"
