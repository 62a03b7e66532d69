"""A recording that was cut off before its run says so, and what to do, in every command."""

import io
import struct
from pathlib import Path

import pytest
from mcap.exceptions import McapError
from mcap.records import Channel, Message
from mcap.stream_reader import StreamReader
from numbered import NUMBERS, payload
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app
from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.no_run import no_run_yet
from planetary_twin_py.recording.ros2.playback import Playback

SAMPLE = Path(__file__).parents[3] / "recordings/sample/sample_0.mcap"
RUN = {"run_origin", "gearbox_state"}  # topics
NO_RUN = "holds no run yet: it ends before the first"
ADVICE = "if it is still being written, try again later; if its recorder was killed, record again"
REFUSING = {
    "verify": [],
    "view": ["--save", "view.rrd"],
    "export": ["--out", "tables", "--format", "csv"],
    "resimulate": ["--out", "again"],
}


def cuts(data):
    """Places within and at the ends of records, up to the end of the chunk with the first state."""
    found, place = [0, 4], 8
    while not topics_in(data[:place]) >= RUN:
        end = place + 9 + struct.unpack_from("<Q", data, place + 1)[0]
        found += [place, (place + end) // 2]
        place = end
    return [*found, place]


def topics_in(data):
    """Last parts of the topics with messages, by a reader that knows nothing of damage."""
    names, there = {}, set()
    try:
        for record in StreamReader(io.BytesIO(data)).records:
            if isinstance(record, Channel):
                names[record.id] = record.topic
            elif isinstance(record, Message):
                there.add(names[record.channel_id].rpartition("/")[2])
    except (McapError, struct.error, EOFError):
        pass
    return there


def says(command, file, *options):
    """Exit code, and the lines about the run."""
    answer = CliRunner().invoke(build_app(), [command, str(file), *options])
    assert not answer.exception or isinstance(answer.exception, SystemExit), answer.exception
    lines = [line for line in answer.output.splitlines() if NO_RUN in line]
    assert all(line.endswith(ADVICE) for line in lines)
    return answer.exit_code, lines, answer.output


@pytest.fixture(scope="module")
def whole():
    """Places at which the sample is cut before its run, and the first place after."""
    data = SAMPLE.read_bytes()
    return data, cuts(data)


@pytest.mark.slow
def test_every_command_says_that_there_is_no_run(whole, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    data, places = whole
    file, tried = tmp_path / "cut.mcap", 0
    for place in places[::3]:
        file.write_bytes(data[:place])
        if topics_in(data[:place]) >= RUN:
            break
        tried += 1
        for command, options in REFUSING.items():
            code, lines, output = says(command, file, *options)
            assert code == 2 and len(lines) == 1, (place, output)
            assert output.strip() == lines[0]
        assert not [one for one in tmp_path.iterdir() if one != file]
        code, lines, output = says("info", file)
        assert code == 0 and len(lines) == 1, (place, output)
        try:
            remarks = Playback(file).remarks  # of which replay prints every line
        except RecordingError as reason:
            remarks = [str(reason)]
        assert len([line for line in remarks if NO_RUN in line and line.endswith(ADVICE)]) == 1
        code, lines, output = says("recover", file, "--out", f"saved_{place}")
        assert len(lines) == 1, (place, output)
        assert (code == 0) == bool(topics_in(data[:place]))
        for saved in tmp_path.glob(f"saved_{place}/*"):
            saved.unlink()
        for folder in tmp_path.glob(f"saved_{place}"):
            folder.rmdir()
    assert tried > 2


def test_a_recording_with_its_run_says_nothing_of_it(whole, tmp_path):
    data, places = whole
    file, tried = tmp_path / "cut.mcap", 0
    for place in places:
        file.write_bytes(data[:place])
        if topics_in(data[:place]) >= RUN:
            tried += 1
            _, lines, _ = says("info", file)
            assert lines == []
    assert tried
    assert says("info", SAMPLE)[1] == says("verify", SAMPLE)[1] == []


def test_a_recording_of_something_else_is_not_blamed(tmp_path):
    bag = BagWriter(tmp_path / "bag")
    channel = bag.add_topic(NUMBERS)
    bag.write(channel, payload(1), 1, 1, 1)
    bag.flush()
    assert not any(NO_RUN in line for line in Playback(bag.file).remarks)
    code, lines, output = says("view", bag.file, "--save", str(tmp_path / "view.rrd"))
    assert code == 2 and not lines and "has no gearbox_state messages" in output


def test_a_finished_recording_without_a_run_is_not_unfinished(tmp_path):
    bag = BagWriter(tmp_path / "bag")
    bag.close()
    assert no_run_yet(bag.file, {}) is None


def test_a_follower_that_is_killed_before_its_first_estimate_needs_no_run(tmp_path):
    file = tmp_path / "cut.mcap"
    file.write_bytes(SAMPLE.read_bytes()[: SAMPLE.stat().st_size // 2])
    seen = {"/rig/joint_states": 5, "/twin/follower/estimate": 0, "/diagnostics": 1}
    assert no_run_yet(file, seen) is None
    del seen["/twin/follower/estimate"]
    assert NO_RUN in no_run_yet(file, seen)
