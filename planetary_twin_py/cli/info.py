"""`planetary-twin info`: the contents of a recording."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import FileArgument, JsonOption
from ..terminal.console import busy, print_list
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, remark
from ..terminal.names import shown

if TYPE_CHECKING:
    from rich.console import Console

    from ..recording.runs.events import Event
    from ..recording.runs.info import Info
    from ..recording.runs.ramps import Ramp


def info(
    file: FileArgument,
    events: Annotated[
        bool, typer.Option(help="Also list events; this reads every message and takes longer.")
    ] = False,
    json_: JsonOption = None,
) -> None:
    """Show the contents of FILE: topics, rates, lost messages, longest gaps, parameter changes.

    The exit code is 1 if nothing can be read of a file to which no recorder can be writing.

    Example: planetary-twin info recordings/paper_20260101_120000
    """

    need("recording", "mcap", "rosbags")
    from ..recording.container.records import RecordingError
    from ..recording.runs.info import read_info

    try:
        with busy("reading the recording"):
            found = read_info(file)
            happened = _events(file, found) if events else None
    except (RecordingError, OSError) as error:
        fail(error)
    for line in found.remarks:
        remark(line)
    console = console_beside(json_)
    _print(console, found)
    for namespace, event in happened or []:
        text = f"{shown(namespace)} run {event.run:<3} {event.time:10.4f} s  {event.text}"
        console.print(text, highlight=False, soft_wrap=True)
    if json_ is not None:
        figures = found.figures()
        if happened is not None:
            figures["changes"] = [change._asdict() for change in found.changes]
            figures["events"] = [{"namespace": n, **event._asdict()} for n, event in happened]
        write_json(figures, json_)
    if found.is_empty:
        fail(f"{file}: has no message that can be read", code=1)


def _events(file: Path, found: Info) -> list[tuple[str, Event]]:
    """Events of each gearbox, with its namespace."""
    from ..recording.ros2.topics import STATE
    from ..recording.runs.events import read_events

    names = [
        topic.removesuffix(f"/{STATE}") for topic in found.topics if topic.endswith(f"/{STATE}")
    ]
    return [(name, event) for name in sorted(names) for event in read_events(file, name, [])]


def _print(console: Console, found: Info) -> None:
    from rich.table import Table

    from ..recording.runs.ramps import ramps

    table = Table(box=None, pad_edge=False)
    table.add_column("topic")
    for title in ("recorded", "lost", "before", "rate [Hz]", r"gap \[s]"):
        table.add_column(title, justify="right")
    table.add_column("type")
    for name, topic in sorted(found.topics.items()):
        lost = "unknown" if topic.lost is None else str(topic.lost - topic.before)
        rate, gap = f"{topic.rate:.2f}", f"{topic.longest_gap * 1e-9:.3f}"
        if topic.recorded < 2:
            rate = gap = "-"
        counts = str(topic.recorded), lost, str(topic.before)
        missing = topic.lost is not None and topic.lost > topic.before
        row = shown(name), *counts, rate, gap, shown(topic.type.rpartition("/")[2])
        table.add_row(*row, style="red" if missing else None)
    console.print(table)
    console.print()
    if any(topic.lost is None for topic in found.topics.values()):
        console.print(
            "lost          unknown: the file has no count of lost messages, which the logger "
            "writes at its end, or a file is missing",
            highlight=False,
            soft_wrap=True,
        )
    for path in found.files:
        size = path.stat().st_size / 1e6
        console.print(f"file          {path}, {size:.1f} MB", highlight=False, soft_wrap=True)
    console.print(f"gearbox time  {found.simulated:.3f} s", highlight=False)
    if found.skips:
        console.print(
            f"skipped       {found.skipped:.3f} s of ROS time, in {found.skips} skips of stamps",
            highlight=False,
        )
    for number, ramp in enumerate(ramps(found.changes)):
        title = "" if number else "changes"
        print_list(console, f"{title:13} {ramp.times[0]:10.4f} s  ", _described(ramp))


def _described(ramp: Ramp) -> list[str]:
    """The changed parameters and their values."""
    steps = len(ramp.times)
    if not ramp.last:
        return ["no change"]
    if steps == 1:
        return [f"{name} = {_shown(name, value)}" for name, value in ramp.last.items()]
    *ways, last = (
        f"{k} from {ramp.first[k]:.6g} to {value:.6g} {_unit(k)}".rstrip()
        for k, value in ramp.last.items()
    )
    return [*ways, f"{last} in {steps} steps over {ramp.duration:.6g} s"]


def _shown(name: str, value: float | str) -> str:
    """A value with its unit."""
    return shown(value) if isinstance(value, str) else f"{value:.6g} {_unit(name)}".rstrip()


def _unit(name: str) -> str:
    from ..scene import TUNABLES

    return TUNABLES[name].unit
