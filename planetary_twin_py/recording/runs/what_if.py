"""What-if: simulates a recorded run again with other values from a given time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from ...model.clock import TICKS
from ...scene import Scene
from ..ros2.definitions import kinds_beside, topics_of
from ..ros2.metadata import Topic
from ..ros2.playback import Playback
from ..ros2.sensor_messages import kinds_of
from ..ros2.topics import POINT, STATE
from .branch import Branch, branched
from .compose import Composer, Stamps, attach_yaml, new_bag
from .expected_damage import Replacements
from .intervals import Intervals
from .origin import Measured
from .resimulation import steps
from .schedule import RecordedRun, messages_of, read_runs, without_gaps

BRANCH_ATTACHMENT = "branch.yaml"
"""The changes, which mark a recording as simulated."""


@dataclass
class Made:
    """The new recording; `remarks` are warnings about unusable parts of the old one."""

    file: Path
    begins: float
    """Simulated time from which the settings apply, at the start of an interval [s]."""
    end: float
    """End of the run [s]."""
    scene: Scene
    """Scene at the start of the new run."""
    remarks: list[str] = field(default_factory=list)


def resimulate(
    path: Path,
    namespace: str,
    branch: Branch,
    folder: Path,
    progress: Callable[[float, float], None] = lambda time, end: None,
) -> Made:
    """Simulate a recorded run again with changes, and record it.

    On the machine that made the recording, the messages before the branch are identical bit for
    bit. A measured run is simulated there, too.

    Args:
        path: path of the recording.
        namespace: namespace of the gearbox.
        branch: the changes.
        folder: folder of the new recording.
        progress: called with the simulated time and the end [s].

    Raises:
        RecordingError: nothing can be simulated again.
        ValueError: a setting, the start, the duration or the run is out of range.
        FileExistsError: `folder` exists.
        OSError: `folder` cannot be written.
    """
    remarks: list[str] = []
    recorded = _chosen(read_runs(path, namespace, remarks), branch.run, remarks)
    recorded = replace(recorded, intervals=Intervals(without_gaps(recorded, remarks)))
    begins, run = branched(recorded, branch)
    if isinstance(recorded.origin.makers, Measured):
        remarks.append("was measured: the part before the branch is simulated, too")
    _, state = next(messages_of(path, namespace, (STATE,), []))
    end = run.intervals[-1].end / TICKS
    with new_bag(folder, run.origin.scene) as bag:
        changes = {
            "recording": path.name,
            "run": branch.run,
            "from": begins,
            "set": {name: str(value) for name, value in branch.settings.items()},
            "commands": [] if branch.commands is None else branch.commands.names,
        }
        attach_yaml(bag, BRANCH_ATTACHMENT, changes)
        topics = _topics(path, namespace, run)
        composer = Composer(bag, topics, namespace, state.header.frame_id)
        for time in write_run(composer, run):
            progress(time, end)
    return Made(bag.file, begins, end, run.origin.scene, remarks)


def write_run(composer: Composer, run: RecordedRun) -> Iterator[float]:
    """Simulate `run` and write its messages.

    Args:
        composer: writes the messages.
        run: origin, intervals and changes.

    Yields:
        Simulated time after each interval [s].
    """
    composer.begin(run.origin)
    stamp = run.origin.begins
    values, ages = run.origin.scene.live_values, Replacements(run)
    for interval, changes, severities, window in steps(run):
        for change, in_force in zip(changes, severities, strict=True):
            values = {**values, **change.values, **in_force}
            worsened = [name for name in in_force if name in change.values]
            composer.point(values, change.time, change.stamp, worsened)
        composer.replace_parts(ages.due(window.start))
        composer.window(window, Stamps(interval.begin, interval.end, stamp, interval.stamp))
        stamp = interval.stamp
        yield window.end


def _topics(path: Path, namespace: str, run: RecordedRun) -> list[Topic]:
    """Topics of a recording, and those that a changed scene or commands have beside them.

    The operating point is written as this version does: earlier ones did not record ports.
    """
    recorded = Playback(path).topics
    scene = run.origin.scene
    beside = scene.moving_axes, bool(run.given), kinds_of(scene), scene.durability is not None
    topics_here = {topic.name: topic for topic in topics_of(namespace, *beside)}
    kinds = kinds_beside(*beside)
    added = {name: topics_here[name] for name in (f"{namespace}/{kind}" for kind in kinds)}
    point = f"{namespace}/{POINT}"
    return list((added | recorded | {point: topics_here[point]}).values())


def _chosen(runs: list[RecordedRun], number: int | None, remarks: list[str]) -> RecordedRun:
    if number is None:
        if len(runs) > 1:
            remarks.append(f"has {len(runs)} runs, the last is simulated; use --run to select")
        return runs[-1]
    if not 1 <= number <= len(runs):
        raise ValueError(f"run = {number}: must be within 1 and {len(runs)}")
    return runs[number - 1]
