"""`planetary-twin faults`: orders at which each fault has lines, and which ones coincide."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import one_line_errors
from ..terminal.names import shown
from ..terminal.settings import scene_with
from ..units.engineering import figure
from ..units.shown import ORDERS

if TYPE_CHECKING:
    from fractions import Fraction

    from rich.table import Table

    from ..analysis.faults.coincidences import Coincidence
    from ..analysis.faults.fault_orders import FaultOrders
    from ..analysis.faults.shared_lines import SharedLines
    from ..analysis.gears.planet_separation import TeethSeen
    from ..scene import Scene


def faults(
    scene: SceneArgument,
    rollers: Annotated[
        int | None, typer.Option(help="Rollers of a planet bearing, with --ratio.")
    ] = None,
    ratio: Annotated[
        str | None,
        typer.Option(
            metavar="RATIO",
            help="Diameter of a roller over that of their pitch circle, times the cosine of the "
            "contact angle, e.g. 0.2.",
        ),
    ] = None,
    set_: SetOption = None,
    json_: JsonOption = None,
) -> None:
    """List the orders at which each fault of SCENE has lines, and those at which it has none.

    The lines are those of a sensor on the housing, around the first mesh harmonic. They follow from
    tooth numbers, held member and spacing of the planets, for equal planets; orders are exact
    fractions, of a differential at its two speeds. It also lists faults whose lines coincide in
    this gear set, and the teeth that a sensor sees when a planet passes it.

    Example: planetary-twin faults wind_turbine_stage --rollers 14 --ratio 0.2
    """
    from ..analysis.faults.fault_orders import fault_orders

    with one_line_errors():
        loaded = scene_with(scene, set_)
        found = fault_orders(loaded, rollers, ratio)
    console = console_beside(json_)
    console.print(_rate_table(loaded, found))
    console.print(_line_table(found))
    for sentence in _sentences(found, loaded.drive.second_input is not None):
        console.one_line(sentence)
    write_json(_figures(found), json_)


def _rate_table(scene: Scene, found: FaultOrders) -> Table:
    from ..terminal.tables import table

    teeth = "/".join(map(str, scene.gearset.tooth_numbers))
    rows = [
        [
            ORDERS[key].text,
            f"{float(order):.6g}",
            str(order),
            _hertz(found, order),
        ]
        for key, order in found.rates.items()
    ]
    return table(
        ("", "order", "exact", "frequency"),
        rows,
        title=f"{shown(scene.name)}, {teeth} teeth, {found.planets} planets: orders per turn of "
        f"the {found.reference}",
        whole=True,
    )


def _hertz(found: FaultOrders, order: Fraction) -> str:
    return figure(float(order) * found.frequency, "Hz") if found.frequency else "-"


def _line_table(found: FaultOrders) -> Table:
    from ..terminal.tables import table

    headings = ("fault", "lines", "weak lines", "no lines")
    rows = [
        [line.fault, *(_listed(each) for each in (line.present, line.weak, line.absent))]
        for line in found.lines
    ]
    return table(
        headings,
        rows,
        title="Orders around the first mesh harmonic, of bearings around the rate of the fault",
        texts=headings,
    )


def _listed(orders: Iterable[Fraction]) -> str:
    return ", ".join(f"{float(order):.7g}" for order in orders) or "-"


def _sentences(found: FaultOrders, differential: bool) -> Iterator[str]:
    """What the tables mean for this gear set."""
    if differential:
        yield (
            "Orders of a differential are those at the ratio of its two speeds at the operating "
            "point; windows do not separate teeth, as other ones pass at another ratio."
        )
    yield from _symmetry(found)
    if found.reference == "carrier" and "ring_turns" not in found.rates:
        yield (
            "A fault of the ring has no orders of its own: its lines are at multiples of "
            f"{found.symmetry}, and grow far from the mesh harmonics."
        )
    yield from map(_shared, found.shared)
    yield from (_coincidence(found, each) for each in found.coincidences)
    for gear, seen in found.seen.items():
        yield _seen(found, gear, seen)


def _symmetry(found: FaultOrders) -> Iterator[str]:
    """What the places of the planets mean for lines."""
    if "carrier_turns" not in found.rates:
        yield (
            "The carrier is held, so planets do not pass a sensor, and windows do not separate "
            "teeth."
        )
        if found.symmetry > 1:
            yield (
                "Lines of one mesh at multiples of its relative turn that are not divisible by "
                f"{found.symmetry} are seen only by a sensor that is nearer to some planets."
            )
    elif found.symmetry == 1:
        yield "No turn brings the planets into places of others, so no sideband is without lines."
    elif found.symmetry < found.planets:
        yield f"Planets are in places of others after each 1/{found.symmetry} turn only."


def _shared(each: SharedLines) -> str:
    sides = ((each.first, each.first_only), (each.second, each.second_only))
    apart = "; ".join(
        f"a line at {_listed(orders)} is of the {fault}"
        if orders
        else f"no listed line shows that it is the {fault}"
        for fault, orders in sides
    )
    return (
        f"Faults of {each.first} and {each.second} share orders: {_listed(each.shared)} may be of "
        f"either; {apart}."
    )


def _coincidence(found: FaultOrders, each: Coincidence) -> str:
    order = f"{float(each.order):.6g} ({each.order})"
    if each.turns is None and each.with_carrier:
        return (
            f"{each.first} = {each.second} = {order}: its lines are at sidebands of the carrier, "
            "where planets with unequal loads have lines, too."
        )
    if each.turns is None:
        return f"{each.first} = {each.second} = {order}: these rates coincide at any speed."
    time = each.turns / found.frequency if found.frequency else None
    length = f", {figure(time, 's')} at the operating point" if time else ""
    return (
        f"{each.first} = {order} is {float(each.apart):.4g} from {each.second}: "
        f"{each.turns:.4g} turns of the {found.reference} separate them{length}."
    )


def _seen(found: FaultOrders, gear: str, seen: TeethSeen) -> str:
    turns = "turn" if seen.turns == 1 else "turns"
    verdict = f"windows of {seen.window} teeth separate them"
    if seen.window > found.widest_window:
        verdict = (
            f"windows must be {seen.window} teeth wide, and from {found.widest_window:.3g} teeth "
            "on they contain other planets: its teeth cannot be separated"
        )
    return (
        f"When a planet passes a sensor, {seen.number} of {seen.number * seen.step} teeth of the "
        f"{gear} are in mesh there, in {seen.turns} {turns} of the carrier: {verdict}."
    )


def _figures(found: FaultOrders) -> dict[str, Any]:
    """The orders for JSON."""

    def place(order: Fraction) -> dict[str, Any]:
        return {
            "order": float(order),
            "exact": str(order),
            "frequency_hz": float(order) * found.frequency,
        }

    return {
        "reference": found.reference,
        "frequency_hz": found.frequency,
        "planets": found.planets,
        "symmetry": found.symmetry,
        "alike": found.symmetry,  # deprecated name
        "orders": {key: place(order) for key, order in found.rates.items()},
        "lines": [
            {
                "fault": line.fault,
                "rate": place(line.rate),
                "present": [place(order) for order in line.present],
                "weak": [place(order) for order in line.weak],
                "absent": [place(order) for order in line.absent],
            }
            for line in found.lines
        ],
        "shared": [
            {
                "faults": [each.first, each.second],
                "orders": [place(order) for order in each.shared],
                "first_only": [place(order) for order in each.first_only],
                "second_only": [place(order) for order in each.second_only],
            }
            for each in found.shared
        ],
        "coincidences": [
            {
                "first": each.first,
                "second": each.second,
                "order": place(each.order),
                "apart": float(each.apart),
                "turns": each.turns,
            }
            for each in found.coincidences
        ],
        "seen": {gear: seen._asdict() for gear, seen in found.seen.items()},
        "widest_window": found.widest_window,
    }
