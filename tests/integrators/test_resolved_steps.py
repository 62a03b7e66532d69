"""A step that is too short for its modes is not tried, and does not start the other method."""

import numpy as np
import pytest
from planetary_twin_benchmark.samples import samples_until

import planetary_twin_py as pt
from planetary_twin_py._core import DTE
from planetary_twin_py.run.start import start

DURATION, RATE = 0.3, 20_000.0


def run(name, tolerance, method):
    """Transmission errors [m] (n, meshes), and the counters of the run."""
    engine = start(pt.load_scene(name), tolerance, method)
    rows = round(DURATION * RATE)
    return samples_until(engine, DURATION, 1, RATE, rows).mesh[:, DTE], engine.control


@pytest.mark.parametrize("name", ["wind_turbine_stage", "helical_stage"])
def test_slow_shafts_do_not_start_rosenbrocks_method(name):
    """Their damping decays over milliseconds, a thousand times the first trial after an edge."""
    dte, control = run(name, 1e-3, "march")
    assert control.stiff_steps == 0
    exact, _ = run(name, 1e-6, "rosenbrock")
    error = np.sqrt(np.mean((dte - exact) ** 2, axis=0))
    assert np.all(error < 2e-3 * exact.std(axis=0))
