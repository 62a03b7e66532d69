"""Services of the follower: baselines are saved, learned again and loaded, events acknowledged."""

import numpy as np
from diagnostic_msgs.msg import DiagnosticStatus
from planetary_twin_msgs.msg import SampledBlock
from std_srvs.srv import Trigger

from ..peer import TWIN
from .test_inputs import BEGIN, FOLLOWER, Rig, begin, stamp

SAMPLED = 2_000.0  # [Hz] of the accelerometer
MESH = 2.0 * np.pi * 500.0 * 1.00001  # [rad/s] of 30 teeth at 104.72 rad/s


def vibrate(rig: Rig, end: float) -> None:
    """Publish vibration at the mesh frequency from time 0 on, in blocks of 0.1 s."""
    publisher = rig.user.node.create_publisher(SampledBlock, f"{TWIN}/measured/vibration", 1000)
    rig.user.until(lambda: rig.is_matched(publisher))
    chance = np.random.default_rng(1)
    count = round(0.1 * SAMPLED)
    for n in range(round(end / 0.1)):
        time = (n * count + np.arange(count)) / SAMPLED
        block = SampledBlock(sequence=n + 1, sample_period=1.0 / SAMPLED)
        block.names, block.units = ["acceleration"], ["m/s^2"]
        values = 5.0 * np.cos(MESH * time) + 0.1 * chance.standard_normal(count)
        block.samples = values.tolist()
        stamp(block, BEGIN + float(time[0]))
        publisher.publish(block)


def asked(rig: Rig, name: str) -> tuple[bool, str]:
    answer = rig.user.call(Trigger, f"{FOLLOWER}/{name}", Trigger.Request())
    return answer.success, answer.message


def test_a_baseline_is_saved_learned_again_and_loaded(peer, start, tmp_path):
    rig, file = Rig(peer), tmp_path / "gearbox.npz"
    (tmp_path / "sensors.yaml").write_text("learning: 8\n")
    begin(start, rig, sensors=tmp_path / "sensors.yaml")
    assert asked(rig, "save_baseline") == (False, "baseline = '': must be the path of a file")
    assert peer.set(FOLLOWER, baseline=str(file)).successful
    assert asked(rig, "save_baseline") == (False, "no baseline has been learned yet")
    assert asked(rig, "load_baseline")[0] is False
    vibrate(rig, 9.0)
    rig.send(0.0, 9.0)
    rig.counters(lambda counts: counts.get("vibration_periods", 0) >= 8)
    assert asked(rig, "save_baseline") == (True, str(file))
    saved = dict(np.load(file))
    assert asked(rig, "learn")[0] is True
    assert asked(rig, "save_baseline") == (False, "no baseline has been learned yet")
    assert asked(rig, "load_baseline") == (True, str(file))
    file.unlink()
    assert asked(rig, "save_baseline") == (True, str(file))
    again = dict(np.load(file))
    assert again.keys() == saved.keys()
    for name, values in saved.items():
        np.testing.assert_array_equal(again[name], values)


def test_an_acknowledged_event_is_no_warning_any_more(peer, start):
    rig = Rig(peer)
    begin(start, rig)
    rig.send(0.0, 20.0)
    rig.send(20.0, 24.0, torque=0.97)
    rig.reported("condition", DiagnosticStatus.WARN, "loss torque stepped")
    assert asked(rig, "acknowledge") == (True, "1 events acknowledged")
    rig.reports.clear()
    rig.reported("condition", DiagnosticStatus.OK, "1 events, all acknowledged")
    assert asked(rig, "acknowledge") == (True, "0 events acknowledged")
    peer.change_state(FOLLOWER, "deactivate")
    assert asked(rig, "acknowledge") == (False, "the follower is not active")
