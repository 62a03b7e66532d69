"""The points of a study: grid or Latin hypercube."""

from __future__ import annotations

import hashlib
import itertools
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..run.window_plan import LONGEST_WINDOW
from ..scene import Scene, SceneError
from ..simulation.simulate import check_run
from .axes import Axis, Normal, Span, admitted

MOST_POINTS = 1_000_000
BIFURCATION = "bifurcation"
"""Kind of study in the metadata `study` of a table; a sweep has none."""


@dataclass(frozen=True)
class Settings:
    """Settings of the run at each point."""

    duration: float = 0.2
    """Evaluated time [s]."""
    settling: float = 0.05
    """Simulated time before [s]."""
    sample_rate: float = 50_000.0
    """[Hz]"""
    tolerance: float = 1e-4
    """Relative local error tolerance of the integrator."""

    def check(self) -> None:
        """Raise `ValueError` if a setting is out of range."""
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
    """One run of a study: its index in the table, and its changes to the scene."""

    place: int
    changes: Mapping[str, Any]


@dataclass(frozen=True)
class Study:
    """A scene, the fields that vary, the points, and the settings of a run."""

    scene: Scene
    fields: tuple[str, ...]
    points: tuple[Point, ...]
    settings: Settings = Settings()

    def extremes(self) -> list[Scene]:
        """Scenes of the first and of the last point with each combination of choices.

        Choices are values that are not numbers, such as the dynamics. Warnings about scenes need
        not judge every point.
        """
        chosen: dict[str, list[Point]] = {}
        for point in self.points:
            choices = {
                name: value for name, value in point.changes.items() if not _is_number(value)
            }
            chosen.setdefault(repr(choices), []).append(point)
        points = [points[end] for points in chosen.values() for end in (0, -1)[: len(points)]]
        return [scene for point in points if (scene := self._scene(point)) is not None]

    def _scene(self, point: Point) -> Scene | None:
        try:
            return self.scene.replace(**point.changes)
        except ValueError:  # a failure of the point
            return None

    def key(self, point: Point, versions: str) -> str:
        """Digest of everything that determines the results of a point.

        Args:
            point: point of this study.
            versions: digest of the core and names of the measures.

        Returns:
            32 hexadecimal digits.
        """
        content = {
            "scene": self.scene.model_dump(mode="json", exclude={"name", "description"}),
            "changes": dict(point.changes),
            "settings": asdict(self.settings),
            "makers": versions,
        }
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:32]


def grid(
    scene: Scene, axes: Sequence[Axis | Span | Normal], settings: Settings = Settings()
) -> Study:
    """All combinations of the values of the axes; the last axis varies fastest.

    Args:
        scene: the gearbox.
        axes: fields and their values.
        settings: settings of each run.

    Raises:
        ValueError: an axis is a range without values or occurs twice, or there are too many
            points.
    """
    for axis in axes:
        if isinstance(axis, Normal):
            raise ValueError(f"{axis.field}: a distribution requires a number of samples")
        if isinstance(axis, Span):
            raise ValueError(
                f"{axis.field}: a range without a count; write {axis.low:g}:{axis.high:g}:5 for "
                "five values, or give a number of samples"
            )
    listed = [axis for axis in axes if isinstance(axis, Axis)]
    count = math.prod(len(axis.values) for axis in listed)
    if count > MOST_POINTS:
        raise ValueError(f"{count} points: must be at most {MOST_POINTS}")
    return _study(scene, axes, itertools.product(*(axis.values for axis in listed)), settings)


def latin_hypercube(
    scene: Scene,
    axes: Sequence[Axis | Span | Normal],
    samples: int,
    seed: int = 0,
    settings: Settings = Settings(),
) -> Study:
    """Latin hypercube sample: one point in each of `samples` strata of every axis.

    McKay, Beckman and Conover 1979, Technometrics 21, 239-245. Listed values occur equally often,
    within one.

    Args:
        scene: the gearbox.
        axes: fields with their ranges, distributions or values.
        samples: number of points.
        seed: seed of the random generator.
        settings: settings of each run.

    Raises:
        ValueError: an axis occurs twice, or the number of samples is out of range.
    """
    if not 1 <= samples <= MOST_POINTS:
        raise ValueError(f"samples = {samples!r}: must be within 1 and {MOST_POINTS}")
    from scipy.stats.qmc import LatinHypercube

    shares = LatinHypercube(len(axes), rng=seed).random(samples)
    columns = [_drawn(scene, axis, shares[:, k]) for k, axis in enumerate(axes)]
    return _study(scene, axes, zip(*columns, strict=True), settings)


def _drawn(scene: Scene, axis: Axis | Span | Normal, share: Any) -> list[Any]:
    if isinstance(axis, Axis):
        return [axis.values[int(s * len(axis.values))] for s in share]
    try:
        return [admitted(scene, axis, np.array([value]))[0] for value in axis.at(share)]
    except SceneError as error:
        if isinstance(axis, Span):
            raise
        law = f"normal({axis.mean:g}, {axis.deviation:g})"
        raise ValueError(f"{axis.field} = {law}: {len(share)} samples reach {error}") from None


def _study(
    scene: Scene, axes: Sequence[Axis | Span | Normal], rows: Any, settings: Settings
) -> Study:
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


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def describe(changes: Mapping[str, Any]) -> str:
    """Changes as text: "backlash = 1e-07, mesh.ramp = 0".

    Args:
        changes: values in SI by field.
    """
    return ", ".join(
        f"{name} = {value:.6g}" if isinstance(value, float) else f"{name} = {value}"
        for name, value in changes.items()
    )
