"""Tooth pairs in contact are where both flanks and the line of action meet."""

import math
from types import SimpleNamespace
from unittest.mock import Mock

import numpy as np
import pytest
from paths import planet_ring_path, sun_planet_path
from twin_recording import START_NS, TwinRecording, write_recording

from planetary_twin_py.gearset.geometry import pitch_radius
from planetary_twin_py.gearset.kinematics import speed_ratios
from planetary_twin_py.gearset.mount import mount
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.recording.runs.severities import Recorded
from planetary_twin_py.robot.parts import carrier_radius
from planetary_twin_py.run.twin import Twin
from planetary_twin_py.scene import load_scene
from planetary_twin_py.view.contacts import _blocks, contacts, forces, log_contacts
from planetary_twin_py.view.motion import motion
from planetary_twin_py.view.timeline import columns

PAPER = load_scene("paper")
FIVE = PAPER.replace(**{"gearset.planet_angles": tuple(2 * np.pi * k / 5 for k in range(5))})
HELD_RING = load_scene("wind_turbine_stage")
HELICAL = load_scene("helical_stage")
SUN_ANGLE = np.linspace(-0.7, 0.9, 301)  # against the carrier


def turned(scene):
    """Angles of all members since the start, the carrier held, at `SUN_ANGLE`."""
    gearset = scene.gearset
    ratio = speed_ratios(gearset.tooth_numbers, "carrier", "sun")
    angle = {name: float(ratio[name]) * SUN_ANGLE for name in ("sun", "ring", "carrier")}
    planets = range(1, gearset.planets + 1)
    return angle | {f"planet_{i}": float(ratio["planet"]) * SUN_ANGLE for i in planets}


def off_flank(gear, angle, point):
    """Distance [m] from points (n, p, 2) about the gear's centre to the nearest of its flanks.

    `angle` (n, p) is that of tooth 0 in the sections of the points. Distances are counted along the
    base circle, where flanks of one kind are a base pitch apart: that is their distance along the
    normal. Both kinds of flank are given, (2, n, p).
    """
    radius = np.hypot(point[..., 0], point[..., 1])
    local = np.arctan2(point[..., 1], point[..., 0]) - angle
    pitch = 2 * math.pi / gear.teeth
    half = gear.half_thickness(radius)
    away = [np.mod(local - side * half + 0.5 * pitch, pitch) - 0.5 * pitch for side in (1, -1)]
    return np.abs(away) * gear.base_radius


def gears_of_mesh(scene, mesh):
    """First and second gear of a mesh: teeth, angle seen from the carrier, and centre."""
    gearset = scene.gearset
    ring, i = divmod(mesh, gearset.planets)
    mounted = mount(gearset.tooth_numbers, gearset.planet_angles)
    psi = gearset.planet_angles[i]
    centre = carrier_radius(gearset) * np.array([math.cos(psi), math.sin(psi)])
    gears, angle, middle = gearset.geometry, turned(scene), np.zeros(2)
    sun = gears.sun, mounted.sun + angle["sun"], middle
    planet = gears.planet, mounted.planets[i] + angle[f"planet_{i + 1}"], centre
    annulus = gears.ring, mounted.ring + angle["ring"], middle
    return (planet, annulus) if ring else (sun, planet)


@pytest.mark.parametrize("scene", [PAPER, FIVE, HELD_RING], ids=["paper", "five", "turbine"])
@pytest.mark.parametrize("flank", [1.0, -1.0], ids=["drive", "coast"])
def test_contacts_are_on_the_loaded_flanks_of_both_gears(scene, flank):
    """Sun and planet turn in opposite senses: both touch with flanks that face the same way."""
    for mesh in range(2 * scene.gearset.planets):
        found = contacts(
            Gearbox(scene), mesh, turned(scene), np.full(len(SUN_ANGLE), 1000.0 * flank)
        )
        there = found.load > 0.0
        facing = (-flank, flank) if mesh >= scene.gearset.planets else (flank, flank)
        for (gear, angle, centre), side in zip(gears_of_mesh(scene, mesh), facing, strict=True):
            hand = 1.0 if gear is scene.gearset.geometry.sun else -1.0
            screw = hand * math.tan(scene.gearset.helix_angle) / gear.pitch_radius
            for end in (0, 1):
                section = angle[:, None] + screw * found.ends[:, :, end, 2]
                place = found.ends[:, :, end, :2] - centre
                counter_clockwise, clockwise = off_flank(gear, section, place)
                own, other = counter_clockwise, clockwise
                if side < 0:
                    own, other = other, own
                assert own[there].max() < 1e-9
                assert other[there].min() > 0.2 * gear.module


def test_helical_lines_of_contact_cover_the_path_of_contact():
    """Of a pair, the sections on the path of contact touch: no more, and none is left out."""
    gearset = HELICAL.gearset
    for mesh, path in ((1, sun_planet_path), (4, planet_ring_path)):
        reach = path(gearset.tooth_numbers, gearset.pressure_angle, gearset.addendum)
        found = contacts(Gearbox(HELICAL), mesh, turned(HELICAL), np.full(len(SUN_ANGLE), 1000.0))
        there = found.load > 0.0
        z = found.ends[there][..., 2]
        assert np.abs(z).max() == pytest.approx(0.5 * gearset.face_width, rel=1e-9)
        length = (np.ptp(found.ends[..., 2], axis=2) * there).sum(axis=1)
        assert length.mean() == pytest.approx(reach.contact_ratio * gearset.face_width, rel=0.01)


@pytest.mark.parametrize("flank", [1.0, -1.0], ids=["drive", "coast"])
def test_contacts_are_on_the_line_of_action(flank):
    """It is tangent to both base circles, so the force acts on each gear with its base radius."""
    gearset = PAPER.gearset
    for mesh, path in ((1, sun_planet_path), (4, planet_ring_path)):
        reach = path(gearset.tooth_numbers, gearset.pressure_angle, gearset.addendum)
        found = contacts(Gearbox(PAPER), mesh, turned(PAPER), np.full(len(SUN_ANGLE), flank))
        there = found.load > 0.0
        for gear, _, centre in gears_of_mesh(PAPER, mesh):
            arm, push = (found.point - centre)[there], found.direction[there]
            lever = arm[:, 0] * push[:, 1] - arm[:, 1] * push[:, 0]
            assert np.allclose(np.abs(lever), gear.base_radius, atol=1e-12)
        assert np.allclose(np.hypot(*found.direction[there].T), 1.0)
        centre = gears_of_mesh(PAPER, mesh)[0][2]
        psi = gearset.planet_angles[1]
        teeth = gearset.teeth.ring if mesh == 4 else gearset.teeth.sun
        pitch_point = pitch_radius(teeth, gearset.module) * np.array([np.cos(psi), np.sin(psi)])
        past = np.einsum("ij,ij->i", found.point[there] - pitch_point, found.direction[there])
        pitch = np.pi * gearset.module * np.cos(gearset.pressure_angle)
        assert past.min() == pytest.approx(-reach.approach * pitch, abs=0.02 * pitch)
        assert past.max() == pytest.approx(reach.recess * pitch, abs=0.02 * pitch)


def test_pairs_share_the_whole_force_and_an_open_mesh_has_none():
    force = np.where(SUN_ANGLE < 0.2, 1500.0, 0.0)
    found = contacts(Gearbox(PAPER), 0, turned(PAPER), force)
    assert np.allclose(found.load.sum(axis=1), force)
    pairs = (found.load > 0).sum(axis=1)
    assert set(pairs[force > 0]) == {1, 2}
    reach = sun_planet_path(PAPER.gearset.tooth_numbers, PAPER.gearset.pressure_angle, 1.0)
    assert pairs[force > 0].mean() == pytest.approx(reach.contact_ratio, abs=0.05)


def test_a_cracked_tooth_is_drawn_with_its_smaller_load():
    """The crack reduces the tooth's stiffness; the adjacent pair takes over."""
    crack = {"kind": "crack", "gear": "sun", "tooth": 0, "stiffness_loss": 0.5}
    force = np.full(len(SUN_ANGLE), 1000.0)
    healthy, cracked = (
        contacts(Gearbox(scene), 0, turned(scene), force)
        for scene in (PAPER, PAPER.replace(faults=[crack]))
    )
    assert np.allclose(cracked.load.sum(axis=1), force)
    cycle = 30 * SUN_ANGLE / (2 * math.pi)  # tooth 0 is at the pitch point of planet 1 at 0
    behind = (cycle > 0.45) & (cycle < 0.7)  # two full pairs, of which the first is cracked
    assert np.allclose(healthy.load[behind].max(axis=1), 500.0)
    assert np.allclose(cracked.load[behind].max(axis=1), 1000.0 * 1 / 1.5)
    far = np.abs(cycle) > 1.5
    assert np.array_equal(healthy.load[far], cracked.load[far])


def test_loads_are_drawn_with_the_severities_of_their_time(tmp_path):
    """A crack that is set after 50 ms: loads of a healthy gear before, of a cracked one after."""
    crack = {"kind": "crack", "gear": "sun", "tooth": 15, "stiffness_loss": 0.0}
    scene = PAPER.replace(faults=[crack])
    written, twin = TwinRecording(tmp_path / "a"), Twin(scene, 20_000.0, 1e-3)
    written.begin(twin, START_NS)
    for number in range(10):
        if number == 5:
            twin.set(**{"faults.0.stiffness_loss": 0.5})
            written.point(twin)
        written.advance(twin, 0.01)
    written.finish()
    recording = read_recording(written.file)
    moved = motion(recording)
    force = forces(recording, moved.time)
    drawn = Recorded(moved.time, moved.stamp, moved.angle, force)
    (before, early), (after, late) = _blocks(Gearbox(scene), recording, drawn)
    assert moved.time[after][0] == pytest.approx(0.05, abs=1e-3) and after.start == before.stop
    healthy, cracked = Gearbox(PAPER), Gearbox(scene.replace(**{"faults.0.stiffness_loss": 0.5}))
    for rows, train, right, wrong in (
        (before, early, healthy, cracked), (after, late, cracked, healthy)
    ):  # fmt: skip
        angle = {name: values[rows] for name, values in moved.angle.items()}
        load = contacts(Gearbox(scene), 0, angle, force[rows, 0], train).load
        assert np.allclose(load, contacts(right, 0, angle, force[rows, 0]).load, rtol=1e-9)
        assert np.abs(load - contacts(wrong, 0, angle, force[rows, 0]).load).max() > 100.0


def test_forces_are_samples_or_means_where_there_is_a_gap(tmp_path):
    recording = read_recording(write_recording(tmp_path / "a.mcap", 0.05))
    wave = recording.waveform
    wave.mesh_force[:] = -7.0
    kept = (wave.time < 0.02) | (wave.time > 0.03)
    wave.time, wave.mesh_force = wave.time[kept], wave.mesh_force[kept]
    found = forces(recording, np.array([0.0101, 0.0255, 0.04]))
    assert np.all(found[[0, 2]] == -7.0)
    assert np.array_equal(found[1], recording.per_mesh("mesh_force_mean")[2])
    recording.waveform = None
    assert np.all(forces(recording, np.array([0.01, 0.04])) > 0.0)


def test_contacts_are_sent_in_blocks_that_miss_no_time(tmp_path, monkeypatch):
    """So that a recording of hours needs little memory."""
    recording, block = read_recording(write_recording(tmp_path / "a.mcap", 0.3)), 7
    monkeypatch.setattr("planetary_twin_py.view.contacts._BLOCK", block)
    sent = {}

    def keep(path, index, strips):
        times = index[0].as_arrow_array().to_numpy(zero_copy_only=False).tolist()
        assert len(times) <= block
        sent.setdefault(path, []).extend(times)

    moved = motion(recording)
    log_contacts(SimpleNamespace(send_columns=keep, log=Mock()), PAPER, recording, moved)
    assert sorted(sent) == sorted(f"gears/carrier/contact/{mesh}" for mesh in recording.meshes)
    expected = (
        columns(moved.time, moved.stamp)[0].as_arrow_array().to_numpy(zero_copy_only=False).tolist()
    )
    assert len(expected) > 3 * block and all(times == expected for times in sent.values())
