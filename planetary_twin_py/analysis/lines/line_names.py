"""Names lines of a spectrum: mesh harmonics, sidebands, rotations of members, and aliases.

A line anywhere must stand out as one bin of noise in 3e7 does. The first mesh harmonics, and their
aliases, are at places that are known beforehand, where a chance of one in a thousand is enough.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from ...scene import Scene
from ..sampling.aliases import alias_frequency, aliased_harmonic
from ..spectra.spectrum import Line, strongest_lines
from .distinct_lines import PLACES, PREDICTED, chance, distinct_ratio, over_noise
from .mesh_spectrum import NEAR, MeshSpectrum
from .overlaps import Overlap, overlap
from .shaft_lines import ShaftLine, ShaftLines, shaft_text
from .sidebands import RESOLVED, Sideband, Sidebands, sideband_text

FIRST = 3  # mesh harmonics that are looked for at their places
EXACT = 0.5  # [bins] largest distance of a line from the alias of a harmonic of unknown height


class Predicted(NamedTuple):
    """A place on the axis at which a mesh harmonic is expected."""

    harmonic: int
    place: float
    is_alias: bool
    """Whether the harmonic is above half the sample rate, and the place is that of its alias."""


class NamedLine(NamedTuple):
    """A line of a spectrum with what coincides with it; nothing unless it is distinct."""

    line: Line
    """Place and amplitude."""
    over_noise: float
    """Amplitude over the noise around it, see `over_noise`."""
    harmonic: int | None
    """Number of the mesh harmonic."""
    alias: int | None
    """Number of the mesh harmonic of which it may be an alias."""
    sidebands: list[Sideband]
    """Sidebands of mesh harmonics."""
    shafts: list[ShaftLine]
    """Rotations of the members."""
    filtered: bool
    """Whether a filter may have removed aliases."""
    overlap: Overlap | None = None
    """The closest line that the record does not separate from those in the name."""
    chance: float = 0.0
    """Probability that noise is as high, in the bins that were searched if the place is known
    beforehand, otherwise in one bin."""

    @property
    def is_named(self) -> bool:
        """Whether it has a name."""
        found = (self.harmonic, self.alias, *self.sidebands, *self.shafts)
        return any(one is not None for one in found)

    @property
    def text(self) -> str:
        """Description of the line; empty if it has no name."""
        beside = (shaft_text(self.shafts), sideband_text(self.sidebands))
        alias = "" if self.alias is None else f"alias of mesh harmonic {self.alias}"
        if self.harmonic is not None:
            alias = "" if self.alias is None else f", or alias of harmonic {self.alias}"
            return f"mesh harmonic {self.harmonic}{alias}"
        if alias and self.filtered:
            alias = f"{alias}, if it was not filtered"
        return "; ".join(text for text in (*beside, alias) if text)


@dataclass(frozen=True)
class LineNames:
    """Names of the lines of one spectrum."""

    spectrum: MeshSpectrum
    """Whose lines are named."""
    scene: Scene | None
    """The gears; None if they are unknown."""
    filtered: bool
    """Whether an anti-aliasing filter may precede the samples, as in data loggers."""

    def named(self, count: int) -> list[NamedLine]:
        """The highest lines in the band, highest first, then lower ones at predicted places.

        Args:
            count: largest number of the highest lines.
        """
        lines = self.spectrum.lines(count)
        known = {line.place for line in lines}
        predicted = [line for place in self.predicted for line in self._at(place)]
        lines += [line for line in predicted if line.place not in known]
        named = self._named_each(lines)
        return named[: len(known)] + [one for one in named[len(known) :] if one.is_named]

    def _named_each(self, lines: list[Line]) -> list[NamedLine]:
        found = self.spectrum
        ratios = over_noise(found.axis, found.amplitude, lines, found.error)
        return [self._named(line, ratio) for line, ratio in zip(lines, ratios, strict=True)]

    @cached_property
    def predicted(self) -> list[Predicted]:
        """Places of the first mesh harmonics in the band, or of their aliases."""
        found = self.spectrum
        if found.mesh is None or self.scene is None:
            return []
        half, places = 0.5 * found.sample_rate, []
        for harmonic in range(1, FIRST + 1):
            place = harmonic * found.mesh
            seen = place if place <= half else alias_frequency(place, found.sample_rate)
            if found.band.low <= seen <= found.band.high and seen > self._near_place:
                places.append(Predicted(harmonic, seen, place > half))
        return places

    def at_predicted(self) -> list[tuple[Predicted, NamedLine | None]]:
        """The line at each predicted place; None if there is no peak."""
        found = []
        for place in self.predicted:
            lines = self._at(place)
            found.append((place, self._named_each(lines)[0] if lines else None))
        return found

    @property
    def _near_place(self) -> float:
        return NEAR * float(self.spectrum.axis[1])

    def _at(self, predicted: Predicted) -> list[Line]:
        """The highest line at a predicted place; none without a peak."""
        near = [
            line for line in self._every if abs(line.place - predicted.place) <= self._near_place
        ]
        return near[:1]

    @cached_property
    def _every(self) -> list[Line]:
        found = self.spectrum
        return strongest_lines(found.axis, found.amplitude, len(found.axis))

    @cached_property
    def _sidebands(self) -> Sidebands:
        """Those of the gears; none if the gears are unknown."""
        return Sidebands({}, 0) if self.scene is None else Sidebands.of(self.scene)

    @cached_property
    def _shafts(self) -> ShaftLines:
        """Those of the gears; none if the gears are unknown."""
        return ShaftLines({}) if self.scene is None else ShaftLines.of(self.scene)

    def unresolved(self) -> dict[str, float]:
        """Distance on the axis of the sidebands of each member that are too close to be named."""
        mesh = self.spectrum.mesh
        if mesh is None:
            return {}
        spacing = self._sidebands.spacing
        separate = self._sidebands.resolved(float(self.spectrum.axis[1]) / mesh).spacing
        return {name: mesh * each for name, each in spacing.items() if name not in separate}

    def _named(self, line: Line, ratio: float) -> NamedLine:
        found = self.spectrum
        orders = found.in_mesh_orders(line.place)
        expected = self._expected(line)
        probability = chance(ratio, found.averages, PLACES if expected else 1)
        unnamed = NamedLine(line, ratio, None, None, [], [], self.filtered, None, probability)
        if orders is None or found.mesh is None:
            return unnamed
        if ratio < distinct_ratio(found.averages):
            if expected is None or probability > PREDICTED:
                return unnamed
            if expected.is_alias:
                return unnamed._replace(alias=expected.harmonic)
            return unnamed._replace(harmonic=expected.harmonic)
        harmonic, resolution = found.harmonic(line.place), float(found.axis[1]) / found.mesh
        shafts = [] if harmonic else self._shafts.at(orders, resolution)
        sidebands = [] if harmonic else self._sidebands.at(orders, resolution)
        separate = self._sidebands.resolved(resolution).spacing
        named = harmonic or shafts or any(one.member in separate for one in sidebands)
        alias = found.alias(line)
        if self.filtered:
            near = EXACT * float(found.axis[1])
            place = line.place, found.mesh, found.sample_rate
            alias = None if named else aliased_harmonic(*place, near)
            if expected is not None and expected.is_alias:
                alias = expected.harmonic
        if not named and alias is None:
            sidebands = []  # of a member whose sidebands are nearly everywhere
        beside = overlap(
            [*shafts, *sidebands], self._near(orders, resolution), RESOLVED * resolution
        )
        return unnamed._replace(
            harmonic=harmonic, alias=alias, sidebands=sidebands, shafts=shafts, overlap=beside
        )

    def _expected(self, line: Line) -> Predicted | None:
        """The predicted place at which a line is, if any."""
        at = (one for one in self.predicted if abs(line.place - one.place) <= self._near_place)
        return next(at, None)

    def _near(self, orders: float, resolution: float) -> dict[Sideband | ShaftLine, float]:
        """Places [mesh orders] of what may overlap a line, or another that coincides with it."""
        within = (RESOLVED + 1.0) * resolution
        sidebands, shafts = self._sidebands.at(orders, within), self._shafts.near(orders, within)
        places: dict[Sideband | ShaftLine, float] = {}
        places |= {one: self._shafts.place(one) for one in shafts}
        return places | {one: self._sidebands.place(one) for one in sidebands}
