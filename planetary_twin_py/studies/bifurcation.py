"""Bifurcation diagram: steady motions at a sequence of speeds, rising and falling.

Each speed is started from the motion at the previous speed. If two motions are possible at a speed,
the rising branch follows one and the falling branch the other. Every steady motion is sampled in
its Poincare section.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..model.gearbox import Gearbox
from ..run.counters import Course
from ..scene import Scene
from ..units.catalogue import COURSE
from .plan import BIFURCATION
from .section import Section
from .work import Failure, Report

if TYPE_CHECKING:
    import pyarrow as pa

UP, DOWN = "up", "down"
FASTEST_SLEW = 1e6  # [rad/s^2], upper limit of a scene
MOST_CYCLES = 100_000
LONGEST_SETTLING = 60.0  # [s]
COUNTED = ("reversals", "both_flanks")  # counters of `Course` that show inaccurate samples


@dataclass(frozen=True)
class Dwell:
    """Settling and sampling at each speed."""

    settling: float = 0.2
    """Simulated time before sampling starts [s]; the speed changes during the first half."""
    cycles: int = 60
    """Mesh cycles sampled, one sample each."""
    phase: float = 0.0
    """Phase of the mesh cycle in [0, 1); 0: a tooth pair of the first mesh at the pitch point."""
    tolerance: float = 1e-4
    """Relative local error tolerance of the integrator."""

    def check(self) -> None:
        """Raise `ValueError` if a setting is out of range."""
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
    dwell: Dwell = Dwell(),
    report: Report = lambda done, failure: None,
) -> pa.Table:
    """Poincare sections at all speeds, on the rising and on the falling branch.

    Args:
        scene: the gearbox; its other set-points are constant.
        speeds: input speeds of the first motor [rad/s], at least two, all of one sign and within
            the limit of the drive.
        dwell: settling and sampling at each speed.
        report: called after each speed with 1, and with the failure if the branch ends there.

    Returns:
        A table with a row per sampled mesh cycle. A branch that fails ends with a row that has
        the reason in place of DTEs.

    Raises:
        ValueError: an argument is out of range, or the scene is quasi-static.
    """
    dwell.check()
    rising = sorted({float(speed) for speed in speeds}, key=abs)
    if len(rising) < 2 or rising[0] * rising[-1] <= 0.0:
        raise ValueError(
            f"input_speed = {', '.join(f'{speed:g}' for speed in rising)} rad/s: must be at least "
            "two speeds, all above or all below 0"
        )
    branches = {UP: _Branch(scene, rising, dwell), DOWN: _Branch(scene, rising[::-1], dwell)}
    with ThreadPoolExecutor(len(branches)) as pool:
        try:
            samples_by_branch = list(
                pool.map(lambda branch: list(branch.run(report)), branches.values())
            )
        finally:
            for branch in branches.values():
                branch.interrupted = True
    return _tabulate(scene, dwell, dict(zip(branches, samples_by_branch, strict=True)))


class _Branch:
    """A sequence of speeds [rad/s], each started from the motion at the previous one."""

    def __init__(self, scene: Scene, speeds: Sequence[float], dwell: Dwell) -> None:
        steps = np.abs(np.diff(speeds))
        control = "drive.speed_control"
        slew = min(2.0 * float(steps.max()) / dwell.settling, FASTEST_SLEW)
        for speed in speeds:
            scene.replace(input_speed=speed)  # check all speeds before the first run
        self._speeds, self._dwell = speeds, dwell
        self.interrupted = False
        self._section = Section(
            scene.replace(
                input_speed=speeds[0],
                **{f"{control}.slew_rate": slew, f"{control}.start_speed": None},
            ),
            dwell.tolerance,
            dwell.phase,
        )

    def run(self, report: Report) -> Iterator[_Sampled]:
        """Samples at each speed, up to the first failure, or until interrupted."""
        for speed in self._speeds:
            if self.interrupted:
                return
            sampled = self._sample(speed)
            report(1, None if sampled.failure is None else Failure(sampled.failure))
            yield sampled
            if sampled.failure:
                return

    def _sample(self, speed: float) -> _Sampled:
        before = self._section.course
        try:
            self._section.hold(speed, self._dwell.settling)
            dte = np.array([self._section.dte() for _ in range(self._dwell.cycles)])
        except ArithmeticError as reason:
            return _Sampled(speed, None, Course(), f"input_speed = {speed:.6g}: {reason}")
        return _Sampled(speed, dte, self._section.course.since(before), None)


class _Sampled(NamedTuple):
    """DTEs [m], shape (cycles, meshes), and counters at one speed [rad/s], or the failure."""

    speed: float
    dte: np.ndarray | None
    course: Course
    failure: str | None


def _counts(sampled: _Sampled) -> tuple[int, ...]:
    return tuple(getattr(sampled.course, name) for name in COUNTED)


def _tabulate(
    scene: Scene, dwell: Dwell, samples_by_branch: Mapping[str, Sequence[_Sampled]]
) -> pa.Table:
    import pyarrow as pa

    from .table import column

    meshes = Gearbox(scene).mesh_names.names
    rows: list[tuple[Any, ...]] = []
    for direction, branch in samples_by_branch.items():
        for sampled in branch:
            samples = np.full((1, len(meshes)), None) if sampled.dte is None else sampled.dte
            rows += [
                (direction, sampled.speed, cycle, *dtes, *_counts(sampled), sampled.failure)
                for cycle, dtes in enumerate(samples.tolist())
            ]
    directions, speeds, cycles, *values, failures = zip(*rows, strict=True)
    dtes, counts = values[: len(meshes)], values[len(meshes) :]
    columns = [
        column("direction", directions, "", "whether speeds rise or fall", "str"),
        column("input_speed", speeds, "rad/s", "speed set-point of the motor", "f8"),
        column("cycle", cycles, "", "number of the sampled mesh cycle, from 0", "i8"),
        *(
            column(f"{mesh}_dte", values, "m", f"DTE of {mesh} at the section", "f8")
            for mesh, values in zip(meshes, dtes, strict=True)
        ),
        *(
            column(name, numbers, COURSE[name].si, COURSE[name].text, "i8")
            for name, numbers in zip(COUNTED, counts, strict=True)
        ),
        column("failure", failures, "", "why the branch ends here", "str"),
    ]
    about = {
        "study": BIFURCATION,
        "scene": json.dumps(scene.model_dump(mode="json")),
        "settings": json.dumps(asdict(dwell)),
    }
    return pa.table(
        [array for _, array in columns], pa.schema([field for field, _ in columns], about)
    )
