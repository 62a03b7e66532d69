"""A file is read in the order of log times, in whatever order it was written."""

from itertools import pairwise

import pytest
from mcap.reader import make_reader
from mcap.records import Message
from mcap.writer import Writer
from twin_recording import NAMESPACE

from planetary_twin_py.recording.container.log_order import records_in_log_order
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.runs.events import read_events
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify

ORDERS = {
    "by topic, states first": lambda topic, message: (not topic.endswith("state"), topic),
    "backwards": lambda topic, message: -message.log_time,
    "second half first": lambda topic, message: message.log_time < HALF,
    # as a logger on a busy machine
    "joints late": lambda topic, message: message.log_time + LATE * topic.endswith("joint_states"),
}
LATE = 1_200_000_000
HALF = 1_790_000_000_150_000_000


def rewritten(file, out, order, chunked=True):
    """The messages of a file in another order, within chunks of 10 kB or without chunks."""
    with file.open("rb") as stream, out.open("wb") as target:
        writer = Writer(target, chunk_size=10_000, use_chunking=chunked)
        writer.start("ros2")
        channels = {}
        messages = [(c.topic, s, c, m) for s, c, m in make_reader(stream).iter_messages()]
        for topic, schema, channel, message in sorted(messages, key=lambda m: order(m[0], m[3])):
            if topic not in channels:
                number = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[topic] = writer.register_channel(
                    topic, channel.message_encoding, number, channel.metadata
                )
            times = message.log_time, message.data, message.publish_time, message.sequence
            writer.add_message(channels[topic], *times)
        writer.finish()
    return out


@pytest.mark.parametrize("chunked", [True, False])
@pytest.mark.parametrize("order", ORDERS)
def test_a_file_is_read_in_the_order_of_log_times(sound, tmp_path, order, chunked):
    file = rewritten(sound, tmp_path / "other.mcap", ORDERS[order], chunked)
    remarks = []
    times = [r.log_time for r in records_in_log_order(file, remarks) if isinstance(r, Message)]
    assert remarks == []
    assert all(before <= after for before, after in pairwise(times))
    played = [message.time for message in Playback(file).messages()]
    assert len(played) == len(times)
    assert all(before <= after for before, after in pairwise(played))
    assert [change.time for change in read_info(file).changes] == [0.0, 0.1, 0.0]
    result = verify(file, NAMESPACE)
    assert result.identical, result
    assert result.messages == verify(sound, NAMESPACE).messages
    assert list(read_events(file, NAMESPACE, [])) == list(read_events(sound, NAMESPACE, []))
    assert read_recording(file).state.stamp.tolist() == read_recording(sound).state.stamp.tolist()
