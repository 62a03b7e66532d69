"""Minutes of running with parameter changes: nothing grows, nothing is lost, all is reported.

One minute by default; `make soak DURATION=3600` for longer runs.
"""

import itertools
import os
import time
from pathlib import Path

import pytest
from planetary_twin_live.figures import Slope
from planetary_twin_live.process import own_memory, resident_memory, waited_for_processor
from planetary_twin_msgs.msg import GearboxState, MeshWaveform, RecorderStatus
from rclpy.serialization import deserialize_message
from rosbags.rosbag2 import Reader

from .peer import LONG, TWIN
from .reported import figures, listen_to_reports, published

DURATION = float(os.environ.get("SOAK_DURATION", "60"))  # [s]
SETTLING = 120.0  # [s] after which everything that is loaded or allocated once has been
NODE = f"{TWIN}/simulation"
PERIOD = 10  # [s] of the parameter
# [MB] of what is filled once: histories of 1000 parameter events, operating points and log lines,
# 0.3 kB per entry, and the steps of a repeated mesh cycle: a tighter tolerance needs more of them.
GROWTH = 1.0
SLOPE = 1.0  # [MB/h]


def accounted(status: RecorderStatus) -> dict[str, int]:
    totals = zip(status.topics, status.recorded, status.lost, strict=True)
    return {name: recorded + lost for name, recorded, lost in totals}


def check_recording(folder: Path, reported: dict[str, str], lost: dict[str, int]) -> None:
    """It contains all published messages except those reported as lost, in order."""
    numbers: dict[str, list[int]] = {}
    stamps: dict[str, list[int]] = {}
    kinds = {f"{TWIN}/gearbox_state": GearboxState, f"{TWIN}/mesh_waveform": MeshWaveform}
    recorded = dict.fromkeys(published(reported), 0)
    with Reader(folder) as reader:
        for connection, _, raw in reader.messages():
            name = connection.topic
            recorded[name] += 1
            if name in kinds:
                message = deserialize_message(raw, kinds[name])
                stamp = message.header.stamp
                numbers.setdefault(name, []).append(message.sequence)
                stamps.setdefault(name, []).append(stamp.sec * 1_000_000_000 + stamp.nanosec)
    assert {name: count + lost[name] for name, count in recorded.items()} == published(reported)
    for name in kinds:
        assert numbers[name][-1] <= published(reported)[name]
        assert all(a < b for a, b in itertools.pairwise(numbers[name]))
        assert all(a < b for a, b in itertools.pairwise(stamps[name]))


@pytest.mark.timeout(DURATION + 300.0)
def test_a_long_run_neither_grows_nor_loses_nor_is_late(peer, start, tmp_path, record_property):
    logger = start("planetary_twin.logger", name="bag")
    process = start("planetary_twin.simulation", autostart="false")
    status = peer.listen(RecorderStatus, f"{TWIN}/logger/status", 1)
    reports = listen_to_reports(peer)
    peer.change_state(NODE, "configure")
    topics = {f"{TWIN}/gearbox_state", f"{TWIN}/mesh_waveform", "/diagnostics"}
    peer.until(lambda: status and topics <= set(status[-1].topics))
    peer.change_state(NODE, "activate")
    started, waited = time.monotonic(), waited_for_processor(process.pid)

    times: list[float] = []
    sizes: dict[str, list[float]] = {"simulation": [], "logger": []}
    for second in itertools.count():
        end = started + second
        peer.until(lambda end=end: time.monotonic() >= end)
        if second > DURATION:
            break
        turn, moment = divmod(second, PERIOD)
        if moment == 0:
            values = {"lambda_ratio": 1.5 + 0.5 * (turn % 2), "backlash": 1e-7 * (2 + turn % 3)}
            assert peer.set(NODE, atomically=True, **values).successful
        assert process.poll() is None and logger.poll() is None
        if second >= min(SETTLING, 0.5 * DURATION):
            times.append(second / 3600.0)
            sizes["simulation"].append(own_memory(process.pid))
            sizes["logger"].append(own_memory(logger.pid))
            assert resident_memory(process.pid) < 350.0
        del reports[:-1], status[:-1]

    waited = waited_for_processor(process.pid) - waited
    elapsed = time.monotonic() - started
    peer.change_state(NODE, "deactivate")
    peer.until(lambda: figures(reports[-1:])["state"] == "stopped")
    reported = figures(reports[-1:])
    peer.until(lambda: accounted(status[-1]) == published(reported))
    lost = dict(zip(status[-1].topics, status[-1].lost, strict=True))
    logger.terminate()
    assert logger.wait(LONG) == 0
    process.terminate()
    assert process.wait(LONG) == 0
    check_recording(tmp_path / "recordings/bag", reported, lost)

    span = times[-1] - times[0]
    slopes = {node: Slope.of(times, sizes[node]) for node in sizes}
    behind = elapsed - float(reported["simulated_time"])
    for name, value in {
        "elapsed_s": elapsed, "overruns": int(reported["overruns"]), "behind_s": behind,
        "lost": sum(lost.values()), "waited_for_processor_s": waited,
        **{f"{node}_memory_mb": sizes[node][-1] for node in sizes},
        **{f"{node}_slope_mb_per_h": slope.value for node, slope in slopes.items()},
        **{f"{node}_slope_error": slope.error for node, slope in slopes.items()},
    }.items():  # fmt: skip
        record_property(name, value)
        print(f"{name} {value}")
    assert not any(lost.values())
    for node, slope in slopes.items():
        assert slope.value * span < GROWTH + SLOPE * span, node
    # The time that the machine gave to other processes explains the delay of the twin.
    assert behind < waited + 0.05
