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
    from ..lifetime.duty_life import DutyLife
    from ..terminal.tables import TableConsole

HOUR, YEAR = 3600.0, 31_557_600.0  # [s]
LONGEST = 1e6  # years that are told apart


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

    errors = zip(found.error.mean, found.error.bound, strict=True)
    rows = [
        [part, f"{damage:.4g}", lasting(life), f"{passages:.4g}" if passages else "-", _error(*e)]
        for part, damage, life, passages, e in zip(
            found.parts, found.damage.tolist(), found.life.tolist(), found.passages.tolist(),
            errors, strict=True,
        )
    ]  # fmt: skip
    headings = ("part", "damage", "life at damage 1", "passages of a tooth", "error of the map")
    title = f"{shown(name)}: damage in {lasting(found.time)}"
    console.print(table(headings, rows, title=title))
    for line in _lines(found):
        console.one_line(line)


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
    yield f"fails first: {found.first}, damage 1 after {lasting(float(found.life[place]))}"
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
    yield (
        f"equivalent torque of {same.part}: {figure(same.torque, 'N m')} (m = {same.exponent:.3g}, "
        f"n_eq = {same.turns:.4g} turns of the input), application factor "
        f"{same.application_factor:.3g}"
    )
    changes = "; ".join(f"{each.change}: x {each.life:.3g}" for each in found.sensitivity)
    yield f"sensitivity of its life: {changes}"
    of = "operating points" if math.isnan(seconds) else f"windows of {seconds:.3g} s"
    yield (
        f"map of {found.runs} runs, judged by {found.error.excerpts} direct runs ({of}): "
        f"{_error(float(found.error.mean[place]), float(found.error.bound[place]))} for "
        f"{same.part}; {found.processor:.3g} s of processor time"
    )


def _shares(material: float, blocks: int) -> str:
    if math.isnan(material):
        return "from the scatter of strength alone"
    duty = 1.0 - material
    return (
        f"{100.0 * material:.0f} % of its variance from the scatter of strength, "
        f"{100.0 * duty:.0f} % from that of {blocks} blocks of the duty"
    )
