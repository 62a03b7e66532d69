"""Pits in rolling bearings: against sums over elements, an energy balance, and orders of faults."""

import math

import numpy as np
import pytest
from analysis.gear_sets import gear_set
from planar.moving_scenes import supports
from planar.rolling_law import element
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.rolling_bearings import press, rolling_bearing
from planetary_twin_py.scene.supports import Rolling

ROLLERS = {"rollers": 14, "length": 0.012}
RATIO = 0.2
DEPTH, WIDTH = 3e-6, 0.1
FAULT = {"kind": "bearing", "ratio": RATIO, "width": WIDTH, "depth": DEPTH}
SUN_TURNS = 40 / 7  # per turn of the carrier of 21/39/99 teeth, ring held


def rig(fault, speed=1000.0, on="planet", **changes):
    """21/39/99 teeth in the plane; one kind of body on rollers."""
    given = supports()
    given[on] = {"mass": given[on]["mass"], "rolling": ROLLERS}
    return gear_set(
        (21, 39, 99), dynamics="planar", supports=given | changes.pop("weight", {}),
        faults=[FAULT | fault] if fault else [], input_speed=pt.rpm(speed), backlash=1e-4,
        **{"gearset.planet_mass": given["planet"]["mass"]} | changes,
    )  # fmt: skip


def eccentricity(run, scene, planet):
    """Displacement of a planet on its pin (n, 2), outwards and across."""
    moved = run.axes.displacement
    angle = scene.gearset.planet_angles[planet - 1]
    cosine, sine = math.cos(angle), math.sin(angle)
    x, y = moved[:, 2].T
    carrier = np.stack([cosine * x + sine * y, cosine * y - sine * x], axis=1)
    return moved[:, 2 + planet] - carrier


@pytest.mark.parametrize("place", [0.0, 0.6])
def test_an_element_in_a_pit_carries_what_its_depth_leaves(place):
    """In slow running, a pit of the inner race `place` from the middle of the load zone.

    What the mean force of all elements exceeds the force on the bearing by is K (d^n - (d - h)^n),
    d = r cos(place), when a roller is in the middle of the pit, and less towards its ends.
    """
    fault = {"element": "inner", "planet": 2, "angle": place}
    scene = rig(fault, speed=30.0, **{"lubrication.friction": False})
    carrier = 0.5 / (1.0 + 99 / 21)  # turns per second
    period = 1.0 / (14 * 0.6 * 33 / 13 * carrier)  # between two rollers in the pit
    run = pt.simulate(scene, period, 20_000.0, settling=0.1)
    moved, force = eccentricity(run, scene, 2), run.axes.bearing_force[:, 4]
    size = np.hypot(*moved.T)
    mean = press(rolling_bearing(Rolling(**ROLLERS)), 0.0, size)[1, :, None] * moved / size[:, None]
    missing = np.hypot(*(mean - force).T)
    damping = np.quantile(missing, 0.3)  # of the bearing, without a roller in the pit
    deepest = int(missing.argmax())
    _, n, strength = element(Rolling(**ROLLERS))
    loaded = -moved[deepest] / size[deepest]  # towards the rollers between pin and planet
    across = math.atan2(loaded[1], loaded[0]) + 0.5 * math.pi  # from the nominal load
    pressed = size[deepest] * math.cos(place - across)
    expected = strength * (pressed**n - max(pressed - DEPTH, 0.0) ** n)
    assert damping < 0.02 * expected
    assert missing[deepest] == pytest.approx(expected, rel=0.02)
    share = WIDTH * 14 / (2.0 * math.pi)  # of the time with a roller in the pit

    def lost(s):
        return strength * (pressed**n - max(pressed - DEPTH * (1.0 - s * s) ** 2, 0.0) ** n)

    mean_lost = share * quad(lost, 0.0, 1.0)[0]
    assert (missing - damping).mean() == pytest.approx(mean_lost, rel=0.05)


CASES = {
    "outer": ("planet", {"element": "outer"}, {}),
    "inner": ("planet", {"element": "inner", "planet": 3}, {}),
    "roller": ("planet", {"element": "roller"}, {}),
    "carrier": ("carrier", {"element": "inner", "bearing": "carrier"}, {"gravity": 100.0}),
    "outer of the carrier": (
        "carrier", {"element": "outer", "bearing": "carrier", "angle": -1.5}, {"gravity": 100.0},
    ),
    "roller of the sun": ("sun", {"element": "roller", "bearing": "sun"}, {"gravity": 100.0}),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_the_ledger_closes_while_elements_pass_a_pit(case):
    """To the same part of the work as without; the pit changes the motion."""
    on, fault, weight = CASES[case]
    scene = rig(fault, on=on, weight=weight)
    found, healthy = (
        pt.simulate(each, 0.15, 10_000.0, tolerance=1e-5)
        for each in (scene, scene.replace(**{"faults.0.depth": 0.0}))
    )
    work = abs(found.energy.machines[0])
    assert np.abs(found.axes.displacement - healthy.axes.displacement).max() > 1e-9
    assert abs(healthy.energy.residual) < 1e-8 * work
    assert abs(found.energy.residual) < 1e-8 * work


@pytest.mark.parametrize("part", ["outer", "inner", "roller"])
def test_passages_have_the_orders_of_the_command_faults(part):
    """Exactly: 14 rollers pass a pit of a race, a roller meets either race once in a turn."""
    train = Gearbox(rig({"element": part})).train
    pit = train.moving.pit[0]
    assert train.moving.pits == 1
    cage, own = pit.per_turn
    rate = own if part == "roller" else 14 * abs(cage - own)
    orders = pt.fault_orders(rig(None), rollers=14, ratio="0.2")
    names = {"outer": "outer race (planet)", "inner": "inner race (pin)", "roller": "roller"}
    (lines,) = (line for line in orders.lines if line.fault == names[part])
    on_pin = float(orders.rates["planet_tooth"])  # turns of the planet on its pin
    assert rate * on_pin == pytest.approx(float(lines.rate), rel=1e-14)
    turned = pit.per_motor[0][0] * SUN_TURNS  # the cage, per turn of the carrier
    assert abs(turned) == pytest.approx(0.6 * on_pin, rel=1e-14)


def test_a_pit_of_depth_zero_is_no_pit():
    fault = {"element": "outer", "depth": 0.0}
    found, healthy = (
        pt.simulate(rig(each), 0.05, 10_000.0, tolerance=1e-6) for each in (fault, None)
    )
    assert np.abs(found.dte - healthy.dte).max() < 1e-4 * np.abs(healthy.dte).max()


def test_a_pit_that_is_set_is_that_of_a_scene_with_it():
    """Samples are the same for windows of any length; the late motion is that of the pit."""
    scene, parts = rig({"element": "inner", "depth": 0.0}), []
    for lengths in ([0.01] * 6, [0.013] * 4 + [0.008]):
        twin, waves = pt.Twin(scene, 10_000.0, 1e-4), []
        for length in lengths:
            waves.append(twin.advance(length).waveform.mesh_force)
        twin.set(**{"faults.0.depth": DEPTH})
        window = twin.advance(0.05)
        waves.append(window.waveform.mesh_force)
        assert abs(window.residual_power) < 1e-4 * window.power_loss
        assert dict(window.severities) == {"faults.0.depth": DEPTH}
        parts.append(np.vstack(waves).tobytes())
    assert parts[0] == parts[1]


@pytest.mark.slow
@pytest.mark.parametrize("part", ["outer", "inner"])
def test_the_envelope_on_the_ring_has_the_lines_of_the_pit(part):
    """Squared envelope of an accelerometer, without its average over a third of a carrier turn.

    A healthy set repeats in this time. The outer race has sidebands of the planet on its pin, the
    inner race only those of the carrier, by the passing of the planet.
    """
    turns, per_turn = 5, 12_000
    carrier = 1000.0 / 60.0 / (1.0 + 99 / 21)
    sensor = {"name": "ring", "kind": "accelerometer", "rate": 10e3, "noise": 0.0}
    scene, found = rig({"element": part, "depth": 5e-6, "width": 0.06}, sensors=[sensor]), []
    for depth in (5e-6, 0.0):
        run = pt.simulate(
            scene.replace(**{"faults.0.depth": depth}), (turns + 0.6) / carrier, 1000.0,
            settling=0.5 / carrier,
        )  # fmt: skip
        measured = run.sensors["ring"]
        angle = np.unwrap(run.angle[:, run.bodies.index("carrier")]) / (2.0 * math.pi)
        known = (measured.time > run.time[0]) & (measured.time < run.time[-1])
        turned = np.interp(measured.time[known], run.time, angle)
        even = turned[0] + np.arange(turns * per_turn) / per_turn
        thirds = CubicSpline(turned, measured.values[known])(even).reshape(3 * turns, -1)
        rest = (thirds - thirds.mean(axis=0)).ravel()
        order, amplitude = pt.squared_envelope_spectrum(rest, float(per_turn), (20.0, 1700.0))
        found.append(lambda at, o=order, a=amplitude: a[np.abs(o - at) < 0.15].max())
    pitted, healthy = found
    orders = pt.fault_orders(scene, rollers=14, ratio="0.2")
    lines = next(line for line in orders.lines if line.fault.startswith(part))
    rate, pin = float(lines.rate), float(orders.rates["planet_tooth"])
    sidebands = {"outer": rate - pin, "inner": rate + 1.0}
    for at in (rate, sidebands[part], 2.0 * rate):
        assert pitted(at) > 20.0 * healthy(at)
        assert pitted(at) > 0.25 * pitted(rate)
    if part == "inner":
        assert pitted(rate - pin) < 0.1 * pitted(rate)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (
            {"dynamics": "torsional"},
            r"^faults\.0: a pit in a bearing requires dynamics = planar or spatial, in which",
        ),
        ({"supports": supports()}, r"^faults\.0: requires the rollers or balls of supports\.plan"),
        ({"faults.0.bearing": "ring"}, r"faults\.0\.bearing = 'ring': does not turn, as gearset"),
        ({"faults.0.width": 0.5}, r"^faults\.0\.width = 0\.5: must be at most 0\.4488 rad, one"),
        ({"faults.0.planet": 4}, r"^faults\.0\.planet = 4: must be at most 3$"),
        (
            {"faults.0.growth": {"meshes": [0, 9], "depth": [3e-6, 4e-6]}},
            r"growth: a pit of a bearing grows by a table of times$",
        ),
    ],
)  # fmt: skip
def test_a_pit_that_a_scene_cannot_have_is_refused_in_a_line(changes, message):
    with pytest.raises(pt.SceneError, match=message):
        rig({"element": "outer"}).replace(**changes)
