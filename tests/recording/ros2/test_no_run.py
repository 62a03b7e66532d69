"""A recording that was cut off before its run says so, and what to do, in every command."""

import struct
from pathlib import Path

import pytest
from command_line import invoke
from numbered import read_numbers

from planetary_twin_py.recording.container.records import RecordingError
from planetary_twin_py.recording.ros2.no_run import no_run_yet
from planetary_twin_py.recording.ros2.playback import Playback

SAMPLE = Path(__file__).parents[3] / "recordings/sample/sample_0.mcap"
STATES = "/planetary_twin/gearbox_state"
NO_RUN = "holds no run yet: it ends before the first"
ADVICE = "if it is still being written, try again later; if its recorder was killed, record again"
REFUSING = {
    "verify": [],
    "view": ["--save", "view.rrd"],
    "export": ["--out", "tables", "--format", "csv"],
    "resimulate": ["--out", "again"],
}


@pytest.fixture(scope="module")
def cuts(tmp_path_factory):
    """The sample cut within and at the ends of records, and whether it has a state then."""
    data, file = SAMPLE.read_bytes(), tmp_path_factory.mktemp("cuts") / "cut.mcap"
    found, place, has_state = {0: False, 4: False}, 8, False
    while not has_state:
        end = place + 9 + struct.unpack_from("<Q", data, place + 1)[0]
        found |= {place: False, (place + end) // 2: False}
        place = end
        file.write_bytes(data[:place])
        has_state = bool(read_numbers(file, STATES))
    return {data[:cut]: has for cut, has in {**found, place: True}.items()}


def says(command, file, *options):
    """Exit code, and the lines about the run."""
    answer = invoke(command, file, *options)
    assert not answer.exception or isinstance(answer.exception, SystemExit), answer.exception
    lines = [line for line in answer.output.splitlines() if NO_RUN in line]
    assert all(line.endswith(ADVICE) for line in lines)
    return answer.exit_code, lines, answer.output


@pytest.mark.slow
def test_every_command_says_that_there_is_no_run(cuts, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "cut.mcap"
    for data in [data for data, has_state in cuts.items() if not has_state][::3]:
        file.write_bytes(data)
        for command, options in REFUSING.items():
            code, lines, output = says(command, file, *options)
            assert code == 2 and len(lines) == 1, (len(data), output)
            assert output.strip() == lines[0]
        assert not [one for one in tmp_path.iterdir() if "saved" not in one.name and one != file]
        code, lines, output = says("info", file)
        assert code == 0 and len(lines) == 1, (len(data), output)
        try:
            remarks = Playback(file).remarks  # of which replay prints every line
        except RecordingError as reason:
            remarks = [str(reason)]
        assert len([line for line in remarks if NO_RUN in line and line.endswith(ADVICE)]) == 1
        code, lines, output = says("recover", file, "--out", f"saved_{len(data)}")
        assert len(lines) == 1, (len(data), output)


def test_a_recording_with_its_run_says_nothing_of_it(cuts, tmp_path):
    file = tmp_path / "cut.mcap"
    file.write_bytes(next(data for data, has_state in cuts.items() if has_state))
    assert says("info", file)[1] == says("info", SAMPLE)[1] == says("verify", SAMPLE)[1] == []


def test_a_follower_killed_before_an_estimate_needs_no_run(tmp_path):
    file = tmp_path / "cut.mcap"
    file.write_bytes(SAMPLE.read_bytes()[: SAMPLE.stat().st_size // 2])
    seen = {"/rig/joint_states": 5, "/twin/follower/estimate": 0, "/diagnostics": 1}
    assert no_run_yet(file, seen) is None
    del seen["/twin/follower/estimate"]
    assert NO_RUN in no_run_yet(file, seen)
