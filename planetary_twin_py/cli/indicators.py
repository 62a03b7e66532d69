"""`planetary-twin indicators`: condition indicators of a gear, with intervals."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import JsonOption, complete_recording
from ..terminal.console import busy
from ..terminal.dataclass_options import take_options_of
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, one_line_errors, remark
from ..units.engineering import figure
from ._signal_file import FILE_HELP, SignalOptions

if TYPE_CHECKING:
    from ..analysis.gears.gear_condition import GearCondition
    from ..scene import Scene
    from ..terminal.tables import TableConsole
    from ..units.catalogue import Quantity
    from ._signal_file import Selected


def _read_angle(text: str | float) -> float:
    """An angle [rad]."""
    from ..terminal.unit_options import read_quantity

    try:
        return read_quantity("--passing", str(text), "rad")
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None


@dataclass(frozen=True)
class Options(SignalOptions):
    """Arguments and options of the command."""

    file: Annotated[
        Path, typer.Argument(metavar="FILE", help=FILE_HELP, autocompletion=complete_recording)
    ] = field(kw_only=True)
    gear: Annotated[
        str,
        typer.Option(
            metavar="sun|planet|planet_N|ring",
            help="Gear whose turns relative to the carrier are averaged. What a sensor on the "
            "housing measures is separated by windows around each pass of a planet.",
        ),
    ] = "sun"
    plain: Annotated[
        bool,
        typer.Option(
            "--plain",
            help="Average without separation, for a signal that planets do not pass, such as a "
            "transmission error.",
        ),
    ] = False
    passing: Annotated[
        float | None,
        typer.Option(
            metavar="ANGLE",
            parser=_read_angle,
            help="Angle of the carrier since the first sample at which planet 1 is at the sensor.",
            show_default="where the vibration is highest",
        ),
    ] = None
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
    reason. A table needs --scene, which defines the gears. Where planets pass a sensor, one planet,
    or the sun in its mesh, is separated by windows; a gear set whose teeth the sensor cannot see is
    refused.

    Example: planetary-twin indicators faulty.npz --quantity mesh_force --baseline healthy.npz
    """
    asked = Options(**given)
    asked.check(asked.file)
    if asked.is_table(asked.file) and asked.scene is None:
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
    selected = asked.read(asked.file, one_way=True)
    if selected.scene is None:
        raise ValueError(
            f"{asked.file}: contains no scene, which defines the gears; give --scene"
            if asked.sensor is not None
            else f"{asked.file}: contains no scene, which defines the gears"
        )
    if asked.baseline is None:
        return selected, _condition(asked, selected, None), None
    sound = replace(asked, file=asked.baseline).read(asked.baseline, one_way=True)
    healthy = _condition(asked, sound, None)
    return selected, _condition(asked, selected, (sound, healthy)), healthy


def _condition(
    asked: Options, selected: Selected, healthy: tuple[Selected, GearCondition] | None
) -> GearCondition:
    """The condition of the gear, perhaps beside that of the healthy one."""
    from ..analysis.gears.gear_condition import gear_condition
    from ..analysis.gears.separated_condition import is_passed, separated_condition

    scene, kind, planet = selected.scene, *_gear(asked.gear)
    assert scene is not None  # see `_analysed`
    if planet is not None and planet > scene.gearset.planets:
        raise ValueError(
            f"gear = {asked.gear!r}: must be planet_1 to planet_{scene.gearset.planets}"
        )
    if selected.mesh is None and not asked.plain and is_passed(scene, kind):
        average = None if healthy is None else healthy[1].average
        number = 1 if planet is None else planet
        return separated_condition(selected.signal, scene, kind, number, asked.passing, average)
    if planet is not None and selected.mesh is None:
        raise ValueError(
            f"gear = {asked.gear!r}: planets do not pass the sensor, which measures all of them"
        )
    if planet is not None and selected.mesh is not None and asked.gear not in selected.mesh:
        raise ValueError(f"gear = {asked.gear!r}: is not in the mesh {selected.mesh!r}; see --mesh")
    sound = None if healthy is None else healthy[0].signal
    teeth = scene.gearset.tooth_numbers
    return gear_condition(selected.signal, teeth, kind, selected.mesh, sound)


def _gear(text: str) -> tuple[str, int | None]:
    """Kind of a gear, and the number of a planet if it is named."""
    kind, _, number = text.partition("_")
    if kind == "planet" and number.isdigit() and int(number) > 0:
        return kind, int(number)
    if text not in ("sun", "planet", "ring"):
        raise ValueError(f"gear = {text!r}: must be sun, planet, ring, or planet_1, planet_2, ...")
    return kind, None


def _remarks(asked: Options, selected: Selected, found: GearCondition) -> Iterator[str]:
    """What limits the meaning of the indicators."""
    yield from selected.signal.remarks
    if found.passing is not None:
        yield from found.passing.remarks()
    yield from found.remarks(simulated=selected.mesh is not None)
    yield from selected.aliases()
    yield from selected.assumed_speed
    if selected.mesh is None and selected.scene is not None and found.passing is None:
        yield from _mixed(selected.scene, _gear(asked.gear)[0])


def _mixed(scene: Scene, gear: str) -> Iterator[str]:
    """A warning if a sensor on the housing mixes the meshes of all planets."""
    from ..analysis.gears.separated_condition import is_passed

    if is_passed(scene, gear):
        yield (
            "--plain: where planets pass the sensor, this average keeps only lines without "
            f"sidebands of the carrier, where a fault of the {gear} nearly vanishes"
        )
    elif gear == "planet":
        yield "a sensor on the housing measures all planets, and this average mixes their teeth"


def _quantities(unit: str) -> dict[str, Quantity]:
    """Indicators by name, in the unit of the signal where they have one."""
    from ..analysis.gears.indicators import ConditionIndicators
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
