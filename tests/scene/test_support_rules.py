"""Bearings that cannot hold their bodies are refused, and runs whose axes leave the teeth stop."""

import re

import numpy as np
import pytest

import planetary_twin_py as pt

FLOATING = pt.load_scene("floating_sun")
HELICAL = pt.load_scene("helical_stage")
NOTHING = {"supports.ring.bearing": 0.0, "supports.carrier.bearing": 0.0}  # the sun floats


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (NOTHING, "supports.sun.bearing, supports.ring.bearing, supports.carrier.bearing = 0"),
        ({"supports.planet.bearing": 0.0}, "supports.planet.bearing = 0: must be above 0 N/m"),
    ],
)
def test_gears_that_nothing_holds_are_refused(given, said):
    for dynamics in ("planar", "quasi_static_planar"):
        with pytest.raises(ValueError, match=re.escape(said)):
            FLOATING.replace(dynamics=dynamics, **given)
    held = FLOATING.replace(dynamics="torsional", **given)  # does not use them
    pt.simulate(held, 0.002)
    with pytest.raises(ValueError, match=re.escape(said)):
        pt.load_sharing(held)


@pytest.mark.parametrize("body", ["sun", "ring"])
@pytest.mark.parametrize("dynamics", ["spatial", "quasi_static_spatial"])
def test_a_helical_gear_needs_an_axial_bearing_a_spur_not(body, dynamics):
    floats = {f"supports.{body}.axial": 0.0, "dynamics": dynamics}
    with pytest.raises(ValueError, match=f"supports.{body}.axial = 0: must be above 0 N/m"):
        HELICAL.replace(**floats)
    HELICAL.replace(**floats, **{"gearset.helix_angle": 0.0})
    HELICAL.replace(**{"supports.planet.axial": 0.0, "supports.carrier.axial": 0.0})


@pytest.mark.parametrize("dynamics", ["planar", "quasi_static_planar"])
def test_pins_that_yield_by_a_module_stop_the_run(dynamics):
    """The load of a pin over its stiffness is its deflection."""
    scene = FLOATING.replace(dynamics=dynamics, **{"lubrication.friction": False})
    pin = pt.load_sharing(scene).planet_bearing
    load = np.linalg.norm(pin, axis=2).max()
    module = scene.gearset.module
    stiff, soft = (scene.replace(**{"supports.planet.bearing": load / (part * module)})
                   for part in (0.6, 1.4))  # fmt: skip
    displaced = pt.simulate(stiff, 0.01).axes.statistics.displacement_peak
    assert 0.5 * module < displaced[3:].max() < module
    stopped = r"the run stops .*: displacement of planet_\d = .* m: must be at most 0.0008 m"
    with pytest.raises(pt.RunawayError, match=stopped):
        pt.simulate(soft, 0.01)
    with pytest.raises(pt.RunawayError, match=stopped):
        pt.Twin(soft).advance(0.01)
    pt.load_sharing(stiff)
    with pytest.raises(ValueError, match="displacement of planet_1 = "):
        pt.load_sharing(soft)


def test_displacements_are_watched_while_a_run_settles():
    """A torque that swings once a turn is largest after 1 s; no sample is taken before 2 s."""
    scene = FLOATING.replace(input_speed=2.0 * np.pi * 0.25, **{"lubrication.friction": False})
    pin = np.linalg.norm(pt.load_sharing(scene).planet_bearing, axis=2).max()
    scene = scene.replace(
        torque_ripple=0.5 * scene.operating_point.input_torque,
        **{
            "drive.speed_control.ripple_order": 1,
            "supports.planet.bearing": pin / (1.1 * scene.gearset.module),
        },
    )
    with pytest.raises(pt.RunawayError, match=r"stops near 0\.[1-6]\d* s: displacement of planet"):
        pt.simulate(scene, 0.01, settling=2.0)


def test_helical_sun_that_leaves_ring_along_its_axis_stops_run():
    scene = HELICAL.replace(**{"supports.sun.axial": 1e5})
    stopped = r"axial displacement of sun = .* m: must be at most 0.62 m, gearset.face_width"
    with pytest.raises(pt.RunawayError, match=stopped):
        pt.simulate(scene, 0.01)
