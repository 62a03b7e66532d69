"""The recorder benchmark counts the messages in the file of a separate process."""

import time
from pathlib import Path

from numbered import Numbered
from planetary_twin_live.recorder import run_trial
from planetary_twin_live.tail import Tail


def test_a_tail_sees_flushed_messages_only(tmp_path: Path) -> None:
    numbered = Numbered(tmp_path / "bag")
    with Tail(numbered.bag.file) as tail:
        for count in (7, 5):
            before = tail.messages
            numbered.write(count)
            numbered.bag.flush()
            numbered.write(1)  # stays in the chunk in progress
            deadline = time.monotonic() + 120.0
            while tail.messages < numbered.written - 1:
                assert time.monotonic() < deadline
                time.sleep(0.01)
            assert tail.messages == numbered.written - 1 > before


def test_a_low_rate_is_sustained(domain: int, tmp_path: Path) -> None:
    trial = run_trial(1000, 100.0, 1.0, tmp_path)
    assert trial.lost == 0
    assert 0.0 < trial.rate < 110.0
    assert 0.0 < trial.latency.p50 <= trial.latency.max
    assert 0.0 < trial.cores < 1.0
