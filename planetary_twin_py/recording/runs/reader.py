"""Reads a recording into plain arrays; needs no ROS."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from mcap.records import Attachment
from numpy.typing import NDArray

from ...printable import one_line
from ..container.records import RecordingError, files_of, sections_of
from ..ros2.decode import Topics
from ..ros2.layout import Layouts
from ..ros2.namespaces import choose_namespace
from ..ros2.repeats import Repeats
from ..ros2.topics import ORIGIN, POINT, STATE, WAVEFORM
from .origin import scene_of_origin
from .waveform import Blocks, Held, Ranges, Samples, Source, TimeSpan, Waveform, joined, stamps

SCENE_ATTACHMENT = "scene.yaml"
TOPICS = (STATE, WAVEFORM, POINT)
_LONGEST = 300  # characters of a remark


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
class Recording:
    """What a recording holds of one gearbox; `remarks` says in lines what could not be read.

    States are held whole; samples stay in the file until they are asked for.
    """

    path: Path
    namespace: str
    planets: int
    state: Series
    operating_point: Series
    blocks: Samples
    scene_yaml: str | None
    remarks: list[str] = field(default_factory=list)

    @cached_property
    def ranges(self) -> Ranges | None:
        """Smallest and largest sample of each block; None without mesh_waveform."""
        return self.blocks.ranges()

    @cached_property
    def waveform(self) -> Waveform | None:
        """Every sample of the whole recording, read when it is first asked for.

        At 50 kHz and six meshes that is 4 MB for each second: of a long recording rather ask for
        `samples` of a stretch.
        """
        return self.samples(-math.inf, math.inf)

    def samples(self, begin: float, end: float) -> Waveform | None:
        """Every sample of the blocks that touch a stretch of simulated time [s], read anew.

        None where there is no such block. Raises `OSError` where the file is gone.
        """
        return self.blocks.waveform(begin, end)

    def within(self, stretches: Sequence[TimeSpan]) -> Recording:
        """The same with the samples of these stretches alone, held in memory; in their order."""
        found = [self.samples(begin, end) for begin, end in stretches]
        return replace(self, blocks=Held(joined([part for part in found if part is not None])))

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
    found = _Found()
    for file in files_of(Path(path)):
        found.read(file)
    namespace = choose_namespace(found.rows, namespace, path)
    rows = {name: found.rows.get(f"{namespace}/{name}", []) for name in (STATE, POINT)}
    blocks = found.blocks.get(f"{namespace}/{WAVEFORM}", Blocks())
    recording = assemble(rows, blocks, Path(path), namespace)
    scene = found.scene_yaml or _scene(found.rows.get(f"{namespace}/{ORIGIN}", []), found.remarks)
    return replace(recording, scene_yaml=scene, remarks=found.remarks)


def _scene(origins: list[NDArray[Any]], remarks: list[str]) -> str | None:
    """The scene of the newest run whose origin can be read, in YAML: any recorder's bag has it."""
    for text in reversed([bytes(data) for rows in origins for data in rows["data"]]):
        try:
            return scene_of_origin(text.decode())
        except (RecordingError, UnicodeDecodeError) as reason:
            remarks.append(one_line(f"{ORIGIN}: {reason}", _LONGEST))
    return None


def assemble(
    rows: Mapping[str, list[NDArray[Any]]], blocks: Samples, path: Path, namespace: str
) -> Recording:
    """What structured arrays of messages tell, by the names of their topics; of states, at least
    one.
    """
    state = _series(rows[STATE])
    planets = np.unique(state["planets"])
    room = state["planet_angle"].shape[1]
    if len(planets) != 1 or not 1 <= planets[0] <= room:
        found = ", ".join(map(str, planets[:3]))
        raise RecordingError(
            f"{path}: {namespace}/{STATE}: planets = {found}: must be one number in all messages, "
            f"within 1 and {room}"
        )
    return Recording(
        path=path,
        namespace=namespace,
        planets=int(planets[0]),
        state=state,
        operating_point=_series(rows[POINT]),
        blocks=blocks,
        scene_yaml=None,
    )


class _Found:
    """What files hold, by topic: rows of structured arrays, and blocks of the waveform."""

    def __init__(self) -> None:
        self.rows: dict[str, list[NDArray[Any]]] = {}
        self.blocks: dict[str, Blocks] = {}
        self.scene_yaml: str | None = None
        self.remarks: list[str] = []
        self._repeats = Repeats()

    def read(self, file: Path) -> None:
        """Take what a file holds."""
        topics = Topics(file, lambda topic: topic.rpartition("/")[2] in (*TOPICS, ORIGIN))
        sources: dict[int, Source] = {}
        self._repeats.next_file()
        for section in sections_of(file, self.remarks):
            messages: dict[int, list[bytes]] = {}
            for record in section.records:
                if self._repeats.repeated(record):
                    continue
                if isinstance(record, Attachment) and record.name == SCENE_ATTACHMENT:
                    self.scene_yaml = self.scene_yaml or self._text(file, record)
                elif found := topics.of(record):
                    channel = record.channel_id
                    if channel not in sources:
                        layouts = Layouts(found.types.fielddefs, found.kind)
                        sources[channel] = Source(file, channel, found.topic, layouts)
                    messages.setdefault(channel, []).append(record.data)
            for channel, data in messages.items():
                self._take(sources[channel], section.place, data)

    def _text(self, file: Path, attached: Attachment) -> str | None:
        """Of an attachment; None and a remark where it is none."""
        try:
            return attached.data.decode()
        except UnicodeDecodeError as reason:
            self.remarks.append(
                f"{file.name}: its attachment {SCENE_ATTACHMENT} must be in UTF-8, byte "
                f"{reason.start + 1} is not"
            )
            return None

    def _take(self, source: Source, place: int, messages: list[bytes]) -> None:
        for rows in source.arrays(messages):
            if source.topic.endswith(WAVEFORM):
                self.blocks.setdefault(source.topic, Blocks()).take(source, place, rows)
            else:
                self.rows.setdefault(source.topic, []).append(rows)


def _series(parts: list[NDArray[Any]]) -> Series:
    if not parts:
        return Series(np.empty(0), np.empty(0, np.int64), {})
    columns = {
        name: _column(name, [rows[name] for rows in parts])
        for name in parts[0].dtype.names or ()
        if name != "header"
    }
    stamp = np.concatenate([stamps(rows) for rows in parts])
    return Series(columns["simulated_time"], stamp, columns)


def _column(name: str, parts: list[NDArray[Any]]) -> NDArray[Any]:
    try:
        column = np.concatenate(parts)
        if column.dtype.kind == "S":
            return np.asarray(np.char.decode(column, "utf-8"))
    except ValueError as reason:  # of shapes, or of what is not UTF-8
        raise RecordingError(f"field {name} of a message: {reason}") from None
    return column.astype(column.dtype.newbyteorder("="), copy=False)
