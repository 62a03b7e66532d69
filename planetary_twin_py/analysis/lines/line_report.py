"""What a spectrum shows: its highest lines with their names, and how far they can be trusted."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

from ...scene import Scene
from ...simulation.natural_modes import natural_modes
from ..sampling.aliases import NEGLIGIBLE, alias_remark
from ..signals.signal import Signal
from .distinct_lines import PLACES, PREDICTED, distinct_ratio
from .line_names import LineNames, NamedLine
from .mesh_spectrum import MeshSpectrum
from .sidebands import RESOLVED

LINES = 12
CYCLES = 2  # in the record, from which on the amplitude of a line is exact to 2 %


@dataclass(frozen=True)
class LineReport:
    """The highest lines of a spectrum over frequency or order."""

    signal: Signal
    spectrum: MeshSpectrum
    scene: Scene | None
    """The gears; None if they are unknown."""
    by_order: bool
    filtered: bool
    """Whether an anti-aliasing filter may precede the samples, as in data loggers."""

    @property
    def unit(self) -> str:
        """Unit of places and distances on the axis."""
        return "orders" if self.by_order else "Hz"

    @property
    def resolution(self) -> float:
        """Distance of two values of the spectrum."""
        return float(self.spectrum.axis[1])

    @property
    def mean(self) -> float:
        """Mean of the samples, in SI."""
        return float(self.signal.samples.mean())

    @cached_property
    def lines(self) -> list[NamedLine]:
        """At most `LINES`, highest first, and lower ones at predicted places."""
        return self._names.named(LINES)

    def figures(self) -> dict[str, Any]:
        """The report for JSON."""
        return {
            "from_s": float(self.signal.time[0]),
            "to_s": float(self.signal.time[-1]),
            "samples": len(self.signal.samples),
            "resolution": self.resolution,
            "mean": self.mean,
            "unresolved_sidebands": self._names.unresolved(),
            "lines": [self._figures_of(line) for line in self.lines],
            "predicted": [
                {
                    "harmonic": expected.harmonic,
                    "order" if self.by_order else "frequency_hz": expected.place,
                    "is_alias": expected.is_alias,
                    "amplitude": None if found is None else found.line.amplitude,
                    "over_noise": None if found is None else found.over_noise,
                    "chance": None if found is None else found.chance,
                    "found": found is not None and found.is_named,
                }
                for expected, found in self._names.at_predicted()
            ],
        }

    def sentences(self) -> Iterator[str]:
        """What is uncertain about the lines, and which lines have no name."""
        yield from self._uncertain()
        if pairs := [pair for pair in map(self._overlap, self.lines) if pair]:
            closest = min(pairs, key=lambda pair: float(pair["apart"]))
            yield (
                f"{len(pairs)} of these lines may be the sum of two, with an uncertain amplitude: "
                f"{closest['named']} overlaps {closest['other']}, {closest['apart']:.4g} "
                f"{self.unit} away; separating them needs {self._length(closest['apart'])}"
            )
        least = distinct_ratio(self.spectrum.averages)
        yield from self._predicted(least)
        weak = [one for one in self.lines if one.over_noise < least and not one.is_named]
        if weak and self.spectrum.mesh is not None:
            yield (
                f"{len(weak)} of these lines have no name: they are less than {least:.3g} times "
                "as high as the noise around them, or as the leakage of higher lines, or too low "
                "for interpolated samples"
            )
        for member, apart in self._names.unresolved().items():
            yield (
                f"sidebands of the {member} are {apart:.4g} {self.unit} apart and not named: they "
                f"need {self._length(apart)}"
            )

    def _predicted(self, least: float) -> Iterator[str]:
        """A sentence for each line that is named because its place is known beforehand."""
        for expected, found in self._names.at_predicted():
            if found is None or not found.is_named or found.over_noise >= least:
                continue
            of = f"{'alias of ' if expected.is_alias else ''}mesh harmonic {expected.harmonic}"
            yield (
                f"the {of} is {found.over_noise:.3g} times as high as the noise around it: its "
                f"place is known beforehand, and noise is so high in one of "
                f"{1.0 / found.chance:.2g} cases ({PLACES} bins); lines there are named from one "
                f"in {1.0 / PREDICTED:g} on"
            )

    def aliases(self) -> Iterator[str]:
        """A warning if the sample rate is too low for the waveform of a twin."""
        signal, found = self.signal, self.spectrum
        if found.alias_share <= NEGLIGIBLE:
            return
        highest = mesh = None
        if self.scene is not None:
            highest = float(natural_modes(self.scene).frequencies.max())
        if found.mesh is not None:
            mesh = found.mesh * signal.sample_rate / found.sample_rate
        yield alias_remark(signal.sample_rate, found.alias_share, highest, mesh)

    @cached_property
    def _names(self) -> LineNames:
        return LineNames(self.spectrum, self.scene, self.filtered)

    def _figures_of(self, named: NamedLine) -> dict[str, Any]:
        return {
            "order" if self.by_order else "frequency_hz": named.line.place,
            "amplitude": named.line.amplitude,
            "over_noise": named.over_noise,
            "chance": named.chance,
            "mesh_orders": self.spectrum.in_mesh_orders(named.line.place),
            "harmonic": named.harmonic,
            "alias_of_harmonic": named.alias,
            "sidebands": [band._asdict() for band in named.sidebands],
            "shafts": [shaft._asdict() for shaft in named.shafts],
            "overlap": self._overlap(named),
            "name": named.text,
        }

    def _overlap(self, named: NamedLine) -> dict[str, Any] | None:
        """The closest line that overlaps a named one, with its distance on the axis."""
        if named.overlap is None or self.spectrum.mesh is None:
            return None
        return named.overlap._asdict() | {"apart": self.spectrum.mesh * named.overlap.apart}

    def _uncertain(self) -> Iterator[str]:
        """Sentences on lines whose amplitude other lines, or the ends of the axis, change."""
        slow = sum(named.line.place < CYCLES * self.resolution for named in self.lines)
        if slow:
            yield (
                f"{slow} of these lines have fewer than {CYCLES:g} cycles in the record: their "
                "amplitudes are not exact, up to 9 % too low from 1.5 cycles, 41 % from one, more "
                "below"
            )
        least = distinct_ratio(self.spectrum.averages)
        clear = sorted(named.line.place for named in self.lines if named.over_noise >= least)
        near = sum(high - low < RESOLVED * self.resolution for low, high in pairwise(clear))
        if near:
            yield (
                f"{near} of these lines are less than {RESOLVED:g} times the resolution above "
                "another: they overlap, and their amplitudes are uncertain"
            )

    def _length(self, apart: float) -> str:
        """Resolution that separates lines, and the length of signal that has it."""
        finest = apart / RESOLVED
        length = f"{1.0 / finest:.3g} {'turns' if self.by_order else 's'}"
        return f"a resolution of {finest:.3g} {self.unit}, {length} of signal"
