"""Records a run without ROS, with the messages that the nodes would publish."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import yaml

from ...model.clock import TICKS
from ...scene import Scene
from ..ros2.bag import BagWriter, write_as
from ..ros2.definitions import topics_of
from .compose import Composer
from .intervals import Interval, Intervals
from .origin import Origin, makers_here
from .reader import SCENE_ATTACHMENT
from .schedule import Change, RecordedRun, nanoseconds
from .written import write_run

NAMESPACE = "/planetary_twin"
INTERVAL = 0.01  # [s], as the simulation node publishes by default


class Plan(NamedTuple):
    """Arguments of a run: see `simulate`."""

    scene: Scene
    duration: float
    sample_rate: float
    tolerance: float


def record(plan: Plan, out: Path, progress: Callable[[float], None] = lambda time: None) -> Path:
    """Simulate and record.

    Args:
        plan: plan of the run.
        out: a bag folder, or a file that ends in .mcap.
        progress: called with the simulated time [s].

    Returns:
        The file.

    Raises:
        ValueError: a value of the plan is out of range, or its scene leaves its dynamics open.
        FileExistsError: `out` exists.
        OSError: `out` cannot be written.
    """
    return write_as(out, lambda folder: _record(plan, folder, progress))


def _record(plan: Plan, folder: Path, progress: Callable[[float], None]) -> Path:
    run = _run(plan)
    bag = BagWriter(folder)
    try:
        scene = yaml.safe_dump(plan.scene.model_dump(mode="json"), sort_keys=False)
        bag.attach(SCENE_ATTACHMENT, scene.encode(), "application/yaml")
        for reached in write_run(
            Composer(bag, topics_of(NAMESPACE, plan.scene.moving_axes), NAMESPACE), run
        ):
            progress(reached)
    finally:  # an incomplete recording is valid, too
        bag.close()
    return bag.file


def _run(plan: Plan) -> RecordedRun:
    """The run, starting now, in equal intervals; the last one may be shorter."""
    begins, end, length = time.time_ns(), round(plan.duration * TICKS), round(INTERVAL * TICKS)
    ends = [min((n + 1) * length, end) for n in range(math.ceil(end / length))]
    intervals = Intervals(
        Interval(n + 1, begins + nanoseconds(to), n * length, to, plan.tolerance, plan.sample_rate)
        for n, to in enumerate(ends)
    )
    change = Change(1, begins, 0.0, plan.scene.live_values)
    return RecordedRun(Origin(plan.scene, begins, makers_here()), intervals, [change])
