"""What runs, what it publishes, and what every field of it means."""

from pathlib import Path

from .command import Ros2

SPEC = Path(__file__).parents[2] / "msgs_spec"
INTERFACES = tuple(
    f"{file.parent.name}/{file.stem}"
    for file in sorted([*SPEC.glob("msg/*.msg"), *SPEC.glob("srv/*.srv")])
)


def test_executables_are_found(ros2: Ros2) -> None:
    listed = ros2("pkg", "executables", "planetary_twin").split("\n")
    for name in ("simulation", "logger", "replay", "twin"):
        assert f"planetary_twin {name}" in listed


def test_the_simulation_is_found_with_its_topics_and_services(ros2: Ros2, twin: str) -> None:
    assert twin in ros2("node", "list").split()
    answer = ros2("node", "info", twin)
    for name in (
        "/planetary_twin/gearbox_state: planetary_twin_msgs/msg/GearboxState",
        "/planetary_twin/joint_states: sensor_msgs/msg/JointState",
        "/diagnostics: diagnostic_msgs/msg/DiagnosticArray",
        f"{twin}/set_operating_point: planetary_twin_msgs/srv/SetOperatingPoint",
        f"{twin}/step: planetary_twin_msgs/srv/Step",
    ):
        assert name in answer


def test_a_message_and_a_field_of_it_are_shown(ros2: Ros2, twin: str) -> None:
    state = ros2.echo("/planetary_twin/gearbox_state")
    assert state["planets"] == 3 and len(state["sun_planet_dte_mean"]) == 7
    assert ros2.echo("/planetary_twin/gearbox_state", "--field", "output_power") > 0
    shown = ros2("topic", "echo", "--once", "/planetary_twin/gearbox_state", "--field", "header")
    assert "frame_id: gearbox" in shown


def test_a_late_subscriber_receives_latched_messages(ros2: Ros2, twin: str) -> None:
    assert ros2.echo("/planetary_twin/operating_point")["input_torque"] == 63.0
    printed = ros2("topic", "echo", "--once", "/planetary_twin/robot_description", "--full-length")
    assert "<robot name=" in printed
    answer = ros2("topic", "info", "-v", "/planetary_twin/operating_point")
    assert "Reliability: RELIABLE" in answer and "Durability: TRANSIENT_LOCAL" in answer


def test_the_interfaces_of_the_package_are_those_of_its_folder(ros2: Ros2) -> None:
    listed = ros2("interface", "package", "planetary_twin_msgs").split()
    assert sorted(listed) == sorted(f"planetary_twin_msgs/{interface}" for interface in INTERFACES)
