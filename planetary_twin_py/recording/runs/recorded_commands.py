"""Commands of a recorded run, to act in another one."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...model.clock import TICKS
from ...run.commands import NAMES, Commands
from ..container.records import RecordingError
from ..ros2.namespaces import namespace_in
from .schedule import read_runs


def recorded_commands(path: Path, remarks: list[str]) -> Commands:
    """Read the commands at the ports of the last run in a recording.

    Args:
        path: path of the recording, with one gearbox.
        remarks: warnings about commands that are missing are appended.

    Returns:
        The commands, at the simulated times at which they acted.

    Raises:
        ValueError: the recording cannot be read, or has no commands.
        OSError: the file cannot be read.
    """
    namespace = namespace_in(path)
    run = read_runs(path, namespace, remarks)[-1]
    if run.missing:
        lost = f"{run.missing} intervals are missing, and commands that acted in them"
        remarks.append(f"{path}: {lost}")
    given = [
        (each.begin, run.given[each.stamp]) for each in run.intervals if each.stamp in run.given
    ]
    if not given:
        raise RecordingError(f"{path}: the last run has no commands at its ports")
    used = [name for name in NAMES if any(name in values for _, values in given)]
    columns = {name: np.array([values.get(name, np.nan) for _, values in given]) for name in used}
    return Commands(np.array([begin for begin, _ in given]) / TICKS, **columns)
