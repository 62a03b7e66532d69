"""Records a run without ROS, with the messages that the nodes would publish."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import yaml

from ...model.clock import TICKS
from ...run.result import Result
from ...run.whole_run import WholeRun
from ...run.window import Window
from ...scene import Scene
from ..ros2.bag import BagWriter, write_as
from ..ros2.definitions import topics_of
from ..ros2.sensor_messages import kinds_of
from .compose import Composer, Stamps
from .origin import Origin, makers_here
from .reader import SCENE_ATTACHMENT
from .schedule import nanoseconds

NAMESPACE = "/planetary_twin"


class Plan(NamedTuple):
    """Arguments of a run: see `simulate`."""

    scene: Scene
    duration: float
    sample_rate: float
    tolerance: float
    settling: float = 0.0


def record(plan: Plan, out: Path, progress: Callable[[float], None] = lambda time: None) -> Path:
    """Simulate and record.

    Args:
        plan: plan of the run; the time of settling is recorded, too.
        out: a bag folder, or a file that ends in .mcap.
        progress: called with the simulated time [s].

    Returns:
        The file.

    Raises:
        ValueError: a value of the plan is out of range, or its scene leaves its dynamics open.
        FileExistsError: `out` exists.
        OSError: `out` cannot be written.
    """
    return record_run(plan, out, progress)[0]


def record_run(plan: Plan, out: Path, progress: Callable[[float], None]) -> tuple[Path, Result]:
    """Simulate and record.

    Args:
        plan: see `record`.
        out: see `record`.
        progress: see `record`.

    Returns:
        The file, and the result of the run that it contains, with the samples of its end alone.

    Raises:
        ValueError: see `record`.
        FileExistsError: see `record`.
        OSError: see `record`.
    """
    results: list[Result] = []

    def write(folder: Path) -> Path:
        file, result = _record(plan, folder, progress)
        results.append(result)
        return file

    file = write_as(out, write)
    return file, results[0]


def _record(plan: Plan, folder: Path, progress: Callable[[float], None]) -> tuple[Path, Result]:
    run, begins, scene = WholeRun(plan.scene, plan.tolerance), time.time_ns(), plan.scene
    bag = BagWriter(folder)
    try:
        text = yaml.safe_dump(scene.model_dump(mode="json"), sort_keys=False)
        bag.attach(SCENE_ATTACHMENT, text.encode(), "application/yaml")
        topics = topics_of(NAMESPACE, scene.moving_axes, sensors=kinds_of(scene))
        composer = Composer(bag, topics, NAMESPACE)
        composer.begin(Origin(scene, begins, makers_here()))
        composer.point(scene.live_values, 0.0, begins)

        def write(window: Window) -> None:
            begin, end = (round(at * TICKS) for at in (window.start, window.end))
            before, stamp = (begins + nanoseconds(ticks) for ticks in (begin, end))
            composer.window(window, Stamps(begin, end, before, stamp))
            progress(window.end)

        result = run.result(plan.duration, plan.sample_rate, plan.settling, write)
    finally:  # an incomplete recording is valid, too
        bag.close()
    return bag.file, result
