"""What `planetary-twin run` starts hears this machine alone."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from .conftest import Start
from .peer import TWIN, Peer
from .processes import working_in

LOOPBACK = "0100007F"  # 127.0.0.1 in /proc/net


def sockets(process: int) -> set[str]:
    """Local addresses of the UDP and TCP sockets of a process, as /proc/net writes them."""
    inodes = set()
    for entry in Path(f"/proc/{process}/fd").iterdir():
        target = os.readlink(entry)
        if target.startswith("socket:["):
            inodes.add(target.removeprefix("socket:[").rstrip("]"))
    found = set()
    for table in ("udp", "tcp", "udp6", "tcp6"):
        for line in Path(f"/proc/net/{table}").read_text().splitlines()[1:]:
            fields = line.split()
            if fields[9] in inodes:
                found.add(fields[1].split(":")[0])
    return found


@pytest.fixture
def running(domain: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """`planetary-twin run` as on a machine where nothing is set, once its nodes talk."""
    monkeypatch.delenv("ROS_AUTOMATIC_DISCOVERY_RANGE")
    command = (
        "import typer; from planetary_twin.commands import run; app = typer.Typer();"
        " app.command()(run); app()"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", command, "--duration", "8", "--no-tour"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline()  # the first line is of a running twin
    yield process
    process.terminate()
    process.communicate(timeout=30)


def test_no_socket_of_a_run_hears_the_network(running: subprocess.Popen[str], tmp_path: Path):
    processes = working_in(tmp_path)
    assert len(processes) >= 3  # the run, the simulation, the logger
    heard = set().union(*(sockets(process) for process in processes))
    assert heard == {LOOPBACK}


def test_a_client_without_the_profile_still_hears_a_strict_twin(
    domain: int, start: Start, monkeypatch: pytest.MonkeyPatch
) -> None:
    from ament_index_python.packages import get_package_share_directory
    from planetary_twin_msgs.msg import GearboxState

    profile = Path(get_package_share_directory("planetary_twin")) / "config" / "loopback.xml"
    monkeypatch.setenv("FASTRTPS_DEFAULT_PROFILES_FILE", str(profile))
    process = start("planetary_twin.simulation")
    time.sleep(0.1)  # the process has read its environment
    monkeypatch.delenv("FASTRTPS_DEFAULT_PROFILES_FILE")
    peer = Peer()
    try:
        states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
        peer.until(lambda: len(states) > 3, 60.0)
        assert sockets(process.pid) == {LOOPBACK}
    finally:
        peer.close()
