"""Services answer `ros2 service call`, and the life cycle `ros2 lifecycle`."""

from .command import Ros2

MESSAGES = "planetary_twin_msgs/srv"


def test_time_pauses_steps_and_starts_again(ros2: Ros2, twin: str) -> None:
    assert "paused from " in ros2.call(f"{twin}/pause", "std_srvs/srv/SetBool", "{data: true}")
    step = ros2.call(f"{twin}/step", f"{MESSAGES}/Step", "{duration: 0.01}")
    assert "success=True" in step and "simulated_time=" in step
    refused = ros2.call(f"{twin}/step", f"{MESSAGES}/Step", "{duration: .nan}")
    assert (
        "success=False" in refused and "duration = nan s: must be within 1e-06 and 10 s" in refused
    )
    assert "runs from " in ros2.call(f"{twin}/pause", "std_srvs/srv/SetBool", "{data: false}")
    assert "starts again at 0 s" in ros2.call(f"{twin}/reset", "std_srvs/srv/Trigger")


def test_the_life_cycle_is_completed(ros2: Ros2, twin: str) -> None:
    assert twin in ros2("lifecycle", "nodes").split()
    assert "- deactivate [4]" in ros2("lifecycle", "list", twin)
    for transition, state in (
        ("deactivate", "inactive [2]"),
        ("cleanup", "unconfigured [1]"),
        ("configure", "inactive [2]"),
        ("activate", "active [3]"),
    ):
        assert "Transitioning successful" in ros2("lifecycle", "set", twin, transition)
        assert ros2("lifecycle", "get", twin).strip() == state
    assert "Unknown transition requested" in ros2("lifecycle", "set", twin, "configure")
