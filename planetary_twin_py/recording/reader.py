"""Reads a recording into plain arrays; needs no ROS."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np
from mcap.records import Attachment, Channel, Message, Schema
from numpy.typing import NDArray
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from .records import RecordingError, files_of, records_of

SCENE_ATTACHMENT = "scene.yaml"
STATE, WAVEFORM, OPERATING_POINT = "gearbox_state", "mesh_waveform", "operating_point"


@dataclass
class Series:
    """Messages of one topic as columns: `series[name]` has one row per message.

    `time` is simulated time [s], `stamp` the ROS time [ns since the epoch] of the same instant.
    """

    time: NDArray[np.float64]
    stamp: NDArray[np.int64]
    columns: dict[str, Any]

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    def __len__(self) -> int:
        return len(self.time)


@dataclass
class Waveform:
    """Every sample of every mesh: `time` [s] and `stamp` [ns] (n,), the rest (n, meshes).

    `block` holds the index of the first sample of each recorded block.
    """

    time: NDArray[np.float64]
    stamp: NDArray[np.int64]
    block: NDArray[np.int64]
    dte: NDArray[np.float32]
    mesh_force: NDArray[np.float32]
    friction: NDArray[np.float32]


@dataclass
class Recording:
    """What a recording holds of one gearbox; `remarks` says in lines what could not be read."""

    path: Path
    namespace: str
    planets: int
    state: Series
    operating_point: Series
    waveform: Waveform | None
    scene_yaml: str | None
    remarks: list[str] = field(default_factory=list)

    @property
    def meshes(self) -> tuple[str, ...]:
        """Names of the meshes, in the order of the waveform's columns."""
        return tuple(
            f"{kind}_{i + 1}" for kind in ("sun_planet", "planet_ring") for i in range(self.planets)
        )

    def per_mesh(self, name: str) -> NDArray[np.float64]:
        """A per-mesh quantity of GearboxState, e.g. "dte_mean", shape (messages, meshes)."""
        pair = [
            self.state[f"{kind}_{name}"][:, : self.planets]
            for kind in ("sun_planet", "planet_ring")
        ]
        return np.concatenate(pair, axis=1)


def read_recording(path: str | Path, namespace: str | None = None) -> Recording:
    """Read the recording at `path`: an .mcap file or a folder of them.

    `namespace` chooses among several gearboxes in one file; without it the file must hold one.
    Raises `RecordingError` where there is nothing to read.
    """
    remarks: list[str] = []
    by_topic: dict[str, list[Any]] = {}
    scene_yaml = None
    for file in files_of(Path(path)):
        for topic, message in _messages(file, remarks):
            if topic == SCENE_ATTACHMENT:
                scene_yaml = scene_yaml or message.decode()
            else:
                by_topic.setdefault(topic, []).append(message)
    namespace = _namespace(by_topic, namespace, path)
    topics = {
        name: by_topic.get(f"{namespace}/{name}", []) for name in (STATE, WAVEFORM, OPERATING_POINT)
    }
    state = _series(topics[STATE])
    planets = int(state["planets"][0])
    return Recording(
        path=Path(path),
        namespace=namespace,
        planets=planets,
        state=state,
        operating_point=_series(topics[OPERATING_POINT]),
        waveform=_waveform(topics[WAVEFORM], 2 * planets),
        scene_yaml=scene_yaml,
        remarks=remarks,
    )


def _messages(file: Path, remarks: list[str]) -> Iterator[tuple[str, Any]]:
    """Pairs of topic and decoded message, and the scene attachment as ("scene.yaml", bytes)."""
    types = get_typestore(Stores.EMPTY)
    schemas: dict[int, Schema] = {}
    channels: dict[int, Channel] = {}
    for record in records_of(file, remarks):
        if isinstance(record, Schema):
            schemas[record.id] = record
        elif isinstance(record, Channel):
            if record.topic.rsplit("/", 1)[-1] in (STATE, WAVEFORM, OPERATING_POINT):
                channels[record.id] = record
                _register(types, schemas[record.schema_id], record)
        elif isinstance(record, Attachment) and record.name == SCENE_ATTACHMENT:
            yield SCENE_ATTACHMENT, record.data
        elif isinstance(record, Message) and record.channel_id in channels:
            channel = channels[record.channel_id]
            yield channel.topic, types.deserialize_cdr(record.data, schemas[channel.schema_id].name)


def _register(types: Typestore, schema: Schema, channel: Channel) -> None:
    """Teach `types` the message definition that the file itself carries."""
    if schema.encoding != "ros2msg" or channel.message_encoding != "cdr":
        raise RecordingError(
            f"{channel.topic}: encoded as {schema.encoding}/{channel.message_encoding}, "
            "only ros2msg/cdr can be read"
        )
    found = get_types_from_msg(schema.data.decode(), schema.name)
    types.register({name: parts for name, parts in found.items() if name not in types.types})


def _namespace(by_topic: dict[str, list[Any]], wanted: str | None, path: str | Path) -> str:
    found = sorted(topic[: -len(STATE) - 1] for topic in by_topic if topic.endswith("/" + STATE))
    if not found:
        raise RecordingError(f"{path}: no {STATE} message in it, so there is nothing to show")
    if wanted is None:
        if len(found) > 1:
            raise RecordingError(
                f"{path}: holds several gearboxes, choose --namespace from {', '.join(found)}"
            )
        return found[0]
    wanted = "/" + wanted.strip("/") if wanted.strip("/") else ""
    if wanted not in found:
        raise RecordingError(f"namespace = {wanted}: {path} holds {', '.join(found)}")
    return wanted


def _nanoseconds(messages: list[Any]) -> NDArray[np.int64]:
    stamps = [message.header.stamp for message in messages]
    return np.array([stamp.sec * 1_000_000_000 + stamp.nanosec for stamp in stamps], dtype=np.int64)


def _series(messages: list[Any]) -> Series:
    if not messages:
        return Series(np.empty(0), np.empty(0, np.int64), {})
    names = [column.name for column in fields(messages[0]) if column.name != "header"]
    rows = {name: np.array([getattr(row, name) for row in messages]) for name in names}
    return Series(rows["simulated_time"], _nanoseconds(messages), rows)


def _waveform(messages: list[Any], meshes: int) -> Waveform | None:
    if not messages:
        return None
    counts = np.array([message.samples for message in messages])
    block = np.concatenate(([0], np.cumsum(counts)))
    offsets = [np.arange(message.samples) * message.sample_period for message in messages]
    start = np.repeat([message.start_time for message in messages], counts)
    columns = {
        name: np.concatenate([getattr(message, name).reshape(meshes, -1).T for message in messages])
        for name in ("dte", "mesh_force", "friction")
    }
    offset = np.concatenate(offsets)
    stamp = np.repeat(_nanoseconds(messages), counts) + np.rint(offset * 1e9).astype(np.int64)
    return Waveform(start + offset, stamp, block[:-1], **columns)
