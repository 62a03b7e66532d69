"""Makes a whole recording of what can still be read of a torn or damaged one."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from mcap.records import Attachment, Channel, Message, Metadata

from ..container.records import files_of
from .bag import BagWriter
from .repeats import Repeats, unrepeated
from .tape import Tape

_OF_THE_FILE = "rosbag2"  # metadata that the new file has its own of


class Recovered(NamedTuple):
    """What was saved: messages by topic, and in lines what could not be."""

    file: Path
    messages: dict[str, int]
    remarks: list[str]


def recover(path: Path, folder: Path) -> Recovered:
    """Write what is sound at `path` into a new `folder`.

    Args:
        path: of an MCAP file, or of a folder of them.
        folder: of the recording to make.

    Returns:
        What was saved, and what is missing.

    Raises:
        RecordingError: there is nothing to save.
        FileExistsError: `folder` exists.
        OSError: it cannot be written.
    """
    tape = Tape(path)
    bag = BagWriter(folder)
    channels = {name: bag.add_topic(topic) for name, topic in tape.topics.items()}
    messages = dict.fromkeys(channels, 0)
    remarks: list[str] = []
    repeats = Repeats()
    for file in files_of(path):
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
    return Recovered(bag.file, messages, remarks)
