"""The follower as a process beside a plant: what it finds, and the same bits from a recording."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from domains import private_domain
from intervals import agrees
from mcap.reader import make_reader
from planetary_twin_msgs import msg
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState, Temperature

import planetary_twin_py as pt
from planetary_twin_py.following.channels.message_types import JOINTS, TEMPERATURE
from planetary_twin_py.following.follower import Follower
from planetary_twin_py.following.measured.messages import Arrived, MessageReader
from planetary_twin_py.following.sensors import read_sensors
from planetary_twin_py.recording.ros2.sensor_topics import ENCODERS

from ..conftest import starting
from ..peer import TWIN, connected, seconds
from ..programs import Forked, Program

SENSORS = "learning: 8\n"  # hunting periods of a baseline, to be soon done
ERRORS = """
sensors:
  input_torque: {noise: 0.1 N m, zero: 0.02 N m}
  output_torque: {noise: 0.25 N m, gain: 5e-4}
  speed_noise: 0.02 rad/s
  encoders: {rate: 20 kHz, lost: 0.003}
"""
CHANGES = """
changes:
  - {at: 10 s, friction: 1.2}
  - at: 9 s
    faults: [{kind: crack, gear: sun, tooth: 3, stiffness_loss: 0.05}]
"""
FOLLOWER = f"{TWIN}/follower"


@dataclass
class Played:
    """What was recorded of a play."""

    place: Path
    messages: dict[str, list[Any]]

    @property
    def recording(self) -> Path:
        return self.place / "recordings" / "rig"


def play(place: Path, hidden: str, duration: float) -> Iterator[Played]:
    """Play a plant beside a follower and a logger, three processes."""
    (place / "hidden.yaml").write_text(hidden)
    (place / "sensors.yaml").write_text(SENSORS)
    with private_domain() as domain, pytest.MonkeyPatch.context() as environment:
        environment.setenv("ROS_DOMAIN_ID", str(domain))
        with starting(Forked, place) as begin, connected() as user:

            def start(node: str, **given: Any) -> Program:
                return begin(f"planetary_twin.{node}", **given)

            plant = start("plant", hidden="hidden.yaml", duration=duration,
                          wait_for="[follower, logger]", autostart=False)  # fmt: skip
            start("follower", sensors="sensors.yaml")
            start("logger", name="rig")
            user.change_state(f"{TWIN}/plant", "configure")
            subscribers = [f"{TWIN}/measured/{name}" for name in ("joint_states", "encoders")]
            user.until(lambda: all(user.node.count_subscribers(n) == 2 for n in subscribers))
            user.change_state(f"{TWIN}/plant", "activate")
            user.until(lambda: plant.poll() is not None)
            user.change_state(FOLLOWER, "deactivate")
            user.change_state(f"{TWIN}/logger", "deactivate")
    yield Played(place, recorded(place / "recordings" / "rig"))


def recorded(folder: Path) -> dict[str, list[Any]]:
    """Messages of the follower and of the encoders, by the last part of their topics."""
    kinds = {f"planetary_twin_msgs/msg/{kind.__name__}": kind for kind in
             (msg.FollowerEstimate, msg.FollowerResiduals, msg.FollowerTeeth, msg.FollowerEvent,
              msg.FollowerBaseline, msg.EncoderBlock)}  # fmt: skip
    found: dict[str, list[Any]] = {}
    (file,) = folder.glob("*.mcap")
    with file.open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema is not None
            if schema.name in kinds:
                name = channel.topic.rpartition("/")[2]
                one = deserialize_message(message.data, kinds[schema.name])
                found.setdefault(name, []).append(one)
    return found


@pytest.fixture(scope="module")
def changing(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Played]:
    """A plant whose friction grows by 20 % and of which a tooth cracks."""
    yield from play(tmp_path_factory.mktemp("changing"), ERRORS + CHANGES, 15.0)


def test_hidden_changes_are_found(changing):
    events = {event.what: event for event in changing.messages["event"]}
    assert set(events) == {"loss torque stepped", "sun tooth 3 changed"}
    step, crack = events["loss torque stepped"], events["sun tooth 3 changed"]
    begin = seconds(changing.messages["encoders"][0].header.stamp)
    assert 10.0 < seconds(step.header.stamp) - begin < 15.0
    truth = 0.2 * tooth_friction()
    assert agrees(step.size_low, truth, step.size_high)
    assert "friction" in step.causes
    assert agrees(crack.size_low, 0.05, crack.size_high)
    last = changing.messages["teeth"][-1]
    assert (
        last.changed == ["sun tooth 3"] and sum(last.teeth) == len(last.every_z) == 30 + 3 * 20 + 70
    )


def tooth_friction() -> float:
    """Mean loss torque of the scene's teeth at the input [N m], of a run with dynamics."""
    scene = pt.load_scene("paper")
    run = pt.simulate(scene, 0.05, settling=0.05)
    return float(run.energy.friction / (run.duration * scene.operating_point.input_speed))


def test_stamps_of_estimates_grow_and_numbers_have_no_gaps(changing):
    for name in ("estimate", "residuals", "teeth", "event", "baseline"):
        messages = changing.messages[name]
        assert [one.sequence for one in messages] == list(range(1, len(messages) + 1))
    fresh = estimates(changing)
    stamps = [seconds(one.header.stamp) for one in fresh]
    assert stamps == sorted(set(stamps))
    published = changing.messages["estimate"]
    for before, one in itertools.pairwise(published):  # silence changes statuses, not the stamp
        assert one in fresh or seconds(one.header.stamp) == seconds(before.header.stamp)


def test_an_estimate_follows_every_tenth_of_a_second(changing):
    stamps = np.array([seconds(one.header.stamp) for one in estimates(changing)])
    assert np.diff(stamps[:-1]) == pytest.approx(0.1, abs=1e-6)  # the last one ends with the play
    begin = seconds(changing.messages["encoders"][0].header.stamp)
    assert stamps[0] - begin < 2.0 and stamps[-1] - begin == pytest.approx(15.0, abs=0.11)


def test_the_recording_followed_again_gives_the_same_bits(changing):
    again = following(changing)
    repeated = {round(one.time * 1e9): one for one in again}
    live = estimates(changing)
    names = [name for name in live[0].get_fields_and_field_types() if name.endswith("_status")]
    for name in (name.removesuffix("_status") for name in names):
        whole = name.startswith(("compliance", "backlash"))  # by hunting periods, not by time
        for message in live[-1:] if whole else live:
            stamp = message.header.stamp.sec * 10**9 + message.header.stamp.nanosec
            expected = repeated[stamp][name]
            for part in ("value", "sd", "low", "high"):
                field = name if part == "value" else f"{name}_{part}"
                found, wanted = getattr(message, field), getattr(expected, part)
                assert found == wanted or (math.isnan(found) and math.isnan(wanted)), (stamp, field)
    every = {one.counters["hunting_periods"]: one.every_z for one in again if one.every_z}
    judged = [one for one in changing.messages["teeth"] if not one.learning]
    for one in judged:
        assert list(one.every_z) == np.float32(every[one.hunting_periods]).tolist()


def estimates(played: Played) -> list[Any]:
    """Those that were made because of readings, not because of silence."""
    published = played.messages["estimate"]
    return [one for one in published if one.input_torque_status != "STALE"]


def following(played: Played) -> list[Any]:
    """What a follower says of the recording, message by message."""
    sensors = read_sensors(played.place / "sensors.yaml")
    follower, reader = Follower(pt.load_scene("paper"), sensors), MessageReader(sensors.joints)
    found = []
    for message in measured(played.recording):
        before = follower.time, follower.hunting_periods
        for block in reader.read([message]):
            follower.add(block)
        if (follower.time, follower.hunting_periods) != before and follower.time > 0.0:
            found.append(follower.estimate())
    follower.finish()
    return [*found, follower.estimate()]


def measured(folder: Path) -> Iterator[Arrived]:
    """Measured messages of a recording, in their order."""
    kinds = {JOINTS[0]: JointState, TEMPERATURE: Temperature, ENCODERS: msg.EncoderBlock}
    (file,) = folder.glob("*.mcap")
    with file.open("rb") as stream:
        for schema, channel, message in make_reader(stream).iter_messages():
            assert schema is not None
            if schema.name in kinds and "/measured/" in channel.topic:
                found = deserialize_message(message.data, kinds[schema.name])
                yield Arrived(channel.topic, schema.name, 1e-9 * message.log_time, found)
