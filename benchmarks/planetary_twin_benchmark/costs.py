"""Speed over terms of the model, planets, motor speed and duration, one table each."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import Any, NamedTuple

from rich.table import Table

from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.phasing import nearest_assembly
from planetary_twin_py.scene import Scene, load_scene
from planetary_twin_py.units.conversion import rpm

from .cases import PLANAR, Case
from .markdown import markdown_table, three_digits
from .timing import METHOD, SAMPLE_RATE, Speed, affordable, end_to_end, speed

TOLERANCE = 1e-4
SHORTEST, LONGEST = 0.02, 10.0  # [s] simulated in a round
PLANETS = range(2, 8)
SPEEDS = (10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10_000.0)  # [rpm]
DURATIONS = (0.1, 1.0, 10.0)  # [s]

# Two to six planets at equal angles, seven nearly so; no two of them mesh in phase.
TEETH = Teeth(43, 17, 77)
MESH_FREQUENCY = 500.0  # [Hz] of the scene `paper`

_NO_FRICTION = {"lubrication.friction": False}
_LOSSES: dict[str, Any] = {
    "lubrication.rolling": "goksem_hargreaves",
    "losses.planet_bearing": {"mean_diameter": 0.012},
    "losses.churning": {"fill": 0.3, "gap": 0.01, "sun": 0.013},
}
_FAULTS: list[dict[str, Any]] = [
    {"kind": "crack", "gear": "sun", "tooth": 0, "stiffness_loss": 0.2},
    {"kind": "spall", "gear": "planet", "tooth": 3, "stiffness_loss": 0.3},
]
_FORM_ERRORS = {
    "mesh.sun_planet_error": {"amplitudes": [1e-6]},
    "mesh.planet_ring_error": {"amplitudes": [1e-6]},
    "mesh.runout": {"sun": 2e-6},
    "backlash": 2e-6,
}
# Changes to the scene `paper`, which has friction and no other loss.
TERMS: dict[str, dict[str, Any]] = {
    "friction, rolling, bearings, churning": _LOSSES,
    "the same without friction": _LOSSES | _NO_FRICTION,
    "friction alone": {},
    "friction alone, rectangular stiffness": {"mesh.ramp": 0.0},
    "neither friction nor other losses": _NO_FRICTION,
    "neither, rectangular stiffness": _NO_FRICTION | {"mesh.ramp": 0.0},
    "friction alone, without dynamics": {"dynamics": "quasi_static"},
    "friction, a crack and a spall": {"faults": _FAULTS},
    "friction, errors of form": _FORM_ERRORS,
}


class Cost(NamedTuple):
    """A line of a table."""

    against: str  # name of the table
    value: str
    speed: Speed


# Lines of a table: what is reported, and the function that measures it.
_Entries = Iterator[tuple[str, Callable[[], Speed]]]


def _integration(scene: Scene) -> Callable[[], Speed]:
    """Measures integration alone, over a time that is long enough to measure."""

    def measured() -> Speed:
        duration = affordable(scene, TOLERANCE, SHORTEST, LONGEST)
        return speed(scene, duration, METHOD, TOLERANCE, sampled=False)

    return measured


def _terms() -> _Entries:
    for name, changes in TERMS.items():
        yield name, _integration(load_scene("paper").replace(**changes))


def _planets() -> _Entries:
    for count in PLANETS:
        yield f"{count}", _integration(load_scene("paper").replace(**planets(count, TEETH)))
    for count in PLANETS:
        changes = planets(count, teeth_in_phase(count))
        yield f"{count} in phase", _integration(load_scene("paper").replace(**changes))


def _speeds() -> _Entries:
    for value in SPEEDS:
        yield f"{value:g} rpm", _integration(load_scene("paper").replace(input_speed=rpm(value)))


def _durations() -> _Entries:
    scene = load_scene("paper")
    for duration in DURATIONS:
        yield f"{duration:g} s", partial(end_to_end, scene, duration, TOLERANCE)


TABLES: dict[str, Callable[[], _Entries]] = {
    "terms": _terms,
    "planets": _planets,
    "motor speed": _speeds,
    "duration": _durations,
}


def teeth_in_phase(count: int) -> Teeth:
    """Tooth numbers close to TEETH with which `count` planets at equal angles mesh in phase.

    The numbers of sun and ring are multiples of `count`. Planets get no fewer teeth than in TEETH,
    otherwise teeth would touch below the base circle.
    """
    half = count // math.gcd(count, 2)
    sun, planet = count * round(TEETH.sun / count), half * math.ceil(TEETH.planet / half)
    return Teeth(sun, planet, sun + 2 * planet)


def planets(count: int, teeth: Teeth) -> dict[str, Any]:
    """Changes to the scene `paper`: gears for `count` planets, each with the same load."""
    paper = load_scene("paper")
    even = [2.0 * math.pi * n / count for n in range(count)]
    per_planet = paper.operating_point.input_torque / paper.gearset.planets
    return {
        "gearset.teeth": teeth._asdict(),
        "gearset.planet_angles": nearest_assembly(teeth, even),
        "input_speed": 2.0 * math.pi * MESH_FREQUENCY / teeth.sun,
        "input_torque": per_planet * count,
    }


# Unequal planets: each has another phase of its meshes, so that all are integrated.
PLANET_CASES = tuple(
    Case(f"{axes}, {count} planets", planets(count, TEETH) | changes, 0.01, 40)
    for axes, changes in (("held", {}), ("planar", PLANAR))
    for count in PLANETS
)


def measure_costs(
    tables: Iterable[str] = tuple(TABLES), progress: Callable[[str], None] = lambda text: None
) -> list[Cost]:
    """Measure the lines of the named tables."""
    found = []
    for against in tables:
        for value, measured in TABLES[against]():
            progress(f"cost against {against}: {value}")
            found.append(Cost(against, value, measured()))
    return found


def _cells(cost: Cost) -> tuple[str, str, str]:
    median, low, high = cost.speed
    return cost.value, three_digits(median), f"{three_digits(low)}-{three_digits(high)}"


def _median(cost: Cost) -> str:
    return three_digits(cost.speed.median)


def _of(costs: Sequence[Cost]) -> Iterator[tuple[str, list[Cost]]]:
    for against in dict.fromkeys(cost.against for cost in costs):
        yield against, [cost for cost in costs if cost.against == against]


def cost_tables(costs: Sequence[Cost]) -> list[Table]:
    """Tables for the terminal."""
    tables = []
    for against, lines in _of(costs):
        table = Table(box=None, header_style="bold", pad_edge=False)
        for title in (against, "speed", "spread"):
            table.add_column(title, justify="left" if title == against else "right")
        for cost in lines:
            table.add_row(*_cells(cost))
        tables.append(table)
    return tables


def cost_markdown(costs: Sequence[Cost]) -> str:
    """A section for the page `docs/speed-and-accuracy.md`."""
    terms = [(cost.value, _median(cost)) for cost in costs if cost.against == "terms"]
    rest = [
        (f"{against}: {'; '.join(cost.value for cost in lines)}", "; ".join(map(_median, lines)))
        for against, lines in _of(costs)
        if against != "terms"
    ]
    return f"""
## What speed costs

The scene `paper` at tolerance {TOLERANCE:g}, method `{METHOD}`, without samples and set-up.

- Planets: teeth {TEETH.sun}/{TEETH.planet}/{TEETH.ring} at the same meshing frequency and load of a
  planet. *In phase*: the nearest teeth with which planets mesh in phase, so that one is integrated
  for all.
- Duration: `simulate` by wall time, with set-up and samples at {SAMPLE_RATE / 1e3:g} kHz.

{markdown_table(("terms", "speed"), terms + rest)}
"""
