"""Bounds of every reader, whatever it is given: a result or one line, in little time and memory."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from planetary_twin_py.text.escaping import printable

SECONDS = 5.0  # of the processor, which a sound file of this size needs a hundredth of
MEGABYTES = 300.0
LONGEST_LINE = 1000  # characters
MOST_LISTED = 31  # errors of a scene, of which there are several at once
_STATUS = Path("/proc/self/status")
_FORGET_PEAK = "5"  # proc(5): resets VmHWM

# What is tried follows from the code alone, so a failure repeats; FUZZ_EXAMPLES=20000 tries more.
searching = settings(
    derandomize=True,
    database=None,
    deadline=None,
    max_examples=int(os.environ.get("FUZZ_EXAMPLES", "100")),
    suppress_health_check=list(HealthCheck),
)


def check(read: Callable[[], Any], refusal: type[Exception]) -> Any:
    """What `read` returns, or the line of its `refusal`; any other exception is passed on."""
    Path("/proc/self/clear_refs").write_text(_FORGET_PEAK)
    resident, start = _megabytes("VmRSS"), time.process_time()
    try:
        found = read()
    except refusal as reason:
        found = printable(str(reason))
        heading, *listed = found.split("\n")
        assert heading and all(line.startswith("  ") for line in listed), found
        assert not listed or heading.endswith(" errors:"), found
        assert len(listed) <= MOST_LISTED and len(max(found.split("\n"), key=len)) < LONGEST_LINE
    assert time.process_time() - start < SECONDS
    assert _megabytes("VmHWM") - resident < MEGABYTES
    return found


def altered(sound: bytes) -> st.SearchStrategy[bytes]:
    """`sound` with up to eight stretches replaced, left out, repeated or moved."""
    place = st.integers(0, len(sound))
    piece = st.one_of(
        st.binary(max_size=16),
        st.sampled_from([b"\0" * 8, b"\xff" * 8, b"\xff" * 4, b"\x7f", b"\n", b"\x80", b"[" * 60]),
        st.tuples(place, st.integers(0, 400)).map(lambda cut: sound[cut[0] : cut[0] + cut[1]]),
    )
    change = st.tuples(place, st.one_of(st.just(0), st.integers(0, 16), place), piece)
    return st.lists(change, min_size=1, max_size=8).map(lambda changes: _apply(sound, changes))


def _apply(sound: bytes, changes: list[tuple[int, int, bytes]]) -> bytes:
    for place, length, piece in changes:
        sound = sound[:place] + piece + sound[place + length :]
    return sound


def _megabytes(figure: str) -> float:
    """A figure of this process."""
    return int(_STATUS.read_text().partition(f"{figure}:")[2].split()[0]) / 1024
