"""What it takes to open a recording, against its length: time, processor time, memory, size.

    .venv/bin/python benchmarks/open_recording.py recordings/NAME --seconds 10 60 600

A longer recording is made of a short one, which is repeated with times and numbers that go on. It
needs 3.6 MB of disk a second.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from mcap.records import Channel, Message
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from planetary_twin_py.recording.bag import BagWriter
from planetary_twin_py.recording.layout import Layouts
from planetary_twin_py.recording.records import files_of, records_of
from planetary_twin_py.recording.tape import Tape

BATCH = 100  # messages that are advanced at once
TIMES = ("simulated_time", "start_time")  # fields that go on with the run [s]


class Cost(NamedTuple):
    """Of a command: seconds, processor seconds, largest memory [MB]."""

    wall: float
    processor: float
    memory: float


def lengthen(path: Path, folder: Path, seconds: float) -> Path:
    """Repeat the recording at `path` until it has lasted for `seconds`; returns the new file."""
    tape, bag = Tape(path), BagWriter(folder)
    channels = {name: bag.add_topic(topic) for name, topic in tape.topics.items()}
    kinds = {name: topic.type for name, topic in tape.topics.items()}
    types = get_typestore(Stores.ROS2_JAZZY)
    for name, topic in tape.topics.items():
        found = get_types_from_msg(topic.definition, kinds[name])
        types.register({k: v for k, v in found.items() if k not in types.types})
    layouts = {name: Layouts(types.fielddefs, kind) for name, kind in kinds.items()}
    messages = list(_messages(path))
    round_length = round(tape.length * 1e-9 + 0.01, 2)
    counts = {name: sum(topic == name for topic, _ in messages) for name in channels}
    for turn in range(int(np.ceil(seconds / round_length))):
        shift = turn * round_length
        for topic, message in messages:
            if turn and (tape.topics[topic].kept and "operating_point" not in topic):
                continue  # latched: told once
            if turn * round_length * 1e9 + message.log_time - messages[0][1].log_time > seconds * 1e9:
                break
            (row,) = layouts[topic].arrays([message.data])
            data = _advanced(row, shift, turn * counts[topic])
            at = message.log_time + round(shift * 1e9)
            bag.write(channels[topic], data, at, at, message.sequence + turn * counts[topic])
    _attach(path, bag)
    bag.close()
    return bag.file
