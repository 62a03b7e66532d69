"""A measured gearbox beside its twin: curves of both, residuals and changes."""

import numpy as np
import pytest
from mcap_ros2.writer import Writer
from view.entity_rows import rows

from planetary_twin_py import load_scene
from planetary_twin_py.recording.ros2.definitions import definition_of
from planetary_twin_py.recording.runs.followed import BALANCE, ESTIMATED
from planetary_twin_py.recording.runs.offline import NAMESPACE, Plan, record
from planetary_twin_py.recording.runs.reader import read_recording

TORQUE, LOSS = 60.0, 1.0  # [N m]
PLACES = {"estimate": "FollowerEstimate", "residuals": "FollowerResiduals",
          "event": "FollowerEvent"}  # fmt: skip


@pytest.fixture(scope="module")
def twin(tmp_path_factory):
    plan = Plan(load_scene("paper"), 0.2, 20_000.0, 1e-3)
    return record(plan, tmp_path_factory.mktemp("bag") / "twin").parent


@pytest.fixture(scope="module")
def recording(twin):
    """The twin, and a follower whose estimates begin before it and end after it."""
    state = read_recording(twin).state
    stamps = np.linspace(state.stamp[0] - 1e8, state.stamp[-1] + 1e8, 9).astype(np.int64)
    with (twin / "follower.mcap").open("wb") as stream:
        writer = Writer(stream)
        kinds = {
            topic: writer.register_msgdef(
                f"planetary_twin_msgs/msg/{name}", definition_of(f"planetary_twin_msgs/msg/{name}")
            )
            for topic, name in PLACES.items()
        }

        def write(topic, stamp, **fields):
            sec, nanosec = divmod(int(stamp), 10**9)
            header = {"stamp": {"sec": sec, "nanosec": nanosec}, "frame_id": ""}
            place = f"{NAMESPACE}/follower/{topic}"
            writer.write_message(place, kinds[topic], {"header": header, **fields}, int(stamp))

        values = dict.fromkeys(ESTIMATED, np.nan) | {
            "input_torque": TORQUE, "input_torque_low": TORQUE - 0.1, "input_speed": -100.0,
            "input_torque_high": TORQUE + 0.1, "loss_torque": LOSS, "friction_level": 1.1,
        }  # fmt: skip
        for stamp in stamps[::-1]:  # in any order
            write("estimate", stamp, **values)
            write("residuals", stamp, **dict.fromkeys(BALANCE, 0.5))
        for size in ("1 %", "2 %"):
            write("event", stamps[4], number=1, what="sun tooth 7 changed", evidence=size)
        writer.finish()
    return read_recording(twin)


def test_measured_and_simulated_torque_share_a_plot(recording, drawn):
    state = recording.state
    found = rows(drawn, "/followed/input_torque")
    times = np.array([time for time, _ in found])
    assert times == pytest.approx(np.linspace(times[0], times[-1], 9), abs=1e-6)
    assert times[0] == pytest.approx(state.time[0] - 0.1, abs=1e-6)
    measured, simulated, low, high = np.array([row for _, row in found]).T
    assert set(measured) == {TORQUE} and set(low) == {TORQUE - 0.1} and set(high) == {TORQUE + 0.1}
    inside = (times >= state.time[0]) & (times <= state.time[-1])
    assert simulated[inside] == pytest.approx(state["input_torque"][0], rel=1e-3)
    assert np.isnan(simulated[~inside]).all() and 0 < inside.sum() < 9
    left = np.array([row[0] for _, row in rows(drawn, "/followed/input_torque_residual")])
    assert left[inside] == pytest.approx((measured - simulated)[inside], abs=1e-9)


def test_the_measured_loss_is_a_power(drawn):
    found = np.array([row for _, row in rows(drawn, "/followed/power_loss")])
    assert set(found[:, 0]) == {LOSS * 100.0}


def test_friction_level_balance_and_changes_are_drawn(drawn):
    assert rows(drawn, "/followed/friction_level")[0][1][0] == 1.1
    assert rows(drawn, "/followed/innovation")[0][1] == [0.5, -1.0, 1.0]
    said = rows(drawn, "/followed/events", "TextLog:text")
    assert [row for _, row in said] == [["sun tooth 7 changed: 2 %"]]
