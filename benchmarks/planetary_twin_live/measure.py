"""The measurements of the live benchmark; each starts a simulation in a separate process."""

from __future__ import annotations

import os
import random
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

from planetary_twin.clients.loopback import stay_on_this_machine
from planetary_twin.running.node_process import Child

from planetary_twin_py.run.tolerance import AUTOMATIC

from .figures import Quantiles, Slope
from .meter import Meter
from .process import processor_time, resident_memory

RATES = (100.0, 1000.0)  # [Hz]
SUBSCRIBERS = (0, 1, 4, 16)
SETS = 200  # parameter changes for the latency
SETTLING = 5.0  # [s] after which the tolerance of a twin is constant and its motion is steady
_PERIOD = 0.5  # [s] between two samples of the memory
_VALUES = (1.5, 2.0)  # of the lambda ratio, in turn
CASES = [("paper", AUTOMATIC, n) for n in SUBSCRIBERS] + [
    (scene, tolerance, 1)
    for scene in ("floating_sun", "differential", "wind_turbine_stage")
    for tolerance in (AUTOMATIC, 1e-3)
]
"""Scene, tolerance and number of subscribers of each measurement of the processor share."""
Progress = Callable[[str], None]


class Punctuality(NamedTuple):
    """Results for one publish rate; times in s."""

    rate: float  # [Hz]
    messages: int
    lost: int
    sent: Quantiles  # jitter by the publisher's stamps
    came: Quantiles  # jitter by the subscriber's clock
    answer: Quantiles  # latency of the response
    shown: Quantiles  # latency of the first message with the new value
    real_time_factor: float
    overruns: int


class Cost(NamedTuple):
    """Processor share of one simulation with `listeners` subscribers."""

    scene: str
    tolerance: float
    mesh_cycles: str
    listeners: int
    cores: float  # share of one core
    real_time_factor: float
    waveform: str


class Memory(NamedTuple):
    """Resident memory over `duration` [s] with one subscriber."""

    duration: float
    begin: float  # [MB]
    end: float  # [MB]
    slope: Slope  # [MB/h]


class Figures(NamedTuple):
    """All results."""

    machine: str
    duration: float  # [s] of each measurement except that of the memory
    punctuality: list[Punctuality]
    costs: list[Cost]
    memory: Memory


def measure(duration: float, memory: float, progress: Progress) -> Figures:
    """
    Run all measurements and return the results.

    Each takes `duration` [s], that of the memory `memory` [s]. `progress` receives a line of text
    for each step.
    """
    machine, bench = _machine(), Bench(duration, progress)
    return Figures(
        machine,
        duration,
        [bench.punctuality(rate) for rate in RATES],
        [bench.cost(*case) for case in CASES],
        bench.memory(memory),
    )


def _machine() -> str:
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.partition(": ")[2] for line in lines if "model name" in line), "unknown")
    return f"{os.cpu_count()} cores of {model}, load average {os.getloadavg()[0]:.1f} before"


class Bench:
    """Measures simulations in a separate namespace, each for `duration` [s]."""

    def __init__(self, duration: float, progress: Progress) -> None:
        stay_on_this_machine()
        self._duration = duration
        self._progress = progress
        self._namespace = f"/bench_{os.getpid()}"

    def punctuality(self, rate: float) -> Punctuality:
        """Measure the jitter of messages and the latency of a parameter at `rate` [Hz]."""
        with ExitStack() as stack:
            simulation = self._simulation(stack, publish_rate=rate)
            meter = stack.enter_context(Meter(self._namespace, simulation))
            meter.begin()
            self._run(SETTLING, f"{rate:g} Hz: settles", simulation)
            meter.restart()
            before = int(meter.figures["overruns"])
            self._run(self._duration, f"{rate:g} Hz: jitter", simulation)
            sent, came = meter.jitter(1.0 / rate)
            received, lost = meter.received, meter.lost
            figures = meter.figures
            latencies = []
            for k in range(SETS):
                self._progress(f"{rate:g} Hz: parameter set {k} of {SETS}")
                latencies.append(meter.latency(_VALUES[k % 2]))
                time.sleep(random.uniform(0.02, 0.05))  # at any phase of an interval
        answer, shown = (Quantiles.of(times) for times in zip(*latencies, strict=True))
        return Punctuality(
            rate, received, lost, sent, came, answer, shown,
            float(figures["real_time_factor"]), int(figures["overruns"]) - before,
        )  # fmt: skip

    def cost(self, scene: str, tolerance: float, listeners: int) -> Cost:
        """Measure the processor share of a simulation with exactly `listeners` subscribers."""
        with ExitStack() as stack:
            simulation = self._simulation(stack, scene=scene, tolerance=tolerance)
            what = f"{scene}, {listeners} listeners"
            with Meter(self._namespace, simulation) as meter:
                meter.begin()
            if listeners:
                parameters = {"listeners": listeners}
                subscribers = Child(
                    "subscribers", self._namespace, parameters, "planetary_twin_live"
                )
                stack.enter_context(subscribers)
            self._run(SETTLING, f"{what}: settles", simulation)
            begin, before = time.monotonic(), processor_time(simulation.pid)
            self._run(self._duration, what, simulation)
            cores = (processor_time(simulation.pid) - before) / (time.monotonic() - begin)
            with Meter(self._namespace, simulation) as meter:
                meter.begin()
                meter.wait(lambda: bool(meter.figures), 5.0)
                figures = meter.figures
        return Cost(
            scene, float(figures["tolerance"]), figures["mesh_cycles"], listeners, cores,
            float(figures["real_time_factor_mean"]), figures["waveform"],
        )  # fmt: skip

    def memory(self, duration: float) -> Memory:
        """Measure the resident memory and its slope for `duration` [s]."""
        with ExitStack() as stack:
            simulation = self._simulation(stack)
            meter = stack.enter_context(Meter(self._namespace, simulation))
            meter.begin()
            self._run(SETTLING, "memory: settles", simulation)
            times, sizes = [], []
            begin = time.monotonic()
            while (now := time.monotonic() - begin) < duration or len(times) < 3:
                times.append(now / 3600.0)
                sizes.append(resident_memory(simulation.pid))
                meter.restart()
                self._run(_PERIOD, f"memory: {now:.0f} of {duration:g} s", simulation)
        return Memory(duration, sizes[0], sizes[-1], Slope.of(times, sizes))

    def _simulation(self, stack: ExitStack, **parameters: object) -> Child:
        return stack.enter_context(Child("simulation", self._namespace, parameters))

    def _run(self, seconds: float, what: str, simulation: Child) -> None:
        self._progress(what)
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            simulation.check()
            time.sleep(min(left, 0.5))
