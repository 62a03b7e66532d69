"""A twin opens no socket to a network unless its user requests one."""

import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from planetary_twin_msgs.msg import GearboxState

from ..peer import LONG, TWIN, Peer
from ..processes import bound_addresses, working_in
from ..programs import ended

COMMAND = "import sys; from planetary_twin_py.cli import main; sys.exit(main())"


@pytest.fixture
def peer(domain: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Peer]:
    """A program on this machine without the profile, with shared memory."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    user = Peer()
    yield user
    user.close()


@pytest.fixture
def twin(
    request: pytest.FixtureRequest,
    peer: Peer,  # created before the environment changes
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[None]:
    """`planetary-twin run` with the discovery range of the environment, or without one."""
    monkeypatch.delenv("ROS_AUTOMATIC_DISCOVERY_RANGE")
    monkeypatch.delenv("FASTRTPS_DEFAULT_PROFILES_FILE")
    monkeypatch.delenv("RMW_FASTRTPS_USE_QOS_FROM_XML")
    if request.param is not None:
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", request.param)
    process = subprocess.Popen([sys.executable, "-c", COMMAND, "run"], cwd=tmp_path)
    yield
    process.send_signal(signal.SIGINT)
    assert process.wait(LONG) == 0


def _addresses(folder: Path) -> dict[int, set[str]]:
    return {process: bound_addresses(process) for process in working_in(folder)}


@pytest.mark.exhaustive
@pytest.mark.parametrize("twin", [None], indirect=True)
def test_every_socket_of_a_run_is_bound_to_loopback(twin, peer, tmp_path):
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: states, 120.0)  # participants with other settings receive it, too
    bound = _addresses(tmp_path)
    assert len(bound) == 3
    for addresses in bound.values():
        assert addresses == {"127.0.0.1"}


def test_enforced_security_is_never_disabled_silently(start, tmp_path, monkeypatch):
    (tmp_path / "keys/enclaves").mkdir(parents=True)
    monkeypatch.setenv("ROS_SECURITY_ENABLE", "true")
    monkeypatch.setenv("ROS_SECURITY_STRATEGY", "Enforce")
    monkeypatch.setenv("ROS_SECURITY_KEYSTORE", str(tmp_path / "keys"))
    process = start("planetary_twin.simulation")
    errors = ended(process, 1)
    *_, last = errors.strip().splitlines()
    assert last.startswith("simulation: the middleware refuses the node: ")


@pytest.mark.exhaustive
@pytest.mark.parametrize("twin", ["SUBNET"], indirect=True)
def test_a_twin_uses_the_network_on_request(twin, peer, tmp_path):
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: states)
    assert all("0.0.0.0" in addresses for addresses in _addresses(tmp_path).values())
