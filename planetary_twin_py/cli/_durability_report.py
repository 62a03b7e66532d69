"""Results of `planetary-twin durability`: a table and lines."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import ExitStack
from types import TracebackType
from typing import TYPE_CHECKING, Self

from ..terminal.console import progress_of
from ..terminal.names import shown
from ..units.engineering import figure

if TYPE_CHECKING:
    from ..lifetime.duty_result import DutyLife
    from ..lifetime.sensitivity import Sensitivity
    from ..terminal.tables import TableConsole

HOUR, YEAR = 3600.0, 31_557_600.0  # [s]
LONGEST = 1e6  # years, above which a time is only said to be above


class Shown:
    """Progress of the map and of the excerpts, one after the other."""

    def __init__(self) -> None:
        self._stack, self._of = ExitStack(), ""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    def report(self, what: str, done: int, whole: int) -> None:
        """Show how much of an activity is done."""
        if what != self._of:
            self._stack.close()
            self._of, self._show = what, self._stack.enter_context(progress_of(what))
        self._show(done, whole)


def print_life(console: TableConsole, name: str, found: DutyLife) -> None:
    """Print damage and life by part, then what holds for the whole gearbox.

    Args:
        console: console to print on.
        name: name of the scene.
        found: the results.
    """
    from ..terminal.tables import table

    title = f"{shown(name)}: damage in {lasting(found.time)}"
    headings, rows = zip(*_columns(found), strict=True)
    console.print(table(headings, list(zip(*rows, strict=True)), title=title))
    for line in _lines(found):
        console.one_line(line)


def _columns(found: DutyLife) -> Iterator[tuple[str, list[str]]]:
    """Columns of the table: headings and a text for each part."""
    yield "part", list(found.parts)
    if found.reached.any():
        yield "damage so far", [f"{damage:.4g}" for damage in found.reached]
    yield "damage", [f"{damage:.4g}" for damage in found.damage]
    yield "life at damage 1", [lasting(life) for life in found.life]
    if found.reached.any():
        yield "left of it", [lasting(left) for left in found.left]
    passages = found.passages.tolist()
    yield "passages of a tooth", [f"{each:.4g}" if each else "-" for each in passages]
    errors = zip(found.error.mean.tolist(), found.error.bound.tolist(), strict=True)
    yield "error of the map", [_error(*each) for each in errors]


def lasting(seconds: float) -> str:
    """A time in hours and, if it is long, in years.

    Args:
        seconds: the time [s]; infinite: no end.
    """
    if not math.isfinite(seconds):
        return "endless"
    if seconds > LONGEST * YEAR:
        return f"above {LONGEST:g} years"
    hours = f"{seconds / HOUR:.4g} h"
    return f"{hours} ({seconds / YEAR:.3g} years)" if seconds >= YEAR else hours


def _error(mean: float, bound: float) -> str:
    if math.isnan(mean):
        return "-"
    return f"{100.0 * mean:+.2f} +- {100.0 * bound:.2f} %"


def _lines(found: DutyLife) -> Iterator[str]:
    if not found.first:
        yield "no part is damaged"
        return
    place = found.parts.index(found.first)
    yield f"fails first: {found.first}, damage 1 after {lasting(float(found.left[place]))}"
    yield (
        f"reliability over {lasting(found.time)}: {found.reliability:.4g}; 10 % of the gearboxes "
        f"fail within {lasting(found.tenth)} (Weibull, all parts in series)"
    )
    left = found.remaining
    yield (
        f"remaining life: {lasting(left.median)}, 95 % interval {lasting(left.low)} to "
        f"{lasting(left.high)}; {_shares(left.material_share, left.blocks)}"
    )
    if found.equivalent.part:
        yield from _of_levels(found)


def _of_levels(found: DutyLife) -> Iterator[str]:
    """What follows from the levels of torque, of a tooth or bearing."""
    same, seconds = found.equivalent, found.error.seconds
    place = found.parts.index(same.part)
    if math.isfinite(same.exponent):
        yield (
            f"equivalent torque of {same.part}: {figure(same.torque, 'N m')} (m = "
            f"{same.exponent:.3g}, n_eq = {same.turns:.4g} turns of the input), application factor "
            f"{same.application_factor:.3g}"
        )
    yield f"sensitivity of its life: {'; '.join(map(_changed, found.sensitivity))}"
    of = "operating points" if math.isnan(seconds) else f"windows of {seconds:.3g} s"
    yield (
        f"map of {found.runs} runs, judged by {found.error.excerpts} direct runs ({of}): "
        f"{_error(float(found.error.mean[place]), float(found.error.bound[place]))} for "
        f"{same.part}; {found.processor:.3g} s of processor time"
    )


def _changed(found: Sensitivity) -> str:
    if math.isnan(found.life):
        return f"{found.change}: unknown, as direct runs do not damage it"
    width = f" +- {100.0 * found.interval:.2g} %" if found.interval else ""
    return f"{found.change}: x {found.life:.3g}{width}"


def _shares(material: float, blocks: int) -> str:
    if math.isnan(material):
        return "from the scatter of strength alone"
    duty = 1.0 - material
    return (
        f"{100.0 * material:.0f} % of its variance from the scatter of strength, "
        f"{100.0 * duty:.0f} % from that of {blocks} blocks of the duty"
    )
