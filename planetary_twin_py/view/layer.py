"""One recording among those shown together: where its curves stand, and how they look.

Entities of a further recording stand below those of the first, /mesh/dte_mean/NAME below
/mesh/dte_mean: so every plot shows them all, and a layout made for one recording fits several.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import rerun as rr
from rerun._baseclasses import ComponentColumn

Colour = tuple[int, int, int]
_FADE = 0.45  # of its colour that a curve keeps from one recording to the next, the rest is white
_WIDTH = 1.5  # of a line of the first recording


@dataclass(frozen=True)
class Layer:
    """Draws one recording into `stream`: the first (`order` 0) in strong lines, others beneath
    in pale and wide ones, which stay seen where they are the same."""

    stream: rr.RecordingStream
    name: str = ""
    order: int = 0
    below: str = ""
    """What its entities stand below, e.g. "difference"."""
    _told: set[tuple[str, type]] = field(default_factory=set)

    def log(self, path: str, what: rr.AsComponents, static: bool = False) -> None:
        """Log at `path`; what is static once, however often it is given."""
        place = self._place(path)
        told = (place, type(what))  # a solid may stand where a place is told
        if static and told in self._told:
            return
        if static:
            self._told.add(told)
        self.stream.log(place, what, static=static)

    def send_columns(
        self, path: str, index: list[rr.TimeColumn], columns: Iterable[ComponentColumn]
    ) -> None:
        """Log columns at `path`, if they have rows: the viewer fails on a time without any."""
        if len(index[0].as_arrow_array()):
            self.stream.send_columns(self._place(path), index, columns)

    def label(self, text: str) -> str:
        """`text` after the recording's name, where there are several."""
        return f"{self.name}: {text}" if self.name else text

    def lines(
        self, names: Sequence[str], colours: Sequence[Colour], steps: bool = False
    ) -> rr.SeriesLines:
        """The look of one line per name."""
        return rr.SeriesLines(
            names=[self.label(name) for name in names],
            colors=[self.shade(colour) for colour in colours[: len(names)]],
            widths=_WIDTH * (1 + self.order),
            interpolation_mode="StepAfter" if steps else "Linear",
        )

    def shade(self, colour: Colour) -> Colour:
        """What becomes of a colour."""
        kept = _FADE**self.order
        red, green, blue = (round(255 - kept * (255 - channel)) for channel in colour)
        return red, green, blue

    def _place(self, path: str) -> str:
        parts = (self.below, path, rr.escape_entity_path_part(self.name) if self.order else "")
        return "/".join(part for part in parts if part)
