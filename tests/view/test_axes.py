"""Axes that move are drawn displaced, with bearing forces, orbits and the scales of both."""

import numpy as np
import pytest
from planar.moving_scenes import planar
from power_flows import FLOWS
from tiers import first
from view.entity_rows import rows

from planetary_twin_py.recording.container.records import records_of
from planetary_twin_py.recording.runs.offline import NAMESPACE, Plan, record
from planetary_twin_py.recording.runs.reader import read_recording
from planetary_twin_py.view.axes import scales
from planetary_twin_py.view.live import LiveView
from planetary_twin_py.view.show import scene_of, to_file

PIN = {"errors.pin_tangential": [-2e-5, 0.0, 0.0]}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """The ring is held, the carrier turns, the sun floats."""
    scene = planar(FLOWS[2], {"sun": 0.0}, **PIN)
    return record(Plan(scene, 0.2, 20_000.0, 1e-3), tmp_path_factory.mktemp("bag") / "axes")


@pytest.fixture(scope="module")
def recording(file):
    return read_recording(file)


def test_the_sun_is_drawn_displaced_by_the_stated_multiple(recording, drawn):
    scene = scene_of(recording)[0]
    scale = scales(scene.gearset, recording.axes_state)
    assert scale.magnification > 1.0
    state = recording.axes_state
    size = np.hypot(state["sun_displacement_x"], state["sun_displacement_y"]).mean()
    moved = rows(drawn, "/gears/sun", "Transform3D:translation")
    places = np.array([where[0][:2] for _, where in moved]) @ np.array([1.0, 1.0j])
    assert np.abs(places).mean() == pytest.approx(1e3 * scale.magnification * size, rel=0.05)
    time = np.array([time for time, _ in moved])
    turned = np.polyfit(time, np.unwrap(np.angle(places)), 1)[0]
    assert turned == pytest.approx(recording.state["carrier_speed"].mean(), rel=0.05)


def test_planets_are_displaced_against_the_carrier(recording, drawn):
    scene = scene_of(recording)[0]
    scale = scales(scene.gearset, recording.axes_state)
    state, psi = recording.axes_state, scene.gearset.planet_angles[0]
    own = (
        state["planet_displacement_radial"][:, 0]
        + 1j * state["planet_displacement_tangential"][:, 0]
    )
    carrier = state["carrier_displacement_x"] + 1j * state["carrier_displacement_y"]
    expected = 1e3 * scale.magnification * (own * np.exp(1j * psi) - carrier).mean()
    moved = rows(drawn, "/gears/carrier/pin_1/planet_1", "Transform3D:translation")
    places = np.array([where[0][:2] for _, where in moved]) @ np.array([1.0, 1.0j])
    assert abs(places.mean() - expected) < 0.02 * abs(expected)


def test_arrows_have_the_size_of_the_bearing_forces(recording, drawn):
    scene = scene_of(recording)[0]
    scale = scales(scene.gearset, recording.axes_state)
    state = recording.axes_state
    force = np.hypot(
        state["planet_bearing_force_radial"][:, 0], state["planet_bearing_force_tangential"][:, 0]
    )
    arrows = rows(drawn, "/gears/carrier/bearing_force/planet_1", "Arrows3D:vectors")
    lengths = np.array([np.linalg.norm(vector[0]) for _, vector in arrows])
    drawn_force = lengths / (1e3 * scale.length) * scale.force
    assert drawn_force.mean() == pytest.approx(force.mean(), rel=0.02)
    assert force.max() <= scale.force
    still = rows(drawn, "/gears/bearing_force/sun", "Arrows3D:vectors")
    assert all(np.linalg.norm(vector[0]) == 0.0 for _, vector in still)  # it floats


def test_orbit_and_load_shares_are_drawn(recording, drawn):
    assert all(len(row) for _, row in rows(drawn, "/orbit/sun/curve", "LineStrips2D:strips"))
    shares = rows(drawn, "/axes/load_share", "Scalars:scalars")
    assert [len(row) for _, row in shares] == [3] * len(recording.axes_state)


@pytest.mark.parametrize("batch", first(1, [1, 50]))
def test_a_live_view_draws_load_shares_and_arrows(file, drawn, tmp_path, batch):
    rrd = tmp_path / "live.rrd"
    view = LiveView(NAMESPACE, lambda: to_file(rrd))
    records = list(records_of(file, []))
    for start in range(0, len(records), batch):
        view.add(records[start : start + batch])
    view.close()
    live, whole = (rows(each, "/axes/load_share", "Scalars:scalars") for each in (rrd, drawn))
    assert live == whole
    arrows = rows(rrd, "/gears/carrier/bearing_force/planet_1", "Arrows3D:vectors")
    assert {round(time, 6) for time, _ in arrows} == {round(time, 6) for time, _ in whole}
