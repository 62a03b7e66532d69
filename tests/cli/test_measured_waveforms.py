"""`spectrum` of waveforms of other programs, with a speed or a tachometer from anywhere."""

import json
from functools import partial
from pathlib import Path

import command_line
import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet
from scipy.io import wavfile

invoke = partial(command_line.invoke, "spectrum")
succeed = partial(command_line.succeed, "spectrum")

DATA = Path(__file__).parents[1] / "data" / "compact"
RATE = 51_200
TIME = np.arange(2 * RATE) / RATE
TURNS = (900.0 * TIME + 50.0 * TIME**2) / 60.0  # from 900 to 1100 rpm in 2 s
SCENE = ("--scene", "paper", "--order")  # 30 teeth of the sun, which is the input


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    """A run-up with a tone of order 100, and pulses and speeds in files of their own."""
    folder = tmp_path_factory.mktemp("rig")
    wavfile.write(folder / "tone.wav", RATE, (0.5 * np.sin(2 * np.pi * 100 * TURNS)).astype("f4"))
    steady = np.sin(2 * np.pi * 500.0 * TIME).astype("f4")
    wavfile.write(folder / "steady.wav", RATE, steady)
    key = np.where(TURNS % 1.0 < 0.05, 5.0, 0.1).astype("f4")
    wavfile.write(folder / "key.wav", RATE, key)
    whole = np.arange(int(TURNS[-1]) + 1)
    pulses = (-900.0 + np.sqrt(900.0**2 + 4.0 * 50.0 * 60.0 * whole)) / 100.0
    header = {"header": "time [s]", "comments": ""}
    np.savetxt(folder / "pulses.csv", pulses, **header)
    np.savetxt(folder / "missing.csv", np.delete(pulses, 12), **header)
    double = np.sort(np.append(pulses, pulses[12] + 1e-3))
    np.savetxt(folder / "double.csv", double, **header)
    slow = TIME[::512]
    speed = np.column_stack((slow, 900.0 + 100.0 * slow))
    named = {"header": "time [s],speed [rpm]", "comments": "", "delimiter": ","}
    np.savetxt(folder / "speed.csv", speed, **named)
    np.savetxt(folder / "later.csv", np.add(speed, [60.0, 0.0]), **named)
    return folder


def first_line(*arguments):
    done = succeed(*arguments, "--json", "-")
    return json.loads(done.stdout)["lines"][0], done.stderr


@pytest.mark.parametrize(
    ("option", "source", "error", "remark"),
    [
        ("--speed", "speed.csv:speed", 1e-3, "the part in both is analysed"),
        ("--tachometer", "pulses.csv", 1e-3, "the part in both is analysed"),
        ("--tachometer", "missing.csv", 1e-3, "1 pulses are missing, and were added: 0.767"),
        ("--tachometer", "double.csv", 1e-3, "1 pulses are double, and were left out: 0.768"),
        ("--tachometer", "key.wav:channel_1", 3e-3, "the part in both is analysed"),
    ],
)
def test_order_100_of_a_run_up_keeps_its_height(rig, option, source, error, remark):
    """Fyfe and Munck 1997: lines between the pulses would lower it by 1.08 %."""
    line, text = first_line(rig / "tone.wav", *SCENE, option, rig / source, "--full-scale", "10 g")
    assert line["order"] == pytest.approx(100.0, abs=0.01)
    assert line["amplitude"] == pytest.approx(5.0, rel=error)
    assert remark in text


def test_a_level_selects_the_edges_of_a_tachometer(rig):
    given = rig / "tone.wav", *SCENE, "--tachometer", rig / "key.wav"
    assert first_line(*given, "--threshold", 3.0)[0]["order"] == pytest.approx(100.0, abs=0.01)
    done = invoke(*given, "--threshold", 7.0)
    assert done.exit_code == 2 and "--level = 7" not in done.stderr
    assert "level = 7: must be between the extremes" in done.stderr


@pytest.mark.parametrize(("shaft", "order"), [("input", 200.0), ("ring", 200.0 * 30.0 / 70.0)])
def test_pulses_per_turn_and_the_shaft_scale_the_orders(rig, shaft, order):
    """At two pulses a turn the shaft turns half as fast; the sun turns 70/30 times for the ring."""
    given = rig / "tone.wav", *SCENE, "--tachometer", rig / "pulses.csv"
    line, _ = first_line(*given, "--pulses-per-turn", 2, "--shaft", shaft)
    assert line["order"] == pytest.approx(order, rel=1e-4)


def test_tables_without_a_common_time_are_refused(rig):
    done = invoke(rig / "tone.wav", *SCENE, "--speed", f"{rig / 'later.csv'}:speed")
    assert done.exit_code == 2 and done.stderr.count("\n") == 1
    assert (
        "speed from 60 to 61.99 s, samples from 0 to 1.99998 s: these do not overlap" in done.stderr
    )


def test_a_constant_speed_has_a_unit(rig):
    line, text = first_line(rig / "steady.wav", "--order", "--speed", "600 rpm")
    assert line["order"] == pytest.approx(50.0, abs=1e-3) and "assumed" not in text
    assert invoke(rig / "steady.wav", "--order", "--speed", "600 kg").exit_code == 2


@pytest.mark.parametrize(
    ("options", "unit", "factor"),
    [
        ((), "full scale", 1.0),
        (("--full-scale", "10 V"), "V", 10.0),
        (("--full-scale", "10 V", "--sensitivity", "100 mV/g"), "g", 100.0),
        (("--full-scale", "10 V", "--sensitivity", "0.01 V/(m/s^2)"), "m/s^2", 1000.0),
    ],
)
def test_full_scale_and_sensitivity_give_the_unit(rig, options, unit, factor):
    tone = 0.25 * np.sin(2 * np.pi * 500.0 * TIME)
    wavfile.write(rig / "whole.wav", RATE, np.rint(32_767 * tone).astype(np.int16))
    line, text = first_line(rig / "whole.wav", *options)
    assert line["amplitude"] == pytest.approx(0.25 * factor, rel=1e-3)
    shown = invoke(rig / "whole.wav", *options)
    assert f"amplitude [{unit}]" in shown.stdout
    assert ("shares of full scale" in text) == (not options)


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (("--sensitivity", "100 mV/g"), "the samples have no unit; state it by --full-scale"),
        (("--full-scale", "10"), "--full-scale = '10': must be a number, not 0, with a unit"),
        (("--full-scale", "9 kg", "--sensitivity", "1 V/g"), "[kg] cannot be converted to V"),
        (("--tachometer", "1", "--speed", "1"), "--tachometer: replaces --speed"),
        (("--shaft", "output"), "--shaft: needs --speed or --tachometer"),
        (("--pulses-per-turn", 2), "need --tachometer"),
        (("--column", "3"), "no such column; columns: channel_1"),
        (("--speed", "no.csv:speed"), "no.csv: No such file"),
    ],
)
def test_wrong_options_are_refused_in_one_line(rig, options, reason):
    done = invoke(rig / "tone.wav", *options)
    assert done.exit_code == 2 and reason in done.stderr and done.stderr.count("\n") == 1


def test_columns_without_headings_are_named_by_number(tmp_path):
    tone = 3.0 * np.sin(2 * np.pi * 500.0 * TIME)
    np.savetxt(tmp_path / "rig.txt", np.column_stack((TIME, tone)))
    line, _ = first_line(tmp_path / "rig.txt", "--time-column", 1, "--column", "2 [g]")
    assert line["frequency_hz"] == pytest.approx(500.0, abs=1e-3)
    assert line["amplitude"] == pytest.approx(3.0, rel=1e-4)
    done = invoke(tmp_path / "rig.txt", "--column", 2)
    assert done.exit_code == 2 and "--time-column, or give --sample-rate" in done.stderr


@pytest.mark.parametrize(
    ("name", "speed", "place", "cause"),
    [
        ("speed", 10, 25.833, "mesh harmonic 1"),
        ("speed_20", 20, 48.333, "alias of mesh harmonic 1, if it was not filtered"),
        ("speed_30", 30, 22.5, "alias of mesh harmonic 1, if it was not filtered"),
    ],
)
def test_the_measured_rig_shows_its_mesh_line_or_its_alias(tmp_path, name, speed, place, cause):
    """155 teeth of the ring at the speed of the carrier; samples of 100 Hz end at 50 Hz."""
    table = parquet.read_table(DATA / f"{name}.parquet")
    files = []
    for heading in table.column_names:
        files.append(tmp_path / f"{heading[:2].strip()}.parquet")
        parquet.write_table(pa.table({"speed [rpm]": table[heading]}), files[-1])
    done = succeed(
        *files, "--average", "--scene", "compact_actuator", "--sample-rate", 100, "--from", 2,
        "--to", 30, "--speed", f"{speed} rpm", "--shaft", "output", "--json", "-",
    )  # fmt: skip
    found = json.loads(done.stdout)
    (line,) = (one for one in found["lines"] if one["name"] == cause)
    assert line["frequency_hz"] == pytest.approx(place, abs=0.05)
    assert line["chance"] < 1e-12
    assert found["predicted"][0]["found"] and found["predicted"][0]["is_alias"] == (speed > 10)


def test_several_files_are_drawn_beside_each_other(rig, tmp_path):
    given = rig / "tone.wav", rig / "steady.wav", "--order", "--speed", "1000rpm"
    done = succeed(*given, "--out", tmp_path / "both.png", "--json", "-")
    assert [one["file"] for one in json.loads(done.stdout)["spectra"]] == ["tone.wav", "steady.wav"]
    assert (tmp_path / "both.png").read_bytes()[:4] == b"\x89PNG"


def test_sample_rates_that_differ_are_not_averaged(rig, tmp_path):
    wavfile.write(tmp_path / "other.wav", 50_000, np.sin(TIME[:60_000] * 700).astype("f4"))
    done = invoke(rig / "tone.wav", tmp_path / "other.wav", "--average")
    assert done.exit_code == 2 and "sample rates from 50000 to 51200 Hz" in done.stderr
