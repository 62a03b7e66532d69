"""Twins in separate namespaces are independent; in one namespace they warn."""

from __future__ import annotations

from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import GearboxState

from .peer import LONG, TWIN


def test_statuses_of_twins_have_distinct_names(peer, start):
    for side in ("left", "right"):
        start("planetary_twin.simulation", "--ros-args", "-r", f"__ns:=/{side}")
        start("planetary_twin.logger", "--ros-args", "-r", f"__ns:=/{side}")
    reports = peer.listen(DiagnosticArray, "/diagnostics")

    def names(side: str) -> set[str]:
        statuses = (status for report in reports for status in report.status)
        return {status.name for status in statuses if status.hardware_id == f"/{side}"}

    simulation = ("real time", "energy ledger", "accuracy")
    tasks = (*(f"simulation: {task}" for task in simulation), "logger: recording")
    peer.until(lambda: len(names("left")) == len(names("right")) == len(tasks))
    for side in ("left", "right"):
        assert names(side) == {f"{side}/{task}" for task in tasks}


def test_two_twins_of_one_name_both_warn_and_give_the_remedy(peer, start):
    twins = [start("planetary_twin.simulation") for _ in range(2)]
    own = ("simulation", TWIN)
    peer.until(lambda: peer.node.get_node_names_and_namespaces().count(own) == 2)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    peer.until(lambda: len(states) > 600)  # three seconds of both
    for twin in twins:
        twin.terminate()
    for twin in twins:
        _, log = twin.communicate(timeout=LONG)
        warned = [line for line in log.splitlines() if "another node is named" in line]
        assert len(warned) == 1 and "[WARN]" in warned[0]
        assert f"{TWIN}/simulation" in warned[0] and "-r __ns:=" in warned[0]
        assert "gearbox_state has another publisher" in log
