"""After a kill at any moment, all flushed messages are present, none wrong or duplicated."""

import itertools
import mmap
import os
import random
import signal
import struct
import time
from pathlib import Path

import pytest
from numbered import COMPRESSIONS, Numbered, read_numbers

from planetary_twin_py.recording.container.records import files_of
from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.ros2.recover import recover

pytestmark = pytest.mark.slow

FLUSH_PERIODS = (0.01, 0.05, 0.2)  # [s]
CHUNK_SIZES = (0.002, 1.0)  # [MB]
SPLITS = (0.0, 0.08)  # [s]
CASES = list(itertools.product(COMPRESSIONS, FLUSH_PERIODS, CHUNK_SIZES, SPLITS))
_COUNTS = struct.Struct("<QQ")  # written, flushed


def write_until_killed(folder: Path, storage: Storage, period: float, counts: mmap.mmap) -> None:
    """Write a message each millisecond, flushed every `period` [s]; count them in `counts`."""
    numbered = Numbered(folder, storage, size=100)
    numbered.settle(1)
    begin = last = time.monotonic()
    flushed = 0
    while True:
        numbered.write(1)
        now = time.monotonic()
        if now - last >= period:
            numbered.bag.flush()
            last, flushed = time.monotonic(), numbered.written
        _COUNTS.pack_into(counts, 0, numbered.written, flushed)
        time.sleep(max(begin + numbered.written * 1e-3 - time.monotonic(), 0.0))


def kill_amid_writing(folder: Path, case: tuple, lifetime: float) -> None:
    """Kill a writer `lifetime` [s] after its first flush, and check the files."""
    compression, period, chunk_size, split = case
    counts = mmap.mmap(-1, _COUNTS.size)
    child = os.fork()
    if child == 0:
        try:
            write_until_killed(folder, Storage(compression, chunk_size, split), period, counts)
        finally:  # in any case, no second test runner continues
            os._exit(1)
    while _COUNTS.unpack_from(counts)[1] == 0:
        assert os.waitpid(child, os.WNOHANG) == (0, 0)
        time.sleep(0.001)
    time.sleep(lifetime)  # the subject of the test: an arbitrary moment
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    written, flushed = _COUNTS.unpack_from(counts)

    kept = [number for file in files_of(folder) for number in read_numbers(file)]
    assert kept == list(range(1, len(kept) + 1))
    assert flushed <= len(kept) <= written + 1
    saved = recover(folder, folder.with_name("saved"))
    assert read_numbers(saved.file) == kept
    assert read_numbers(saved.file, "/settings") == [1]


def cases(tries: int, seed: int) -> list[tuple[tuple, float]]:
    """Every combination in random order, each with a random lifetime [s]."""
    generator = random.Random(seed)
    order = itertools.cycle(generator.sample(CASES, len(CASES)))
    return [(case, generator.uniform(0.0, 0.3)) for case in itertools.islice(order, tries)]


@pytest.mark.parametrize(("case", "lifetime"), cases(10, seed=1))
def test_flushed_messages_survive_a_kill(tmp_path, case, lifetime):
    kill_amid_writing(tmp_path / "bag", case, lifetime)
