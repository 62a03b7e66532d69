"""Cost of opening a recording over its length: time, processor time, memory.

    .venv/bin/python benchmarks/open_recording.py recordings/NAME --seconds 10 60 600

A longer recording is made from the given one, which is repeated with increasing times and numbers.
It takes about 4 MB of disk for each second, or with --states 0.1 MB, for hours: only the states are
repeated.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from mcap.records import Attachment, Channel, Message
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from planetary_twin_py.recording.container.records import files_of, records_of
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.layout import Layouts
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.ros2.topics import JOINTS, POINT, STATE, WAVEFORM

REPEATED = (STATE, WAVEFORM, JOINTS, POINT, "/tf", "/diagnostics")
TIMES = ("simulated_time", "start_time")  # fields that go on with the run [s]
COMMANDS = {
    "view": ("view", "--save", ".rrd"),
    "info": ("info", "--json", ".json"),
    "export": ("export", "--topics=gearbox_state", "--out", ".parquet"),
    "picture": ("view", "--screenshot", ".png"),
}


class Cost(NamedTuple):
    """Of a command: seconds, processor seconds, largest memory [MB]."""

    wall: float
    processor: float
    memory: float


def lengthen(path: Path, folder: Path, seconds: float, topics: tuple[str, ...]) -> Path:
    """Repeat `topics` of the recording at `path` for `seconds`; returns the new file."""
    playback, bag = Playback(path), BagWriter(folder)
    channels = {name: bag.add_topic(topic) for name, topic in playback.topics.items()}
    layouts = _layouts(playback)
    messages = _messages(path, bag)
    counts = Counter(topic for topic, _ in messages)
    first = messages[0][1].log_time
    turn_length = round(playback.length, -7)  # [ns] to whole intervals
    for turn in range(int(np.ceil(seconds * 1e9 / turn_length))):
        for topic, message in messages:
            at = message.log_time + turn * turn_length
            if at - first > seconds * 1e9:
                break
            if turn and not topic.endswith(topics):
                continue
            (rows,) = layouts[topic].arrays([message.data])
            data = bytearray(message.data)
            _advance(np.frombuffer(data, rows.dtype)[0], turn * turn_length, turn * counts[topic])
            bag.write(channels[topic], bytes(data), at, at, message.sequence + turn * counts[topic])
    bag.close()
    return bag.file


def cost(*command: str) -> Cost:
    """Cost of `planetary-twin` with these arguments."""
    program = str(Path(sys.executable).with_name("planetary-twin"))
    begin = time.perf_counter()
    with tempfile.TemporaryFile() as output:
        child = subprocess.Popen([program, *command], stdout=output, stderr=output)
        _, code, usage = os.wait4(child.pid, 0)
    if code:
        sys.exit(f"planetary-twin {' '.join(command)} has failed")
    processor = usage.ru_utime + usage.ru_stime
    return Cost(time.perf_counter() - begin, processor, usage.ru_maxrss / 1024)


def _layouts(playback: Playback) -> dict[str, Layouts]:
    types = get_typestore(Stores.EMPTY)
    for topic in playback.topics.values():
        found = get_types_from_msg(topic.definition, topic.type)
        types.register({k: v for k, v in found.items() if k not in types.types})
    return {name: Layouts(types.fielddefs, topic.type) for name, topic in playback.topics.items()}


def _messages(path: Path, bag: BagWriter) -> list[tuple[str, Message]]:
    """Topics and messages at `path`; what is attached to it goes to `bag`."""
    found = []
    for file in files_of(path):
        names: dict[int, str] = {}
        for record in records_of(file, []):
            if isinstance(record, Channel):
                names[record.id] = record.topic
            elif isinstance(record, Attachment):
                bag.attach(record.name, record.data, record.media_type)
            elif isinstance(record, Message):
                found.append((names[record.channel_id], record))
    return found


def _advance(row: Any, shift: int, number: int) -> None:
    """Move a message by `shift` [ns] and by `number` messages."""
    names = row.dtype.names
    for name in set(names).intersection(TIMES):
        row[name] += shift * 1e-9
    if "sequence" in names:
        row["sequence"] += number
    if "header" in names:
        stamp = row["header"]["stamp"]
        later = int(stamp["sec"]) * 10**9 + int(stamp["nanosec"]) + shift
        stamp["sec"], stamp["nanosec"] = divmod(later, 10**9)


def main() -> None:
    """Print one table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("recording", type=Path)
    parser.add_argument("--seconds", type=float, nargs="+", default=[10.0, 60.0, 600.0])
    parser.add_argument("--states", action="store_true", help="repeat only the states")
    parser.add_argument("--commands", nargs="+", choices=COMMANDS, default=list(COMMANDS))
    parser.add_argument("--keep", type=Path, help="folder in which the recordings are left")
    chosen = parser.parse_args()
    print("| recorded | file | command | time | processor time | memory | writes |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for seconds in chosen.seconds:
            folder = (chosen.keep or Path(scratch)) / f"{seconds:g}_s"
            if not folder.exists():
                topics = (f"/{STATE}",) if chosen.states else REPEATED
                lengthen(chosen.recording, folder, seconds, topics)
            (file,) = files_of(folder)
            for name in chosen.commands:
                command, *options, suffix = COMMANDS[name]
                written = Path(scratch) / f"{name}_{seconds:g}{suffix}"
                spent = cost(command, str(file), *options, str(written))
                print(
                    f"| {seconds:g} s | {file.stat().st_size / 1e6:.0f} MB | {name} "
                    f"| {spent.wall:.1f} s | {spent.processor:.1f} s | {spent.memory:.0f} MB "
                    f"| {written.stat().st_size / 1e6:.1f} MB |",
                    flush=True,
                )


if __name__ == "__main__":
    main()
