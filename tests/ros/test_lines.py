"""Who reads a node's log does not set its pace, and gets its lines."""

from __future__ import annotations

import fcntl
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from planetary_twin_msgs.msg import GearboxState

from .conftest import Start
from .peer import LONG, TWIN, Peer
from .told import figures, listen_to_reports

NODE = f"{TWIN}/simulation"
PAGE = 4096


@pytest.fixture
def stalled(domain: int, tmp_path: Path) -> Iterator[subprocess.Popen[bytes]]:
    """A simulation that logs into a pipe which is full, and which nobody reads."""
    reader, writer = os.pipe()
    fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, PAGE)
    os.write(writer, b"\n" * PAGE)
    node = subprocess.Popen(
        [sys.executable, "-m", "planetary_twin.simulation"], cwd=tmp_path, stderr=writer
    )
    yield node
    node.kill()
    node.wait()
    os.close(writer)
    os.close(reader)


SHARED = """
import os
from planetary_twin.standard_error import never_waiting
with never_waiting():
    os.write(2, b"of the node\\n")
"""


def test_lines_in_a_file_that_others_write_into_stay(tmp_path: Path) -> None:
    file = tmp_path / "log"
    with file.open("wb", buffering=0) as log:
        log.write(b"before\n")
        subprocess.run([sys.executable, "-c", SHARED], stderr=log, check=True)
        log.write(b"after\n")
    assert file.read_text() == "before\nof the node\nafter\n"


def test_its_lines_come_where_somebody_reads(peer: Peer, start: Start) -> None:
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    node = start("planetary_twin.simulation", "--ros-args", "-p", "rate_factor:=1e9")
    _, errors = node.communicate(timeout=LONG)
    assert node.returncode == 1
    assert "rate_factor = 1000000000.0: must be a number within 0 and 100" in errors
    node = start("planetary_twin.simulation")
    peer.until(lambda: len(states) > 300)
    node.terminate()
    _, errors = node.communicate(timeout=LONG)
    assert "tolerance" in errors


def test_a_terminal_that_stands_still_holds_up_neither_the_twin_nor_its_parameters(
    peer: Peer, stalled: subprocess.Popen[bytes]
) -> None:
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    reports = listen_to_reports(peer)
    # The tolerance that it chooses is the first line it logs.
    peer.until(lambda: int(figures(reports).get("tolerance_changes", 0)))
    count = len(states)
    assert peer.set(NODE, backlash=3e-7).successful
    peer.until(lambda: len(states) > count + 300)
    stalled.terminate()
    assert stalled.wait(LONG) == 0
