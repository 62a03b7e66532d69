"""The sensors of a scene are published, live and recorded, whatever the rate of the waveform."""

import itertools
import math
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from domains import private_domain
from planetary_twin_msgs.msg import (
    EncoderBlock,
    GearboxState,
    PulseTimes,
    RecorderStatus,
    SampledBlock,
    SensorLevels,
)
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Temperature
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from planetary_twin_py.recording.runs.verify import verify

from ...conftest import Play, starting
from ...peer import TWIN, Peer, connected
from ...programs import Forked
from ...recordings import read_all
from ...reported import recorded

SCENE = """
base: paper
name: with_sensor
sensors:
  - {name: ring_top, kind: accelerometer, angle: 30 deg, rate: 25.6 kHz, range: 5000 m/s^2}
  - {name: shaft, kind: torque, rate: 6.4 kHz}
  - {name: key, kind: tachometer, shaft: input, pulses: 4}
  - {name: input_encoder, kind: encoder, shaft: input, lines: 1024, rate: 6.4 kHz}
  - {name: output_encoder, kind: encoder, shaft: output, bits: 20, rate: 6.4 kHz}
  - {name: oil, kind: thermometer, rate: 20 Hz}
"""
KINDS = {
    "ring_top": SampledBlock,
    "ring_top/levels": SensorLevels,
    "shaft": SampledBlock,
    "shaft/levels": SensorLevels,
    "key": PulseTimes,
    "input_encoder": EncoderBlock,
    "output_encoder": EncoderBlock,
    "oil": Temperature,
}
PERIOD = 1.0 / 25_600.0  # [s] of the accelerometer
SUN_TEETH, SPEED = 30, 2.0 * math.pi * 1000.0 / 60.0  # of `paper`, whose carrier is held [rad/s]
MESH = SUN_TEETH * SPEED / (2.0 * math.pi)  # [Hz]
SLOWLY = {"rate_factor": 0.5, "sample_rate": 2000.0, "tolerance": 0.001}


class Run(NamedTuple):
    """What the sensors of a twin have sent, by name, and their recording."""

    sent: dict[str, list[Any]]
    states: list[GearboxState]
    transforms: list[TFMessage]
    folder: Path


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Run]:
    """A second, a reset, and some tenths more, received over DDS and recorded."""
    place = tmp_path_factory.mktemp("sensors")
    (place / "sensor.yaml").write_text(SCENE)
    with private_domain() as domain, pytest.MonkeyPatch.context() as environment:
        environment.setenv("ROS_DOMAIN_ID", str(domain))
        with starting(Forked, place) as start, connected() as user:
            sent = {
                name: user.listen(kind, f"{TWIN}/sensors/{name}", 1000)
                for name, kind in KINDS.items()
            }
            states = user.listen(GearboxState, f"{TWIN}/gearbox_state", 1000)
            transforms = user.listen(TFMessage, "/tf")
            status = user.listen(RecorderStatus, f"{TWIN}/logger/status")
            logger = start("planetary_twin.logger", name="bag")
            given = {"scene": place / "sensor.yaml", "wait_for": f"{TWIN}/logger"} | SLOWLY
            twin = start("planetary_twin.simulation", **given)
            levels = sent["ring_top/levels"]
            user.until(lambda: len(levels) >= 9)
            assert user.call(Trigger, f"{TWIN}/simulation/reset", Trigger.Request()).success
            count = len(levels)
            user.until(lambda: len(levels) >= count + 3)
            user.pause(f"{TWIN}/simulation")
            newest = states[-1].sequence
            user.until(lambda: states[-1].sequence > newest or recorded(status, _STATE) >= newest)
            for node in (twin, logger):
                node.send_signal(signal.SIGINT)
                assert node.wait(60.0) == 0
            yield Run(sent, states, transforms, place / "recordings/bag")


_STATE = f"{TWIN}/gearbox_state"


def seconds(header: Any) -> float:
    return header.stamp.sec + 1e-9 * header.stamp.nanosec


def in_order(messages: list[Any]) -> None:
    assert [m.sequence for m in messages] == list(
        range(messages[0].sequence, messages[0].sequence + len(messages))
    )
    stamps = [seconds(message.header) for message in messages]
    assert all(a < b for a, b in itertools.pairwise(stamps))


def first_run(messages: list[Any]) -> list[Any]:
    """The messages before a jump of the stamps."""
    for number, (a, b) in enumerate(itertools.pairwise(messages), 1):
        length = len(a.samples) * a.sample_period
        if abs(seconds(b.header) - seconds(a.header) - length) > 1e-6:
            return messages[:number]
    return messages


def test_blocks_follow_one_another_at_the_rate_of_the_sensor(run: Run) -> None:
    blocks = run.sent["ring_top"]
    assert all(b.sample_period == PERIOD for b in blocks)
    assert all((b.names, b.units) == (["ring_top"], ["m/s^2"]) for b in blocks)
    assert all(b.header.frame_id == "sensor_ring_top" for b in blocks)
    in_order(blocks)
    assert len(first_run(blocks)) > 40  # of 0.02 s


def test_the_accelerometer_hears_the_mesh(run: Run) -> None:
    samples = np.concatenate([b.samples for b in first_run(run.sent["ring_top"])][10:])
    spectrum = np.abs(np.fft.rfft(samples * np.hanning(len(samples))))
    highest = np.fft.rfftfreq(len(samples), PERIOD)[spectrum.argmax()]
    assert highest / MESH == pytest.approx(round(highest / MESH), abs=0.01) and highest > 400.0


def test_the_frame_of_a_sensor_is_on_the_rim(run: Run) -> None:
    assert run.sent["shaft"][0].header.frame_id == "gearbox"
    transforms = {t.child_frame_id: t for t in run.transforms[-1].transforms}
    placed = transforms["sensor_ring_top"]
    assert placed.header.frame_id == "gearbox"
    at, rotation = placed.transform.translation, placed.transform.rotation
    assert math.hypot(at.x, at.y) > 0.0 and at.z == 0.0
    turned = 2.0 * math.atan2(rotation.z, rotation.w)
    assert turned == pytest.approx(math.atan2(at.y, at.x)) == pytest.approx(math.radians(30.0))


def test_levels_are_those_of_the_samples(run: Run) -> None:
    for name, rate in (("ring_top", 25_600), ("shaft", 6_400)):
        blocks = first_run(run.sent[name])
        samples = np.concatenate([b.samples for b in blocks]).astype(float)
        begin, size = seconds(blocks[0].header), rate // 10
        compared = 0
        for levels in run.sent[f"{name}/levels"]:
            end = round((seconds(levels.header) - begin) * rate)
            if not size <= end <= len(samples):
                continue
            part = samples[end - size : end]
            deviation = part - part.mean()
            assert levels.interval == pytest.approx(0.1)
            assert levels.mean == pytest.approx(part.mean(), rel=1e-5, abs=1e-6 * part.std())
            assert levels.rms == pytest.approx(part.std(), rel=1e-5)
            assert levels.peak == pytest.approx(np.abs(deviation).max(), rel=1e-5)
            assert levels.kurtosis == pytest.approx(
                (deviation**4).mean() / part.var() ** 2, rel=1e-5
            )
            line = np.exp(-2j * math.pi * MESH * np.arange(size) / rate)
            window = np.hanning(size + 1)[:-1]
            amplitude = 2.0 * abs((window * deviation * line).sum()) / window.sum()
            assert levels.mesh_line == pytest.approx(amplitude, rel=0.05)
            compared += 1
        assert compared >= 5


def test_encoders_count_the_turns_of_their_shafts(run: Run) -> None:
    for name, side, per_turn in (
        ("input_encoder", "input", 4096),
        ("output_encoder", "output", 2**20),
    ):
        blocks = run.sent[name]
        other = "output" if side == "input" else "input"
        assert all(getattr(b, f"{side}_counts_per_turn") == per_turn for b in blocks)
        assert all(len(getattr(b, f"{other}_counts")) == 0 for b in blocks)
        assert all(b.absolute for b in blocks)
    counts = run.sent["input_encoder"][5].input_counts
    turned = (counts[-1] - counts[0]) / 4096 * 2.0 * math.pi
    assert abs(turned) == pytest.approx(SPEED * (len(counts) - 1) / 6400.0, rel=0.05)


def test_pulses_come_four_times_a_turn(run: Run) -> None:
    times = np.concatenate([message.times for message in run.sent["key"]])
    steps = np.diff(times)
    steps = steps[steps > 0.0]  # not that of the reset
    assert np.median(steps) == pytest.approx(2.0 * math.pi / SPEED / 4.0, rel=0.02)
    in_order(run.sent["key"])


def test_the_thermometer_is_in_degrees_celsius(run: Run) -> None:
    temperatures = [message.temperature for message in run.sent["oil"]]
    assert len(temperatures) >= 10
    assert np.ptp(temperatures) > 0.0  # it has noise
    assert 0.0 < np.mean(temperatures) < 150.0


def test_the_recording_has_every_message(run: Run) -> None:
    bag = read_all(run.folder)
    for name, kind in KINDS.items():
        received = bag[f"{TWIN}/sensors/{name}"]
        assert received.type == f"{kind.__module__.split('.')[0]}/msg/{kind.__name__}"
        kept = [deserialize_message(raw, kind) for raw in received.messages]
        by_stamp = {seconds(message.header): message for message in kept}
        assert len(by_stamp) == len(kept) >= len(run.sent[name])
        assert all(by_stamp[seconds(m.header)] == m for m in run.sent[name])
        assert getattr(kept[0], "sequence", 1) == 1


def test_the_recording_is_verified_with_its_sensors(run: Run) -> None:
    found = verify(run.folder, TWIN)
    assert found.identical, (found.first_difference, found.remarks)
    for name in KINDS:
        assert found.messages[f"sensors/{name}"] >= len(run.sent[name])


def test_a_replay_publishes_the_sensors_again(run: Run, peer: Peer, play: Play) -> None:
    again = {name: peer.listen(kind, f"{TWIN}/sensors/{name}") for name, kind in KINDS.items()}
    play(run.folder, "--loop")
    peer.until(lambda: all(again.values()) and len(again["ring_top/levels"]) > 3)
    for name, messages in again.items():
        sent = {seconds(message.header): message for message in run.sent[name]}
        both = [m for m in messages if seconds(m.header) in sent]
        assert both and all(sent[seconds(m.header)] == m for m in both)
