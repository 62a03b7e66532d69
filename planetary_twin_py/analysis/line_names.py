"""Names lines of a spectrum: mesh harmonics, sidebands, rotations of members, and aliases."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from ..scene import Scene
from .aliases import aliased_harmonic
from .distinct_lines import DISTINCT, over_noise
from .mesh_spectrum import MeshSpectrum
from .overlaps import Overlap, overlap
from .shaft_lines import ShaftLine, ShaftLines, shaft_text
from .sidebands import RESOLVED, Sideband, Sidebands, sideband_text
from .spectrum import Line

EXACT = 0.5  # [bins] largest distance of a line from the alias of a harmonic of unknown height


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
        """The highest lines in the band, highest first.

        Args:
            count: largest number of lines.
        """
        found, lines = self.spectrum, self.spectrum.lines(count)
        ratios = over_noise(found.axis, found.amplitude, lines, found.error)
        return [self._named(line, ratio) for line, ratio in zip(lines, ratios, strict=True)]

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
        if ratio < DISTINCT or orders is None or found.mesh is None:
            return NamedLine(line, ratio, None, None, [], [], self.filtered)
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
        if not named and alias is None:
            sidebands = []  # of a member whose sidebands are nearly everywhere
        beside = overlap(
            [*shafts, *sidebands], self._near(orders, resolution), RESOLVED * resolution
        )
        return NamedLine(line, ratio, harmonic, alias, sidebands, shafts, self.filtered, beside)

    def _near(self, orders: float, resolution: float) -> dict[Sideband | ShaftLine, float]:
        """Places [mesh orders] of what may overlap a line, or another that coincides with it."""
        within = (RESOLVED + 1.0) * resolution
        sidebands, shafts = self._sidebands.at(orders, within), self._shafts.near(orders, within)
        places: dict[Sideband | ShaftLine, float] = {}
        places |= {one: self._shafts.place(one) for one in shafts}
        return places | {one: self._sidebands.place(one) for one in sidebands}
