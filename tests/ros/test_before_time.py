"""No state is published before the operating point that governs it, and none without a clock."""

from __future__ import annotations

import signal
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

from planetary_twin.live import LiveTwin
from planetary_twin_msgs.msg import GearboxState, OperatingPoint
from planetary_twin_msgs.srv import Step
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool, Trigger

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.verify import verify

from .conftest import Start
from .peer import LATCHED, LONG, TWIN, Peer
from .test_clocks import Ticking
from .test_shaft_commands import received

NODE = f"{TWIN}/simulation"
NO_CLOCK = "use_sim_time: the twin waits for the first message on /clock"


def pause(peer: Peer) -> None:
    assert peer.call(SetBool, f"{NODE}/pause", SetBool.Request(data=True)).success


def step(peer: Peer) -> Step.Response:
    return peer.call(Step, f"{NODE}/step", Step.Request(duration=0.05))


def check_verified(logger: Any, folder: Path) -> None:
    """The recording repeats the run bit for bit."""
    logger.send_signal(signal.SIGINT)
    logger.communicate(timeout=LONG)
    verdict = verify(folder, TWIN)
    assert verdict.identical, verdict


def test_steps_before_the_first_clock_are_refused_and_those_after_it_are_recorded_in_full(
    peer: Peer, start: Start, tmp_path: Path
) -> None:
    logger = start("planetary_twin.logger", "--ros-args", "-p", "name:=clockless")
    given = ("-p", "use_sim_time:=true", "-p", "wait_for:=logger")
    start("planetary_twin.simulation", "--ros-args", *given)
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    pause(peer)
    assert peer.set(NODE, input_torque=80.0).successful
    for _ in range(2):
        refused = step(peer)
        assert not refused.success and refused.simulated_time == 0.0
        assert refused.message == f"{NO_CLOCK}; step the twin then"
        assert (refused.stamp.sec, refused.stamp.nanosec) == (0, 0)  # no time yet
        assert peer.call(Trigger, f"{NODE}/reset", Trigger.Request()).success
    assert not states and not points
    Ticking(peer, 5.0)
    peer.until(lambda: step(peer).success)
    peer.until(lambda: len(states) == 5 and points)
    assert points[-1].input_torque == 80.0
    assert states[0].header.stamp.sec >= 5
    check_verified(logger, tmp_path / "recordings/clockless")


def test_a_running_twin_that_changes_to_a_clock_without_time_refuses_steps(
    peer: Peer, start: Start, tmp_path: Path
) -> None:
    logger = start("planetary_twin.logger", "--ros-args", "-p", "name:=changed")
    start("planetary_twin.simulation", "--ros-args", "-p", "wait_for:=logger")
    states = peer.listen(GearboxState, f"{TWIN}/gearbox_state")
    points = peer.listen(OperatingPoint, f"{TWIN}/operating_point", LATCHED)
    peer.until(lambda: states and points)
    answer = peer.set(NODE, use_sim_time=True)
    assert answer.successful and answer.reason == NO_CLOCK
    pause(peer)
    assert peer.set(NODE, input_torque=80.0).successful
    assert step(peer).message.startswith(NO_CLOCK)
    answer = peer.set(NODE, use_sim_time=False)
    assert answer.successful and answer.reason == ""
    assert step(peer).success
    peer.until(lambda: points[-1].input_torque == 80.0)
    check_verified(logger, tmp_path / "recordings/changed")


def test_a_plant_begins_with_the_first_clock(peer: Peer, start: Start) -> None:
    measured = peer.listen(JointState, f"{TWIN}/measured/joint_states")
    given = ("-p", "use_sim_time:=true", "-p", "duration:=0.5")
    plant = start("planetary_twin.plant", "--ros-args", *given)
    assert peer.state(f"{TWIN}/plant") == "active"
    Ticking(peer, 5.0)
    peer.until(lambda: plant.poll() is not None)
    assert measured and measured[0].header.stamp.sec >= 5


class Recorded:
    """What a live twin publishes, whose time passes once `ready` returns True."""

    def __init__(self, ready: Callable[[], bool]) -> None:
        self.ready = ready
        self.published: list[str] = []

    def listener(self) -> Any:
        """The callbacks of the twin."""
        return SimpleNamespace(
            ready=self.ready,
            has_clock=lambda: True,
            has_room=lambda: True,
            resumed=lambda twin: None,
            retuned=lambda *given: None,
            prepare=lambda window: None,
            publish=lambda: self.published.append("state"),
            changed=lambda change: self.published.append(f"{change.point.backlash:g}"),
        )


def live(record: Recorded) -> LiveTwin:
    twin = pt.Twin(pt.load_scene("paper"))
    setting = SimpleNamespace(tolerance=twin.tolerance, sample_rate=twin.sample_rate)
    quality = SimpleNamespace(setting=setting, relearn=lambda: None, observe=lambda *given: None)
    quality.without_deadline = lambda: quality
    return LiveTwin(twin, 0.01, 1.0, cast(Any, quality), record.listener(), received())


def test_a_step_waits_for_the_recorder_and_publishes_the_operating_point_first() -> None:
    asked = iter([False, False, False])
    record = Recorded(lambda: next(asked, True))
    twin = live(record)
    twin._pause(True)
    twin._change({"backlash": 4e-7})
    twin._steps(0.02, ({},), lambda twin: None)
    assert record.published == ["2e-07", "4e-07", "state", "state"]


def test_a_clock_lost_between_a_change_and_its_interval_withholds_no_operating_point() -> None:
    """`use_sim_time` is set in another thread than that of the twin."""
    asked = iter([True])
    record = Recorded(lambda: next(asked, False))
    twin = live(record)
    twin._commands.change({"backlash": 4e-7})
    assert twin._serve() and twin._run_on()
    assert record.published == ["2e-07", "4e-07", "state"]
