"""A plant that is paused and continued publishes every measurement once."""

from planetary_twin_msgs.msg import EncoderBlock
from sensor_msgs.msg import JointState

from ..peer import TWIN

NODE = f"{TWIN}/plant"
DURATION = 8.0  # [s], of which the pauses take place in the first 1.2: a busy machine may be late


def test_no_measurement_is_lost_in_a_pause(peer, start, tmp_path):
    (tmp_path / "hidden.yaml").write_text("sensors: {encoders: {rate: 20 kHz}}\n")
    joints = peer.listen(JointState, f"{TWIN}/measured/joint_states")
    blocks = peer.listen(EncoderBlock, f"{TWIN}/measured/encoders")
    plant = start("planetary_twin.plant", autostart="false", hidden="hidden.yaml",
                  duration=DURATION)  # fmt: skip
    peer.change_state(NODE, "configure")
    topics = (f"{TWIN}/measured/joint_states", f"{TWIN}/measured/encoders")
    peer.until(lambda: all(map(peer.node.count_publishers, topics)))
    for number in range(1, 5):
        peer.change_state(NODE, "activate")
        peer.until(lambda number=number: len(joints) > 30 * number)
        peer.change_state(NODE, "deactivate")
    peer.change_state(NODE, "activate")
    peer.until(lambda: plant.poll() is not None)
    peer.until(lambda: len(joints) == round(100 * DURATION))
    assert [block.sequence for block in blocks] == list(range(1, len(blocks) + 1))
    ends = [block.first_sample + len(block.input_counts) for block in blocks]
    assert [block.first_sample for block in blocks[1:]] == ends[:-1]
