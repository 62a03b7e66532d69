"""`ros2 launch` starts twins that do not disturb one another, and ends them cleanly."""

import os
import re
import signal
import time
from pathlib import Path

from rosbags.rosbag2 import Reader

from .command import Ros2

LAUNCH = ("launch", "planetary_twin", "twin.launch.py")
FOLLOW = ("launch", "planetary_twin", "follow.launch.py")
ARGUMENTS = (
    "scene", "namespace", "frame_prefix", "record", "respawn", "rate_factor", "params_file",
    "params", "use_sim_time", "log_level", "domain", "use_composition", "composed",
)  # fmt: skip


def test_every_argument_is_described(ros2: Ros2) -> None:
    output = ros2(*LAUNCH, "-s")
    for name in ARGUMENTS:
        _, _, after = output.partition(f"'{name}':\n")
        description, default = after.splitlines()[:2]
        assert len(description.strip()) > 10 and "(default: " in default, name


def test_twins_of_two_namespaces_run_and_record_side_by_side(ros2: Ros2) -> None:
    """One of them in one process, at another rate."""
    left = ros2.start(*LAUNCH, "namespace:=left", "frame_prefix:=left/")
    options = ("frame_prefix:=right/", "use_composition:=true", "rate_factor:=0.5")
    right = ros2.start(*LAUNCH, "namespace:=right", *options)
    for name in ("left", "right"):
        ros2.until("active [3]", "lifecycle", "get", f"/{name}/simulation")
        ros2.until("active [3]", "lifecycle", "get", f"/{name}/logger")
    assert ros2.value("/right/simulation", "rate_factor") == "0.5"
    for name in ("left", "right"):
        state = ros2.echo(f"/{name}/gearbox_state")
        assert state["header"]["frame_id"] == f"{name}/gearbox"
    ros2("param", "set", "/left/simulation", "backlash", "3e-7")
    assert ros2.value("/left/simulation", "backlash") == "3e-07"
    assert ros2.value("/right/simulation", "backlash") == "2e-07"
    assert [ros2.interrupt(process) for process in (left, right)] == [0, 0]
    for name, other in (("left", "right"), ("right", "left")):
        (bag,) = Path(ros2.folder, "recordings").glob(f"{name}_*")
        with Reader(bag) as reader:
            topics = {c.topic: c.msgcount for c in reader.connections}
        assert topics[f"/{name}/gearbox_state"] > 100
        assert not any(topic.startswith(f"/{other}/") for topic in topics)


def test_a_twin_in_another_domain_is_not_discovered(ros2: Ros2) -> None:
    params = ros2.folder / "params.yaml"
    params.write_text("/**:\n  ros__parameters:\n    backlash: 1.5e-7\n", encoding="utf-8")
    options = ("domain:=230", "namespace:=far", "scene:=run_up", "record:=false")
    far = ros2.start(*LAUNCH, *options, f"params_file:={params}", "log_level:=debug")
    away = Ros2(230, ros2.folder)
    try:
        away.until("active [3]", "lifecycle", "get", "/far/simulation")
        assert away.value("/far/simulation", "scene") == "run_up"
        assert away.value("/far/simulation", "backlash") == "1.5e-07"
        assert "/far/logger" not in away("node", "list").split()
        assert "/far/simulation" not in ros2("node", "list").split()
    finally:
        away("daemon", "stop")
    assert ros2.interrupt(far) == 0
    assert "[DEBUG]" in ros2.output(far)


def test_deprecated_names_of_arguments_work(ros2: Ros2) -> None:
    params = ros2.folder / "older.yaml"
    params.write_text("/**:\n  ros__parameters:\n    backlash: 1.5e-7\n", encoding="utf-8")
    older = ("composed:=true", f"params:={params}")
    process = ros2.start(*LAUNCH, *older, "namespace:=older", "use_sim_time:=true")
    ros2.until("active [3]", "lifecycle", "get", "/older/simulation")
    assert ros2.value("/older/simulation", "backlash") == "1.5e-07"
    assert ros2.value("/older/simulation", "use_sim_time") == "True"
    assert ros2.interrupt(process) == 0
    output = ros2.output(process)
    assert "[twin-" in output and "use_sim_time: waits for the first message on /clock" in output


def test_a_scene_keeps_its_operating_point(ros2: Ros2) -> None:
    light = ros2.start(*LAUNCH, "namespace:=light", "scene:=lightly_loaded", "record:=false")
    ros2.until("active [3]", "lifecycle", "get", "/light/simulation")
    assert ros2.value("/light/simulation", "input_torque") == "0.3"
    assert ros2.value("/light/simulation", "torque_ripple") == "1.0"
    assert ros2.interrupt(light) == 0


def test_a_simulation_that_cannot_start_ends_the_launch(ros2: Ros2) -> None:
    process = ros2.start(*LAUNCH, "namespace:=wrong", "rate_factor:=1000.0")
    process.wait(60)
    output = ros2.output(process)
    assert "simulation: " in output and "rate_factor" in output
    assert "Traceback" not in output
    assert "/wrong/logger" not in ros2("node", "list").split()


def test_a_follower_uses_the_given_topics_and_parameters(ros2: Ros2) -> None:
    params = ros2.folder / "follower.yaml"
    params.write_text("/**:\n  ros__parameters:\n    publish_rate: 5.0\n", encoding="utf-8")
    topics = {
        "joint_states": "/rig/joints", "dynamic_joint_states": "/rig/dynamic",
        "vibration": "/rig/vibration",
    }  # fmt: skip
    given = [f"{name}:={topic}" for name, topic in topics.items()]
    options = ("namespace:=machine", f"params_file:={params}", "use_composition:=true")
    launched = ros2.start(*FOLLOW, *given, *options)
    joints = "{name: [input_joint, output_joint], velocity: [100.0, -43.0]}"
    sent = ros2.start("topic", "pub", "-r", "50", "/rig/joints", "sensor_msgs/JointState", joints)
    # The logger records the topic whatever its type: the right one may not be installed.
    other = ros2.start("topic", "pub", "-r", "50", "/rig/dynamic", "std_msgs/String", "{data: x}")
    ros2.until("active [3]", "lifecycle", "get", "/machine/follower")
    assert ros2.value("/machine/follower", "publish_rate") == "5.0"
    subscribed = ros2("node", "info", "/machine/follower").partition("Publishers:")[0]
    assert "/rig/joints: " in subscribed and "/rig/vibration: " in subscribed
    ros2.until("/rig/dynamic", "topic", "echo", "--once", "/machine/logger/status")
    for process in (sent, other):
        ros2.interrupt(process)
    assert ros2.interrupt(launched) == 0
    assert "[recorded_follower-" in ros2.output(launched)
    (bag,) = Path(ros2.folder, "recordings").glob("machine_*")
    with Reader(bag) as reader:
        counts = {connection.topic: connection.msgcount for connection in reader.connections}
    assert counts["/rig/joints"] and counts["/rig/dynamic"]


def test_a_killed_logger_starts_again_with_respawn(ros2: Ros2) -> None:
    twin = ros2.start(*LAUNCH, "namespace:=again", "respawn:=true")
    ros2.until("active [3]", "lifecycle", "get", "/again/logger")
    (started,) = re.findall(r"\[logger-\d\]: process started with pid \[(\d+)\]", ros2.output(twin))
    os.kill(int(started), signal.SIGKILL)
    deadline = time.monotonic() + 60.0
    while len(list(Path(ros2.folder, "recordings").glob("again_*"))) < 2:
        assert time.monotonic() < deadline, ros2.output(twin)
        time.sleep(0.1)
    assert ros2.interrupt(twin) == 0
