"""One of several recordings shown together: its entity paths and its line style.

Entities of further recordings are below those of the first, for example /mesh/dte_mean/NAME below
/mesh/dte_mean, so that the layout of one recording shows them all.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import rerun as rr
from rerun._baseclasses import ComponentColumn

Colour = tuple[int, int, int]
_FADE = 0.45  # fraction of the colour kept from one recording to the next, the rest is white
_WIDTH = 1.5  # of a line of the first recording


@dataclass(frozen=True)
class Layer:
    """Draws one recording into `stream`: the first (`order` 0) in strong lines, others behind it
    in pale, wide lines, which remain visible where curves coincide."""

    stream: rr.RecordingStream
    name: str = ""
    order: int = 0
    below: str = ""
    """Parent of its entities, e.g. "difference"."""
    _logged: set[tuple[str, type]] = field(default_factory=set)

    def log(self, path: str, what: rr.AsComponents, static: bool = False) -> None:
        """Log `what` at `path`; static data only once."""
        place = self._place(path)
        key = (place, type(what))  # a path may have a transform and a mesh
        if static and key in self._logged:
            return
        if static:
            self._logged.add(key)
        self.stream.log(place, what, static=static)

    def send_columns(
        self, path: str, index: list[rr.TimeColumn], columns: Iterable[ComponentColumn]
    ) -> None:
        """Send columns at `path` unless they are empty, on which the viewer fails.

        Args:
            path: path of the entity.
            index: time columns.
            columns: columns of components.
        """
        if len(index[0].as_arrow_array()):
            self.stream.send_columns(self._place(path), index, columns)

    def label(self, text: str) -> str:
        """`text`, with the name of the recording if there are several."""
        return f"{self.name}: {text}" if self.name else text

    def lines(
        self, names: Sequence[str], colours: Sequence[Colour], steps: bool = False
    ) -> rr.SeriesLines:
        """Style of one line per name.

        Args:
            names: names of the lines.
            colours: colours of the lines.
            steps: whether values are constant between their times.
        """
        return rr.SeriesLines(
            names=[self.label(name) for name in names],
            colors=[self.shade(colour) for colour in colours[: len(names)]],
            widths=_WIDTH * (1 + self.order),
            interpolation_mode="StepAfter" if steps else "Linear",
        )

    def shade(self, colour: Colour) -> Colour:
        """A colour as drawn in this layer."""
        strength = _FADE**self.order
        red, green, blue = (round(255 - strength * (255 - channel)) for channel in colour)
        return red, green, blue

    def _place(self, path: str) -> str:
        parts = (self.below, path, rr.escape_entity_path_part(self.name) if self.order else "")
        return "/".join(part for part in parts if part)
