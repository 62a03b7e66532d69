"""Recordings of scenes whose axes move, read back by readers that did not write them."""

import numpy as np
import pyarrow.parquet
import pytest
from planar.moving_scenes import planar
from power_flows import FLOWS
from twin_recording import decoded

from planetary_twin_py import simulate
from planetary_twin_py.recording.ros2.axes_fields import axes_state_fields, largest_of_kind
from planetary_twin_py.recording.runs import compose
from planetary_twin_py.recording.runs.branch import Branch
from planetary_twin_py.recording.runs.offline import NAMESPACE, Plan, record
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.verify import verify
from planetary_twin_py.recording.runs.what_if import resimulate
from planetary_twin_py.recording.tables.export import Export, export
from planetary_twin_py.units.catalogue import axes_fields

DURATION, RATE = 0.05, 20_000.0
PIN = {"errors.pin_tangential": [-2e-5, 0.0, 0.0]}


@pytest.fixture(scope="module")
def scene():
    return planar(FLOWS[2], {"sun": 1e7}, **PIN)  # the ring is held, the carrier turns


@pytest.fixture(scope="module")
def file(scene, tmp_path_factory):
    return record(Plan(scene, DURATION, RATE, 1e-4), tmp_path_factory.mktemp("bag") / "axes")


@pytest.fixture(scope="module")
def run(scene):
    return simulate(scene, DURATION, sample_rate=RATE)


def messages(file, topic):
    """Messages of a topic by rosbags, from the definitions in the file."""
    return decoded(file.parent, f"{NAMESPACE}/{topic}")


def test_another_reader_finds_every_sample_of_the_axes(file, run):
    blocks = messages(file, "axes_waveform")
    for name, bodies in (("displacement", 6), ("bearing_force", 6), ("orbit", 3)):
        read = [getattr(block, name).reshape(bodies, 2, -1).transpose(2, 0, 1) for block in blocks]
        computed = getattr(run.axes, name)
        scale = np.abs(computed).max()
        assert np.concatenate(read) == pytest.approx(computed, abs=1e-5 * scale)
    assert blocks[0].planets == 3
    assert sum(block.samples for block in blocks) == len(run.time)


def test_means_and_extremes_are_those_of_the_samples(file):
    states, blocks = messages(file, "axes_state"), messages(file, "axes_waveform")
    assert [state.sequence for state in states] == list(range(1, 6))
    for state, block in zip(states, blocks, strict=True):
        moved = block.displacement.reshape(6, 2, -1).astype(float)
        force = block.bearing_force.reshape(6, 2, -1).astype(float)
        assert state.sun_displacement_x == pytest.approx(moved[0, 0].mean(), rel=1e-5)
        assert state.sun_displacement_y == pytest.approx(moved[0, 1].mean(), rel=1e-5)
        assert state.carrier_bearing_force_y == pytest.approx(force[2, 1].mean(), rel=1e-4)
        assert state.sun_bearing_force_peak == pytest.approx(np.hypot(*force[0]).max(), rel=1e-5)
        tangential = force[3:, 1].mean(axis=1)
        assert state.planet_bearing_force_tangential[:3] == pytest.approx(tangential, rel=1e-5)
        assert np.isnan(state.planet_bearing_force_tangential[3:]).all()
        orbit = block.orbit.reshape(3, 2, -1)
        assert [state.sun_orbit_x, state.sun_orbit_y] == pytest.approx(orbit[0, :, -1], rel=1e-5)


def test_orbits_are_displacements_turned_with_the_carrier(run):
    moved = run.axes.displacement[:, :3] @ np.array([1.0, 1.0j])
    carrier = np.exp(1j * run.angle[:, -1:])
    orbit = run.axes.orbit @ np.array([1.0, 1.0j])
    assert np.abs(carrier * moved - orbit).max() < 1e-12 * np.abs(orbit).max() + 1e-18
    assert np.ptp(run.angle[:, -1]) > 0.05  # it turns


def test_load_shares_follow_the_mesh_forces(file):
    gearbox = messages(file, "gearbox_state")
    for state, other in zip(messages(file, "axes_state"), gearbox, strict=True):
        force = other.sun_planet_mesh_force_mean[:3]
        assert state.load_share[:3] == pytest.approx(force / force.mean(), rel=1e-12)
        assert state.load_share[:3].sum() == pytest.approx(3.0)
        assert state.load_sharing_factor == state.load_share[:3].max() > 1.01
        flanks = state.sun_planet_drive_force[:3] - state.sun_planet_coast_force[:3]
        assert np.abs(flanks) == pytest.approx(np.abs(force), rel=5e-3)


def test_the_recording_is_verified_bit_for_bit_with_its_axes(file):
    found = verify(file, NAMESPACE)
    assert found.identical
    assert found.messages["axes_state"] == found.messages["axes_waveform"] == 5


def test_the_reader_has_states_and_samples_of_the_axes(file, run):
    recording = read_recording(file)
    assert recording.moves_axes
    assert set(axes_fields()) <= set(recording.axes_state.columns)
    samples = recording.axes_blocks.samples(0.0, DURATION)
    assert samples.orbit == pytest.approx(run.axes.orbit, rel=1e-4, abs=1e-10)
    part = recording.axes_blocks.samples(0.021, 0.022)
    assert part.time[0] < 0.021 < 0.022 <= part.time[-1] + 1e-9
    assert len(part.time) == RATE * 0.01


def test_tables_have_columns_of_every_body_with_units(file, tmp_path):
    export(file, Export(tmp_path / "tables"))
    waves = pyarrow.parquet.read_table(tmp_path / "tables/axes_waveform.parquet")
    states = pyarrow.parquet.read_table(tmp_path / "tables/axes_state.parquet")
    for table, name, unit in (
        (waves, "displacement_sun_x", b"m"),
        (waves, "bearing_force_planet_3_tangential", b"N"),
        (waves, "orbit_ring_y", b"m"),
        (states, "planet_bearing_force_radial_3", b"N"),
        (states, "load_share_1", b"-"),
    ):
        assert table.schema.field(name).metadata[b"unit"] == unit
    assert len(waves) == RATE * DURATION
    assert len(waves.column_names) == 2 + 4 * 6 + 2 * 3
    orbit = [state.sun_orbit_x for state in messages(file, "axes_state")]
    assert states["sun_orbit_x"].to_pylist() == orbit


def test_a_torsional_recording_gains_axes_in_a_branch(scene, tmp_path):
    held = record(Plan(scene.replace(dynamics="torsional"), 0.02, RATE, 1e-4), tmp_path / "held")
    assert not messages(held, "axes_state") + messages(held, "axes_waveform")
    assert not read_recording(held).moves_axes
    made = resimulate(held, NAMESPACE, Branch({"dynamics": "planar"}), tmp_path / "moving")
    assert len(messages(made.file, "axes_state")) == 2
    assert verify(made.file, NAMESPACE).identical


def test_an_altered_displacement_is_found(scene, file, tmp_path, monkeypatch):
    state = messages(file, "axes_state")[-1]
    moved = [state.sun_displacement_peak, state.ring_displacement_peak]
    moved += [state.carrier_displacement_peak, *state.planet_displacement_peak[:3]]
    assert largest_of_kind(state, "ring_displacement_x") == max(moved)
    forces = [state.sun_planet_drive_force[:3], state.planet_ring_drive_force[:3]]
    assert largest_of_kind(state, "planet_ring_coast_force") == np.max(forces)
    assert largest_of_kind(state, "load_share") == 0.0

    def altered(window):
        found = axes_state_fields(window)
        return found | {"ring_displacement_x": found["ring_displacement_x"] + 1e-6 * max(moved)}

    monkeypatch.setattr(compose, "axes_state_fields", altered)
    other = record(Plan(scene, 0.02, RATE, 1e-4), tmp_path / "altered")
    found = verify(other, NAMESPACE)
    assert found.first_difference.topic == "axes_state"
    assert found.first_difference.field == "ring_displacement_x"
    assert 1e-3 < found.largest < 1.0 and found.within_bound  # in tolerances
