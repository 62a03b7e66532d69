"""A long recording does not fill the memory, and its index is complete."""

import tracemalloc
from pathlib import Path

import pytest
from mcap.reader import make_reader
from numbered import NUMBERS

from planetary_twin_py.recording.container.storage import Storage
from planetary_twin_py.recording.ros2.mcap_file import McapFile

WARM = 50  # chunks after which everything that is allocated once has been
CHUNKS = 500
PER_CHUNK = 50.0  # bytes; a chunk index of mcap's list takes 1 kB


def test_memory_does_not_grow_with_the_chunks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.fsync", lambda descriptor: None)
    file = McapFile(tmp_path / "long.mcap", Storage())
    channel = file.add_topic(NUMBERS)

    def close_chunks(count: int) -> None:
        for _ in range(count):
            number = file.counts[channel] + 1
            file.write(channel, b"\0" * 8, 1000 + number, 1000 + number, number)
            file.flush()

    close_chunks(WARM)
    tracemalloc.start()
    try:
        before, _ = tracemalloc.get_traced_memory()
        close_chunks(CHUNKS)
        after, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert after - before < PER_CHUNK * CHUNKS
    file.finish()
    assert list(tmp_path.iterdir()) == [file.path]
    with file.path.open("rb") as stream:
        reader = make_reader(stream)
        summary = reader.get_summary()
        times = [message.log_time for _, _, message in reader.iter_messages()]
    assert summary is not None and len(summary.chunk_indexes) == WARM + CHUNKS
    assert times == list(range(1001, 1001 + WARM + CHUNKS))
    starts = [index.message_start_time for index in summary.chunk_indexes]
    assert starts == times
