"""The logger records the inputs of a follower under any names, so they can be followed again."""

import signal

import pytest
from planetary_twin_msgs.msg import FollowerEstimate
from sensor_msgs.msg import JointState, Temperature

from planetary_twin_py.following.measured.recording import read_recording
from planetary_twin_py.following.readings import Readings
from planetary_twin_py.following.sensors import JointNames

from ..peer import LONG, TWIN
from .test_inputs import Rig, stamp

REMAPPED = {"joint_states": "/rig/joint_states", "oil_temperature": "/plant/oil"}
COUNT = 400


@pytest.mark.parametrize(
    "programs",
    [("planetary_twin.logger", "planetary_twin.follower"), ("planetary_twin.recorded_follower",)],
)
def test_remapped_inputs_are_recorded_completely(peer, start, tmp_path, programs):
    remaps = [f"measured/{name}:={topic}" for name, topic in REMAPPED.items()]
    options = [word for remap in remaps for word in ("-r", remap)]
    nodes = [start(program, "--ros-args", *options, name="bag") for program in programs]
    joints = peer.node.create_publisher(JointState, REMAPPED["joint_states"], 2000)
    oil = peer.node.create_publisher(Temperature, REMAPPED["oil_temperature"], 100)
    estimates: list[FollowerEstimate] = []
    results = peer.node.create_subscription(
        FollowerEstimate, f"{TWIN}/follower/estimate", estimates.append, 1000
    )
    rig = Rig(peer)  # publishes nothing under the names that are remapped
    peer.until(lambda: all(rig.is_matched(one, 2) for one in (joints, oil)))
    peer.until(lambda: results.get_publisher_count() == 1)  # it publishes each estimate once
    temperature = Temperature(temperature=70.0)
    stamp(temperature, 0.0)
    oil.publish(temperature)
    for n in range(COUNT):
        joints.publish(rig.reading(n / 100.0))
    peer.until(lambda: len(estimates) > 5)
    for node in nodes:
        node.send_signal(signal.SIGINT)
    assert [node.wait(LONG) for node in nodes] == [0] * len(nodes)
    blocks = read_recording(tmp_path / "recordings/bag", JointNames())
    rows = [len(block.time) for block in blocks if isinstance(block, Readings)]
    assert sum(rows) == COUNT + 1
