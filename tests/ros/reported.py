"""Reports of a twin, and the same run simulated again from them."""

import itertools
import signal
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from planetary_twin_msgs.msg import MeshWaveform, OperatingPoint, RecorderStatus
from rclpy.time import Time

import planetary_twin_py as pt
from planetary_twin_py.recording.ros2.topics import REAL_TIME, is_status
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.run.quality_control import Setting

from .peer import LONG, TWIN, Peer
from .programs import Program

LONGEST = 20.0  # [s] simulated at a time


def check_verified(logger: Program, folder: Path) -> None:
    """The recording of `logger`, which is ended, repeats the run bit for bit."""
    logger.send_signal(signal.SIGINT)
    logger.communicate(timeout=LONG)
    verdict = verify(folder, TWIN)
    assert verdict.identical, verdict


def check_rising(*topics: Sequence[Any]) -> None:
    """Sequence numbers have no gaps, and stamps increase."""
    for messages in topics:
        for before, after in itertools.pairwise(messages):
            assert after.sequence == before.sequence + 1
            assert Time.from_msg(after.header.stamp) > Time.from_msg(before.header.stamp)


def listen_to_reports(peer: Peer) -> list[DiagnosticArray]:
    """A list of the simulation's reports; the logger's reports are left out."""
    reports: list[DiagnosticArray] = []

    def receive(message: DiagnosticArray) -> None:
        if is_status(message.status[0].name, REAL_TIME):
            reports.append(message)

    peer.node.create_subscription(DiagnosticArray, "/diagnostics", receive, 100)
    return reports


def figures(reports: list[DiagnosticArray]) -> dict[str, str]:
    """All reported values, the newest of each key."""
    return {item.key: item.value for report in reports for item in report.status[0].values}


def statuses(reports: Sequence[DiagnosticArray], task: str) -> list[DiagnosticStatus]:
    """Statuses of this kind, in the order received."""
    return [s for report in reports for s in report.status if is_status(s.name, task)]


def published(reported: Mapping[str, str]) -> dict[str, int]:
    """Numbers of published messages in a report, by topic."""
    prefix = "published."
    return {k.removeprefix(prefix): int(v) for k, v in reported.items() if k.startswith(prefix)}


def recorded(status: Sequence[RecorderStatus], topic: str) -> int:
    """Number of recorded messages of a topic in the newest status of a recorder."""
    counted = dict(zip(status[-1].topics, status[-1].recorded, strict=True)) if status else {}
    return int(counted.get(topic, 0))


def reported_settings(reported: Mapping[str, str]) -> dict[float, Setting]:
    """Settings by the simulated time [s] from which they apply, in order."""
    since: dict[float, dict[str, float]] = {}
    for key, value in reported.items():
        name, mark, instant = key.partition("_from.")
        if mark:
            since.setdefault(float(instant), {})[name] = float(value)
    settings, last = {}, Setting(np.nan, np.nan)
    for instant in sorted(since):
        settings[instant] = last = last._replace(**since[instant])
    return settings


def assert_simulated_again(
    scene: pt.Scene,
    waves: Sequence[MeshWaveform],
    points: Sequence[OperatingPoint],
    reported: Mapping[str, str],
    sample_rate: float,
) -> None:
    """The reported changes reproduce every sample of `waves`, at the full `sample_rate`."""
    again = _transmission_error(scene, points, reported, sample_rate)
    for wave in waves:
        stride = round(wave.sample_period * sample_rate)
        assert wave.sample_period == stride / sample_rate
        first = round(wave.start_time * sample_rate) - 1
        published = np.array(wave.dte, dtype=np.float32).reshape(-1, wave.samples).T
        assert np.array_equal(again[first::stride][: wave.samples], published)


def _transmission_error(
    scene: pt.Scene,
    points: Sequence[OperatingPoint],
    reported: Mapping[str, str],
    sample_rate: float,
) -> np.ndarray:
    """Transmission error of all meshes, in float32 as published, shape (samples, meshes)."""
    changes = {point.simulated_time: point for point in points}
    settings = reported_settings(reported)
    values = {name: getattr(points[0], name) for name in pt.TUNABLES}
    twin = pt.Twin(scene.replace(**values), sample_rate, settings[0.0].tolerance)
    parts = []
    for instant in sorted({*changes, *settings, float(reported["simulated_time"])} - {0.0}):
        while twin.time < instant:
            window = twin.advance(min(instant - twin.time, LONGEST))
            parts.append(window.waveform.dte.astype(np.float32))
        if instant in changes:
            twin.set(**{name: getattr(changes[instant], name) for name in pt.TUNABLES})
        if instant in settings:
            twin.set_tolerance(settings[instant].tolerance)
    return np.vstack(parts)
