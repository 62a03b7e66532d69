"""Reads what a recording contains, from the index of a finished file and a few messages."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

from ...text.escaping import one_line
from ..container.message_index import UNSOUND, Index
from ..container.records import files_of
from ..ros2.bag import ACCOUNT_RECORD
from ..ros2.decode import Described, Topics
from ..ros2.no_run import no_run_yet
from ..ros2.point import values_of_point
from ..ros2.repeats import Repeats
from ..ros2.sensor_topics import SAMPLED, THERMAL_STATE
from ..ros2.topics import DAMAGE, POINT, REAL_TIME, STATE, is_status
from .contents import Changed, Info, TopicInfo
from .covered import cover, missing_between
from .last_states import last_damage, last_temperatures
from .sampled_info import first_look

REPORT = "/diagnostics"
REPORTED = {"real_time_factor_mean", "overruns"}
_DECODED = tuple(f"/{topic}" for topic in (STATE, POINT, DAMAGE, THERMAL_STATE))
_LONGEST = 100  # characters of a topic in a remark


def read_info(*paths: Path) -> Info:
    """Read the contents of recordings; of a finished file only the index and a few messages.

    Args:
        paths: .mcap files or folders, in order.

    Raises:
        RecordingError: a path is not a recording.
    """
    remarks: list[str] = []
    files = [file for path in paths for file in files_of(path, remarks)]
    collected = _Collector(Info(files, remarks=remarks.copy()))
    for file in collected.info.files:
        attempt = deepcopy(collected)
        try:
            attempt.add(file, Index.of_summary(file))
        except UNSOUND:  # truncated without an index, or damaged
            collected.add(file, Index.of_records(file, collected.info.remarks))
        else:
            collected = attempt
    info = collected.info
    if remarks:  # the accounts of the missing files are missing, too
        for topic in info.topics.values():
            topic.lost, topic.before = None, 0
    collected.warn_of_missing()
    counts = {name: topic.recorded for name, topic in info.topics.items()}
    info.remarks += filter(None, (no_run_yet(path, counts) for path in paths[:1]))
    return info


class _Collector:
    """Collects the contents of files in order."""

    def __init__(self, info: Info) -> None:
        self.info = info
        self._points: dict[str, dict[str, Any]] = {}
        self._states: dict[str, Any] = {}
        self._missing: Counter[str] = Counter()
        self._blocks: dict[str, Any] = {}  # the last ones
        self._repeats = Repeats()

    def add(self, file: Path, index: Index) -> None:
        """Add the contents of a file from its index and the few messages that are needed."""
        topics = Topics(file, _is_decoded, (SAMPLED,))
        self._repeats.next_file()
        for schema in index.summary.schemas.values():
            topics.of(schema)
        changes = []
        for number, channel in index.summary.channels.items():
            topics.of(channel)
            kind = index.summary.schemas[channel.schema_id].name
            topic = self.info.topics.setdefault(channel.topic, TopicInfo(type=kind))
            new = self._new(index, number)
            if self._repeats.is_latched(number):
                topic.add([index.message(number, k).log_time for k in new])
            else:
                topic.join(index.times[number])
            if number not in topics.by_channel:
                continue
            messages = _Messages(index, number, topics.by_channel[number])
            if channel.topic.endswith(f"/{STATE}") and len(messages):
                self._count_missing(channel.topic, messages[0])
                covered = cover(messages)
                self.info.simulated += covered.time
                self._missing[channel.topic] += covered.missing
                self._states[channel.topic] = messages[len(messages) - 1]
            elif channel.topic.endswith(f"/{POINT}"):
                changes += [
                    (index.message(number, k).log_time, channel.topic, messages[k]) for k in new
                ]
            elif channel.topic.endswith(f"/{DAMAGE}") and len(messages):
                self.info.damage[channel.topic] = last_damage(messages[len(messages) - 1])
            elif channel.topic.endswith(f"/{THERMAL_STATE}") and len(messages):
                last = last_temperatures(messages[len(messages) - 1])
                self.info.temperatures[channel.topic] = last
            elif topics.by_channel[number].kind == SAMPLED and len(messages):
                self._look_at(channel.topic, messages)
            elif channel.topic == REPORT:
                self.info.report |= _newest_report(messages)
        for _, name, message in sorted(changes, key=lambda change: change[0]):
            self._add_change(name, message)
        self._add_losses(file, index)

    def _new(self, index: Index, channel: int) -> Sequence[int]:
        """Numbers of the messages of a channel that are not in the previous files."""
        count = range(index.times[channel].recorded)
        self._repeats.repeated(index.summary.channels[channel])
        if not self._repeats.is_latched(channel):
            return count
        return [k for k in count if not self._repeats.repeated(index.message(channel, k))]

    def _look_at(self, topic: str, blocks: Sequence[Any]) -> None:
        """Add the blocks of samples in a file."""
        sampled = self.info.sampled.setdefault(topic, first_look(blocks[0]))
        sampled.join(blocks, self._blocks.get(topic))
        self._blocks[topic] = blocks[len(blocks) - 1]

    def _count_missing(self, topic: str, state: Any) -> None:
        """Count the states that are missing between the last one and `state`."""
        if topic in self._states:
            self._missing[topic] += missing_between(self._states[topic], state)
        self._states[topic] = state

    def warn_of_missing(self) -> None:
        """Warn of missing states of which the recording contains no account."""
        for topic, missing in self._missing.items():
            lost = self.info.topics[topic].lost
            if missing > (lost or 0):
                name = one_line(topic, _LONGEST)
                account = (
                    "the recording contains no count of losses"
                    if lost is None
                    else f"the recorder has counted {lost} as lost, so a part of the recording is "
                    "missing"
                )
                self.info.remarks.append(
                    f"{missing} messages of {name} are missing between the first and the last, "
                    "according to their sequence numbers; other topics may lack messages, too: "
                    f"{account}"
                )

    def _add_losses(self, file: Path, index: Index) -> None:
        """Add the losses in the accounts of a file.

        Messages are lost, too, that were recorded by the account and cannot be read.
        """
        channels = index.summary.channels.items()
        read = {channel.topic: index.times[number].recorded for number, channel in channels}
        recorded, unreadable = Counter[str](), 0
        for record in index.summary.metadata:
            if record.name != ACCOUNT_RECORD:
                continue
            account = record.metadata
            try:
                lost, missed, written = (int(account[k]) for k in ("lost", "missed", "recorded"))
                name = account["topic"]
            except (KeyError, ValueError):
                unreadable += 1
                continue
            if topic := self.info.topics.get(name):  # an account may be of no messages
                topic.lost = (topic.lost or 0) + lost
                topic.before += lost - missed
                recorded[name] += written
        for name, count in recorded.items():
            topic = self.info.topics[name]
            topic.lost = (topic.lost or 0) + max(count - read.get(name, 0), 0)
        if unreadable:
            self.info.remarks.append(
                f"{file.name}: accounts of losses that cannot be read: {unreadable}"
            )

    def _add_change(self, topic: str, message: Any) -> None:
        """Add the values in a message of an operating point that differ from the last ones."""
        last = self._points.get(topic)
        self._points[topic] = values = values_of_point(message)
        new = {k: v for k, v in values.items() if last is None or v != last.get(k)}
        namespace = topic.removesuffix(f"/{POINT}")
        self.info.changes.append(Changed(message.simulated_time, namespace, new))


class _Messages(Sequence[Any]):
    """The messages of a channel, decoded on access."""

    def __init__(self, index: Index, channel: int, described: Described) -> None:
        self._index, self._channel, self._described = index, channel, described

    def __len__(self) -> int:
        return self._index.times[self._channel].recorded

    def __getitem__(self, number: Any) -> Any:
        return self._described.message(self._index.message(self._channel, number).data)


def _newest_report(reports: Sequence[Any]) -> dict[str, str]:
    """The newest value of each key of REPORTED, and of other keys that were read on the way."""
    found: dict[str, str] = {}
    for number in reversed(range(len(reports))):
        found = _report_values(reports[number]) | found
        if found.keys() >= REPORTED:
            break
    return found


def _report_values(report: Any) -> dict[str, str]:
    """Values of the real-time status of the simulation; empty for other reports."""
    statuses = [status for status in report.status if is_status(status.name, REAL_TIME)]
    return {item.key: item.value for status in statuses for item in status.values}


def _is_decoded(topic: str) -> bool:
    """Whether messages of a topic are decoded, not only counted."""
    return topic == REPORT or topic.endswith(_DECODED)
