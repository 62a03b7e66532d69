"""`planetary-twin info`: the contents of a recording."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import FileArgument, JsonOption
from ..terminal.console import busy, print_list
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import fail, need, one_line_errors, remark
from ..terminal.names import shown
from ..text.escaping import one_line

if TYPE_CHECKING:
    from rich.table import Table

    from ..recording.runs.contents import Info
    from ..terminal.tables import TableConsole

_LONGEST = 300  # characters of a sensor


def info(
    file: FileArgument,
    events: Annotated[
        bool, typer.Option(help="Also list events; this reads every message and takes longer.")
    ] = False,
    json_: JsonOption = None,
) -> None:
    """Show the contents of FILE: topics, rates, lost messages, longest gaps, parameter changes.

    Sensors with samples are listed with the names for `spectrum --sensor`, channels, units, rates,
    and missing blocks by their numbers; --events looks at every block.

    The exit code is 1 if nothing can be read of a file to which no recorder can be writing.

    Example: planetary-twin info recordings/paper_20260101_120000
    """

    need("recording", "mcap", "rosbags")
    from ..recording.runs.events import events_of_all
    from ..recording.runs.info import read_info
    from ..recording.runs.sampled_files import read_sampled
    from ..recording.runs.sampled_info import whole_look

    with one_line_errors(), busy("reading the recording"):
        found = read_info(file)
        happened = events_of_all(file, found.topics) if events else None
        if events:
            every = read_sampled(file, [])
            found.sampled = {name: whole_look(sensor) for name, sensor in every.items()}
    for line in found.remarks:
        remark(line)
    console = console_beside(json_)
    _print(console, found)
    for namespace, event in happened or []:
        text = f"{shown(namespace)} run {event.run:<3} {event.time:10.4f} s  {event.text}"
        console.print(text, soft_wrap=True)
    if json_ is not None:
        figures = found.figures()
        if happened is not None:
            figures["changes"] = [change._asdict() for change in found.changes]
            figures["events"] = [{"namespace": n, **event._asdict()} for n, event in happened]
        write_json(figures, json_)
    if found.is_empty:
        fail(f"{file}: has no message that can be read", code=1)


def _print(console: TableConsole, found: Info) -> None:
    from ..recording.runs.ramps import ramps

    console.print(_topics(found))
    console.print()
    for label, text in _lines(found):
        console.one_line(f"{label:14}{text}")
    for number, ramp in enumerate(ramps(found.changes)):
        title = "" if number else "changes"
        print_list(console, f"{title:13} {ramp.times[0]:10.4f} s  ", ramp.in_words())


def _topics(found: Info) -> Table:
    """A row per topic, red if messages are lost."""
    from ..terminal.tables import table

    headings = ("topic", "recorded", "lost", "before", "rate [Hz]", "gap [s]", "type")
    made = table(headings, texts=("topic", "type"), framed=False)
    for name, topic in sorted(found.topics.items()):
        lost = "unknown" if topic.lost is None else str(topic.lost - topic.before)
        rate, gap = f"{topic.rate:.2f}", f"{topic.longest_gap * 1e-9:.3f}"
        if topic.recorded < 2:
            rate = gap = "-"
        counts = str(topic.recorded), lost, str(topic.before)
        missing = topic.lost is not None and topic.lost > topic.before
        row = shown(name), *counts, rate, gap, shown(topic.type.rpartition("/")[2])
        made.add_row(*row, style="red" if missing else None)
    return made


def _lines(found: Info) -> Iterator[tuple[str, str]]:
    """What is known of the whole recording, with labels."""
    if any(topic.lost is None for topic in found.topics.values()):
        yield (
            "lost",
            "unknown: the file has no count of lost messages, which the logger writes at its end, "
            "or a file is missing",
        )
    for name, sensor in _sensors(found):
        yield "sensor", one_line(f"{name}: {sensor}", _LONGEST)
    for topic, damage in found.damage.items():
        yield "damage", one_line(f"{topic}: {damage.text()}", _LONGEST)
    for topic, temperatures in found.temperatures.items():
        yield "temperatures", one_line(f"{topic}: {temperatures.text()}", _LONGEST)
    for path in found.files:
        yield "file", f"{path}, {path.stat().st_size / 1e6:.1f} MB"
    yield "gearbox time", f"{found.simulated:.3f} s"
    if found.skips:
        skips = f"in {found.skips} skips of stamps"
        yield "skipped", f"{found.skipped:.3f} s of ROS time, {skips}"


def _sensors(found: Info) -> Iterator[tuple[str, str]]:
    """Names that select sensors, and what they measure."""
    from ..recording.runs.sampled_files import short_names

    names = short_names(found.sampled)
    yield from ((names[topic], sensor.text()) for topic, sensor in found.sampled.items())
