"""The built interfaces carry their values between two processes over real DDS."""

import array
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import rclpy
from planetary_twin_msgs import msg
from planetary_twin_msgs.srv import SetOperatingPoint

RANDOM = np.random.default_rng(7)


def gearbox_state():
    message = msg.GearboxState(sequence=41, planets=3, efficiency=float("nan"))
    message.header.frame_id = "gearbox"
    message.sun_planet_dte_rms = RANDOM.normal(size=7)
    message.planet_ring_power_loss = RANDOM.normal(size=7)
    return message


def mesh_waveform():
    samples = array.array("f", RANDOM.normal(size=6 * 500).astype(np.float32))
    return msg.MeshWaveform(sequence=2, planets=3, samples=500, dte=samples, mesh_force=samples)


def operating_point():
    return msg.OperatingPoint(backlash=2e-7, lambda_ratio=1.5, changed="backlash,lambda_ratio")


def recorder_status():
    return msg.RecorderStatus(topics=["/a", "/b"], recorded=[2**63, 1], lost=[0, 3])


@pytest.fixture
def node():
    mirror = Path(__file__).with_name("interface_mirror.py")
    process = subprocess.Popen([sys.executable, str(mirror)])
    rclpy.init()
    node = rclpy.create_node("tester")
    yield node
    node.destroy_node()
    rclpy.shutdown()
    process.kill()  # it has nothing to save, and rclpy's own way out can hang at exit
    process.wait(timeout=120)


def spin_until(node, condition, timeout=120.0):
    deadline = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < deadline, "nothing came back"
        rclpy.spin_once(node, timeout_sec=0.1)


@pytest.mark.parametrize(
    "message",
    [gearbox_state(), mesh_waveform(), operating_point(), recorder_status()],
    ids=lambda message: type(message).__name__,
)
def test_message_comes_back_unchanged(node, message):
    kind = type(message)
    received = []
    node.create_subscription(kind, f"{kind.__name__}/back", received.append, 10)
    publisher = node.create_publisher(kind, kind.__name__, 10)
    spin_until(node, lambda: publisher.get_subscription_count())
    spin_until(node, lambda: node.count_publishers(f"{kind.__name__}/back"))
    spin_until(node, lambda: publisher.publish(message) or received)
    assert repr(received[0]) == repr(message)  # NaN included


def test_service_answers(node):
    client = node.create_client(SetOperatingPoint, "set_operating_point")
    assert client.wait_for_service(timeout_sec=120.0)
    request = SetOperatingPoint.Request(names=["backlash", "lambda_ratio"], values=[2e-7, 1.5])
    future = client.call_async(request)
    spin_until(node, future.done)
    assert future.result().success
    assert future.result().message == "2e-07, 1.5"


def test_wrong_length_is_refused():
    with pytest.raises(AssertionError, match="sun_planet_dte_mean"):
        msg.GearboxState(sun_planet_dte_mean=[0.0] * 6)
