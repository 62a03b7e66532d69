"""Bifurcation: what a gearbox settles to at one speed after the other, both up and down.

Each speed begins with the motion of the one before, so that where two motions are possible the way
up keeps one and the way down the other. Every settled motion is seen in its Poincare section.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..dynamics.bodies import mesh_names
from ..scene import Scene
from .section import Section

if TYPE_CHECKING:
    import pyarrow as pa

STUDY = "bifurcation"
"""Marks such a table."""
UP, DOWN = "up", "down"
FASTEST_SLEW = 1e6  # [rad/s^2] that a scene allows
MOST_CYCLES = 100_000
LONGEST_SETTLING = 60.0  # [s]

Hearer = Callable[[str | None], None]


@dataclass(frozen=True)
class Holding:
    """How each speed is held and looked at."""

    settling: float = 0.2
    """Simulated before it is looked at [s]; the first half goes into the change of speed."""
    cycles: int = 60
    """Mesh cycles that are looked at, once each."""
    phase: float = 0.0
    """Where in the mesh cycle, in [0, 1); 0: a tooth pair of the first mesh at the pitch point."""
    tolerance: float = 1e-4
    """Relative local error of a step."""

    def check(self) -> None:
        """Raise the `ValueError` of a setting that is out of range."""
        if not 0.0 < self.settling <= LONGEST_SETTLING:
            raise ValueError(
                f"settling = {self.settling!r} s: must be above 0 and at most {LONGEST_SETTLING:g}"
            )
        if not 1 <= self.cycles <= MOST_CYCLES:
            raise ValueError(f"cycles = {self.cycles!r}: must be within 1 and {MOST_CYCLES}")
        if not 0.0 <= self.phase < 1.0:
            raise ValueError(f"phase = {self.phase!r}: must be at least 0 and below 1")


def bifurcation(
    scene: Scene,
    speeds: Sequence[float],
    holding: Holding = Holding(),
    hear: Hearer = lambda failure: None,
) -> pa.Table:
    """The sections at all `speeds` [rad/s] of the first motor, up and down.

    One row for each mesh cycle that is looked at. Where a way fails, it ends, and a row without
    DTEs says why.

    Args:
        scene: what runs; its other set-points stay.
        speeds: at least two, all of one sign and within the drive's limit.
        holding: how each is held and looked at.
        hear: is called for each speed held, and told why a way has ended.

    Raises:
        ValueError: an argument is out of range, or the scene has no vibrations.
    """
    holding.check()
    rising = sorted({float(speed) for speed in speeds}, key=abs)
    if len(rising) < 2 or rising[0] * rising[-1] <= 0.0:
        raise ValueError(
            f"input_speed = {', '.join(f'{speed:g}' for speed in rising)} rad/s: must be at least "
            "two speeds, all above or all below 0"
        )
    ways = {UP: _Way(scene, rising, holding), DOWN: _Way(scene, rising[::-1], holding)}
    with ThreadPoolExecutor(len(ways)) as pool:
        try:
            found = list(pool.map(lambda way: list(way.walk(hear)), ways.values()))
        finally:
            for way in ways.values():
                way.interrupted = True
    return _tabulate(scene, holding, dict(zip(ways, found, strict=True)))


class _Way:
    """Speeds to hold one after the other [rad/s]."""

    def __init__(self, scene: Scene, speeds: Sequence[float], holding: Holding) -> None:
        steps = np.abs(np.diff(speeds))
        control = "drive.speed_control"
        gentle = min(2.0 * float(steps.max()) / holding.settling, FASTEST_SLEW)
        for speed in speeds:
            scene.replace(input_speed=speed)  # refuse all at once, not the last after an hour
        self._speeds, self._holding = speeds, holding
        self.interrupted = False
        self._section = Section(
            scene.replace(
                input_speed=speeds[0],
                **{f"{control}.slew_rate": gentle, f"{control}.start_speed": None},
            ),
            holding.tolerance,
            holding.phase,
        )

    def walk(self, hear: Hearer) -> Iterator[_Held]:
        """What is seen at each speed, up to the first that fails, or until interrupted."""
        for speed in self._speeds:
            if self.interrupted:
                return
            held = self._hold(speed)
            hear(held.failure)
            yield held
            if held.failure:
                return

    def _hold(self, speed: float) -> _Held:
        try:
            self._section.hold(speed, self._holding.settling)
            dte = np.array([self._section.dte() for _ in range(self._holding.cycles)])
        except ArithmeticError as reason:
            return _Held(speed, None, f"input_speed = {speed:.6g}: {reason}")
        return _Held(speed, dte, None)


class _Held(NamedTuple):
    """One speed [rad/s] of one way: the DTEs at the sections [m], (cycles, meshes), or why none."""

    speed: float
    dte: np.ndarray | None
    failure: str | None


def _tabulate(scene: Scene, holding: Holding, found: Mapping[str, Sequence[_Held]]) -> pa.Table:
    import pyarrow as pa

    from .table import column

    meshes = mesh_names(scene).names
    rows: list[tuple[Any, ...]] = []
    for direction, way in found.items():
        for held in way:
            seen = np.full((1, len(meshes)), None) if held.dte is None else held.dte
            rows += [
                (direction, held.speed, cycle, *dtes, held.failure)
                for cycle, dtes in enumerate(seen.tolist())
            ]
    directions, speeds, cycles, *dtes, failures = zip(*rows, strict=True)
    columns = [
        column("direction", directions, "", "whether speeds rise or fall", "str"),
        column("input_speed", speeds, "rad/s", "speed set-point of the motor", "f8"),
        column("cycle", cycles, "", "mesh cycles that have been looked at before", "i8"),
        *(
            column(f"{mesh}_dte", values, "m", f"DTE of {mesh} at the section", "f8")
            for mesh, values in zip(meshes, dtes, strict=True)
        ),
        column("failure", failures, "", "why the way ends here", "str"),
    ]
    about = {
        "study": STUDY,
        "scene": json.dumps(scene.model_dump(mode="json")),
        "settings": json.dumps(asdict(holding)),
    }
    return pa.table(
        [array for _, array in columns], pa.schema([field for field, _ in columns], about)
    )
