"""A playback gives the same messages from any instant, for every layout of its files."""

import struct

import pytest

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.clock_messages import CLOCK, with_clock
from planetary_twin_py.recording.ros2.metadata import Topic
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.ros2.renaming import moved

START = 1_790_000_000_000_000_000
STEP = 10_000_000  # [ns] between two messages of a topic
LATCHED = [{"durability": "transient_local", "depth": 1}]
HEADER = "# text\n\nstd_msgs/Header header\nfloat64 x\n"


def stamped(time):
    return b"\0\1\0\0" + struct.pack("<iI", *divmod(time, 10**9))


def write(folder, steps, pace=1.0):
    """Ten chunks per second; `pace` stamped seconds per recorded second, with another epoch."""
    bag = BagWriter(folder)
    kinds = [("/twin/state", HEADER, []), ("/twin/point", "float64 x\n", LATCHED)]
    kinds += [("/twin/model", "string data\n", LATCHED), ("/diagnostics", HEADER, [])]
    state, point, model, diagnostics = (
        bag.add_topic(Topic(name, "pkg/msg/" + name[1:].replace("/", "_"), "", text, qos))
        for name, text, qos in kinds
    )
    for k in steps:
        now = START + k * STEP
        stamp = 10**9 + round(k * STEP * pace)
        if k % 10 == 0:
            bag.flush()
            bag.write(diagnostics, stamped(now), now, now, k)
        if k == 1:
            bag.write(model, b"model", now, now, k)
        if k % 25 == 0:
            bag.write(point, b"point %d" % k, now, now, k)
        bag.write(state, stamped(stamp) + b"%d" % k, now, now, k)
    bag.close()
    return bag.file


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return write(tmp_path_factory.mktemp("playback") / "bag", range(301))


@pytest.fixture(params=["indexed", "truncated", "split", "split and truncated"])
def playback(request, whole, tmp_path):
    """The same messages in several layouts; a truncated one lacks those of the last chunk."""
    if request.param == "indexed":
        return Playback(whole)
    if request.param == "truncated":
        file = tmp_path / "truncated.mcap"
        file.write_bytes(whole.read_bytes()[:-2000])
        return Playback(file)
    folder = tmp_path / "split"
    folder.mkdir()
    for n, steps in enumerate([range(100), range(100, 200), range(200, 301)]):
        file = write(tmp_path / f"part_{n}", steps)
        data = file.read_bytes()
        truncated = n == 2 and "truncated" in request.param
        (folder / f"split_{9 + n}.mcap").write_bytes(data[:-2000] if truncated else data)
    return Playback(folder)


@pytest.mark.parametrize("begin", [0, 1, 25, 26, 100, 251, 270])
def test_it_starts_at_any_instant_with_latched_messages(playback, begin):
    messages = list(playback.messages(begin * STEP, 275 * STEP))
    latched = [
        message
        for message in messages
        if message.time == begin * STEP and message.data[:1] in b"mp"
    ]
    newest = 25 * ((begin - 1) // 25)
    expected = [b"point %d" % newest] * (begin > 0) + [b"model"] * (begin > 0)
    if begin % 25 == 0:
        expected.append(b"point %d" % begin)
    assert sorted(message.data for message in latched) == sorted(expected)
    states = [message for message in messages if message.topic == "/twin/state"]
    assert [int(message.data[12:]) for message in states] == list(range(begin, 276))
    assert [message.time for message in states] == [k * STEP for k in range(begin, 276)]
    assert [message.time for message in messages] == sorted(message.time for message in messages)


def test_topics_can_be_selected(whole):
    playback = Playback(whole, ["/twin/point"])
    assert (
        {message.topic for message in playback.messages()}
        == set(playback.topics)
        == {"/twin/point"}
    )
    assert playback.length == 300 * STEP
    with pytest.raises(RecordingError, match=r"topics: /odd: .* has /diagnostics, /twin/model"):
        Playback(whole, ["/odd"])


@pytest.mark.parametrize("pace", [0.5, 1.0, 3.0])
def test_the_clock_has_the_stamps_of_the_messages(tmp_path, pace):
    playback = Playback(write(tmp_path / "bag", range(301), pace))
    times, newest, off = [], 0, []
    for message in with_clock(playback, 0, playback.length, 200.0):
        if message.topic == CLOCK.name:
            seconds, nanoseconds = struct.unpack("<4xiI", message.data)
            times.append(seconds * 10**9 + nanoseconds)
            off.append(times[-1] - newest)
        elif message.topic == "/twin/state":
            seconds, nanoseconds = struct.unpack_from("<4xiI", message.data)
            newest = seconds * 10**9 + nanoseconds
    assert times == sorted(times)
    assert len(times) == 601
    assert min(off) >= 0 and max(off) <= STEP


def test_without_stamps_the_clock_has_the_time_of_the_recorder(whole):
    messages = list(with_clock(Playback(whole, ["/twin/point"]), STEP, 2 * STEP, 1000.0))
    ticks = [message for message in messages if message.topic == CLOCK.name]
    assert [message.time for message in ticks] == [STEP + k * 1_000_000 for k in range(11)]
    assert all(message.data == stamped(START + message.time) for message in ticks)


def test_topics_move_below_another_namespace():
    names = ["/twin/state", "/twin/logger/status", "/tf"]
    assert list(moved(names, "b/c").values()) == ["/b/c/state", "/b/c/logger/status", "/tf"]
    assert list(moved(names, "/").values()) == ["/state", "/logger/status", "/tf"]
    assert list(moved(["/a/x", "/b/x", "/tf"], "n").values()) == ["/n/a/x", "/n/b/x", "/tf"]
    with pytest.raises(ValueError, match="namespace = n: no recorded topic"):
        moved(["/tf"], "n")
