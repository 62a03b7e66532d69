"""`planetary-twin fleet`: estimates friction of many gearboxes from readings of a SCADA system."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption, SceneArgument, SetOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, remark
from ..terminal.output_files import TABLES, file_ending_in, writing
from ..terminal.settings import changed_scene, settings
from ._study import progress

if TYPE_CHECKING:
    from rich.console import Console

    from ..fleet.groups import GearboxResult
    from ..studies.work import Executor

SHOWN = 20  # gearboxes with events
STEP = 0.1  # of the loss torque, which users look for


def fleet(
    scene: SceneArgument,
    from_: Annotated[
        Path,
        typer.Option(
            "--from",
            metavar="FILE",
            help="Readings: a .csv or .parquet table with the columns gearbox, time, input_torque, "
            "output_torque, input_speed and oil_temperature.",
        ),
    ],
    sensors: Annotated[
        Path | None,
        typer.Option(metavar="FILE.yaml", help="Noise and uncertainty of the torque sensors."),
    ] = None,
    set_: SetOption = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Write a row for each gearbox to a .csv, .parquet or .npz table.",
            callback=file_ending_in(*TABLES),
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Address of a Dask scheduler, e.g. tcp://10.0.0.1:8786, whose workers read the "
            "same file.",
            show_default="this machine",
        ),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Estimate friction of many gearboxes of the type SCENE, with one reading in 0.1 s to 60 s.

    Prints changes: steps of the loss torque of a gearbox. --out and --json have the friction level
    of each gearbox with a 95 % interval. The fleet has one false alarm per year. Readings should be
    means over their intervals: where they scatter more than their noise, a warning names the steps
    that may not be found. If no gearbox can be judged, the exit code is 2.

    Example: planetary-twin fleet wind_turbine_stage --from scada.parquet --out state.csv
    """
    need("analysis", "pyarrow")
    from ..fleet.groups import FollowGroup, follow_groups
    from ..fleet.tables import gearboxes_of
    from ..following.sensors import Sensors, read_sensors

    console = console_beside(json_)
    try:
        loaded = changed_scene(scene, settings(set_ or []))
        known = read_sensors(sensors) if sensors is not None else Sensors()
        names = gearboxes_of(from_)
        work = FollowGroup(from_.resolve(), loaded, len(names), known)
        with _executor(scheduler) as executor, progress("gearboxes", len(names)) as advance:
            found = follow_groups(work, names, executor, advance)
    except (ValueError, ArithmeticError, OSError) as error:
        fail(error)
    _show(console, found)
    _warn(found)
    if out is not None:
        from ..fleet.notes import write_state

        with writing("--out", out):
            write_state(out, found)
    if json_ is not None:
        write_json({one.gearbox: _figures(one) for one in found}, json_)
    if not any(map(_is_judged, found)):
        fail(
            "no gearbox is judged: readings contradict the scene, are incomplete, or are too few "
            "for their scatter"
        )


@contextmanager
def _executor(scheduler: str | None) -> Iterator[Executor]:
    if scheduler is None:
        from ..simulation.threads import Threads

        yield Threads(1)  # array operations share the processor already
        return
    need("studies", "distributed")
    from ..studies.cluster import Cluster

    cluster = Cluster(scheduler)
    try:
        yield cluster
    finally:
        cluster.close()


def _is_judged(one: GearboxResult) -> bool:
    """Whether a step could be found."""
    return not one.fault and one.readings > 0


def _show(console: Console, found: Sequence[GearboxResult]) -> None:
    judged = list(filter(_is_judged, found))
    changed = [one for one in judged if one.events]
    estimated = sum(math.isfinite(one.estimates["friction_level"][0]) for one in found)
    blind = sum(one.scatters and one.smallest_step > STEP for one in judged)
    hidden = f"; {blind} may hide a step of {100.0 * STEP:g} % in their scatter" if blind else ""
    changes = f"{len(changed) or 'none'} changed" if judged else "none judged"
    console.print(
        f"{len(found)} gearboxes, friction level of {estimated} estimated, {changes}{hidden}",
        highlight=False,
    )
    _show_faults(console, [one for one in found if one.fault])
    for one in changed[:SHOWN]:
        if not one.fits:
            console.print(
                f"{one.gearbox}: readings do not fit the scene: {len(one.events)} steps in close "
                "succession; check units, signs and gains of its sensors",
                highlight=False, markup=False,
            )  # fmt: skip
            continue
        for event in one.events:
            console.print(
                f"{one.gearbox}: loss torque changed by about {100.0 * event.share:+.3g} % of the "
                f"scene's or more, since {event.since:g} s, found at {event.found:g} s",
                highlight=False, markup=False,
            )  # fmt: skip
    if len(changed) > SHOWN:
        console.print(f"and {len(changed) - SHOWN} more; --out has all", highlight=False)


def _show_faults(console: Console, faulty: Sequence[GearboxResult]) -> None:
    for one in faulty[:SHOWN]:
        console.print(
            f"{one.gearbox}: readings contradict the scene, not estimated: {one.fault}",
            highlight=False, markup=False, soft_wrap=True,
        )  # fmt: skip
    if len(faulty) > SHOWN:
        more = len(faulty) - SHOWN
        console.print(f"and {more} more contradict it; --out has all", highlight=False)


def _warn(found: Sequence[GearboxResult]) -> None:
    """Name gearboxes with a large scatter, with a doubtful unit, and without complete readings."""
    scattering = [one for one in found if one.scatters and not one.fault]
    if scattering:
        remark(f"warning: {_scatter_line(scattering)}")
    lines = [f"{one.gearbox}: {line}" for one in found if not one.fault for line in one.remarks]
    for one in found:
        count, first = one.missing
        if count:
            lines.append(
                f"{one.gearbox}: at {count} times of the table, the first at {first:g} s, a torque "
                "or the speed is missing; these rows are not used"
            )
    for line in lines[:SHOWN]:
        remark(f"warning: {line}")
    if len(lines) > SHOWN:
        remark(f"warning: and {len(lines) - SHOWN} more lines; --json has all")


def _scatter_line(found: Sequence[GearboxResult]) -> str:
    """What the scatter of these gearboxes is, means and does."""
    names = ", ".join(one.gearbox for one in found[:SHOWN])
    if len(found) > SHOWN:
        names += f" and {len(found) - SHOWN} more"
    measured, stated = zip(*(one.scatter for one in found), strict=True)
    steps = [one.smallest_step for one in found]
    return (
        f"{names}: the torque balance scatters by {_range(measured)} N m, the sensors explain "
        f"{_range(stated)} N m: rows are instants of a wandering speed or shorter than its wander, "
        "or noise in --sensors is too small; intervals are wider, and steps of less than "
        f"{_range([100.0 * step for step in steps])} % of the loss may not be found"
    )


def _range(values: Sequence[float]) -> str:
    """Smallest and largest of some values, with two digits each."""
    low, high = (f"{float(f'{value:.2g}'):g}" for value in (min(values), max(values)))
    return low if low == high else f"{low} to {high}"


def _figures(one: GearboxResult) -> dict[str, object]:
    return {
        "readings": one.readings,
        "missing": one.missing[0],
        "first_missing": _finite(one.missing[1]),
        "fits": one.fits,
        "fault": one.fault or None,
        "remarks": one.remarks,
        "scatter": _finite(one.scatter[0]),
        "stated_scatter": _finite(one.scatter[1]),
        "scatters": one.scatters,
        "smallest_step": _finite(one.smallest_step),
        "estimates": {
            name: [_finite(value) for value in values] for name, values in one.estimates.items()
        },
        "events": [
            {name: _finite(getattr(event, name)) for name in ("since", "found", "size", "share")}
            for event in one.events
        ],
    }


def _finite(value: float) -> float | None:
    """`value`, or None in place of NaN, which JSON lacks."""
    return value if math.isfinite(value) else None
