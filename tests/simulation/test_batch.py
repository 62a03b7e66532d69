"""Many scenes at once: as one by one, in order, a few at a time, and none stops another."""

import gc
import threading
import weakref

import numpy as np
import pytest
from stability.sound import PAPER

import planetary_twin_py as pt
from planetary_twin_py.simulation import threads

# The first takes longest, so that others are done before it.
SCENES = [
    PAPER.replace(input_torque=0.3, torque_ripple=3.0),
    pt.load_scene("differential"),
    pt.load_scene("wind_turbine_stage"),
    PAPER.replace(dynamics="quasi_static"),
    *(PAPER.replace(lambda_ratio=x, input_torque=y) for x in (1.0, 1.5) for y in (20.0, 63.0)),
]
# So small an addendum that a tooth pair leaves before the next one comes.
IMPOSSIBLE = PAPER.replace(**{"gearset.addendum": 0.3})
ARRAYS = ("time", "angle", "speed", "dte", "mesh_force", "film_thickness", "power_loss")


@pytest.mark.parametrize("workers", [1, 2, 5])
def test_results_are_those_of_single_runs_in_order(workers):
    outcomes = list(pt.simulate_many(SCENES, 0.01, 20_000.0, tolerance=1e-3, workers=workers))
    assert [outcome.place for outcome in outcomes] == list(range(len(SCENES)))
    for outcome, scene in zip(outcomes, SCENES, strict=True):
        assert outcome.scene is scene
        alone = pt.simulate(scene, 0.01, 20_000.0, tolerance=1e-3)
        for name in ARRAYS:
            found, expected = getattr(outcome.result, name), getattr(alone, name)
            assert np.array_equal(found, expected, equal_nan=True)
        assert outcome.result.energy == alone.energy


@pytest.mark.parametrize("workers", [1, 2])
def test_a_scene_that_fails_is_named_and_stops_no_other(workers):
    scenes = [PAPER, IMPOSSIBLE, PAPER]
    first, failed, last = pt.simulate_many(scenes, 0.002, workers=workers)
    assert np.array_equal(first.result.dte, last.result.dte)
    assert isinstance(failed.found, ValueError)
    with pytest.raises(ValueError, match=r"^scene 1 \(paper\): ") as error:
        _ = failed.result
    assert "\n" not in str(error.value) and error.value.__cause__ is failed.found


@pytest.fixture
def small_heap():
    """What is there already need not be searched for garbage, again and again."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


def test_results_are_kept_only_a_few_ahead_of_the_caller(small_heap):
    taken, results = [], []

    def scenes():
        for n in range(40):
            taken.append(n)
            yield PAPER.replace(lambda_ratio=1.0 + 0.01 * n)

    for outcome in pt.simulate_many(scenes(), 0.001, workers=2):
        assert len(taken) <= outcome.place + 1 + 2 * threads.Threads.ahead
        results.append(weakref.ref(outcome.result))
        del outcome
        gc.collect()
        assert all(result() is None for result in results)
    assert len(taken) == 40


def test_who_stops_taking_stops_the_work():
    before = threading.active_count()
    outcomes = pt.simulate_many([PAPER] * 1000, 0.002, workers=2)
    next(outcomes)
    outcomes.close()
    assert threading.active_count() == before


@pytest.mark.parametrize(
    "arguments",
    [{"duration": 0.0}, {"method": "euler"}, {"tolerance": 1.0}, {"workers": 0}],
    ids=str,
)
def test_arguments_out_of_range_are_refused_before_anything_runs(arguments):
    (name,) = arguments
    with pytest.raises(ValueError, match=f"^{name} = ") as error:
        pt.simulate_many([PAPER], **{"duration": 0.01, **arguments})
    assert "\n" not in str(error.value)
