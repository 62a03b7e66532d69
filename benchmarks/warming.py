"""Cost of temperatures and damage, with the error that repeating mesh cycles makes.

python benchmarks/warming.py [ROUNDS [SECONDS]]: `paper` with heating in windows of 1 s, SECONDS
(600) from cold, near the steady state and with other dead bands, then live windows of 10 ms. The
cases of a round take turns. Processor time: the median of the rounds, and their spread. The error
is that of the end, against a run of the same scene in which every mesh cycle is computed.
"""

from __future__ import annotations

import sys
import time
from statistics import median

import planetary_twin_py as pt
from planetary_twin_py.run.tolerance import LIVE_TOLERANCE

HEATING = {
    "ambient": "25 degC",
    "oil": {"mass": "0.5 kg"},
    "gears": {"to_oil": "300 W/(m^2 K)"},
    "housing": {
        "mass": "4 kg", "area": "0.1 m^2", "height": "0.2 m", "from_oil": "10 W/K",
        "to_ambient": "still_air",
    },
    "cooler": {"capacity": "80 W/K", "opens": "60 degC"},
}  # fmt: skip
WITHOUT = pt.load_scene("paper").replace(
    losses={"planet_bearing": {"mean_diameter": "20 mm"}, "sun_drag": {"coulomb": "0.05 N m"}},
    **{"lubrication.lambda_ratio": "computed"},
)
COLD = WITHOUT.replace(thermal=HEATING)
RUNS = {
    "without heating": WITHOUT,
    "from cold": COLD,
    "near the steady state": COLD.replace(**{"thermal.start": "steady"}),
    "from cold, dead band 0.07 K": COLD.replace(**{"thermal.dead_band": 0.07}),
    "from cold, dead band 0.1 K": COLD.replace(**{"thermal.dead_band": 0.1}),
    "from cold, dead band 0.2 K": COLD.replace(**{"thermal.dead_band": 0.2}),
}
DAMAGE = {"material": dict.fromkeys(("sun", "planet", "ring"), "case_hardened")}
LIVE = {
    "without": WITHOUT,
    "damage": WITHOUT.replace(durability=DAMAGE),
    "temperatures from cold": COLD,
    "both": COLD.replace(durability=DAMAGE),
}
SETTLED, FOLLOWED = 300, 600  # live windows before the measured ones, and of these


def spread(values: list[float], digits: str) -> str:
    """Median, and smallest and largest value."""
    return f"{median(values):{digits}} ({min(values):{digits}} to {max(values):{digits}})"


def run(scene: pt.Scene, seconds: int) -> tuple[float, pt.Window]:
    """Processor time of a run [s], and its last window."""
    twin = pt.Twin(scene, 1000.0)
    begin = time.process_time()
    for _ in range(seconds):
        window = twin.advance(1.0)
    return time.process_time() - begin, window


def error(scene: pt.Scene, window: pt.Window) -> str:
    """Errors of the last window of a run."""
    settling = window.end - 1.0
    exact = pt.simulate(scene, 1.0, 1.0, "march", LIVE_TOLERANCE, settling)
    loss = window.power_loss / exact.mean_power_loss - 1.0
    found = [f"loss {loss:+.1e}"]
    if exact.temperatures:
        gaps = {part: window.temperatures[part] - at for part, at in exact.temperatures.items()}
        part = max(gaps, key=lambda part: abs(gaps[part]))
        found.append(f"{part} {gaps[part]:+.1e} K")
    return ", ".join(found)


def measure_runs(rounds: int, seconds: int) -> None:
    """Print the cost and the error of whole runs."""
    spent: dict[str, list[float]] = {name: [] for name in RUNS}
    ends = {}
    for _ in range(rounds):
        for name, scene in RUNS.items():
            took, ends[name] = run(scene, seconds)
            spent[name].append(took)
    least = median(spent["without heating"])
    for name, scene in RUNS.items():
        print(
            f"{seconds} s {name}: {spread(spent[name], '.3f')} s, "
            f"{median(spent[name]) / least:.2f} times without; error: {error(scene, ends[name])}"
        )


def live(scene: pt.Scene) -> float:
    """Processor time of a live window [us], after it has settled."""
    twin = pt.Twin(scene)
    for _ in range(SETTLED):
        twin.advance(0.01)
    begin = time.process_time()
    for _ in range(FOLLOWED):
        twin.advance(0.01)
    return 1e6 * (time.process_time() - begin) / FOLLOWED


def measure_live(rounds: int) -> None:
    """Print the cost of live windows."""
    spent: dict[str, list[float]] = {name: [] for name in LIVE}
    for _ in range(rounds):
        for name, scene in LIVE.items():
            spent[name].append(live(scene))
    least = median(spent["without"])
    for name, values in spent.items():
        ratio = median(values) / least
        print(f"window of 10 ms at 50 kHz, {name}: {spread(values, '.0f')} us, {ratio:.2f} times")


def main() -> None:
    """Measure all."""
    given = [int(argument) for argument in sys.argv[1:]]
    rounds, seconds = given + [5, 600][len(given) :]
    measure_runs(rounds, seconds)
    measure_live(rounds)


if __name__ == "__main__":
    main()
