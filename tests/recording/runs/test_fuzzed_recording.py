"""Randomly altered recordings are read as far as they are valid, or refused in one line."""

import shutil
from dataclasses import replace

import pytest
from fuzzing import altered, check, searching
from hostile import rewritten
from hypothesis import given
from hypothesis import strategies as st
from mcap.records import Attachment, Channel, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from synthetic_recording import START_NS
from twin_recording import NAMESPACE

import planetary_twin_py as pt
from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.definitions import topics_of
from planetary_twin_py.recording.ros2.playback import Playback
from planetary_twin_py.recording.ros2.recover import recover
from planetary_twin_py.recording.runs.compose import Composer
from planetary_twin_py.recording.runs.events import read_events
from planetary_twin_py.recording.runs.info import read_info
from planetary_twin_py.recording.runs.origin import Origin, makers_here
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.schedule import read_runs
from planetary_twin_py.recording.tables.export import Export, export

pytestmark = [pytest.mark.exhaustive, pytest.mark.filterwarnings("ignore")]

FIELDS = {
    Schema: ("name", "encoding", "data"),
    Channel: ("topic", "message_encoding"),
    Message: ("data", "log_time", "publish_time", "sequence"),
    Attachment: ("name", "data"),
    Metadata: ("name", "metadata"),
}


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """Four intervals in two chunks, uncompressed so that alterations reach the messages."""
    folder = tmp_path_factory.mktemp("sound")
    bag = BagWriter(folder / "bag")
    composer = Composer(bag, topics_of(NAMESPACE), NAMESPACE)
    twin = pt.Twin(pt.load_scene("paper"), 1000.0, 1e-2)
    bag.attach("scene.yaml", b"base: paper\n", "application/yaml")
    composer.begin(Origin(twin.scene, START_NS, makers_here()))
    composer.point(twin.log[-1].values, 0.0, START_NS)
    for number in range(1, 5):
        window = twin.advance(0.01)
        first = START_NS + round(window.waveform.time[0] * 1e9)
        composer.window(window, START_NS + round(window.end * 1e9), first)
        if number == 2:
            bag.flush()
    bag.close()
    return bag.file


def read_all(file):
    """Read `file` with every reader."""
    out = file.parent / "out"
    readers = {
        "info": lambda: read_info(file).figures(),
        "recording": lambda: used(read_recording(file)),
        "runs": lambda: read_runs(file, NAMESPACE, []),
        "events": lambda: list(read_events(file, NAMESPACE, [])),
        "playback": lambda: list(Playback(file).messages()),
        "recover": lambda: recover(file, out),
        "export": lambda: export(file, Export(out)),
    }
    for read in readers.values():
        shutil.rmtree(out, ignore_errors=True)
        check(read, RecordingError)


def used(recording):
    """Evaluate what views use of a recording."""
    return recording.ranges, recording.waveform, recording.per_mesh("dte_mean"), recording.meshes


@searching
@given(data=st.data())
def test_a_recording_with_other_bytes_is_read_or_refused(sound, data):
    file = sound.parent / "altered.mcap"
    file.write_bytes(data.draw(altered(sound.read_bytes())))
    read_all(file)


@searching
@given(data=st.data())
def test_a_recording_with_other_contents_is_read_or_refused(sound, data):
    """All checksums are valid: the contents of one to three records differ."""
    with sound.open("rb") as stream:
        records = [r for r in StreamReader(stream).records if type(r) in FIELDS]
    chosen = data.draw(st.lists(st.sampled_from(range(len(records))), min_size=1, max_size=3))
    changes = {id_of(records[n]): contents(data, records[n]) for n in chosen}
    file = rewritten(
        sound, sound.parent / "rewritten.mcap", lambda record: changes.get(id_of(record), record)
    )
    read_all(file)


def id_of(record):
    return repr(record)


def contents(data, record):
    """`record` with another content of one field."""
    field = data.draw(st.sampled_from(FIELDS[type(record)]))
    before = getattr(record, field)
    if isinstance(before, bytes):
        drawn = data.draw(altered(before))
    elif isinstance(before, str):
        drawn = data.draw(st.text(max_size=40) | altered(before.encode()).map(lossy))
    elif isinstance(before, int):
        most = 2**32 - 1 if field == "sequence" else 2**64 - 1
        drawn = data.draw(st.integers(0, most))
    else:
        drawn = data.draw(st.dictionaries(st.sampled_from([*before, "x"]), st.text(max_size=40)))
    return replace(record, **{field: drawn})


def lossy(data):
    return data.decode("utf-8", "replace")
