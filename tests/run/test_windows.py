"""Windows of a run: what they are asked for, and what they add up to."""

import numpy as np
import pytest

import planetary_twin_py as pt
from planetary_twin_py._core import PUBLISHED, WAVEFORM
from planetary_twin_py.model.clock import TICKS
from planetary_twin_py.run.run_total import RunTotal
from planetary_twin_py.run.samples import EVERYTHING, PUBLISHED_ONES, Asked
from planetary_twin_py.run.window_jobs import run_alone
from planetary_twin_py.run.windows import Windows
from planetary_twin_py.units.catalogue import WAVEFORM as IN_MESSAGES

PAPER = pt.load_scene("paper")
SCENES = {
    "held axes": PAPER,
    "moving axes": pt.load_scene("floating_sun"),
    "quasi-static": PAPER.replace(dynamics="quasi_static"),
}
EVERY_SCENE = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)


def advanced(scene, asked, *lengths):
    """Windows of these lengths [s], and the samples of the last one."""
    windows = Windows(scene, 1e-4, asked=asked)
    for length in lengths:
        plan = windows.plan(windows.ticks + round(length * TICKS), 50_000.0)
        run_alone(windows.jobs(plan))
        windows.close(plan)
    return windows, plan.waves


def test_messages_have_the_first_quantities_of_the_core():
    assert WAVEFORM[:PUBLISHED] == tuple(IN_MESSAGES)


@EVERY_SCENE
def test_only_quantities_that_are_asked_for_are_sampled(scene):
    _, none = advanced(scene, Asked(frozenset()), 0.003)
    _, film = advanced(scene, Asked(frozenset(["film_thickness"])), 0.003)
    _, every = advanced(scene, EVERYTHING, 0.003)
    assert none.asked_of_meshes == [] and none.bodies is None
    (alone,) = film.asked_of_meshes
    assert np.array_equal(alone, every.mesh[WAVEFORM.index("film_thickness")], equal_nan=True)
    assert len(every.asked_of_meshes) == len(WAVEFORM) and every.bodies is not None


@EVERY_SCENE
def test_what_is_asked_for_does_not_change_the_run(scene):
    found = [
        advanced(scene, asked, 0.002, 0.0013)
        for asked in (Asked(frozenset()), PUBLISHED_ONES, EVERYTHING)
    ]
    ends = [windows.last for windows, _ in found]
    for end in ends[1:]:
        for name in ("ledger", "turns", "angle"):
            assert np.array_equal(getattr(end, name), getattr(ends[0], name))
        assert np.array_equal(end.sums.integral, ends[0].sums.integral)
    for published, whole in zip(found[1][1].asked_of_meshes, found[2][1].mesh, strict=False):
        assert np.array_equal(published, whole)


@EVERY_SCENE
def test_friction_is_that_of_boundary_and_of_viscous_friction(scene):
    _, waves = advanced(scene, EVERYTHING, 0.003)
    of = dict(zip(WAVEFORM, waves.mesh, strict=True))
    assert of["friction"] == pytest.approx(of["boundary_friction"] + of["viscous_friction"])


@EVERY_SCENE
def test_looking_at_the_end_of_a_window_changes_nothing(scene):
    seen, untouched = Windows(scene, 1e-4), Windows(scene, 1e-4)
    for _ in range(3):
        for windows in (seen, untouched):
            plan = windows.plan(windows.ticks + round(0.00123 * TICKS), 1e4)
            run_alone(windows.jobs(plan))
            windows.close(plan)
        RunTotal(seen)
        assert np.array_equal(seen.last.ledger, untouched.last.ledger)
        assert np.array_equal(seen.last.sums.integral, untouched.last.sums.integral)


@pytest.mark.parametrize("scene", [PAPER, SCENES["moving axes"]], ids=["held", "moving"])
def test_energy_of_parts_of_a_run_is_that_of_steps_that_end_there(scene):
    """Against a run with a hundredth of the tolerance, whose steps are many times shorter."""
    run, exact = (
        pt.simulate(scene, 0.00111, 1e4, tolerance=t, settling=0.00222) for t in (1e-4, 1e-6)
    )
    assert run.energy.machines == pytest.approx(exact.energy.machines, rel=2e-4)
    assert run.energy.loss == pytest.approx(exact.energy.loss, rel=2e-4)
    assert abs(run.energy.residual) < 1e-6 * run.energy.driving_work
