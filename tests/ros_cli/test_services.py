"""Every service answers `ros2 service call`, and the life cycle `ros2 lifecycle`."""

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


def test_the_operating_point_changes_as_a_whole(ros2: Ros2, twin: str) -> None:
    service, kind = f"{twin}/set_operating_point", f"{MESSAGES}/SetOperatingPoint"
    request = "{names: [backlash, lambda_ratio], values: [3.0e-7, 1.5]}"
    assert "success=True" in ros2.call(service, kind, request)
    assert ros2.value(twin, "backlash") == "3e-07"
    refused = ros2.call(service, kind, "{names: [backlash, gap], values: [1.0e-7, 1.0]}")
    assert "success=False" in refused and "no such quantity; there are backlash" in refused
    assert ros2.value(twin, "backlash") == "3e-07"


def test_natural_modes_are_returned(ros2: Ros2, twin: str) -> None:
    modes = ros2.call(f"{twin}/natural_modes", f"{MESSAGES}/NaturalModes")
    assert "frequencies=[0.0, " in modes and "'rotational'" in modes


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
