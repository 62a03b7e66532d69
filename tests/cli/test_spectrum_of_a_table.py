"""Spectrum of a vibration in a table: tones of known amplitude, with the harmonics of a scene."""

import json
import re
from functools import partial

import command_line
import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet
from scipy import io

from planetary_twin_py.analysis.spectra.spectrum import amplitude_spectrum, strongest_lines
from planetary_twin_py.recording.tables.units_file import write_units

invoke = partial(command_line.invoke, "spectrum")
succeed = partial(command_line.succeed, "spectrum")

RATE = 25_600.0  # [Hz]
MESH = 499.0  # [Hz] of the gears of `paper` at 998 rpm
SIDEBAND = 998.0 / 60.0  # [Hz] one turn of the sun
NAME = "acceleration [m/s^2]"


def save(file, heading, *columns, fmt="%.9g"):
    """Write a table in CSV."""
    rows = np.column_stack(columns)
    np.savetxt(file, rows, delimiter=",", header=heading, comments="", fmt=fmt)


def vibration():
    """Two seconds with two mesh harmonics and a pair of sidebands."""
    time = np.arange(0.0, 2.0, 1.0 / RATE)
    modulation = 1.0 + 0.1 * np.cos(2.0 * np.pi * SIDEBAND * time)
    first = 0.8 * modulation * np.sin(2.0 * np.pi * MESH * time)
    return time, first + 0.3 * np.sin(2.0 * np.pi * 2.0 * MESH * time + 1.0)


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    file = tmp_path_factory.mktemp("measured") / "vibration.csv"
    save(file, f"time [s],{NAME}", *vibration())
    return file


def lines(*arguments):
    done = succeed(*arguments, "--json", "-")
    return json.loads(done.stdout)["lines"]


def test_tones_have_their_amplitudes_and_harmonics(table):
    found = lines(table, "--scene", "paper", "--set", "input_speed=998 rpm")[:4]
    expected = ((MESH, 0.8, 1), (2.0 * MESH, 0.3, 2))
    for line, (frequency, amplitude, harmonic) in zip(found, expected, strict=False):
        assert line["frequency_hz"] == pytest.approx(frequency, abs=0.05)
        assert line["amplitude"] == pytest.approx(amplitude, rel=0.01)
        assert line["harmonic"] == harmonic and line["alias_of_harmonic"] is None
    sidebands = sorted(line["frequency_hz"] for line in found[2:])
    assert sidebands == pytest.approx([MESH - SIDEBAND, MESH + SIDEBAND], abs=0.1)
    assert [line["amplitude"] for line in found[2:]] == pytest.approx([0.04, 0.04], rel=0.02)


@pytest.mark.parametrize(
    ("options", "axis", "place"),
    [((), "frequency_hz", SIDEBAND), (("--order",), "order", 1.0)],
)
def test_the_squared_envelope_of_a_band_has_the_modulation(table, options, axis, place):
    """0.64 (1 + 0.1 cos)^2 has 0.128 at the modulation, and 0.0032 at twice that."""
    scene = "--scene", "paper", "--set", "input_speed=998 rpm"
    done = succeed(table, *scene, *options, "--envelope", "400:600", "--json", "-")
    found = json.loads(done.stdout)
    assert found["mean"] == pytest.approx(0.64 * 1.005, rel=1e-3)
    assert found["quantity"] == "squared envelope of acceleration"
    first, second = found["lines"][:2]
    assert first[axis] == pytest.approx(place, rel=1e-3)
    assert first["amplitude"] == pytest.approx(0.128, rel=0.01)
    assert first["name"].startswith("1x sun")
    assert second["amplitude"] == pytest.approx(0.0032, rel=0.05)
    assert "[(m/s^2)^2]" in done.stderr


def test_orders_count_the_turns_of_the_sun(table):
    found = lines(table, "--scene", "paper", "--set", "input_speed=998 rpm", "--order")
    assert found[0]["order"] == pytest.approx(30.0, abs=0.01)
    assert sorted(line["order"] for line in found[2:4]) == pytest.approx([29.0, 31.0], abs=0.02)


def test_a_sample_rate_replaces_a_missing_time(tmp_path):
    file = tmp_path / "vibration.csv"
    save(file, "acceleration", vibration()[1])
    assert lines(file, "--sample-rate", RATE)[0]["frequency_hz"] == pytest.approx(MESH, abs=0.05)
    done = invoke(file)
    assert done.exit_code == 2 and "missing" in done.stderr and "give --sample-rate" in done.stderr


@pytest.mark.parametrize(
    ("decimals", "rate", "contradicts"),
    [(9, RATE, False), (3, RATE, False), (9, 0.5 * RATE, True), (9, 1.001 * RATE, True)],
)
def test_a_sample_rate_that_contradicts_the_time_is_reported(tmp_path, decimals, rate, contradicts):
    file = tmp_path / "vibration.csv"
    save(file, "time,a", *vibration(), fmt=f"%.{decimals}f")
    done = invoke(file, "--sample-rate", rate)
    words = f"--sample-rate = {rate:g} Hz contradicts the column 'time', whose stamps are 25600 Hz"
    assert done.exit_code == 0 and (words in done.stderr) == contradicts
    assert len(done.stderr.splitlines()) == contradicts


def test_a_doubled_stamp_is_stated_where_the_mean_rate_agrees(tmp_path):
    file, (time, values) = tmp_path / "vibration.csv", vibration()
    time[1001::500] = time[1000::500][: len(time[1001::500])]
    save(file, "time,a", time, values)
    said = invoke(file, "--sample-rate", RATE).stderr
    assert "whose stamp in row 1002 is not later than the one before" in said
    assert "by --from and --to, or give --sample-rate" in invoke(file).stderr


def test_rounded_stamps_give_the_lines_of_even_steps(tmp_path):
    file, (time, values) = tmp_path / "vibration.csv", vibration()
    save(file, "time [ms],a", 1e3 * time, values, fmt=["%.2f", "%.9f"])
    assert "rounded to 1e-05 s: equal steps that fit them are used, 25600 Hz" in invoke(file).stderr
    first, second = lines(file)[:2]
    assert first["frequency_hz"] == pytest.approx(MESH, abs=0.05)
    assert [first["amplitude"], second["amplitude"]] == pytest.approx([0.8, 0.3], rel=0.01)


def test_one_of_several_columns_is_chosen_by_its_name(tmp_path):
    file, (time, values) = tmp_path / "vibration.csv", vibration()
    rows = np.column_stack((time, values, 2.0 * values))
    np.savetxt(file, rows, delimiter=";", header="time [s];radial [g];axial [g]", comments="")
    assert lines(file, "--column", "axial")[0]["amplitude"] == pytest.approx(1.6, rel=0.01)
    compared = invoke(f"{file}:radial", f"{file}:axial", "--json", "-")
    found = [each["lines"][0]["amplitude"] for each in json.loads(compared.stdout)["spectra"]]
    assert found == pytest.approx([0.8, 1.6], rel=0.01)
    for given in ((), ("--column", "tangential")):
        done = invoke(file, *given)
        assert done.exit_code == 2 and "columns: radial, axial" in done.stderr
        assert len(done.stderr.splitlines()) == 1


@pytest.fixture(scope="module")
def run_up(tmp_path_factory):
    """A vibration of 30 cycles per turn with amplitude 0.8, while the speed rises by 20 %."""
    file = tmp_path_factory.mktemp("measured") / "run_up.csv"
    time = np.arange(0.0, 2.0, 1.0 / RATE)
    turns = 15.0 * time + 0.75 * time**2
    rpm = 60.0 * (15.0 + 1.5 * time)
    save(
        file,
        "Time (s),Acceleration (m/s2),Motor speed (rpm)",
        time,
        0.8 * np.sin(2.0 * np.pi * 30.0 * turns),
        rpm,
        fmt="%.12g",
    )
    return file


def test_orders_follow_a_measured_speed(run_up):
    for options in ((), ("--scene", "paper")):
        line = lines(run_up, "--order", "--speed", "Motor speed", *options)[0]
        assert line["order"] == pytest.approx(30.0, abs=0.01)
        assert line["amplitude"] == pytest.approx(0.8, rel=0.01)


def test_orders_at_an_assumed_speed_come_with_a_remark(run_up):
    options = ("--column", "Acceleration", "--order", "--scene", "paper")
    done = invoke(run_up, *options)
    assert "the speed is assumed to be constant, 16.6667 turns" in done.stderr
    assert "assumed" not in invoke(run_up, "--order", "--speed", "Motor speed").stderr


def test_lines_that_a_varying_speed_lowers_are_remarked(run_up):
    done = invoke(run_up, "--speed", "Motor speed")
    words = r"the speed varies: lines above [3-6]\.\d+ Hz that follow it are more than 1 % too low"
    assert re.search(words, done.stderr)
    assert "the speed varies" not in invoke(run_up, "--speed", "Motor speed", "--order").stderr


@pytest.mark.parametrize("options", [(), ("--scene", "paper")])
def test_a_speed_that_reverses_has_no_mesh_frequency(tmp_path, options):
    file, time = tmp_path / "reversing.csv", np.arange(0.0, 2.0, 2e-4)
    speed = 50.0 * np.sin(2.0 * np.pi * time)
    save(file, "time [s],a [m/s^2],speed [rad/s]", time, np.sin(600.0 * np.pi * time), speed)
    done = invoke(file, "--speed", "speed", *options)
    (remark,) = done.stderr.splitlines()
    assert "times its rms, 35.4 rad/s: there is no mesh frequency" in remark
    assert "sidebands of" not in done.stdout and "mesh harmonic" not in done.stdout
    half = ("--speed", "speed", *options, "--to", 0.5, "--json", "-")
    assert "no mesh frequency" not in invoke(file, *half).stderr
    orders = {line["mesh_orders"] is None for line in lines(file, *half[:-2])}
    assert orders == {not options}


def test_a_measured_speed_without_a_unit_comes_with_a_remark(tmp_path):
    file, time = tmp_path / "a.csv", np.arange(0.0, 1.0, 1e-3)
    columns = time, np.sin(200.0 * np.pi * time), 600.0 + 0.0 * time
    for heading, remarks in (("speed", 1), ("speed [rpm]", 0)):
        save(file, f"time,a,{heading}", *columns)
        said = invoke(file, "--order", "--speed", "speed").stderr
        assert said.count("column 'speed' has no unit and is read in rad/s") == remarks


def test_lines_with_undetermined_amplitudes_are_counted(tmp_path):
    turns = np.arange(2000) / 2000.0
    for cycles, words in (
        ((1.3, 300.0), "1 of these lines have fewer than 2 cycles in the record"),
        ((300.0, 303.0), "1 of these lines are less than 4 times the resolution above another"),
        ((20.0, 300.0), ""),
    ):
        tones = sum(np.sin(2.0 * np.pi * count * turns) for count in cycles)
        file = tmp_path / "a.csv"
        save(file, "a", tones)
        shown = invoke(file, "--sample-rate", 1000.0).stdout
        assert words in shown and (words or "of these lines" not in shown)


def most_too_low(low, high):
    """Largest share that a tone lacks of its height 1, with this many cycles in the record."""
    turns = np.arange(1000) / 1000.0
    tones = [
        np.sin(2.0 * np.pi * cycles * turns + phase)
        for cycles in np.linspace(low, high, 20, endpoint=False)
        for phase in np.linspace(0.0, np.pi, 20)
    ]
    return max(1.0 - strongest_lines(*amplitude_spectrum(tone, 1.0), 1)[0][1] for tone in tones)


def test_stated_errors_of_few_cycles_are_those_of_tones(tmp_path):
    file = tmp_path / "a.csv"
    save(file, "a", np.sin(2.0 * np.pi * 1.3 * np.arange(2000) / 2000.0))
    shown = invoke(file, "--sample-rate", 1000.0).stdout
    stated = re.search(
        r"up to (\d+) % too low from 1.5 cycles, (\d+) % from one, more below", shown
    )
    assert stated is not None
    for share, (low, high) in zip(stated.groups(), ((1.5, 2.0), (1.0, 1.5)), strict=True):
        assert most_too_low(low, high) == pytest.approx(0.01 * int(share), abs=0.005)
    assert most_too_low(0.6, 1.0) > 0.42 and most_too_low(2.0, 3.0) < 0.02


def test_lines_at_drifting_stamps_have_their_amplitudes(tmp_path):
    file, number = tmp_path / "vibration.csv", np.arange(25_600)
    time = np.cumsum(1.0 + 0.01 * number / len(number)) / RATE
    turns = 15.0 * time + 0.75 * time**2
    values = 0.8 * np.sin(2.0 * np.pi * 30.0 * turns)
    tones = 0.8 * np.sin(2.0 * np.pi * 500.0 * time) + 0.5 * np.sin(2e4 * np.pi * time)
    save(file, "time,a,of_orders,shaft [rev/s]", time, tones, values, 15.0 + 1.5 * time)
    found = lines(file, "--column", "a")[:2]
    assert [line["frequency_hz"] for line in found] == pytest.approx([500.0, 1e4], rel=1e-5)
    assert [line["amplitude"] for line in found] == pytest.approx([0.8, 0.5], rel=0.01)
    line = lines(file, "--column", "of_orders", "--speed", "shaft", "--order")[0]
    assert line["order"] == pytest.approx(30.0, abs=0.01)
    assert line["amplitude"] == pytest.approx(0.8, rel=0.01)
    said = invoke(file, "--column", "a").stderr.splitlines()
    assert (
        len(said) == 1 and "the time stamps deviate from equal steps by up to 31.8 sam" in said[0]
    )


def test_what_is_wrong_outside_of_the_interval_does_not_matter(tmp_path):
    file, (time, values) = tmp_path / "vibration.csv", vibration()
    values[:5], time[-100:] = np.nan, time[-100:] + 3.0
    time[3] = np.nan
    save(file, "time,a", time, values, fmt="%.9f")
    inside = ("--from", 0.5, "--to", 1.5)
    done = invoke(file, *inside, "--json", "-")
    assert done.exit_code == 0 and "planetary-twin: " not in done.stderr
    figures = json.loads(done.stdout)
    assert (figures["from_s"], figures["to_s"]) == pytest.approx((0.5, 1.5), abs=1e-9)
    assert figures["lines"][0]["amplitude"] == pytest.approx(0.8, rel=0.01)
    assert "row 1: a: has no value" in invoke(file, "--to", 1.5).stderr
    assert f"row {len(time) - 99}: time" in invoke(file, "--from", 0.5).stderr
    assert "planetary-twin" not in invoke(file, *inside, "--sample-rate", RATE).stderr
    nothing = invoke(file, "--from", 7.0).stderr
    assert "from 7 to 4.99996 s: 0 rows; the table runs from 0 to 4.99996 s" in nothing


def test_the_unit_of_a_parquet_column_may_be_in_its_metadata(tmp_path):
    time = np.arange(2000) / 1000.0
    stated = [("time", "ms", 1e3 * time), ("acceleration", "m/s^2", np.sin(200.0 * np.pi * time))]
    schema = pa.schema(
        [pa.field(name, pa.float64(), metadata={"unit": unit}) for name, unit, _ in stated]
    )
    table = pa.table([values for _, _, values in stated], schema=schema)
    parquet.write_table(table, tmp_path / "vibration.parquet")
    done = succeed(tmp_path / "vibration.parquet")
    assert "amplitude [m/s^2]" in done.stdout
    frequency, amplitude = map(float, done.stdout.splitlines()[1].split()[:2])
    assert frequency == pytest.approx(100.0, rel=1e-3) and amplitude == pytest.approx(1.0, rel=0.01)


def written(file, samples, heading="time [s],a [m/s^2]", unit=1.0):
    time = unit * np.arange(len(samples)) / RATE
    save(file, heading, time, samples)
    return invoke(file, "--scene", "paper", "--set", "input_speed=998 rpm", "--json", "-")


def meshing(teeth, rpm=998.0):
    """One second of two mesh harmonics with sidebands of the sun, and noise."""
    turns = rpm / 60.0 * np.arange(0.0, 1.0, 1.0 / RATE)
    tones = np.sin(2.0 * np.pi * teeth * turns) + 0.4 * np.sin(4.0 * np.pi * teeth * turns + 1.0)
    noise = 0.01 * np.random.default_rng(0).standard_normal(len(turns))
    return tones * (1.0 + 0.1 * np.cos(2.0 * np.pi * teeth / 30.0 * turns)) + noise


@pytest.mark.parametrize(
    ("teeth", "rpm", "words"),
    [
        (30, 996.0, "fit a mesh frequency 0.998 times that of the scene: are the speed"),
        (30, 600.0, "fit a mesh frequency 0.6012 times that of the scene: are the speed"),
        (21, 998.0, "is gearset.held = ring?"),
    ],
)
def test_lines_off_by_one_factor_are_reported(tmp_path, teeth, rpm, words):
    assert words in written(tmp_path / "a.csv", meshing(teeth, rpm)).stderr


def series(factor, amplitudes, sidebands):
    """A second at `factor` times 998 rpm: mesh harmonics, with sidebands once per turn or not."""
    turns = factor * SIDEBAND * np.arange(0.0, 1.0, 1.0 / RATE)
    tones = sum(a * np.sin(60.0 * np.pi * h * turns + h) for h, a in amplitudes.items())
    noise = 0.01 * np.random.default_rng(0).standard_normal(len(turns))
    return tones * (1.0 + sidebands * np.cos(2.0 * np.pi * turns)) + noise


@pytest.mark.parametrize("factor", [1 / 3, 0.5, 2 / 3, 1.5, 2.0, 4.0])
@pytest.mark.parametrize("amplitudes", [{1: 1.0, 2: 0.4, 3: 0.2}, {1: 0.3, 2: 1.0, 4: 0.2}])
def test_a_factor_of_integers_is_found_by_the_sidebands(tmp_path, factor, amplitudes):
    said = written(tmp_path / "a.csv", series(factor, amplitudes, 0.1)).stderr
    assert f"fit a mesh frequency {factor:.4g} times that of the scene: are the speed" in said


@pytest.mark.parametrize("factor", [2, 3, 4])
def test_an_undetermined_integer_factor_is_possible(tmp_path, factor):
    said = written(tmp_path / "a.csv", series(factor, {1: 1.0, 2: 0.4, 3: 0.2}, 0.0)).stderr
    assert f"are multiples of {factor}: these fit a mesh frequency {factor} times that of" in said


@pytest.mark.parametrize("turn", [1.0, 30.0 / 70.0])
@pytest.mark.parametrize("others", ["none", "mains", "bearing", "shaft"])
def test_a_right_speed_gives_no_warning_whatever_else_vibrates(tmp_path, turn, others):
    time = np.arange(0.0, 1.0, 1.0 / RATE)
    turns = SIDEBAND * time
    heights = {h: 1.0 if h == 3 else 0.3 for h in (1, 2, 3)}
    tones = sum(a * np.sin(60.0 * np.pi * h * turns) for h, a in heights.items())
    tones *= 1.0 + 0.1 * np.cos(2.0 * np.pi * turn * turns)
    base = {"none": 0.0 * time, "mains": 50.0 * time, "bearing": 4.37 * turns, "shaft": turns}
    tones += sum(2.0 / k * np.sin(2.0 * np.pi * k * base[others]) for k in (1, 2, 3, 4))
    noise = 0.01 * np.random.default_rng(0).standard_normal(len(time))
    assert "times that of the scene" not in written(tmp_path / "a.csv", tones + noise).stderr


def test_a_mesh_frequency_above_half_the_sample_rate_is_reported(tmp_path):
    done = written(tmp_path / "a.csv", meshing(30), "time,a", unit=1e3)
    assert "is 39 times half the sample rate" in done.stderr and "time [ms]" in done.stderr


def test_sidebands_name_the_members_that_separate_them(table):
    found = lines(table, "--scene", "paper", "--set", "input_speed=998 rpm")[:4]
    named = [line["sidebands"] for line in found]
    assert named[:2] == [[], []]
    below, above = ({"harmonic": 1, "member": "sun", "number": n} for n in (-1, 1))
    assert sorted(named[2:], key=str) == sorted([[below], [above]], key=str)
    assert lines(table)[0]["sidebands"] == []


def test_the_length_that_separates_overlaps_is_stated(tmp_path):
    """A turn of the sun, and two of the ring with 70 teeth: 1/30 and 2/70 of the mesh frequency."""
    shown = written(tmp_path / "a.csv", meshing(30)).stderr
    apart = MESH * (1.0 / 30.0 - 2.0 / 70.0)
    assert f"2 of harmonic 1: ring, {apart:.4g} Hz away; separating them needs" in shown
    assert f"needs a resolution of {apart / 4.0:.3g} Hz, {4.0 / apart:.3g} s of signal" in shown


def test_lines_within_the_noise_are_not_named_and_counted(tmp_path):
    noise = np.random.default_rng(1).standard_normal(int(RATE))
    done = written(tmp_path / "a.csv", noise)
    assert "12 of these lines have no name: they are less than 5 times as high as" in done.stderr
    assert {line["name"] for line in json.loads(done.stdout)["lines"]} == {""}


@pytest.mark.parametrize("heading", ["n [rpm]", "speed", "input_speed (rad/s)", "f [rev/s]"])
@pytest.mark.parametrize(("rise", "varies"), [(0.0, False), (1e-5, False), (0.1, True)])
def test_a_column_of_a_varying_speed_is_suggested(tmp_path, heading, rise, varies):
    time = np.arange(0.0, 1.0, 1.0 / RATE)
    noise = np.random.default_rng(0).standard_normal(len(time))
    speed = 1000.0 * (1.0 + rise * time) + noise
    tone = np.sin(2.0 * np.pi * 500.0 * (time + 0.5 * rise * time**2))
    file = tmp_path / "a.csv"
    save(file, f"time [s],a [g],{heading}", time, tone, speed)
    said = invoke(file, "--column", "a").stderr
    name = heading.split()[0]
    assert (f"the column '{heading}' varies from " in said) == varies
    assert (f"use --speed {name} --order" in said) == varies


def test_a_stuck_sensor_and_a_clipped_signal_are_reported(tmp_path):
    samples = meshing(30)
    assert "planetary-twin: " not in written(tmp_path / "a.csv", samples).stderr
    assert "exactly at the lowest" in written(tmp_path / "a.csv", np.clip(samples, -1, 1)).stderr
    samples[len(samples) // 2 :] = samples[len(samples) // 2]
    assert "is the sensor stuck" in written(tmp_path / "a.csv", samples).stderr


def speed_table(file, change, heading="speed [rpm]"):
    """A vibration at 1000 rpm beside a reading of this speed that `change` makes wrong."""
    time = np.arange(0.0, 1.0, 1e-4)
    tone = np.sin(2.0 * np.pi * 500.0 * time)
    save(file, f"time,{NAME},{heading}", time, tone, change(time))
    return invoke(file, "--column", NAME, "--speed", heading.split()[0], "--order",
                  "--scene", "paper")  # fmt: skip


@pytest.mark.parametrize(
    "change, words",
    [
        (
            lambda t: np.where(t < 0.3, 1e3, -1e3),
            "row 3001: speed [rpm] = -1000 at 0.3 s: reverses",
        ),
        (
            lambda t: np.where((t < 0.3) | (t > 0.35001), -1e3, 0.0),
            "row 3001: speed [rpm] = 0 at 0.3 s: stands still until 0.35 s, 501 rows",
        ),
        (lambda t: 5.0 * (np.mod(16.0 * t, 1.0) < 0.5), "is it a pulse train?"),
    ],
)
def test_a_speed_without_orders_is_named_with_its_row(tmp_path, change, words):
    done = speed_table(tmp_path / "table.csv", change)
    assert done.exit_code != 0 and done.stderr.count("\n") == 1
    assert str(tmp_path / "table.csv") in done.stderr and words in done.stderr


@pytest.mark.parametrize("factor, words", [(2.0, "2 times"), (0.5, "0.5 times"), (3.0, "3 times")])
@pytest.mark.parametrize("rows", [1, 700])
def test_a_speed_that_jumps_is_named_with_its_time(tmp_path, factor, words, rows):
    def pieces(time):
        wrong = np.isin(np.arange(len(time)) % 2000, np.arange(1200, 1200 + rows))
        return np.where(wrong, factor, 1.0) * (950.0 + 100.0 * time)

    done = speed_table(tmp_path / "table.csv", pieces)
    assert done.exit_code == 0
    assert (
        f"the column 'speed [rpm]' jumps to {words} its value at 0.12 s (row 1201)" in done.stderr
    )
    assert "and 9 times later" in done.stderr and "teeth" not in done.stderr


def test_an_option_states_the_units_that_a_mat_file_cannot(tmp_path):
    file, time = tmp_path / "run_up.mat", np.arange(0.0, 2.0, 1e-4)
    turns = (900.0 * time + 50.0 * time**2) / 60.0
    vectors = {"time": time, "acceleration": np.sin(2.0 * np.pi * 30.0 * turns)}
    io.savemat(file, vectors | {"speed": 900.0 + 100.0 * time})
    options = ("--scene", "paper", "--order", "--column", "acceleration [g]", "--speed")
    done = invoke(file, *options, "speed [rpm]")
    assert "amplitude [g]" in done.stdout and done.stderr == ""
    assert lines(file, *options, "speed [rpm]")[0]["order"] == pytest.approx(30.0, abs=0.01)
    assert "state it, for example --speed 'speed [rpm]'" in invoke(file, *options, "speed").stderr
    write_units(file, {"speed": "rpm"})
    assert lines(file, *options, "speed")[0]["order"] == pytest.approx(30.0, abs=0.01)
    refused = invoke(file, *options, "speed [dps]")
    assert refused.exit_code != 0 and "the column 'speed' is in [rpm]" in refused.stderr
