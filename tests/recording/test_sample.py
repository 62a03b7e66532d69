"""The recording that is kept in git is sound, complete, and still what the model computes."""

from collections import Counter
from pathlib import Path

import pytest
from mcap.reader import make_reader
from rosbags.rosbag2 import Reader

from planetary_twin_py.recording.info import read_info
from planetary_twin_py.recording.reader import read_recording
from planetary_twin_py.recording.verify import verify

SAMPLE = Path(__file__).parents[2] / "recordings" / "sample"
NAMESPACE = "/planetary_twin"


def test_it_is_small_and_holds_every_message_that_was_published():
    assert sum(file.stat().st_size for file in SAMPLE.iterdir()) < 1.5e6
    info = read_info(SAMPLE)
    assert info.remarks == []
    states = info.topics[f"{NAMESPACE}/gearbox_state"]
    assert states.recorded == round(info.simulated * 100) > 100
    assert all(topic.lost == 0 for topic in info.topics.values())
    assert {name for change in info.changes[1:] for name in change.values} == {
        "lambda_ratio",
        "backlash",
        "input_speed",
        "input_torque",
    }


def test_two_readers_find_the_same_messages_in_it():
    (file,) = SAMPLE.glob("*.mcap")
    with file.open("rb") as stream:
        messages = make_reader(stream, validate_crcs=True).iter_messages()
        found = Counter((channel.topic, message.data) for _, channel, message in messages)
    with Reader(SAMPLE) as reader:
        others = Counter((c.topic, bytes(data)) for c, _, data in reader.messages())
    assert found == others and found.total() > 400


@pytest.mark.slow
def test_it_simulates_again_to_what_it_says():
    verdict = verify(SAMPLE, NAMESPACE)
    assert verdict.remarks == []
    assert verdict.values > 250_000
    assert verdict.identical or (not verdict.same_makers and verdict.within_bound)


def test_it_opens_with_its_scene():
    recording = read_recording(SAMPLE)
    assert recording.scene_yaml and recording.planets == 3
    assert recording.waveform is not None
