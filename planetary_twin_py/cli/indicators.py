"""`planetary-twin indicators`: condition indicators of a gear, with intervals."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from ..terminal.arguments import JsonOption, complete_recording
from ..terminal.console import busy
from ..terminal.dataclass_options import take_options_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, one_line_errors, remark
from ..units.engineering import figure
from ._signal_file import SignalFile

if TYPE_CHECKING:
    from ..analysis.gear_condition import GearCondition
    from ..scene import Scene
    from ..terminal.tables import TableConsole
    from ..units.catalogue import Quantity
    from ._signal_file import Selected


@dataclass(frozen=True)
class Options(SignalFile):
    """Arguments and options of the command."""

    gear: Annotated[
        Literal["sun", "planet", "ring"],
        typer.Option(help="Gear whose turns relative to the carrier are averaged."),
    ] = "sun"
    baseline: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="The same signal of the healthy gear, for NA4* and to compare.",
            autocompletion=complete_recording,
        ),
    ] = None
    json_: JsonOption = None


def indicators(**given: Any) -> None:
    """Compute condition indicators of a gear: RMS, FM0, FM4, NA4, M6A, M8A and others.

    The signal is averaged over the turns of the gear relative to the carrier. Names are those of
    gearConditionMetrics of MATLAB. Intervals of 95 % follow from the scatter of at most 20 blocks
    of turns (jackknife, Student's t); they need six turns. What is not defined has no value, but a
    reason. A table needs --scene, which defines the gears.

    Example: planetary-twin indicators faulty.npz --quantity mesh_force --baseline healthy.npz
    """
    asked = Options(**given)
    asked.check()
    if asked.is_table and asked.scene is None:
        fail(f"{asked.file}: needs --scene, which defines the gears")
    with one_line_errors(), busy("reading and analysing"):
        selected, found, healthy = _analysed(asked)
    for line in _remarks(asked, selected, found):
        remark(line)
    _print(console_beside(asked.json_), asked, selected, found)
    if healthy is not None:
        times = f"{found.difference / healthy.difference:.4g}" if healthy.difference else "-"
        console_beside(asked.json_).one_line(
            f"rms of the difference signal over that of {asked.baseline}: {times}"
        )
    write_json(_figures(asked, selected, found, healthy), asked.json_)


take_options_of(Options, indicators)


def _analysed(asked: Options) -> tuple[Selected, GearCondition, GearCondition | None]:
    """The signal, the condition of the gear, and that of the healthy one."""
    from ..analysis.gear_condition import gear_condition

    selected = asked.read(one_way=True)
    if selected.scene is None:
        raise ValueError(
            f"{asked.file}: contains no scene, which defines the gears; give --scene"
            if asked.sensor is not None
            else f"{asked.file}: contains no scene, which defines the gears"
        )
    teeth = selected.scene.gearset.tooth_numbers
    if asked.baseline is None:
        return selected, gear_condition(selected.signal, teeth, asked.gear, selected.mesh), None
    sound = replace(asked, file=asked.baseline).read(one_way=True)
    healthy = gear_condition(sound.signal, teeth, asked.gear, selected.mesh)
    found = gear_condition(selected.signal, teeth, asked.gear, selected.mesh, sound.signal)
    return selected, found, healthy


def _remarks(asked: Options, selected: Selected, found: GearCondition) -> Iterator[str]:
    """What limits the meaning of the indicators."""
    yield from selected.signal.remarks
    yield from found.remarks(simulated=selected.mesh is not None)
    yield from selected.aliases()
    yield from selected.assumed_speed
    if selected.mesh is None and selected.scene is not None:
        yield from _mixed(selected.scene, asked.gear)


def _mixed(scene: Scene, gear: str) -> Iterator[str]:
    """A warning if a sensor on the housing mixes the meshes of all planets."""
    from ..model.layout import Layout

    if gear == "ring":
        return
    if any(Layout(scene).ratios["carrier"]):
        yield (
            "planets pass a sensor on the housing, and this average keeps only lines without "
            f"sidebands of the carrier, where a fault of the {gear} nearly vanishes; separate the "
            "planets by planetary_twin_py.separate"
        )
    elif gear == "planet":
        yield "a sensor on the housing hears all planets, and this average mixes their teeth"


def _quantities(unit: str) -> dict[str, Quantity]:
    """Indicators by name, in the unit of the signal where they have one."""
    from ..analysis.indicators import ConditionIndicators
    from ..units.shown import quantities_of

    return {
        name: quantity._replace(si=unit) if quantity.si else quantity
        for name, quantity in quantities_of(ConditionIndicators).items()
    }


def _print(console: TableConsole, asked: Options, selected: Selected, found: GearCondition) -> None:
    from ..terminal.tables import table

    unit = selected.unit
    headings = ("indicator", "value", "from", "to", "")
    rows = []
    for name, quantity in _quantities(unit).items():
        value = getattr(found.indicators, name)
        ends = ("-", "-")
        if found.intervals is not None:
            interval = found.intervals[name]
            low, high = (figure(each, quantity.si) for each in (interval.low, interval.high))
            ends = (low, high)
        reason = found.indicators.reasons.get(name, "")
        rows.append([quantity.text, figure(value, quantity.si), *ends, reason])
    console.print(table(headings, rows, texts=("indicator", ""), whole=True, framed=False))
    of_mesh = f" of {selected.mesh}" if selected.mesh else ""
    begin, end = selected.signal.time[[0, -1]]
    console.one_line(
        f"{selected.quantity}{of_mesh}, {asked.gear}, average over {len(found.average.turns)} "
        f"turns in {begin:.4f} to {end:.4f} s; rms of the difference signal "
        f"{figure(found.difference, unit)}, noise left in the average "
        f"{figure(found.average.noise, unit)}"
    )
    console.one_line(
        f"regular meshing, not in the difference: orders 1 and 2, multiples of {found.teeth} up to "
        f"{found.parts.regular_orders[-1]}, and the sidebands one order from each"
    )


def _figures(
    asked: Options, selected: Selected, found: GearCondition, healthy: GearCondition | None
) -> dict[str, Any]:
    """The condition for JSON; what is not defined is null."""
    intervals = found.intervals or {}
    return {
        "mesh": selected.mesh,
        "quantity": selected.quantity,
        "unit": selected.unit,
        "gear": asked.gear,
        "from_s": float(selected.signal.time[0]),
        "to_s": float(selected.signal.time[-1]),
        "turns": len(found.average.turns),
        "meshing_period_turns": found.period,
        "difference_rms": found.difference,
        "noise_rms": found.average.noise,
        "baseline_difference_rms": None if healthy is None else healthy.difference,
        "regular_orders": found.parts.regular_orders,
        "indicators": {
            name: {
                "value": _number(getattr(found.indicators, name)),
                "low": _number(intervals[name].low) if intervals else None,
                "high": _number(intervals[name].high) if intervals else None,
                "reason": found.indicators.reasons.get(name),
            }
            for name in _quantities(selected.unit)
        },
    }


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None
