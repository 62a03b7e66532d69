"""Which points of the space between the axes are run."""

from __future__ import annotations

import hashlib
import itertools
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..scene import Scene
from ..simulation import check_run
from ..twin import LONGEST_WINDOW
from .axes import Axis, Span, admitted

MOST_POINTS = 1_000_000


@dataclass(frozen=True)
class Settings:
    """How each point is run: simulated time, what of its begin is not measured, and how exactly."""

    duration: float = 0.2
    """Measured time [s]."""
    settling: float = 0.05
    """Simulated before [s]."""
    sample_rate: float = 50_000.0
    """[Hz]"""
    tolerance: float = 1e-4
    """Relative local error of a step."""

    def check(self) -> None:
        """Raise the `ValueError` of a setting that is out of range."""
        if not 0.0 < self.duration <= LONGEST_WINDOW:
            raise ValueError(
                f"duration = {self.duration!r} s: must be above 0 and at most {LONGEST_WINDOW:g}"
            )
        if not 0.0 <= self.settling <= LONGEST_WINDOW:
            raise ValueError(
                f"settling = {self.settling!r} s: must be within 0 and {LONGEST_WINDOW:g}"
            )
        check_run(self.duration, self.sample_rate, "auto", self.tolerance)


@dataclass(frozen=True)
class Point:
    """One run of a study: its place in the table and where it differs from the scene."""

    place: int
    changes: Mapping[str, Any]


@dataclass(frozen=True)
class Study:
    """A scene, the fields that vary, the points to run, and how."""

    scene: Scene
    fields: tuple[str, ...]
    points: tuple[Point, ...]
    settings: Settings = Settings()

    def key(self, point: Point, makers: str) -> str:
        """Digest of all that the figures of `point` follow from; `makers`: what computes them."""
        content = {
            "scene": self.scene.model_dump(mode="json", exclude={"name", "description"}),
            "changes": dict(point.changes),
            "settings": asdict(self.settings),
            "makers": makers,
        }
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:32]


def grid(scene: Scene, axes: Sequence[Axis | Span], settings: Settings = Settings()) -> Study:
    """Every combination of the axes' values; the last axis varies quickest.

    Raises:
        ValueError: an axis is a range without values, stands twice, or the points are too many.
    """
    for axis in axes:
        if isinstance(axis, Span):
            raise ValueError(
                f"{axis.field}: a range without a count; {axis.low:g}:{axis.high:g}:5 gives five "
                "values, a number of samples draws from it"
            )
    listed = [axis for axis in axes if isinstance(axis, Axis)]
    count = math.prod(len(axis.values) for axis in listed)
    if count > MOST_POINTS:
        raise ValueError(f"{count} points: must be at most {MOST_POINTS}")
    return _study(scene, axes, itertools.product(*(axis.values for axis in listed)), settings)


def latin_hypercube(
    scene: Scene,
    axes: Sequence[Axis | Span],
    samples: int,
    seed: int = 0,
    settings: Settings = Settings(),
) -> Study:
    """`samples` points, of which each falls in a stratum of its own along every axis.

    Ranges are drawn from; of listed values each comes equally often, up to one. (McKay, Beckman
    and Conover 1979.)

    Raises:
        ValueError: an axis stands twice, or the number of samples is out of range.
    """
    if not 1 <= samples <= MOST_POINTS:
        raise ValueError(f"samples = {samples!r}: must be within 1 and {MOST_POINTS}")
    from scipy.stats.qmc import LatinHypercube

    shares = LatinHypercube(len(axes), rng=seed).random(samples)
    columns = [_drawn(scene, axis, shares[:, k]) for k, axis in enumerate(axes)]
    return _study(scene, axes, zip(*columns, strict=True), settings)


def _drawn(scene: Scene, axis: Axis | Span, share: Any) -> list[Any]:
    if isinstance(axis, Axis):
        return [axis.values[int(s * len(axis.values))] for s in share]
    return [admitted(scene, axis, np.array([value]))[0] for value in axis.at(share)]


def _study(scene: Scene, axes: Sequence[Axis | Span], rows: Any, settings: Settings) -> Study:
    fields = tuple(axis.field for axis in axes)
    for field in fields:
        if fields.count(field) > 1:
            raise ValueError(f"{field}: given twice")
    if not fields:
        raise ValueError("no field varies: give at least one, e.g. lambda_ratio 1:2:5")
    settings.check()
    points = tuple(
        Point(place, dict(zip(fields, row, strict=True))) for place, row in enumerate(rows)
    )
    return Study(scene, fields, points, settings)


def told(changes: Mapping[str, Any]) -> str:
    """Changes in words."""
    return ", ".join(
        f"{name} = {value:.6g}" if isinstance(value, float) else f"{name} = {value}"
        for name, value in changes.items()
    )
