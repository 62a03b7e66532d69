"""A running twin, drawn in batches by the functions that draw a recording."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import rerun as rr
from numpy.typing import NDArray

from ..recording.ros2.decode import Topics
from ..recording.ros2.sensor_topics import SAMPLED
from ..recording.ros2.topics import AXES_STATE, AXES_WAVEFORM, ORIGIN, POINT, STATE, WAVEFORM
from ..recording.runs.origin import read_origin
from ..recording.runs.reader import SERIES, TOPICS, Recording
from ..recording.runs.series import planets_in, series_of
from ..recording.runs.waveform import (
    AxesSamples,
    InMemory,
    Waveform,
    WaveformInMemory,
    samples_of,
    stamps,
)
from ..scene import Scene
from .axes import Scales, scales
from .blueprint import LIVE
from .events import log_events
from .gears import log_gears
from .layer import Layer
from .live_sensors import LiveBlock, LiveSensors
from .motion import motion
from .plots import log_plots, log_plots_of_axes
from .sensor_page import sensor_page
from .show import check_scene, log_solids, send_layout
from .waveform import log_waveform

_TIME = {
    STATE: "simulated_time",
    WAVEFORM: "start_time",
    POINT: "simulated_time",
    AXES_STATE: "simulated_time",
    AXES_WAVEFORM: "start_time",
}
Messages = dict[str, list[NDArray[Any]]]  # arrays of one row


class LiveView:
    """Draws the messages of a twin; each run, from one reset to the next, has its own stream.

    Args:
        namespace: namespace of the twin.
        begin: opens the stream of a run.
        scene: scene to draw in place of the published one; without it, drawing starts when the
            twin has published its scene.
    """

    def __init__(
        self, namespace: str, begin: Callable[[], rr.RecordingStream], scene: Scene | None = None
    ) -> None:
        self._namespace = namespace
        self._begin = begin
        self._chosen = scene
        self._published: Scene | None = None
        self._topics = Topics("the running twin", lambda topic: True)
        self._waiting: Messages = {name: [] for name in TOPICS}
        self._blocks: list[LiveBlock] = []  # of sensors
        self._run: _DrawnRun | None = None

    def add(self, records: Iterable[Any]) -> None:
        """Draw MCAP records.

        Args:
            records: schemas and channels, then messages in order.

        Raises:
            RecordingError: the scene does not match the messages, or cannot be read.
        """
        for record in records:
            if described := self._topics.of(record):
                name = described.topic.rpartition("/")[2]
                (message,) = described.arrays([record.data])
                if name == ORIGIN:
                    self._published = read_origin(message["data"][0].decode()).scene
                elif described.kind == SAMPLED:
                    self._blocks.append(LiveBlock(described.topic, message))
                elif name in self._waiting:
                    self._waiting[name].append(message)
        scene = self._chosen or self._published
        while scene is not None and self._draw(scene):
            self.close()

    def close(self) -> None:
        """Flush and close the stream."""
        if self._run is not None:
            self._run.end()
            self._run = None

    def _draw(self, scene: Scene) -> bool:
        """Draw the messages of one run; return whether another run has started."""
        if self._run is None:
            first = (STATE, AXES_STATE) if scene.moving_axes else (STATE,)
            if not all(self._waiting[name] for name in first):
                return False
            axes = series_of(AXES_STATE, self._waiting[AXES_STATE].copy())
            drawn = scales(scene.gearset, axes)
            self._run = _DrawnRun(self._namespace, self._begin(), scene, drawn)
        now: Messages = {}
        for name, messages in self._waiting.items():
            cut = _cut(messages, _TIME[name], self._run.reached[name])
            now[name], self._waiting[name] = messages[:cut], messages[cut:]
        if any(now.values()):
            self._run.draw(now)
        if now[STATE]:
            reached = int(stamps(now[STATE][-1])[0])
            self._run.hear([b for b in self._blocks if b.stamp <= reached], now[STATE])
            self._blocks = [b for b in self._blocks if b.stamp > reached]
        return bool(self._waiting[STATE])


class _DrawnRun:
    """Draws one run of a twin."""

    def __init__(
        self, namespace: str, stream: rr.RecordingStream, scene: Scene, drawn: Scales | None
    ) -> None:
        self.reached = dict.fromkeys(TOPICS, 0.0)
        self._drawn = drawn
        self._namespace = namespace
        self._scene = scene
        self._layer = Layer(stream)
        self._last: Messages = {name: [] for name in SERIES}
        self._sensors = LiveSensors(self._layer)
        self._send_layout()
        log_gears(self._layer, scene.gearset)

    def draw(self, new: Messages) -> None:
        """Draw further messages of the run."""
        known = len(self._last[POINT])
        recording = self._recording(
            new | {name: before + new[name] for name, before in self._last.items()}
        )
        check_scene(self._scene, recording)
        log_solids(self._layer, recording, self._scene.gearset, motion(recording), self._drawn)
        log_events(self._layer, recording, known)
        if wave := recording.waveform:
            log_waveform(self._layer, recording, [(float(wave.time[0]), float(wave.time[-1]))])
        if new[STATE]:
            log_plots(self._layer, self._recording(new))
        if new[AXES_STATE]:
            states = {STATE: self._last[STATE] + new[STATE]}
            log_plots_of_axes(self._layer, self._recording(new | states))
        for name, messages in new.items():
            if messages:
                self.reached[name] = float(messages[-1][_TIME[name]][0])
        for name, before in self._last.items():
            self._last[name] = (before + new[name])[-1:]

    def hear(self, blocks: list[LiveBlock], states: list[NDArray[Any]]) -> None:
        """Draw blocks of sensors that were sent up to the last of some states."""
        if self._sensors.draw(blocks, states):
            self._send_layout()

    def _send_layout(self) -> None:
        pages = [sensor_page(page) for page in self._sensors.pages]
        send_layout(self._layer.stream, self._scene, LIVE, axes=self._drawn, pages=pages)

    def end(self) -> None:
        """Flush and close the stream."""
        self._layer.stream.flush()
        self._layer.stream.disconnect()

    def _recording(self, messages: Messages) -> Recording:
        samples = WaveformInMemory(samples_of(Waveform, messages[WAVEFORM]))
        axes = InMemory(samples_of(AxesSamples, messages[AXES_WAVEFORM]))
        series = {name: series_of(name, messages[name].copy()) for name in SERIES}
        path = Path(self._namespace)
        return Recording(
            path=path,
            namespace=self._namespace,
            planets=planets_in(series[STATE], path, self._namespace),
            state=series[STATE],
            operating_point=series[POINT],
            blocks=samples,
            axes_state=series[AXES_STATE],
            axes_blocks=axes,
        )


def _cut(messages: list[NDArray[Any]], time: str, reached: float) -> int:
    """Number of messages before the simulated time decreases."""
    for count, message in enumerate(messages):
        if message[time][0] < reached:
            return count
        reached = float(message[time][0])
    return len(messages)
