"""Stribeck and bifurcation figures show their tables; files depend on their content only."""

import numpy as np
import pyarrow as pa
import pytest
from tiers import first

import planetary_twin_py as pt
from planetary_twin_py.plots.style import save
from planetary_twin_py.simulation.threads import Threads
from planetary_twin_py.studies.axes import Axis
from planetary_twin_py.studies.bifurcation import Dwell, bifurcation
from planetary_twin_py.studies.stribeck import stribeck

PAPER = pt.load_scene("paper")
MIXED = PAPER.replace(**{"lubrication.boundary": "load_sharing"})


@pytest.fixture(scope="module")
def curve():
    return stribeck(MIXED, Axis("input_speed", tuple(np.geomspace(1.0, 1000.0, 7))), Threads())


@pytest.fixture(scope="module")
def diagram():
    return bifurcation(PAPER, [300.0, 310.0, 320.0], Dwell(0.02, cycles=3))


def test_parts_of_friction_add_up(curve):
    figure = pt.plot_study(curve, kind="stribeck")
    for axes, side in zip(figure.axes, ("sun_planet", "planet_ring"), strict=True):
        assert axes.get_xlabel() == "Lambda ratio [-]" and axes.get_xscale() == "log"
        assert axes.get_ylabel() == "Friction coefficient [-]"
        lines = {line.get_label(): line.get_data() for line in axes.get_lines()}
        ratio, boundary = lines["boundary"]
        assert ratio == pytest.approx(curve[f"{side}_lambda_ratio"].to_numpy())
        force = curve[f"{side}_mesh_force_mean"].to_numpy()
        assert boundary == pytest.approx(curve[f"{side}_boundary_friction"].to_numpy() / force)
        assert lines["total"][1] == pytest.approx(boundary + lines["viscous"][1])
        assert (np.diff(ratio) > 0.0).all() and (np.diff(boundary) < 0.0).all()


def test_every_section_is_a_dot_in_rpm_and_micrometres(diagram):
    (axes,) = pt.plot_study(diagram).axes
    assert axes.get_xlabel() == "Speed [rpm]"
    assert axes.get_ylabel() == "DTE of sun-planet mesh 1 [µm]"
    for line, way in zip(axes.get_lines(), ("up", "down"), strict=True):
        rows = diagram.filter(pa.compute.equal(diagram["direction"], way))
        assert line.get_xdata() == pytest.approx(rows["input_speed"].to_numpy() * 30.0 / np.pi)
        assert line.get_ydata() == pytest.approx(rows["sun_planet_1_dte"].to_numpy() * 1e6)


@pytest.mark.parametrize("suffix", first(1, ["png", "svg", "pdf"]))
def test_the_same_figure_is_the_same_file(tmp_path, diagram, suffix):
    for name in ("a", "b"):
        save(pt.plot_study(diagram), str(tmp_path / f"{name}.{suffix}"))
    first, second = (tmp_path / f"{name}.{suffix}" for name in ("a", "b"))
    assert first.read_bytes() == second.read_bytes() and first.stat().st_size > 1000


def test_without_a_speed_dependent_film_there_is_no_curve(diagram):
    from planetary_twin_py.studies.plan import Settings, grid
    from planetary_twin_py.studies.sweep import sweep

    axes = [Axis("input_torque", (20.0, 30.0))]
    quick = Settings(0.02, 0.01, tolerance=1e-3)
    table = sweep(grid(PAPER, axes, quick), Threads())
    with pytest.raises(ValueError, match="lambda_ratio: does not vary"):
        pt.plot_study(table, kind="stribeck")
