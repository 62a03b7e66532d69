"""The reader of a node's log does not delay the node, and receives its lines."""

import fcntl
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from planetary_twin_msgs.msg import GearboxState

from ..peer import LONG, TWIN
from ..reported import figures, listen_to_reports

NODE = f"{TWIN}/simulation"
PAGE = 4096


@pytest.fixture
def stalled(domain: int, tmp_path: Path) -> Iterator[subprocess.Popen[bytes]]:
    """A simulation that logs into a full pipe without a reader."""
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
from planetary_twin.process.standard_error import nonblocking_stderr
with nonblocking_stderr():
    os.write(2, b"of the node\\n")
"""


def test_lines_in_a_file_with_other_writers_are_kept(tmp_path):
    file = tmp_path / "log"
    with file.open("wb", buffering=0) as log:
        log.write(b"before\n")
        subprocess.run([sys.executable, "-c", SHARED], stderr=log, check=True)
        log.write(b"after\n")
    assert file.read_text() == "before\nof the node\nafter\n"


def test_a_stopped_terminal_does_not_delay_the_twin(peer, stalled):
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    reports = listen_to_reports(peer)
    # The chosen tolerance is the first line that it logs.
    peer.until(lambda: int(figures(reports).get("tolerance_changes", 0)))
    count = len(states)
    assert peer.set(NODE, backlash=3e-7).successful
    peer.until(lambda: len(states) > count + 300)
    stalled.terminate()
    assert stalled.wait(LONG) == 0
