"""Resonant speeds: a harmonic of the meshing frequency on a natural frequency."""

import itertools
import math

import numpy as np
import pytest
from power_flows import DIFFERENTIALS, scene_of

import planetary_twin_py as pt
from planetary_twin_py.explanation.meshes import describe_meshes
from planetary_twin_py.modal.campbell import mesh_line, resonances
from planetary_twin_py.modal.excitation import EXCITED
from planetary_twin_py.modal.natural import spring_model
from planetary_twin_py.plots.campbell import campbell_diagram


def rays_of(figure):
    """Speeds [rpm] and frequencies [Hz] of the line of each harmonic that a label names."""
    (axes,) = figure.axes
    numbers = sorted(int(label.get_text()) for label in axes.texts)
    return {n: line.get_data() for n, line in zip(numbers, axes.lines, strict=False)}


def test_first_mode_is_met_at_11000_rpm_and_fractions_of_it():
    scene = pt.load_scene("paper")
    modes = pt.natural_modes(scene)
    found = resonances(scene, modes, spring_model(scene), pt.rpm(12_000), harmonics=3)
    speeds = {r.harmonic: r.speed * 30 / math.pi for r in found if r.mode == 1}
    first = modes.frequencies[1] / 30 * 60
    assert speeds == pytest.approx({1: first, 2: first / 2, 3: first / 3})
    assert [r.speed for r in found] == sorted(r.speed for r in found)
    for resonance in found:
        per_second = 30 * resonance.speed / (2 * math.pi)
        assert resonance.harmonic * per_second == pytest.approx(resonance.frequency)


def test_modes_of_one_frequency_are_met_once():
    scene = pt.load_scene("paper")
    modes, springs = pt.natural_modes(scene), spring_model(scene)
    found = resonances(scene, modes, springs, pt.rpm(30_000), harmonics=1)
    assert [(r.mode, r.kind, r.multiplicity) for r in found] == [
        (1, "rotational", 1),
        (2, "planet", 2),
        (4, "rotational", 1),
    ]


SECOND = pt.rpm(-400.0)


def differential(**changes):
    """The sun turns at the speed of the axis, the carrier at `SECOND`."""
    return scene_of(DIFFERENTIALS[0], **{"second_input_speed": SECOND, **changes})


def test_a_second_motor_shifts_the_resonant_speeds_by_its_own():
    """f_m = Zs |ns - nc|, so speeds of the sun are those relative to the carrier, plus its own."""
    scene, highest = differential(), pt.rpm(20_000)
    modes = pt.natural_modes(scene)
    found = resonances(scene, modes, spring_model(scene), highest, harmonics=2)
    expected = [
        sense * frequency / (30 * h) * 2 * math.pi + SECOND
        for frequency in sorted(set(modes.frequencies[[2, 3, 5]]))
        for h in (1, 2)
        for sense in (-1, 1)
    ]
    within = sorted(speed for speed in expected if abs(speed) <= highest)
    assert [r.speed for r in found] == pytest.approx(within)
    assert min(within) < 0.0 < max(within)


@pytest.mark.parametrize("speed", [pt.rpm(1500), pt.rpm(-1500)])
def test_lines_of_a_differential_are_those_of_both_speeds(speed):
    scene = differential(input_speed=speed)
    found = describe_meshes(scene).mesh_frequency
    assert mesh_line(scene).at(np.array(speed)) == pytest.approx(found)


def test_the_twin_meshes_at_the_frequency_of_a_resonance():
    scene = differential(**{"drive.speed_limit": pt.rpm(20_000)})
    modes, springs = pt.natural_modes(scene), spring_model(scene)
    for resonance in resonances(scene, modes, springs, pt.rpm(12_000), harmonics=2):
        run = pt.simulate(scene.replace(input_speed=resonance.speed), 0.02, tolerance=1e-3)
        sun, carrier = (run.mean_speed[run.bodies.index(body)] for body in ("sun", "carrier"))
        met = resonance.harmonic * 30 * abs(sun - carrier) / (2 * math.pi)
        assert met == pytest.approx(resonance.frequency, rel=0.01)


def test_marks_of_a_differential_are_on_its_lines():
    scene, highest = differential(), pt.rpm(20_000)
    modes = pt.natural_modes(scene, stiffness="mean")
    found = resonances(scene, modes, spring_model(scene, stiffness="mean"), highest)
    figure = campbell_diagram(scene, modes, found, highest)
    (axes,) = figure.axes
    rays, marks = rays_of(figure), axes.collections[-1].get_offsets()
    assert {*rays} == {1, 2, 3, 4, 5} | {r.harmonic for r in found} and len(marks) == len(found) > 0
    assert axes.get_xlim() == pytest.approx((-20_000, 20_000))
    for resonance, (x, y) in zip(found, marks, strict=True):
        assert y == pytest.approx(np.interp(x, *rays[resonance.harmonic]))
    assert rays[1][1][1] == 0.0 and rays[1][0][1] == pytest.approx(-400)
    figure.draw_without_rendering()
    boxes = [label.get_window_extent() for label in axes.texts]
    assert not any(a.overlaps(b) for a, b in itertools.combinations(boxes, 2))


def test_every_crossing_of_a_harmonic_is_marked():
    scene = pt.load_scene("paper")
    modes, highest = pt.natural_modes(scene, stiffness="mean"), pt.rpm(20_000)
    found = resonances(scene, modes, spring_model(scene, stiffness="mean"), highest)
    figure = campbell_diagram(scene, modes, found, highest)
    rays, (axes,) = rays_of(figure), figure.axes
    marks = axes.collections[-1]
    sizes = marks.get_sizes()
    assert int(np.argmax(sizes)) == int(np.argmax([r.weight for r in found]))
    assert len(sizes) == len(found) > 0
    for resonance, (x, y) in zip(found, marks.get_offsets(), strict=True):
        (x0, x1), (y0, y1) = rays[resonance.harmonic]
        assert y == pytest.approx(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
        assert y == pytest.approx(modes.frequencies[resonance.mode])


def test_crossings_that_phasing_suppresses_are_open_circles():
    scene = pt.load_scene("wind_turbine_stage")
    modes, springs = (make(scene, "planar", "mean") for make in (pt.natural_modes, spring_model))
    found = resonances(scene, modes, springs, pt.rpm(60.0))
    (axes,) = campbell_diagram(scene, modes, found, pt.rpm(60.0)).axes
    filled, hollow = axes.collections[-2:]
    assert [marks.get_facecolor()[0, 0] for marks in (filled, hollow)] == [0.0, 1.0]
    excited = [r.frequency for r in found if r.excitation == EXCITED]
    assert filled.get_offsets()[:, 1].tolist() == pytest.approx(excited)
    assert len(hollow.get_offsets()) == len(found) - len(excited) > 0
