"""Speed of the integrator against its error, case by case, for one build of the core or several.

    python benchmarks/core_speed.py                      # this checkout
    python benchmarks/core_speed.py --against ../before  # ... beside another one with its own build
    python benchmarks/core_speed.py --levels v3 v4       # ... these levels, both built
    python benchmarks/core_speed.py --tolerances 1e-3 1e-2  # in place of that of each case

Prints simulated over processor time (without and with samples at 50 kHz), processor time and number
of steps, and the error of the transmission error against the same build at a tolerance of 1e-8,
relative to its rms and to the rms of its alternating part, of the worst mesh. Runs alternate
between the processes of the builds, and `ratio` is the median over the rounds of a row's speed over
that of the last build. The periodic repetition of mesh cycles is off (`march`).

    python benchmarks/core_speed.py --planets --levels v3 v4

measures 2 to 7 unequal planets with held and with moving axes, whose runs alternate, too: `of 4` is
the time of a step over that with four planets, `by size` the same over the ratio of the numbers of
bodies and meshes.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

import numpy as np

SAMPLE_RATE = 50_000.0
# [s] of a call with samples, which are few enough that their memory is used again; without samples,
# one call integrates all, so the interpreter takes no time.
WINDOW = 0.02
CONVERGED = 1e-8  # tolerance of the run that errors are measured against
HERE = Path(__file__).resolve().parent


class Case(NamedTuple):
    """A case of `planetary_twin_benchmark.cases`, and how it is timed."""

    name: str
    of: str  # its name there
    tolerance: float
    lead: float  # [s] before what is timed
    timed: float  # [s]; about 20 ms of a processor, so that filling the caches counts little


CASES = (
    Case("steady 1000 rpm", "steady 1000 rpm", 1e-3, 0.01, 1.2),
    Case("steady at 1e-6", "steady 1000 rpm", 2e-5, 0.01, 0.5),
    Case("steady 3000 rpm", "steady 3000 rpm", 1e-3, 0.01, 0.5),
    Case("stiff 100 rpm", "stiff 100 rpm", 1e-3, 0.01, 8.0),
    Case("rattle", "rattle", 1e-3, 0.01, 1.0),
    Case("light damping", "light damping 1000 rpm", 1e-3, 0.01, 0.8),
    Case("run-up", "run-up 5 to 1000 rpm in 0.5 s", 1e-3, 0.02, 0.48),
    Case("resonance 17 000 rpm", "resonance 17 000 rpm", 1e-3, 0.005, 0.04),
    Case("planar", "planar", 1e-3, 0.05, 0.4),
    Case("planar, floating sun", "planar, floating sun", 1e-3, 0.05, 0.4),
    Case("planar, in phase", "planar, 4 planets in phase", 1e-3, 0.05, 0.8),
    Case("planar, helical", "planar, helical", 1e-3, 0.05, 0.4),
    Case("spatial", "spatial", 1e-3, 0.05, 0.2),
    Case("wind turbine stage", "wind turbine stage", 1e-3, 0.1, 2.0),
    Case("helical stage", "helical stage", 1e-3, 0.1, 1.0),
)
PLANETS = tuple(
    Case(name := f"{axes}, {count} planets", name, 1e-3, 0.05, timed)
    for axes, timed in (("held", 0.4), ("planar", 0.2))
    for count in range(2, 8)
)
FOUR = 15  # gears, carrier and meshes of four planets


class Timed(NamedTuple):
    """What a timed run took."""

    seconds: float  # of processor
    steps: int


def scene_of(case: Case) -> Any:
    """The case of `planetary_twin_benchmark`."""
    from planetary_twin_benchmark.cases import CASES as HELD
    from planetary_twin_benchmark.cases import PLANAR_CASES, STAGE_CASES
    from planetary_twin_benchmark.costs import PLANET_CASES

    known = (*HELD, *PLANAR_CASES, *STAGE_CASES, *PLANET_CASES)
    return next(each for each in known if each.name == case.of)


def timed(case: Case, sampled: bool) -> Timed:
    """Run a case in this process."""
    from planetary_twin_benchmark.samples import samples_until

    from planetary_twin_py.run.start import start

    engine = start(scene_of(case).scene(), case.tolerance, "march")
    engine.sample(case.lead)
    before, windows = engine.control.steps, round(case.timed / WINDOW) if sampled else 1
    ends = [case.lead + (n + 1) * case.timed / windows for n in range(windows)]
    seconds, done = 0.0, round(case.lead * SAMPLE_RATE)
    for end in ends:
        due = round(end * SAMPLE_RATE)
        begin = time.thread_time()
        samples_until(engine, end, done + 1, SAMPLE_RATE, due - done if sampled else 0)
        seconds += time.thread_time() - begin
        done = due
    return Timed(seconds, engine.control.steps - before)


def errors(case: Case) -> tuple[float, float]:
    """Error of the DTE over its rms, and over that of its alternating part, of the worst mesh."""
    from planetary_twin_benchmark.samples import samples_until

    from planetary_twin_py._core import DTE
    from planetary_twin_py.run.start import start

    compared = scene_of(case)
    room = round(compared.duration * SAMPLE_RATE)

    def dte(tolerance: float) -> Any:
        engine = start(compared.compared(), tolerance, "march")
        return samples_until(engine, compared.duration, 1, SAMPLE_RATE, room).mesh[:, DTE]

    def rms(values: Any) -> Any:
        return np.sqrt(np.mean(values**2, axis=0))

    exact = dte(CONVERGED)
    error = rms(dte(case.tolerance) - exact)
    alternating = rms(exact - exact.mean(axis=0))
    return float(np.max(error / rms(exact))), float(np.max(error / alternating))


def serve() -> None:
    """Answer requests of the parent process, a line each."""
    for line in sys.stdin:
        request = json.loads(line)
        case = Case(*request["case"])
        answer = errors(case) if request["errors"] else timed(case, request["sampled"])
        print(json.dumps(answer), flush=True)


class Build:
    """A checkout with its built core, in a process of its own."""

    def __init__(self, checkout: Path, level: str | None) -> None:
        self.name = " ".join(filter(None, (checkout.resolve().name, level)))
        paths = [str(checkout.resolve()), str(checkout.resolve() / "benchmarks")]  # its own calls
        code = f"import sys; sys.path[:0] = {paths}; import core_speed; core_speed.serve()"
        self._process = subprocess.Popen(
            [sys.executable, "-c", code],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env=os.environ | ({"PLANETARY_TWIN_LEVEL": level} if level else {}),
        )

    def ask(self, case: Case, *, errors: bool = False, sampled: bool = False) -> Any:
        """What the process answers."""
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None and stdout is not None
        print(json.dumps({"case": case, "errors": errors, "sampled": sampled}), file=stdin)
        stdin.flush()
        return json.loads(stdout.readline())

    def close(self) -> None:
        """End the process."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()


Entry = tuple[Case, Build]


def measure(builds: list[Build], cases: list[Case], rounds: int) -> Iterator[str]:
    """Rows of the table: for each case one of each build, all timed in turns."""
    entries = [(case, build) for case in cases for build in builds]
    runs: dict[tuple[Entry, bool], list[Timed]] = {
        (entry, sampled): [] for entry in entries for sampled in (False, True)
    }
    for round_number in range(rounds):
        for sampled in (False, True):
            for case, build in entries if round_number % 2 else reversed(entries):
                run = Timed(*build.ask(case, sampled=sampled))
                runs[(case, build), sampled].append(run)
    for case, build in entries:
        plain = runs[(case, build), False]
        row = _row(case, build, plain, runs[(case, build), True])
        row += f"{_ratio(runs[(case, builds[-1]), False], plain, 1.0):7.2f}"
        if len(cases) > 1:
            four = next(each for each in cases if _size(each) == FOUR)
            steps = plain[0].steps / runs[(four, build), False][0].steps
            of_four = _ratio(plain, runs[(four, build), False], steps)
            row += f"{of_four:7.2f}{of_four * FOUR / _size(case):9.2f}"
        yield row


def _row(case: Case, build: Build, plain: list[Timed], sampled: list[Timed]) -> str:
    """The cells of one build alone."""
    seconds = median(run.seconds for run in plain)
    spread = [case.timed / run.seconds for run in plain]
    sampled_speed = case.timed / median(run.seconds for run in sampled)
    error, alternating = build.ask(case, errors=True)
    return (
        f"{case.name:22s}{case.tolerance:<10g}{build.name:14s}{case.timed / seconds:8.2f}"
        f"{f'{min(spread):.3g}-{max(spread):.3g}':>14s}{sampled_speed:9.2f}"
        f"{1e9 * seconds / plain[0].steps:9.0f}{plain[0].steps:8d}"
        f"{error:10.1e}{alternating:10.1e}"
    )


def _ratio(above: list[Timed], below: list[Timed], steps: float) -> float:
    """Median over the rounds of the ratio of times, over that of the steps."""
    pairs = zip(above, below, strict=True)
    return median(one.seconds / other.seconds for one, other in pairs) / steps


def _size(case: Case) -> int:
    """Number of gears, carrier and meshes."""
    planets = scene_of(case).scene().gearset.planets
    return 3 + planets + 2 * planets


def main() -> None:
    """Measure all cases and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--against", type=Path, help="another checkout with its own build")
    parser.add_argument("--levels", nargs="*", default=[None], help="of the core, each built")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--cases", nargs="*", default=[""], help="parts of the names of cases")
    parser.add_argument("--planets", action="store_true", help="2 to 7 unequal planets instead")
    parser.add_argument(
        "--tolerances", nargs="*", type=float, default=[], help="in place of theirs"
    )
    arguments = parser.parse_args()
    checkouts = [HERE.parent, *filter(None, [arguments.against])]
    builds = [Build(checkout, level) for checkout in checkouts for level in arguments.levels]
    titles = (
        f"{'case':22s}{'tolerance':10s}{'build':14s}{'RTF':>8s}{'slow-fast':>14s}{'sampled':>9s}"
        f"{'ns/step':>9s}{'steps':>8s}{'error':>10s}{'of AC':>10s}{'ratio':>7s}"
    )
    print(titles + (f"{'of 4':>7s}{'by size':>9s}" if arguments.planets else ""))
    chosen = [case for case in CASES if any(part in case.name for part in arguments.cases)]
    families = [[case] for case in chosen]
    if arguments.planets:
        families = [[case for case in PLANETS if axes in case.name] for axes in ("held", "planar")]
    for cases in families:
        for tolerance in arguments.tolerances or [cases[0].tolerance]:
            tried = [case._replace(tolerance=tolerance) for case in cases]
            print(*measure(builds, tried, arguments.rounds), sep="\n", flush=True)
    for build in builds:
        build.close()


if __name__ == "__main__":
    main()
