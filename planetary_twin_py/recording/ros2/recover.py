"""Copies the readable parts of a truncated or damaged recording to a valid one."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from mcap.records import Attachment, Channel, Message, Metadata

from ..container.records import files_of
from .bag import BagWriter
from .no_run import no_run_yet
from .playback import Playback
from .repeats import Repeats, unrepeated

_OF_THE_FILE = "rosbag2"  # metadata that is generated for the new file


class Recovered(NamedTuple):
    """Messages saved by topic, and warnings about missing parts."""

    file: Path
    messages: dict[str, int]
    remarks: list[str]


def recover(path: Path, folder: Path) -> Recovered:
    """Copy the intact parts of a recording.

    Returns:
        Saved messages and warnings.

    Raises:
        RecordingError: nothing can be read.
        FileExistsError: `folder` exists.
        OSError: `folder` cannot be written.
    """
    playback = Playback(path)
    bag = BagWriter(folder)
    channels = {name: bag.add_topic(topic) for name, topic in playback.topics.items()}
    messages = dict.fromkeys(channels, 0)
    remarks: list[str] = []
    repeats = Repeats()
    for file in files_of(path, remarks):
        names: dict[int, str] = {}
        for record in unrepeated(file, remarks, repeats):
            if isinstance(record, Channel):
                names[record.id] = record.topic
            elif isinstance(record, Attachment):
                bag.attach(record.name, record.data, record.media_type)
            elif isinstance(record, Metadata) and record.name != _OF_THE_FILE:
                bag.note(record.name, record.metadata)
            elif isinstance(record, Message):
                name = names[record.channel_id]
                times = record.log_time, record.publish_time
                bag.write(channels[name], record.data, *times, record.sequence)
                messages[name] += 1
    bag.close()
    no_run = no_run_yet(path, messages)  # by what was read: an index counts what is lost, too
    return Recovered(bag.file, messages, [*filter(None, [no_run]), *remarks])
