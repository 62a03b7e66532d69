"""An unconfigured node has no topics, and accepts every parameter of the start."""

import pytest
import yaml
from planetary_twin_msgs.msg import GearboxState, RecorderStatus
from rcl_interfaces.srv import DescribeParameters
from std_msgs.msg import String

import planetary_twin_py as pt

from ..peer import LATCHED, TWIN, Peer

OF_ROS = {"/rosout", "/parameter_events"}
SIMULATION = f"{TWIN}/simulation"


def topics(peer: Peer) -> set[str]:
    """Topics that the node publishes, except the peer's and those of every node."""
    found = {topic for topic, _ in peer.node.get_topic_names_and_types()}
    published = {topic for topic in found if peer.node.count_publishers(topic)}
    return {topic for topic in published - OF_ROS if not topic.endswith("/transition_event")}


def read_only(peer: Peer, name: str) -> bool:
    request = DescribeParameters.Request(names=[name])
    service = f"{SIMULATION}/describe_parameters"
    return bool(peer.call(DescribeParameters, service, request).descriptors[0].read_only)


def test_a_simulation_uses_parameters_set_when_unconfigured(peer, start):
    start("planetary_twin.simulation", autostart="false")
    assert peer.state(SIMULATION) == "unconfigured"
    assert topics(peer) == set()
    assert not read_only(peer, "publish_rate") and read_only(peer, "autostart")

    own = pt.load_scene("wind_turbine_stage")
    torque = own.operating_point.input_torque
    refused = peer.set(SIMULATION, input_torque=torque)
    assert not refused.successful and "input_torque" in refused.reason  # beyond the paper's motor
    for given in ({"backlash": 4e-7}, {"scene": own.name}, {"publish_rate": 50}, {"frame_id": "f"}):
        answer = peer.set(SIMULATION, **given)
        assert answer.successful, answer.reason
    geometry = ("gearset.teeth.sun", "gearset.module")
    assert peer.parameters(SIMULATION, "input_torque", "backlash", *geometry) == [
        torque,
        4e-7,  # was set, and is kept
        own.gearset.teeth.sun,
        own.gearset.module,
    ]
    assert peer.set(SIMULATION, input_torque=0.9 * torque).successful

    peer.change_state(SIMULATION, "configure")
    peer.until(lambda: f"{TWIN}/gearbox_state" in topics(peer))
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    origins = peer.listen(String, f"{TWIN}/run_origin", LATCHED)
    for given in ({"publish_rate": 60}, {"scene": "paper"}, {"gearset.teeth.sun": 5}):
        answer = peer.set(SIMULATION, **given)
        assert not answer.successful and "fixed" in answer.reason, answer.reason
    assert read_only(peer, "publish_rate") and read_only(peer, "gearset.teeth.sun")
    assert peer.set(SIMULATION, publish_rate=50).successful  # its present value

    peer.change_state(SIMULATION, "activate")
    peer.until(lambda: states and origins)
    assert states[0].header.frame_id == "f"
    assert states[0].interval == pytest.approx(1.0 / 50.0)
    assert states[0].planets == own.gearset.planets
    point = yaml.safe_load(origins[0].data)["scene"]["operating_point"]
    assert point["input_torque"] == pytest.approx(0.9 * torque) and point["backlash"] == 4e-7

    for transition in ("deactivate", "cleanup"):
        peer.change_state(SIMULATION, transition)
    peer.until(lambda: topics(peer) == set())
    assert peer.set(SIMULATION, publish_rate=20).successful


def test_a_logger_uses_the_name_set_when_unconfigured(peer, start, tmp_path):
    node = f"{TWIN}/logger"
    start("planetary_twin.logger", autostart="false")
    assert peer.state(node) == "unconfigured"
    assert topics(peer) == set()
    assert peer.set(node, name="later").successful
    refused = peer.set(node, flush_period=1e3)
    assert not refused.successful and "flush_period" in refused.reason
    status = peer.listen(RecorderStatus, f"{node}/status")
    for transition in ("configure", "activate"):
        peer.change_state(node, transition)
    peer.until(lambda: status)
    assert status[-1].file.startswith("recordings/later/")
    assert (tmp_path / status[-1].file).exists()
    assert topics(peer) == {"/diagnostics", f"{node}/status"}
