"""Exports a recording as tables, in batches."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import NamedTuple

from ..container.records import RecordingError
from ..ros2.namespaces import choose_namespace
from ..ros2.playback import Playback
from ..ros2.sensor_topics import SAMPLED
from ..ros2.topics import STATE
from ..runs.sampled_files import read_sampled
from ..runs.waveform import stamps
from .message_rows import rows_of
from .message_tables import OF_SENSORS, TABLES, Table
from .sampled_tables import batches, columns, time_axis
from .table_files import FORMATS, NewTable

Progress = Callable[[int, int], None]


class Export(NamedTuple):
    """Options of an export.

    `out` is a folder, for a file per topic; or a file with the suffix of a format, for one topic.
    """

    out: Path
    format: str | None = None
    """One of `FORMATS`; None uses the suffix of `out`, or Parquet."""
    topics: Sequence[str] = ()
    """Some of `TABLES`, or of sensors, such as `sensors/ring_top`; if empty, all recorded ones."""
    namespace: str | None = None


class Exported(NamedTuple):
    """Files with their numbers of rows; `remarks` are warnings about parts that are left out."""

    rows: dict[Path, int]
    remarks: list[str]


def export(path: Path, chosen: Export, progress: Progress = lambda done, length: None) -> Exported:
    """Write the tables of a recording.

    Args:
        path: path of the recording.
        chosen: options.
        progress: called with the completed and the total ROS time [ns].

    Raises:
        RecordingError: there is nothing to read.
        ValueError: format or topics are unknown.
        FileExistsError: a file exists.
        OSError: a file cannot be written.
    """
    kind, single = _format(chosen)
    playback = Playback(path)
    namespace = _namespace(playback, chosen.namespace, path)
    names = _topics(playback, namespace, chosen.topics)
    if single and len(names) > 1:
        raise ValueError(
            f"out = {chosen.out}: a file takes one topic, not {','.join(names)}; use --topics, or "
            "give a folder"
        )
    files = {name: chosen.out if single else chosen.out / f"{name}.{kind}" for name in names}
    for file in files.values():
        if file.exists():
            raise FileExistsError(f"{file}: already exists; choose another name")
        file.parent.mkdir(parents=True, exist_ok=True)
    types = {name: playback.topics[f"{namespace}/{name}"] for name in names}
    sampled = [name for name in names if types[name].type == SAMPLED]
    tables = {
        name: Table(name, types[name].type, types[name].definition)
        for name in names
        if name not in sampled
    }
    writers = {name: NewTable(files[name], kind, one.describe) for name, one in tables.items()}
    remarks: list[str] = []
    first: int | None = None
    try:
        for name, parts in rows_of(path, namespace, [*writers], remarks):
            writers[name].write(tables[name].batch(parts))
            begin, *_, end = *stamps(parts[0][:1]), *stamps(parts[-1][-1:])
            first = int(begin) if first is None else first
            progress(int(end) - first, playback.length)
    finally:  # incomplete tables are valid, too
        for writer in writers.values():
            writer.close()
    remarks += [f"{name}: {one.remark}" for name, one in tables.items() if one.remark]
    rows = {writer.path: writer.rows for writer in writers.values() if writer.rows}
    if sampled:
        wanted = {f"{namespace}/{name}": files[name] for name in sampled}
        rows |= _write_sampled(path, namespace, wanted, kind, remarks)
    return Exported(rows, remarks)


def _write_sampled(
    path: Path, namespace: str, files: Mapping[str, Path], kind: str, remarks: list[str]
) -> dict[Path, int]:
    """Write the samples of sensors to files by topic; returns their numbers of rows."""
    unread: list[str] = []  # as the other tables have remarked, unless there are none
    sensors = read_sampled(path, unread)
    remarks += [line for line in unread if line not in remarks]
    rows: dict[Path, int] = {}
    if not sensors:
        return rows
    to_time = time_axis(path, namespace, [*sensors.values()])
    for topic, file in files.items():
        if (sensor := sensors.get(topic)) is None:
            continue
        remarks += sensor.order.remarks(to_time)
        with closing(NewTable(file, kind, partial(columns, sensor))) as table:
            for batch in batches(sensor, to_time):
                table.write(batch)
        rows[file] = table.rows
    return rows


def _format(chosen: Export) -> tuple[str, bool]:
    """The format, and whether the output is a single file."""
    ending = chosen.out.suffix.removeprefix(".")
    if not chosen.format and ending and ending not in FORMATS:
        raise ValueError(
            f"out = {str(chosen.out)!r}: must end in {', '.join(f'.{kind}' for kind in FORMATS)}, "
            "or give a format for a folder of this name"
        )
    kind = chosen.format or ending or "parquet"
    if kind not in FORMATS:
        raise ValueError(f"format = {kind!r}: must be one of {', '.join(FORMATS)}")
    return kind, ending == kind


def _namespace(playback: Playback, wanted: str | None, path: Path) -> str:
    """The namespace of the twin; "" without one, if there are samples of a sensor."""
    counts = playback.counts
    has_twin = any(count and name.endswith(f"/{STATE}") for name, count in counts.items())
    if not has_twin and any(topic.type == SAMPLED for topic in playback.topics.values()):
        return ""
    return choose_namespace(counts, wanted, path)


def _topics(playback: Playback, namespace: str, wanted: Sequence[str]) -> list[str]:
    """Topics to write: those `wanted`, or all."""
    recorded = [name for name in TABLES if f"{namespace}/{name}" in playback.topics]
    recorded += [
        name.removeprefix(f"{namespace}/")
        for name, topic in playback.topics.items()
        if topic.type in (SAMPLED, *OF_SENSORS) and name.startswith(f"{namespace}/")
    ]
    for name in wanted:
        if name not in recorded:
            raise RecordingError(f"topics = {name}: must be one of {', '.join(recorded)}")
    return list(dict.fromkeys(wanted)) or recorded
