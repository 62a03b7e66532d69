"""The command `indicators` as typed."""

import json

import numpy as np
import pytest
from command_line import invoke, succeed
from sensor_recording import record_device

RATE = 25_600.0
SUN = 1000.0 / 60.0  # turns per second of `paper`, whose carrier is held


def table(file, modulation, noise=0.0, seconds=3.0, second=0.0):
    """A vibration with 30 cycles a turn, modulated once and twice per turn of the sun."""
    time = np.arange(0.0, seconds, 1.0 / RATE)
    turn = 2.0 * np.pi * SUN * time
    beat = 1.0 + modulation * np.cos(turn) + second * np.cos(2.0 * turn)
    signal = beat * np.cos(30.0 * turn)
    signal += noise * np.random.default_rng(1).normal(size=len(time))
    rows = np.column_stack((time, signal))
    header = "time [s],acceleration [m/s^2]"
    np.savetxt(file, rows, delimiter=",", header=header, comments="", fmt="%.12g")
    return file


def figures(*arguments):
    done = succeed("indicators", *arguments, "--json", "-")
    return json.loads(done.stdout), done.stderr


def test_a_measured_modulation_has_its_indicators(tmp_path):
    file = table(tmp_path / "vibration.csv", 0.2)
    found, text = figures(file, "--scene", "paper")
    assert (found["gear"], found["turns"], found["unit"]) == ("sun", 48, "m/s^2")
    values = {name: each["value"] for name, each in found["indicators"].items()}
    assert values["rms"] == pytest.approx(np.sqrt(0.51), rel=2e-3)
    assert values["sideband_level_factor"] == pytest.approx(0.280056, rel=2e-3)
    assert values["nb4"] == pytest.approx(1.5, rel=2e-3)
    assert "speed is assumed to be constant" in text


def test_intervals_contain_the_value_without_noise(tmp_path):
    """Second sidebands have FM4 = 2.25; noise that is left raises it towards 3 by a little."""
    file = table(tmp_path / "vibration.csv", 0.2, noise=0.2, second=0.3, seconds=12.0)
    found, _ = figures(file, "--scene", "paper")
    assert found["noise_rms"] == pytest.approx(0.2 / np.sqrt(found["turns"]), rel=0.1)
    level, fm4 = (found["indicators"][name] for name in ("sideband_level_factor", "fm4"))
    expected = 0.2 * np.sqrt(2.0 / (1.0 + 0.02 + 0.045))
    assert level["low"] < expected < level["high"]
    assert level["high"] - level["low"] < 0.1 * expected
    assert 2.2 < fm4["low"] < fm4["value"] < fm4["high"] < 2.5


def test_noise_in_place_of_a_difference_is_remark(tmp_path):
    file = table(tmp_path / "vibration.csv", 0.2, noise=0.2)
    _, text = figures(file, "--scene", "paper")
    assert "indicators of the difference are those of noise" in text


@pytest.mark.parametrize(
    ("held", "gear", "remark"),
    [
        ("ring", "sun", "where a fault of the sun nearly vanishes"),
        ("ring", "planet", "where a fault of the planet nearly vanishes"),
        ("carrier", "planet", "this average mixes their teeth"),
        ("ring", "ring", None),
        ("carrier", "sun", None),
    ],
)
def test_a_sensor_that_measures_all_planets_is_reported(tmp_path, held, gear, remark):
    file = table(tmp_path / "vibration.csv", 0.2, seconds=1.0)
    output = {"ring": "carrier", "carrier": "ring"}[held]
    scene = "--scene", "paper", "--set", f"gearset.held={held}"
    member = "--set", f"drive.output.member={output}"
    _, text = figures(file, *scene, *member, "--gear", gear, "--plain")
    assert remark in text if remark else "planets" not in text


def test_what_is_not_defined_is_null_with_a_reason(tmp_path):
    file = table(tmp_path / "vibration.csv", 0.2, seconds=0.2)
    found, text = figures(file, "--scene", "paper")
    star = found["indicators"]["na4_star"]
    assert star["value"] is None and star["reason"] == "needs the average of the healthy gear"
    assert star["low"] is None
    assert "no intervals: they need 6 turns of the gear, the signal has 2" in text


@pytest.mark.slow
def test_a_simulated_crack_is_compared_with_the_healthy_gear(tmp_path):
    """The rms of the difference grows with the loss of stiffness, and FM4 does not."""
    files = {loss: tmp_path / f"{loss}.npz" for loss in (0.0, 0.01, 0.02)}
    for loss, file in files.items():
        crack = f"[{{kind: crack, gear: sun, tooth: 3, stiffness_loss: {loss}}}]" if loss else "[]"
        succeed(
            "simulate", "cracked_tooth", "--set", f"faults={crack}", "--duration", "0.8",
            "--settling", "0.3", "--out", file,
        )  # fmt: skip
    found = {}
    for loss in (0.01, 0.02):
        found[loss], text = figures(
            files[loss], "--quantity", "mesh_force", "--baseline", files[0.0]
        )
        assert "this signal has no noise of a sensor" in text
    one, two = found.values()
    assert two["difference_rms"] == pytest.approx(2.0 * one["difference_rms"], rel=0.1)
    assert one["difference_rms"] > 10.0 * one["baseline_difference_rms"]
    fm4 = [each["indicators"]["fm4"]["value"] for each in (one, two)]
    assert fm4[1] == pytest.approx(fm4[0], rel=0.1)
    assert one["indicators"]["na4_star"]["value"] > 1e3


def test_a_recorded_sensor_has_its_indicators(tmp_path):
    time = np.arange(int(3.0 * RATE)) / RATE
    turn = 2.0 * np.pi * SUN * time
    signal = (1.0 + 0.2 * np.cos(turn)) * np.cos(30.0 * turn)
    lost = record_device(
        tmp_path / "rig", signal[:, None], {"housing": "g"}, lambda n: () if n == 20 else (n,)
    )
    found, text = figures(lost, "--sensor", "vibration", "--scene", "paper")
    assert found["unit"] == "g" and found["mesh"] is None
    level = found["indicators"]["sideband_level_factor"]["value"]
    assert level == pytest.approx(0.280056, rel=2e-3)
    assert "1 block is missing" in text and "speed is assumed to be constant" in text


TEETH = {"17/37/91": (17, 37, 91), "30/20/70": (30, 20, 70), "20/40/100": (20, 40, 100)}
PER_TURN = 91 * 40  # samples per turn of the carrier


def passing(file, tooth=11, planets=3, start=0.7, turns=260, noise=0.02):
    """A sensor that three planets of 17/37/91 pass; a tooth of the second planet has a burst.

    Planet 1 is at the sensor `start` rad of the carrier after the first sample.
    """
    carrier = 2.0 * np.pi / PER_TURN * np.arange(turns * PER_TURN)
    passed = 91.0 * carrier / (2.0 * np.pi)
    signal = noise * np.random.default_rng(2).standard_normal(len(carrier))
    for planet in range(planets):
        place = 2.0 * np.pi * planet / planets - start
        weight = np.cos(0.5 * (carrier + place)) ** 8
        signal += weight * np.cos(2.0 * np.pi * passed + 91.0 * place)
        if planet == 1:
            away = (passed - tooth + 18.5) % 37 - 18.5
            signal += weight * np.exp(-((away / 0.4) ** 2)) * np.cos(20.0 * away)
    np.savez(file, acc=signal, fs=PER_TURN / 60.0 * 60.0)
    return file


def scene_of(teeth):
    sun, planet, ring = TEETH[teeth]
    fields = f"gearset.teeth={{sun: {sun}, planet: {planet}, ring: {ring}}}"
    places = "0 deg, 118.8 deg, 241.2 deg" if planet == 20 else "0 deg, 120 deg, 240 deg"
    angles = f"gearset.planet_angles=[{places}]"
    return (
        "--scene", "paper", "--set", fields, "--set", "gearset.held=ring", "--set", angles, "--set",
        "drive.output.member=carrier", "--speed", "60 rpm", "--shaft", "carrier",
    )  # fmt: skip


@pytest.fixture(scope="module")
def passed(tmp_path_factory):
    return passing(tmp_path_factory.mktemp("passing") / "rig.npz")


def test_the_planet_with_a_fault_is_separated(passed):
    """The rms of the difference of planet 2 is far above that of the others, and FM4 above 10."""
    found = {
        n: figures(passed, *scene_of("17/37/91"), "--gear", f"planet_{n}")[0] for n in (1, 2, 3)
    }
    rms = {n: one["difference_rms"] for n, one in found.items()}
    assert rms[2] > 5.0 * max(rms[1], rms[3])
    assert found[2]["indicators"]["fm4"]["value"] > 10.0
    assert found[2]["turns"] == 7  # of 260 passes, 37 of which see each tooth once
    interval = found[2]["indicators"]["rms"]
    assert interval["low"] < interval["value"] < interval["high"]


def test_the_place_of_the_planet_is_found_or_stated(passed):
    given = *scene_of("17/37/91"), "--gear", "planet_2"
    found, text = figures(passed, *given)
    assert "planet 1 passes the sensor 40" in text  # 0.7 rad, to the degree
    stated, quiet = figures(passed, *given, "--passing", "0.7 rad")
    assert "planet 1 passes" not in quiet
    assert stated["difference_rms"] == pytest.approx(found["difference_rms"], rel=0.02)


@pytest.mark.parametrize(
    ("teeth", "gear", "seen"),
    [
        ("30/20/70", "planet_1", "2 of 20 teeth"),
        ("20/40/100", "planet_2", "2 of 40 teeth"),
        ("20/40/100", "sun", "1 of 20 teeth"),
    ],
)
def test_teeth_that_the_sensor_cannot_see_are_refused(passed, teeth, gear, seen):
    done = invoke("indicators", passed, *scene_of(teeth), "--gear", gear)
    assert done.exit_code == 2 and seen in done.stderr and "cannot be separated" in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_planet_that_does_not_exist_is_refused(passed):
    for gear in ("planet_4", "planet_0", "pinion"):
        done = invoke("indicators", passed, *scene_of("17/37/91"), "--gear", gear)
        assert done.exit_code == 2 and f"--gear = '{gear}': must be" in done.stderr
