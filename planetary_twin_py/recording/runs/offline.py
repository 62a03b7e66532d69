"""Records a run without ROS, with the messages that the nodes would publish."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...model.clock import TICKS
from ...run.commands import Commands
from ...run.result import Result
from ...run.steady_temperatures import with_start
from ...run.whole_run import SPAN, WholeRun
from ...run.window import Window
from ...scene import Scene
from ..ros2.bag import write_as
from ..ros2.definitions import topics_of
from ..ros2.sensor_messages import kinds_of
from .compose import Composer, Stamps, new_bag
from .origin import Origin, makers_here
from .schedule import nanoseconds

NAMESPACE = "/planetary_twin"


class Plan(NamedTuple):
    """Arguments of a run: see `simulate`."""

    scene: Scene
    duration: float
    sample_rate: float
    tolerance: float
    settling: float = 0.0
    commands: Commands | None = None
    begins: int | None = None
    """ROS time of its start [ns]; None: now."""


def record(plan: Plan, out: Path) -> Path:
    """Simulate and record, see `record_run`; returns the file."""
    return record_run(plan, out)[0]


def record_run(
    plan: Plan,
    out: Path,
    progress: Callable[[float], None] = lambda time: None,
    watch: Callable[[Window], None] = lambda window: None,
) -> tuple[Path, Result]:
    """Simulate and record.

    Args:
        plan: plan of the run; the time of settling is recorded, too.
        out: a bag folder, or a file that ends in .mcap.
        progress: called with the simulated time [s].
        watch: called with each window.

    Returns:
        The file, and the result of the run that it contains, with the samples of its end alone.

    Raises:
        ValueError: a value of the plan is out of range, or its scene leaves its dynamics open.
        FileExistsError: `out` exists.
        OSError: `out` cannot be written.
    """
    results: list[Result] = []

    def write(folder: Path) -> Path:
        file, result = _record(plan, folder, progress, watch)
        results.append(result)
        return file

    file = write_as(out, write)
    return file, results[0]


def _record(
    plan: Plan,
    folder: Path,
    progress: Callable[[float], None],
    watch: Callable[[Window], None],
) -> tuple[Path, Result]:
    scene, commands = with_start(plan.scene), plan.commands
    if commands is not None:
        _check_times(commands, plan.settling)
    run = WholeRun(scene, plan.tolerance, commands=commands)
    begins = time.time_ns() if plan.begins is None else plan.begins
    with new_bag(folder, scene, plan.begins) as bag:
        topics = topics_of(
            NAMESPACE, scene.moving_axes, scene.drive.ports.given, kinds_of(scene),
            scene.durability is not None,
        )  # fmt: skip
        composer = Composer(bag, topics, NAMESPACE)
        composer.begin(Origin(scene, begins, makers_here()))
        composer.point(scene.live_values, 0.0, begins)

        def write(window: Window) -> None:
            begin, end = (round(at * TICKS) for at in (window.start, window.end))
            before, stamp = (begins + nanoseconds(ticks) for ticks in (begin, end))
            composer.window(window, Stamps(begin, end, before, stamp))
            watch(window)
            progress(window.end)

        result = run.result(plan.duration, plan.sample_rate, plan.settling, write)
    return bag.file, result


def _check_times(commands: Commands, settling: float) -> None:
    """Check that each command acts in a window of its own, which is recorded with it."""
    for name, times in (("commands.time", commands.time), ("settling", np.array([settling]))):
        for at in times[np.round(times * TICKS) % SPAN != 0.0][:1]:
            raise ValueError(
                f"{name} = {at:g} s: must be a multiple of {SPAN / TICKS:g} s to be recorded"
            )
