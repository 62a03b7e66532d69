"""`--set`: lists and sections as in a scene file, and bare numbers echoed with their unit."""

import pytest
from command_line import invoke, succeed

import planetary_twin_py as pt
from planetary_twin_py.terminal.settings import settings

SHORT = ("simulate", "paper", "--duration", "0.002")


SI = ": no unit is given, so this is SI"


def notes(done):
    assert done.exit_code == 0, done.output
    lines = [line.removeprefix("planetary-twin: ") for line in done.stderr.splitlines()]
    return [line for line in lines if not line.startswith("warning: ")]


@pytest.mark.parametrize(
    ("setting", "line"),
    [
        ("input_speed=1000", "input_speed = 1000 rad/s (9549 rpm)"),
        ("backlash=3e-7", "backlash = 3e-07 m (0.3 um)"),
        ("gearset.module=0.001", "gearset.module = 0.001 m (1 mm)"),
        ("gearset.pressure_angle=0.35", "gearset.pressure_angle = 0.35 rad (20.05 deg)"),
        ("oil_temperature=300", "oil_temperature = 300 K (26.85 degC)"),
        ("input_torque=50", "input_torque = 50 N m"),
        (
            "gearset.planet_angles=[0, 180 deg]",
            "gearset.planet_angles.0 = 0 rad (0 deg)",
        ),
        (
            "faults=[{kind: wear, gear: sun, depth: 1e-6}]",
            "faults.0.depth = 1e-06 m (1 um)",
        ),
    ],
)
def test_a_number_without_a_unit_is_echoed_with_the_assumed_unit(setting, line):
    assert notes(invoke(*SHORT, "--set", setting)) == [f"{line}{SI}"]


@pytest.mark.parametrize(
    "setting", ["input_speed=1000rpm", "mesh.ramp=0.02", "lambda_ratio=1.5", "gearset.teeth.sun=30"]
)
def test_a_value_with_a_unit_is_not_echoed(setting):
    assert notes(invoke(*SHORT, "--set", setting)) == []


def test_bare_ends_of_the_range_of_a_study_are_echoed(tmp_path):
    out = str(tmp_path / "s.csv")
    done = invoke("stribeck", "paper", "--input-speed", "10:100:3", "--out", out)
    assert [line for line in notes(done) if "rad/s" in line] == [
        f"input_speed = 10 rad/s (95.49 rpm){SI}",
        f"input_speed = 100 rad/s (954.9 rpm){SI}",
    ]


def test_lists_and_sections_are_written_as_in_a_scene_file():
    given = ["faults=[{kind: crack, gear: ring, stiffness_loss: 0.3}]", "mesh.runout={sun: 0.2 um}"]
    scene = pt.load_scene("paper").replace(**settings(given))
    assert scene.faults[0].gear == "ring"
    assert scene.mesh.runout.sun == pytest.approx(2e-7)


def test_null_removes_what_is_optional_as_in_a_scene_file():
    given = ["supports=null", "dynamics=torsional", "lubrication.friction_table=null"]
    scene = pt.load_scene("floating_sun").replace(**settings(given))
    assert scene.supports is None and scene.lubrication.friction_table is None
    rolling = ["supports.sun.bearing=null", "supports.sun.rolling={balls: 9, diameter: 8 mm}"]
    scene = pt.load_scene("floating_sun").replace(**settings(rolling))
    assert scene.supports.sun.bearing is None and scene.supports.sun.rolling.balls == 9


def test_a_setting_that_is_given_twice_is_refused():
    with pytest.raises(ValueError, match="--set backlash: given twice, as 1um and as 2um"):
        settings(["backlash=1um", "backlash=2um"])


@pytest.mark.parametrize(
    ("field", "scene", "fixed"),
    [
        ("faults.0.tooth", "cracked_tooth", []),
        ("losses.planet_bearing.f0", "paper", ["losses.planet_bearing.mean_diameter=10mm"]),
    ],
)
def test_a_sweep_varies_fields_in_lists_and_in_optional_sections(field, scene, fixed, tmp_path):
    from planetary_twin_py.studies.table import read

    out = tmp_path / "s.parquet"
    sets = [part for setting in fixed for part in ("--set", setting)]
    short = ("--duration", "0.01", "--settling", "0")
    succeed("sweep", scene, f"--{field}", "1,2", *sets, *short, "--out", str(out))
    assert read(out)[field].to_pylist() == [1, 2]


def test_a_value_and_its_unit_are_on_one_line():
    shown = invoke("simulate", "paper", "--duration", "0.002", COLUMNS="60")
    lines = shown.output.splitlines()
    assert max(map(len, lines)) <= 60
    for part in ("pressure angle 21.34 deg", "input torque 63 N m", "planet 3 at 208.8 deg"):
        assert any(part in line for line in lines)
