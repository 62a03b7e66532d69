"""What would have been: a recorded run simulated again with other values from an instant on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import yaml

from ...scene import Scene
from ...twin import TICKS
from ..ros2.bag import BagWriter
from ..ros2.tape import Tape
from ..ros2.topics import STATE
from .branch import Branch, branched
from .compose import Composer
from .origin import Measured
from .reader import SCENE_ATTACHMENT
from .schedule import Run, messages_of, read_runs, without_gaps
from .written import write_run

BRANCH_ATTACHMENT = "branch.yaml"


@dataclass
class Made:
    """What was written; `remarks` says in lines what of the recording could not be used."""

    file: Path
    begins: float
    """Simulated instant from which the settings hold: where an interval began [s]."""
    end: float
    """Of the run [s]."""
    scene: Scene
    """Of the new run at its start, where the settings hold from 0."""
    remarks: list[str] = field(default_factory=list)


def resimulate(
    path: Path,
    namespace: str,
    branch: Branch,
    folder: Path,
    progress: Callable[[float, float], None] = lambda time, end: None,
) -> Made:
    """Simulate a run of the gearbox in `namespace` again, and write it into a new `folder`.

    Up to the branch the messages are as recorded, on the machine that recorded them to the last
    bit; a run that was measured is simulated there, too. `progress` hears the simulated time
    reached, and that of the end [s].

    Raises:
        RecordingError: nothing in the recording can be simulated again.
        ValueError: a setting, the start, the duration or the run cannot be.
        FileExistsError: `folder` exists.
        OSError: it cannot be written.
    """
    remarks: list[str] = []
    recorded = _chosen(read_runs(path, namespace, remarks), branch.run, remarks)
    recorded = replace(recorded, intervals=without_gaps(recorded, remarks))
    begins, run = branched(recorded, branch)
    if isinstance(recorded.origin.makers, Measured):
        remarks.append("was measured: what comes before the branch is simulated, too")
    _, state = next(messages_of(path, namespace, (STATE,), []))
    bag = BagWriter(folder)
    end = run.intervals[-1].end / TICKS
    try:
        _attach(bag, path, run.origin.scene, branch, begins)
        composer = Composer(bag, Tape(path).topics.values(), namespace, state.header.frame_id)
        for time in write_run(composer, run):
            progress(time, end)
    finally:  # what is there is true, however far it goes
        bag.close()
    return Made(bag.file, begins, end, run.origin.scene, remarks)


def _chosen(runs: list[Run], number: int | None, remarks: list[str]) -> Run:
    if number is None:
        if len(runs) > 1:
            remarks.append(f"holds {len(runs)} runs, and the last is simulated: --run chooses")
        return runs[-1]
    if not 1 <= number <= len(runs):
        raise ValueError(f"run = {number}: must be within 1 and {len(runs)}")
    return runs[number - 1]


def _attach(bag: BagWriter, path: Path, scene: Scene, branch: Branch, begins: float) -> None:
    """Say beside the messages what the gearbox is, and that this is no recording of a live one."""
    told = {
        "recording": path.name,
        "run": branch.run,
        "from": begins,
        "set": {name: str(value) for name, value in branch.settings.items()},
    }
    for name, content in (
        (SCENE_ATTACHMENT, scene.model_dump(mode="json")),
        (BRANCH_ATTACHMENT, told),
    ):
        text = yaml.safe_dump(content, sort_keys=False)
        bag.attach(name, text.encode(), "application/yaml")
