"""`planetary-twin duty`: losses and peaks of a duty cycle from a table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import (
    EvaluatedOption,
    JsonOption,
    SceneArgument,
    SetOption,
    SettlingOption,
    StudyTable,
    ToleranceOption,
)
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import one_line_errors, remark
from ..terminal.settings import scene_with
from ..units.catalogue import STUDY_RESULTS
from ..units.engineering import figure
from ._study import computed, need_packages, warn_of, write_results

if TYPE_CHECKING:
    from ..studies.duty import Summary


def duty(
    scene: SceneArgument,
    table: Annotated[
        Path,
        typer.Argument(
            metavar="TABLE", help="Duty cycle: .csv or .parquet with time, torque, speed."
        ),
    ],
    out: StudyTable,
    set_: SetOption = None,
    duration: EvaluatedOption = 0.2,
    settling: SettlingOption = 0.05,
    tolerance: ToleranceOption = 1e-4,
    json_: JsonOption = None,
) -> None:
    """Sum losses and find peaks of SCENE over a duty cycle.

    TABLE has the columns time, torque and speed of the first motor, with units in the headings
    (speed [rpm]) or in SI; further ones are quantities of the operating point, such as
    oil_temperature [degC]. Each row holds up to the time of the next one, the last one ends the
    cycle. Each distinct operating point runs once, in steady running; with --set
    dynamics=quasi_static in milliseconds, without vibration. To resume an interrupted cycle, repeat
    the command.

    Example: planetary-twin duty paper cycle.csv --set dynamics=quasi_static --out points.parquet
    """
    need_packages(out)
    from ..studies.duty import read_cycle, study_of, summary_of_duty
    from ..studies.plan import Settings

    with one_line_errors():
        loaded = scene_with(scene, set_)
        cycle = read_cycle(table)
        study, place = study_of(cycle, loaded, Settings(duration, settling, tolerance=tolerance))
        with computed(study, out) as found:
            write_results(found, out)
            summary = summary_of_duty(cycle, place, found)
    console = console_beside(json_)
    for line in _lines(summary, len(study.points)):
        console.print(line)
    warn_of(found, study.extremes())
    if not summary.driving_energy:
        remark("no machine drives in this cycle, so there is no efficiency")
    peaks = {name: {"value": v, "time": t} for name, (v, t) in summary.peaks.items()}
    figures = summary._asdict() | {"efficiency": summary.efficiency, "peaks": peaks}
    write_json(figures, json_)


def _lines(summary: Summary, points: int) -> list[str]:
    """The results in words."""
    lines = [
        f"duty cycle of {summary.duration:g} s, {points} operating points, in steady running",
        f"driving energy {figure(summary.driving_energy, 'J')}, lost "
        f"{figure(summary.loss_energy, 'J')}, efficiency {summary.efficiency:.4%}",
    ]
    for name, (value, time) in summary.peaks.items():
        quantity = STUDY_RESULTS[name]
        lines.append(f"{quantity.title}: {figure(value, quantity.si)} at {time:g} s")
    return lines
