"""Measured joint states and temperatures of a recording."""

import numpy as np
import pytest
from mcap_ros2.writer import Writer

from planetary_twin_py.following.measured_recording import read_recording
from planetary_twin_py.following.sensors import JointNames

HEADER = """
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""
JOINT = "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
DYNAMIC = """std_msgs/Header header
string[] joint_names
control_msgs/InterfaceValue[] interface_values
================================================================================
MSG: control_msgs/InterfaceValue
string[] interface_names
float64[] values
"""
TEMPERATURE = "std_msgs/Header header\nfloat64 temperature\nfloat64 variance\n"


def header(time):
    stamp = {"sec": int(time), "nanosec": round((time % 1) * 1e9)}
    return {"stamp": stamp, "frame_id": ""}


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "rig.mcap"
    with path.open("wb") as stream:
        writer = Writer(stream)
        kinds = {
            name: writer.register_msgdef(f"{package}/msg/{name}", text + HEADER)
            for package, name, text in (
                ("sensor_msgs", "JointState", JOINT + "float64[] effort\n"),
                ("control_msgs", "DynamicJointState", DYNAMIC),
                ("sensor_msgs", "Temperature", TEMPERATURE),
            )
        }

        def write(topic, kind, time, **fields):
            writer.write_message(
                f"/rig/measured/{topic}", kinds[kind], {"header": header(time), **fields},
                round((time + 0.003) * 1e9),
            )  # fmt: skip

        for n in range(4):
            time = 100.0 + 0.01 * n
            write(
                "joint_states", "JointState", time, name=["motor", "load", "other"],
                position=[], velocity=[10.0 + n, -4.0, 7.0], effort=[60.0, 140.0, 1.0] if n else [],
            )  # fmt: skip
        values = [{"interface_names": ["effort", "temperature"], "values": [61.0, 50.0]}]
        write("dynamic_joint_states", "DynamicJointState", 100.05, joint_names=["motor"],
              interface_values=values)  # fmt: skip
        write("oil_temperature", "Temperature", 100.06, temperature=70.0, variance=0.0)
        writer.finish()
    return path


JOINTS = JointNames(input="motor", output="load", topics="joint_states")


def test_joint_states_are_read_by_their_joints(file):
    first, states, _, _ = read_recording(file, JOINTS)
    assert set(first.columns) == {"input_speed", "output_speed"}  # without efforts
    assert list(states.columns["input_speed"]) == [11.0, 12.0, 13.0]
    assert list(states.columns["output_torque"]) == [140.0] * 3
    assert states.time == pytest.approx([100.01, 100.02, 100.03])
    assert states.arrival - states.time == pytest.approx([0.003] * 3, abs=1e-6)


def test_dynamic_joint_states_and_celsius_are_read(file):
    *_, dynamic, oil = read_recording(file, JOINTS)
    assert {name: list(v) for name, v in dynamic.columns.items()} == {"input_torque": [61.0]}
    assert oil.columns["oil_temperature"] == pytest.approx(np.array([343.15]))


def test_a_folder_is_read_and_unknown_joints_are_refused(file):
    assert len(read_recording(file.parent, JOINTS)) == 4
    with pytest.raises(ValueError, match="no JointState or DynamicJointState with the joints 'a'"):
        read_recording(file, JointNames(input="a", output="b", topics="x"))


def test_what_is_no_recording_is_refused(tmp_path):
    text = tmp_path / "rig.mcap"
    text.write_text("time,torque\n")
    with pytest.raises(ValueError, match="is not a readable recording"):
        read_recording(text, JOINTS)
