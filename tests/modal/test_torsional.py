"""Torsional modes of the bare gearset against closed forms and other people's numbers."""

import math

import numpy as np
import pytest
from power_flows import DIFFERENTIALS, FLOWS, flow_name, scene_of

import planetary_twin_py as pt
from planetary_twin_py.modal.modes import modes_of
from planetary_twin_py.modal.natural import spring_model

CASES = [
    (FLOWS[0], [0, 5500.36, 9375.70, 9375.70, 11112.99]),
    (FLOWS[2], [0, 5620.95, 9375.70, 9375.70, 10928.67]),
    (FLOWS[4], [0, 4724.50, 9375.70, 9375.70, 9879.57]),
    (DIFFERENTIALS[0], [0, 0, 6664.08, 9375.70, 9375.70, 11135.22]),
]


@pytest.mark.parametrize(
    "flow, expected", CASES, ids=lambda v: flow_name(v) if isinstance(v, tuple) else ""
)
def test_frequencies_and_kinds_whatever_is_held(flow, expected):
    modes = pt.natural_modes(scene_of(flow))
    assert modes.frequencies == pytest.approx(expected, abs=0.01)
    assert modes.kinds.count("rigid") == expected.count(0)
    assert modes.kinds.count("planet") == 2
    assert set(modes.kinds) == {"rigid", "planet", "rotational"}


@pytest.mark.parametrize("planets", [2, 4, 5, 7])
def test_planet_modes_depend_on_planet_and_meshes_only(planets):
    step = 2 * math.pi / 126
    angles = tuple(step * round(126 * k / planets) for k in range(planets))
    changes = {
        "gearset.teeth": {"sun": 42, "planet": 21, "ring": 84},  # room for seven
        "gearset.planet_angles": angles,
        "mesh.planet_ring_stiffness": 3e8,
    }
    scene = scene_of(FLOWS[0], **changes)
    modes = pt.natural_modes(scene)
    mass = 0.1 / math.cos(math.radians(21.34)) ** 2
    expected = math.sqrt((2e8 + 3e8) / mass) / (2 * math.pi)
    found = modes.frequencies[[kind == "planet" for kind in modes.kinds]]
    assert found == pytest.approx([expected] * (planets - 1))


def test_shapes_are_mass_normalised_and_satisfy_the_eigenproblem():
    model = spring_model(pt.load_scene("paper"))
    modes = modes_of(model)
    assert modes.shapes.T @ (model.mass[:, None] * modes.shapes) == pytest.approx(
        np.eye(5), abs=1e-9
    )
    squares = (2 * math.pi * modes.frequencies) ** 2
    weighted = model.mass[:, None] * modes.shapes
    residual = model.stiffness @ modes.shapes - weighted * squares
    assert np.abs(residual).max() < 1e-6 * np.abs(model.stiffness @ modes.shapes).max()
    assert modes.coordinates == model.coordinates


def driven(port):
    """Soft couplings on both sides of stiff and light gears."""
    changes = {
        "drive.input.port": port,
        "drive.output.port": "torque",
        "drive.input.coupling_damping": 0.0,
        "drive.output.coupling_damping": 0.0,
        "drive.output.inertia": 2.0,
    }
    return pt.load_scene("paper").replace(**changes)


def test_the_end_of_a_shaft_whose_motion_is_given_is_at_rest():
    """Load and gears on both couplings in series, seen from the load; no mode is rigid."""
    scene = driven("motion")
    modes = pt.natural_modes(scene, "machines")
    turns = (70 / 30) ** 2  # (ns/nr)^2
    load, motor = scene.drive.output, scene.drive.input
    in_series = 1.0 / (1.0 / load.coupling_stiffness + 1.0 / (motor.coupling_stiffness * turns))
    expected = math.sqrt(in_series / load.inertia) / (2 * math.pi)
    assert "rigid" not in modes.kinds
    assert modes.frequencies[0] == pytest.approx(expected, rel=0.01)
    assert not any(name.startswith("motor") for name in modes.coordinates)


def test_given_torque_leaves_inertia_of_its_port_in_the_train():
    given, machine = (pt.natural_modes(driven(port), "machines") for port in ("torque", "machine"))
    assert given.frequencies == pytest.approx(machine.frequencies, rel=1e-12)
    assert given.kinds[0] == "rigid"


@pytest.mark.parametrize("port", ["motion", "torque"])
def test_a_twin_swings_at_the_lowest_frequency_of_its_ports(port):
    scene = driven(port)
    modes = pt.natural_modes(scene, "machines", "mean")
    lowest = next(f for f in modes.frequencies if f > 0.0)
    twin = pt.Twin(scene, tolerance=1e-3)
    twist, step = [], 1.0 / (50.0 * lowest)
    kick = {"motion": {"input_speed": 1.01}, "torque": {"output_torque": 1.1}}[port]
    state = twin.port_states
    changed = {name: factor * getattr(state, name) for name, factor in kick.items()}
    for _ in range(500):
        state = twin.step(step, **changed)
        twist.append(state.output_angle * 70 / 30 + state.input_angle)
    twist = np.array(twist) - np.polyval(np.polyfit(np.arange(500), twist, 1), np.arange(500))
    spectrum = np.abs(np.fft.rfft(twist * np.hanning(500), 20_000))
    found = np.fft.rfftfreq(20_000, step)[np.argmax(spectrum)]
    assert found == pytest.approx(lowest, rel=0.02)


def test_an_unknown_model_ends_in_one_line():
    scene = pt.load_scene("paper")
    with pytest.raises(ValueError, match="model = 'flat': must be one of torsional"):
        pt.natural_modes(scene, "flat")
    with pytest.raises(pt.SceneError, match="supports: missing"):
        pt.natural_modes(scene, "planar")
