"""Reads a recording into plain arrays; needs no ROS."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np
from mcap.records import Attachment
from numpy.typing import NDArray

from .decode import Decoder
from .namespaces import choose_namespace
from .records import files_of, records_of
from .repeats import Seen, unrepeated
from .topics import POINT, STATE, WAVEFORM

SCENE_ATTACHMENT = "scene.yaml"


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
    seen: Seen = set()
    for file in files_of(Path(path)):
        for topic, message in _messages(file, remarks, seen):
            if topic == SCENE_ATTACHMENT:
                scene_yaml = scene_yaml or message.decode()
            else:
                by_topic.setdefault(topic, []).append(message)
    namespace = choose_namespace(by_topic, namespace, path)
    topics = {name: by_topic.get(f"{namespace}/{name}", []) for name in (STATE, WAVEFORM, POINT)}
    state = _series(topics[STATE])
    planets = int(state["planets"][0])
    return Recording(
        path=Path(path),
        namespace=namespace,
        planets=planets,
        state=state,
        operating_point=_series(topics[POINT]),
        waveform=_waveform(topics[WAVEFORM], 2 * planets),
        scene_yaml=scene_yaml,
        remarks=remarks,
    )


def _messages(file: Path, remarks: list[str], seen: Seen) -> Iterator[tuple[str, Any]]:
    """Pairs of topic and decoded message, and the scene attachment as ("scene.yaml", bytes)."""
    decoder = Decoder(lambda topic: topic.rsplit("/", 1)[-1] in (STATE, WAVEFORM, POINT))
    for record in unrepeated(records_of(file, remarks), seen):
        if isinstance(record, Attachment) and record.name == SCENE_ATTACHMENT:
            yield SCENE_ATTACHMENT, record.data
        elif found := decoder.read(record):
            yield found


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
