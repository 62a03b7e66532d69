"""A failing disk loses only unflushed messages, and is reported with the system's error."""

import os
import resource
import signal
from pathlib import Path

import pytest
from numbered import COMPRESSIONS, Numbered, read_numbers
from small_disk import make_read_only, mounted

from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.ros2.bag import BagWriter
from planetary_twin_py.recording.ros2.recover import recover

LIMIT = 200_000  # bytes


def write_until_it_fails(numbered: Numbered) -> tuple[int, OSError]:
    """Number of messages flushed before the failure, and its error."""
    flushed = 0
    try:
        while numbered.written < 100_000:
            numbered.write(10)
            numbered.bag.flush()
            flushed = numbered.written
    except OSError as reason:
        numbered.bag.abandon()
        return flushed, reason
    raise AssertionError("nothing has failed")


def check_what_is_left(file: Path, flushed: int, saved: Path) -> None:
    kept = read_numbers(file)
    assert flushed > 0
    assert kept == list(range(1, len(kept) + 1))
    assert len(kept) >= flushed
    assert read_numbers(recover(file, saved).file) == kept


@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_a_full_disk(tmp_path, compression):
    with mounted(tmp_path / "disk", "400k") as disk:
        numbered = Numbered(disk / "bag", Storage(compression), size=200)
        flushed, reason = write_until_it_fails(numbered)
        assert reason.strerror == "No space left on device"
        assert numbered.bag.closed
        check_what_is_left(disk / "bag/bag_0.mcap", flushed, tmp_path / "saved")


def test_a_file_that_may_not_grow(tmp_path):
    """As on a full disk, if nothing can be mounted: a quota of a child process."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (LIMIT, LIMIT))
            flushed, reason = write_until_it_fails(Numbered(tmp_path / "bag", Storage("none")))
            os.write(write, f"{flushed} {reason.strerror}".encode())
        finally:  # in any case, no second test runner continues
            os._exit(0)
    os.waitpid(child, 0)
    flushed, reason = os.read(read, 100).decode().split(" ", 1)
    os.close(read)
    os.close(write)
    assert reason == "File too large"
    check_what_is_left(tmp_path / "bag/bag_0.mcap", int(flushed), tmp_path / "saved")


def test_a_read_only_disk_is_refused_at_the_start(tmp_path):
    with mounted(tmp_path / "disk") as disk:
        make_read_only(disk)
        with pytest.raises(OSError, match="Read-only file system"):
            BagWriter(disk / "bag")


@pytest.mark.parametrize("moved", [True, False])
def test_a_folder_that_is_deleted_or_moved_away_is_noticed(tmp_path, moved):
    numbered = Numbered(tmp_path / "bag")
    numbered.write(10)
    numbered.bag.flush()
    if moved:
        (tmp_path / "bag").rename(tmp_path / "elsewhere")
    else:
        (tmp_path / "bag/bag_0.mcap").unlink()
        (tmp_path / "bag").rmdir()
    numbered.write(10)
    for step in (numbered.bag.flush, numbered.bag.split, numbered.bag.close):
        with pytest.raises(FileNotFoundError, match="deleted or moved away"):
            step()
    numbered.bag.abandon()
    if moved:
        assert read_numbers(tmp_path / "elsewhere/bag_0.mcap")[:10] == list(range(1, 11))
