"""The command `simulate` against the library it calls."""

import json
import re
from functools import partial

import command_line
import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.summary import operating_point
from planetary_twin_py.studies.fit.parameter import read_parameters
from planetary_twin_py.units.conversion import to_si

invoke = partial(command_line.invoke, "simulate")
succeed = partial(command_line.succeed, "simulate")

SHORT = ["--duration", "0.004", "--set", "lambda_ratio=1.5", "--set", "mesh.ramp=0.05"]


def expected(sample_rate=50_000.0):
    scene = pt.load_scene("paper").replace(lambda_ratio=1.5, **{"mesh.ramp": 0.05})
    return pt.simulate(scene, 0.004, sample_rate)


def over_time(run, values):
    """Mean of samples (samples, ...) by trapezoids."""
    return np.trapezoid(values, run.time, axis=0) / (run.time[-1] - run.time[0])


def test_figures_are_those_of_the_library():
    figures = json.loads(invoke("paper", *SHORT, "--json", "-").stdout)
    run = expected()
    assert figures["efficiency"] == pytest.approx(run.efficiency)
    assert figures["mean_power_loss_W"] == pytest.approx(run.energy.loss / run.duration)
    assert figures["mean_power_loss_W"] == pytest.approx(over_time(run, run.total_power_loss), 2e-3)


def test_figures_do_not_depend_on_the_sample_rate():
    coarse, fine, late = (
        json.loads(invoke("paper", "--duration", "0.1", *options, "--json", "-").stdout)
        for options in (["--sample-rate", "10"], ["--sample-rate", "1e6"], ["--settling", "0.1"])
    )
    for figures in (coarse, fine, late):
        assert figures.pop("real_time_factor") > 0.0
    assert coarse["sun_planet"] == pytest.approx(fine["sun_planet"], rel=1e-12)
    assert coarse["planet_ring"] == pytest.approx(fine["planet_ring"], rel=1e-12)
    assert coarse["mean_dte_m"] == pytest.approx(fine["mean_dte_m"], rel=1e-12)
    assert coarse["mesh_frequency_Hz"] == pytest.approx(fine["mesh_frequency_Hz"], rel=1e-12)
    tooth = coarse["sun_planet"]["power_loss_W"] + coarse["planet_ring"]["power_loss_W"]
    assert tooth == pytest.approx(coarse["mean_power_loss_W"], rel=3e-3)
    assert (coarse["settling_s"], late["settling_s"]) == (0.0, 0.1)
    assert late["mean_dte_m"] != coarse["mean_dte_m"]


@pytest.mark.parametrize("name", ["paper", "lightly_loaded"])
def test_meshes_of_the_sun_and_of_the_ring_are_distinguished(name):
    """Compared with the samples themselves; under light load the teeth separate for a while."""
    figures = json.loads(invoke(name, "--duration", "0.1", "--json", "-").stdout)
    run = pt.simulate(pt.load_scene(name), 0.1, 1e6)
    for side, meshes in {"sun_planet": slice(3), "planet_ring": slice(3, 6)}.items():
        found, touching = figures[side], run.mesh_force[:, meshes] != 0.0
        assert found == pytest.approx(
            {
                "dte_mean_m": run.dte[:, meshes].mean(),
                "dte_rms_m": max(run.dte[:, meshes].std(axis=0)),
                "dte_peak_m": abs(run.dte[:, meshes]).max(),
                "mesh_force_peak_N": abs(run.mesh_force[:, meshes]).max(),
                "boundary_friction_N": run.boundary_friction[:, meshes].mean(),
                "viscous_friction_N": run.viscous_friction[:, meshes].mean(),
                "mesh_force_mean_N": run.mesh_force[:, meshes].mean(),
                "contact_fraction": min(touching.mean(axis=0)),
                "film_thickness_m": np.nanmean(run.film_thickness[:, meshes], axis=0).mean(),
                "lambda_ratio": np.nanmean(run.lambda_ratio[:, meshes], axis=0).mean(),
                "power_loss_W": run.power_loss[:, meshes].mean(axis=0).sum(),
            },
            rel=1e-3,
        )
        assert (found["contact_fraction"] < 0.99) == (name == "lightly_loaded")


def test_the_mesh_frequency_is_that_of_a_differential_too():
    """30 teeth of the sun, relative to the carrier, which turns as well."""
    scene = pt.load_scene("differential")
    sun, carrier = scene.operating_point.input_speed, scene.operating_point.second_input_speed
    figures = json.loads(invoke("differential", "--duration", "0.1", "--json", "-").stdout)
    turns = abs(sun - carrier) / (2 * np.pi)
    assert figures["mesh_frequency_Hz"] == pytest.approx(30 * turns, rel=1e-3)


def test_printed_results_have_units_and_name_the_meshes():
    shown, figures = invoke("paper", *SHORT).stdout, expected()
    labels = dict(re.split(r"  +", line, maxsplit=1) for line in shown.splitlines() if "  " in line)
    mesh, fine = figures.mesh, expected(1e6)
    for label, unit, statistic, samples, rel in (
        ("DTE of all meshes, mean", "m", mesh["dte_mean"].mean(), fine.dte.mean(), 1e-4),
        ("DTE of all meshes, rms about the mean", "m", mesh["dte_rms"].mean(),
         fine.dte.std(axis=0).mean(), 1e-3),
        ("DTE of any mesh, peak", "m", mesh["dte_peak"].max(), abs(fine.dte).max(), 5e-3),
        ("force of any mesh, peak", "N", mesh["mesh_force_peak"].max(),
         abs(fine.mesh_force).max(), 5e-3),
    ):  # fmt: skip
        value = to_si(labels[label], unit)
        assert value == pytest.approx(statistic, rel=1e-5)
        assert value == pytest.approx(samples, rel=rel)
    rows = {
        cells[0].strip(): [cell.strip() for cell in cells[1:]]
        for cells in (line.strip("│").split("│") for line in shown.splitlines() if line[0] == "│")
    }
    dte = figures.dte.mean(axis=0)
    printed = [to_si(cell, "m") for cell in rows["DTE, mean"]]
    assert printed == pytest.approx([dte[:3].mean(), dte[3:].mean()], rel=0.01)


def test_the_loss_of_each_source_is_printed_if_there_are_several():
    options = ("compact_actuator", "--duration", "0.05")
    figures = json.loads(invoke(*options, "--json", "-").stdout)
    parts = [figures[f"{part}_W"] for part in ("tooth_friction", "bearing_loss", "churning_loss")]
    assert sum(parts) == pytest.approx(figures["mean_power_loss_W"], rel=1e-9)
    drag = pt.load_scene("compact_actuator").losses.sun_drag.coulomb
    speed = pt.load_scene("compact_actuator").operating_point.input_speed
    assert parts[1] == pytest.approx(drag * speed, rel=2e-3)
    shown = invoke(*options).stdout
    assert "of bearings, seals and grease" in shown and "of tooth friction" in shown
    assert "of tooth friction" not in invoke("paper", *SHORT).stdout


def test_the_sign_of_loaded_coast_flanks_is_explained():
    line = "Forces and DTE are negative where the coast flanks carry the load."
    assert line not in invoke("paper", *SHORT).stdout
    assert line in invoke("wind_turbine_stage", "--duration", "0.05").stdout


def test_samples_contain_their_scene(tmp_path):
    invoke("paper", *SHORT, "--out", str(tmp_path / "run.npz"))
    text = str(np.load(tmp_path / "run.npz")["scene_yaml"])
    assert pt.parse_scene(text) == pt.load_scene("paper").replace(
        lambda_ratio=1.5, **{"mesh.ramp": 0.05}
    )


def test_samples_are_written_completely(tmp_path):
    run = expected()
    for name in ("run.npz", "run.csv"):
        assert invoke("paper", *SHORT, "--out", str(tmp_path / name)).exit_code == 0
    stored = np.load(tmp_path / "run.npz")
    assert np.array_equal(stored["dte"], run.dte)
    assert tuple(stored["meshes"]) == run.meshes
    table = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True, deletechars="")
    assert table["dte/sun_planet_2"] == pytest.approx(run.dte[:, 1])
    assert len(table.dtype.names) == 1 + 2 * 6 + 7 * 6


COMPUTED = ["--set", "lubrication.lambda_ratio=computed"]


def test_a_computed_lambda_ratio_is_said_to_have_no_effect():
    done = succeed("paper", *COMPUTED, *SHORT, "--json", "-")
    (line,) = [line for line in done.stderr.splitlines() if "lambda_ratio" in line]
    warning, reason = line.split(": has no effect: ")
    assert warning == "planetary-twin: warning: lambda_ratio"
    assert "set lubrication.lambda_ratio = prescribed" in reason
    assert f"lambda_ratio: has no effect: {reason}" in json.loads(done.stdout)["remarks"]
    scene = pt.load_scene("paper").replace(**{"lubrication.lambda_ratio": "computed"})
    with pytest.raises(ValueError, match="cannot be estimated") as refusal:
        read_parameters(scene, ["lambda_ratio"], {})
    assert str(refusal.value).endswith(reason)


def test_efficiency_without_a_driving_machine_is_undefined():
    found = invoke("paper", "--duration", "0.02", "--set", "input_speed=0 rpm")
    assert re.search(r"^efficiency +undefined: no machine puts power in", found.stdout, re.M)


@pytest.mark.parametrize(
    ("torque", "speed", "enters"),
    [(63.0, 1000.0, False), (-63.0, 1000.0, True), (63.0, -1000.0, True), (-63.0, -1000.0, False)],
)
def test_the_output_is_named_where_power_enters_there(torque, speed, enters):
    scene = pt.load_scene("paper").replace(input_torque=torque, input_speed=pt.rpm(speed))
    line = "power enters at the output, the ring"
    assert (line in operating_point(scene)) == enters
    machines = pt.simulate(scene, 0.02).energy.machines
    assert (machines[1] > 0.0) == enters


def test_parents_of_the_folder_of_a_recording_are_created(tmp_path):
    out = tmp_path / "new" / "run"
    succeed("paper", "--duration", 0.01, "--out", out)
    assert list(out.glob("*.mcap"))
