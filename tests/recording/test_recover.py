"""What is sound of a torn recording becomes a whole one."""

import pytest
from mcap.reader import make_reader
from twin_recording import NAMESPACE, record
from typer.testing import CliRunner

from planetary_twin_py.cli import build_app
from planetary_twin_py.recording.records import RecordingError, records_of
from planetary_twin_py.recording.recover import recover
from planetary_twin_py.recording.verify import verify


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    return record(tmp_path_factory.mktemp("sound") / "bag")


def messages(file):
    """Topic, times, number and bytes of every message, by a reader that goes by the index."""
    with file.open("rb") as stream:
        return [
            (channel.topic, m.log_time, m.publish_time, m.sequence, m.data)
            for _, channel, m in make_reader(stream, validate_crcs=True).iter_messages()
        ]


@pytest.mark.parametrize("share", [0.4, 0.6, 0.95])
def test_a_torn_file_becomes_whole_with_all_that_was_sound(sound, tmp_path, share):
    whole = sound.read_bytes()
    torn = tmp_path / "torn.mcap"
    torn.write_bytes(whole[: int(share * len(whole))])
    saved = recover(torn, tmp_path / "saved")
    assert list(records_of(saved.file, remarks := [])) and remarks == []
    kept = messages(saved.file)
    assert len(kept) == sum(saved.messages.values()) > 30
    assert kept == messages(sound)[: len(kept)]
    assert "ends torn" in saved.remarks[0]
    verdict = verify(saved.file.parent, NAMESPACE)
    assert verdict.identical


def test_what_is_whole_stays_as_it_is(sound, tmp_path):
    saved = recover(sound.parent, tmp_path / "saved")
    assert messages(saved.file) == messages(sound)
    assert saved.remarks == []


def test_nothing_is_made_of_nothing(sound, tmp_path):
    torn = tmp_path / "torn.mcap"
    torn.write_bytes(sound.read_bytes()[:60])
    with pytest.raises(RecordingError):
        recover(torn, tmp_path / "saved")
    assert not (tmp_path / "saved").exists()


def test_the_command_says_what_is_lost_and_overwrites_nothing(sound, tmp_path):
    torn = tmp_path / "torn.mcap"
    torn.write_bytes(sound.read_bytes()[:-5000])
    answer = CliRunner().invoke(build_app(), ["recover", str(torn)])
    assert answer.exit_code == 0
    assert "not readable" in answer.output
    assert "gearbox_state" in answer.output
    again = CliRunner().invoke(build_app(), ["recover", str(torn)])
    assert again.exit_code == 2
    assert len(again.output.strip().splitlines()) == 1
    assert "exists" in again.output
