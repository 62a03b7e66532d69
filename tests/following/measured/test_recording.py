"""Measured joint states and temperatures of a recording."""

from types import SimpleNamespace

import numpy as np
import pytest
from mcap_ros2.writer import Writer

from planetary_twin_py.following.channels.encoders import EncoderFormat
from planetary_twin_py.following.input_error import InputError
from planetary_twin_py.following.measured.messages import Arrived, MessageReader
from planetary_twin_py.following.measured.recording import read_recording
from planetary_twin_py.following.sensors import JointNames
from planetary_twin_py.recording.ros2.sensor_topics import ENCODERS, SAMPLED

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


def block(first, stamp, counts=2**20):
    """A block of two samples at 20 kHz."""
    seconds, part = divmod(round(stamp * 1e9), 10**9)
    header = SimpleNamespace(stamp=SimpleNamespace(sec=seconds, nanosec=part))
    message = SimpleNamespace(
        header=header, first_sample=first, sample_period=5e-5, input_counts_per_turn=counts,
        output_counts_per_turn=2**18, input_counts=[10, 11], output_counts=[-4, -5],
    )  # fmt: skip
    return Arrived("/rig/encoders", ENCODERS, stamp, message)


def test_encoder_blocks_are_numbered_from_their_stamps():
    reader = MessageReader(JOINTS)
    (samples,) = reader.read([block(700, 1000.0), block(704, 1000.00025)])  # the stamp is late
    begin = round(1000.0 / 5e-5)
    assert list(samples.sample - begin) == [0, 1, 4, 5]
    assert samples.counts.tolist() == [[10, -4], [11, -5]] * 2
    assert samples.format == EncoderFormat((2**20, 2**18), 5e-5)
    (later,) = reader.read([block(0, 1003.0)])  # the device has restarted
    assert list(later.sample) == [round(1003.0 / 5e-5) + n for n in (0, 1)]


def test_counts_of_one_encoder_are_not_used_and_named():
    reader, one = MessageReader(JOINTS), block(0, 1.0)
    one.message.output_counts, one.message.output_counts_per_turn = [], 0
    assert list(reader.read([one])) == []
    assert [*reader.remarks()] == [
        "/rig/encoders: counts of one encoder, and teeth need both of one device: not used"
    ]


def test_messages_whose_stamp_was_never_set_are_named():
    reader, unset = MessageReader(JOINTS), header(0.0)["stamp"]
    state = SimpleNamespace(
        header=SimpleNamespace(stamp=SimpleNamespace(**unset)), name=["motor"], position=[],
        velocity=[10.0], effort=[],
    )  # fmt: skip
    list(reader.read([Arrived("/rig/joints", "sensor_msgs/msg/JointState", 5.0, state)]))
    assert "1 messages have the stamp 0" in next(reader.remarks())


def test_samples_of_a_torque_are_no_vibration():
    reader, torque = MessageReader(JOINTS), vibration(5.0, [1, 2])
    torque.message.units = ["N m", "N m"]
    assert list(reader.read([torque])) == []
    assert "read from joint states: not used" in next(reader.remarks())


@pytest.mark.parametrize("kind", ["encoders", "vibration"])
def test_two_devices_with_the_same_channels_are_refused(kind):
    one = block(0, 1.0) if kind == "encoders" else vibration(1.0, [1, 2])
    said = f"/rig/{kind} and /other/{kind}: both send .*: follow one of them"
    with pytest.raises(InputError, match=said):
        list(MessageReader(JOINTS).read([one, one._replace(sender=f"/other/{kind}")]))


def test_encoder_blocks_of_another_format_are_refused():
    reader = MessageReader(JOINTS)
    list(reader.read([block(0, 1.0)]))
    with pytest.raises(InputError, match="must be 1048576, 262144, 5e-05 s as in the blocks"):
        list(reader.read([block(2, 1.0001, counts=4096)]))
    with pytest.raises(InputError, match="must be at least 1"):
        list(MessageReader(JOINTS).read([block(0, 1.0, counts=0)]))


def vibration(stamp, samples, names=("housing", "bearing"), period=1e-3):
    """A block of vibration."""
    seconds, part = divmod(round(stamp * 1e9), 10**9)
    header = SimpleNamespace(stamp=SimpleNamespace(sec=seconds, nanosec=part))
    message = SimpleNamespace(
        header=header, sample_period=period, names=list(names), units=["m/s^2"] * len(names),
        samples=samples,
    )  # fmt: skip
    return Arrived("/rig/vibration", SAMPLED, stamp, message)


def test_blocks_of_vibration_are_read_channel_by_channel():
    reader = MessageReader(JOINTS)
    (found,) = reader.read([vibration(5.0, [1, 2, 10, 20]), vibration(5.002, [3, 30])])
    assert found.values.tolist() == [[1.0, 10.0], [2.0, 20.0], [3.0, 30.0]]
    assert found.time == pytest.approx([5.0, 5.001, 5.002])
    assert (found.names, found.period) == (("housing", "bearing"), 1e-3)


@pytest.mark.parametrize(
    ("block", "said"),
    [
        (vibration(6.0, [1, 2], names=("housing", "motor")), "must be housing, bearing, 0.001 s"),
        (vibration(6.0, [1, 2], period=2e-3), "must be housing, bearing, 0.001 s as in the blocks"),
        (vibration(6.0, [1, 2, 3]), "3 samples: must be the same number of each of the 2 channels"),
    ],
)
def test_other_blocks_of_vibration_are_refused(block, said):
    reader = MessageReader(JOINTS)
    list(reader.read([vibration(5.0, [1, 2])]))
    with pytest.raises(InputError, match=said):
        list(reader.read([block]))
