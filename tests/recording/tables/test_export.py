"""Exported tables contain the values that another reader finds, bit for bit, with units."""

import csv
import json
from functools import partial

import numpy as np
import pytest
from command_line import invoke, succeed
from pyarrow import parquet
from rosbags.highlevel import AnyReader
from twin_recording import NAMESPACE

import planetary_twin_py as pt
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.offline import Plan
from planetary_twin_py.recording.runs.offline import record as record_plan
from planetary_twin_py.recording.runs.what_if import resimulate
from planetary_twin_py.recording.tables import message_rows

MESHES = [f"{kind}_{n}" for kind in ("sun_planet", "planet_ring") for n in (1, 2, 3)]

export = partial(invoke, "export")
exported = partial(succeed, "export")


@pytest.fixture(scope="module")
def messages(sound):
    """Messages by topic, decoded by rosbags."""
    found = {}
    with AnyReader([sound.parent]) as bag:
        for connection, _, raw in bag.messages():
            message = bag.deserialize(raw, connection.msgtype)
            found.setdefault(connection.topic.removeprefix(f"{NAMESPACE}/"), []).append(message)
    return found


def read_parquet(path):
    table = parquet.read_table(path)
    units = {field.name: field.metadata[b"unit"].decode() for field in table.schema}
    return {name: table[name].to_numpy() for name in table.column_names}, units


def read_csv(path):
    with path.open(newline="") as stream:
        names, *rows = list(csv.reader(stream))
    columns = dict(zip(names, map(list, zip(*rows, strict=True)), strict=True))
    units = json.loads(path.with_suffix(".units.json").read_text())
    return columns, units


def read_npz(path):
    with np.load(path) as stored:
        units = dict(zip(stored["columns"].tolist(), stored["units"].tolist(), strict=True))
        return {name: stored[name] for name in units}, units


READ = {"parquet": read_parquet, "csv": read_csv, "npz": read_npz}


def same(column, expected):
    """Whether a column has exactly these values; texts are converted first."""
    expected = np.asarray(expected)
    found = np.array(column).astype(expected.dtype)
    if isinstance(column, list) and expected.dtype.kind == "f":  # a text has only one NaN
        expected = np.where(np.isnan(expected), found.dtype.type(np.nan), expected)
    return found.tobytes() == expected.tobytes()


@pytest.mark.parametrize("kind", READ)
def test_values_are_the_recorded_ones_to_the_last_bit(sound, messages, tmp_path, monkeypatch, kind):
    monkeypatch.setattr(message_rows, "MESSAGES", 7)  # per batch, so that there are several
    exported(sound, "--out", tmp_path / "tables", "--format", kind)
    state, units = READ[kind](tmp_path / "tables" / f"gearbox_state.{kind}")
    expected = messages["gearbox_state"]
    count = 1  # the stamp
    for name in vars(expected[0]).keys() - {"header", "__msgtype__"}:
        values = np.array([getattr(message, name) for message in expected])
        for n, column in enumerate(values.T[:3] if values.ndim > 1 else [values]):
            assert same(state[f"{name}_{n + 1}" if values.ndim > 1 else name], column), name
            count += 1
    assert len(state) == count
    assert same(
        state["stamp"], [m.header.stamp.sec * 10**9 + m.header.stamp.nanosec for m in expected]
    )
    assert (units["power_loss"], units["sun_planet_dte_rms_2"], units["stamp"]) == ("W", "m", "ns")
    assert units["planet_speed_1"] == "rad/s" and units["planets"] == "-"

    point, units = READ[kind](tmp_path / "tables" / f"operating_point.{kind}")
    expected = messages["operating_point"]
    assert list(point["changed"]) == [m.changed for m in expected]
    assert same(point["backlash"], [m.backlash for m in expected])
    assert (units["input_torque"], units["changed"]) == ("N m", "")

    wave, units = READ[kind](tmp_path / "tables" / f"mesh_waveform.{kind}")
    blocks = messages["mesh_waveform"]
    for quantity in ("dte", "mesh_force", "friction"):
        for mesh, name in enumerate(MESHES):
            samples = [getattr(m, quantity).reshape(6, -1)[mesh] for m in blocks]
            assert same(wave[f"{quantity}_{name}"], np.concatenate(samples))
    time = [m.start_time + np.arange(m.samples) * m.sample_period for m in blocks]
    assert same(wave["time"], np.concatenate(time))
    assert (units["dte_planet_ring_1"], units["time"]) == ("m", "s")

    joints, units = READ[kind](tmp_path / "tables" / f"joint_states.{kind}")
    expected = messages["joint_states"]
    assert len(joints) == 1 + 3 * len(expected[0].name)
    for field, unit in (("position", "rad"), ("velocity", "rad/s"), ("effort", "N m")):
        for n, joint in enumerate(expected[0].name):
            assert same(joints[f"{field}_{joint}"], [getattr(m, field)[n] for m in expected])
            assert units[f"{field}_{joint}"] == unit


def test_commands_are_exported_with_nan_where_none_was_given(tmp_path):
    step, torque = 0.01, [63.0, 62.0, 61.0]
    plan = Plan(pt.load_scene("paper"), len(torque) * step, 10_000.0, 1e-3)
    machine = record_plan(plan, tmp_path / "machine").parent
    course = pt.Commands(step * np.arange(len(torque)), input_torque=torque)
    resimulate(machine, NAMESPACE, Branch({}, commands=course), tmp_path / "driven")
    exported(tmp_path / "driven", "--out", tmp_path / "t", "--topics", "applied_commands")
    given, units = read_parquet(tmp_path / "t" / "applied_commands.parquet")
    assert list(given["effort_sun_joint"]) == torque
    assert units["effort_sun_joint"] == "N m"
    missing = given.keys() - {"stamp", "effort_sun_joint"}
    assert missing == {"effort_ring_joint"} | {
        f"{field}_{side}_joint" for field in ("position", "velocity") for side in ("sun", "ring")
    }
    assert all(np.isnan(given[name]).all() for name in missing)


def test_one_topic_can_be_one_file(sound, tmp_path):
    file = tmp_path / "points.csv"
    answer = exported(sound, "--out", file, "--topics", "operating_point")
    assert f"{file}: 3 rows" in answer.output
    assert len(read_csv(file)[0]["backlash"]) == 3


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("--format", "xls"), ["--format = 'xls'", "parquet, csv, npz"]),
        (
            ("--topics", "tf"),
            ["--topics = tf", "gearbox_state, operating_point, joint_states, mesh_waveform"],
        ),
        (("--out", "all.npz"), ["--out = all.npz", "a file takes one topic"]),
        (("--out", "all.txt"), ["--out = 'all.txt'", ".parquet, .csv, .npz"]),
        (("--out", "there"), ["there/gearbox_state.parquet", "exists"]),
        (("--out", "/proc/tables"), ["/proc/tables"]),
        (("--namespace", "other"), ["--namespace = /other"]),
    ],
)
def test_invalid_arguments_end_in_one_line(sound, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there").mkdir()
    (tmp_path / "there" / "gearbox_state.parquet").touch()
    answer = export(sound, "--out", "tables", *arguments)
    assert answer.exit_code == 2, answer.output
    assert answer.stderr.count("\n") == 1 and all(word in answer.stderr for word in words)
