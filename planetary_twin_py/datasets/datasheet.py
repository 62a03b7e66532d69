"""datasheet.md of a data set, with the headings of Gebru et al. 2021, Commun. ACM 64, 86-92."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .._core import SOURCES
from ..recording.runs.origin import makers_here
from ..scene.sensors import AnySensor
from ..studies.axes import Axis, Normal, Span
from .card import counts
from .card_texts import LIMITS, USES, description_of, unmodelled
from .plan import DatasetPlan, Record
from .spec import Course


def datasheet(plan: DatasetPlan, records: Sequence[Record]) -> str:
    """Text of datasheet.md.

    Args:
        plan: of the data set.
        records: all records.
    """
    spec = plan.spec
    software = ", ".join(f"{name} {number}" for name, number in makers_here().software.items())
    maker = ", ".join(spec.creators) or "not stated"
    why = spec.description.strip() or "Labelled vibration of a planetary gearbox, to learn from."
    states = [
        f"{state.label}: {_draw(draw, name)}"
        for state in plan.states
        for _, name, draw in state.draws
    ]
    points = [
        f"operating point {n}: {_draw(draw)}"
        for n, (draws, _) in enumerate(plan.points)
        for draw in draws
    ]
    courses = [
        f"operating point {n}: {_course(course)}" for n, (_, course) in enumerate(plan.points)
    ]
    return f"""# Datasheet of {spec.name}

## Motivation

{why}

Made by: {maker}.

## Composition

{description_of(plan)}

{counts(plan, records)}

- A row is a signal: one sensor in one run of one specimen. Nothing is missing, and there are no
  people in it.
- Parts are by specimen: no specimen is in two of them.
- A state with a fault has the same fault in all records of a specimen. Levels of severity are
  thirds of the drawn distribution, not grades of damage.
- Random numbers depend on the seed and on the numbers of specimen, state, operating point,
  repetition and run only.

Sensors: {"; ".join(_sensors(plan))}.

Drawn for each specimen:

{_list(_draw(draw) for draw in plan.drawn)}

Drawn for each specimen and state:

{_list(states)}

Drawn for each record, the same for all states of a specimen:

{_list(points)}

Courses within a record:

{_list(courses)}

## Collection process

Simulated by {software}; core {SOURCES}.

Each run starts at its operating point, settles for {spec.settling:g} s and is recorded for
{spec.duration:g} s; tolerance {spec.tolerance:g}. Where speed or torque change, the motion of the
input shaft and the torque of the output shaft are given, so the motor has no ripple and no speed
loop. `spec.yaml` repeats the data: bit for bit with the same software on a processor with the same
instructions.

## Preprocessing, cleaning, labelling

A filter of 80 dB stops what would be an alias before the samples are taken; it passes 0.4 of the
rate. Samples are rounded to single precision. Labels are the states of the specification. No record
is left out; `remarks` has what limits the accuracy of a run, `n_clipped` counts samples beyond the
range.

## Uses

{_list(USES)}

What is not modelled, and what the data cannot show:

{_list((*unmodelled(plan), *LIMITS))}

## Distribution

Licence: {spec.license}. Cite the data set by its name and version {spec.version}, and the software
by its CITATION.cff.

## Maintenance

A new version has another `version` in `spec.yaml`. An error in the data is one of the specification
or of the software: report it with `spec.yaml` and the name of the signal.
"""


def _list(lines: Iterable[str]) -> str:
    return "\n".join(f"- {line}" for line in lines) or "- nothing"


def _sensors(plan: DatasetPlan) -> list[str]:
    return [
        f"{sensor.name}: {', '.join(f'{name} {value}' for name, value in _plain(sensor).items())}"
        for sensor in plan.scene.sensors
    ]


def _plain(sensor: AnySensor) -> dict[str, object]:
    return sensor.model_dump(mode="json", exclude={"name", "seed"}, exclude_none=True)


def _draw(draw: Axis | Span | Normal, name: str = "") -> str:
    """A distribution in words, in SI."""
    name = name or draw.field
    if isinstance(draw, Axis):
        return f"`{name}`: one of {', '.join(map(str, draw.values))}"
    if isinstance(draw, Normal):
        return f"`{name}`: normal, mean {draw.mean:g}, standard deviation {draw.deviation:g}"
    law = "logarithmically uniform" if draw.logarithmic else "uniform"
    return f"`{name}`: {law} from {draw.low:g} to {draw.high:g}"


def _course(course: Course) -> str:
    given = course.model_dump(exclude_defaults=True)
    return ", ".join(f"{name} {value:g}" for name, value in given.items()) or "constant"
