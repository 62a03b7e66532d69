"""The converged reference sees every event."""

import pytest
from planetary_twin_benchmark.cases import CASES
from planetary_twin_benchmark.reference import Reference
from planetary_twin_benchmark.samples import samples_until
from planetary_twin_benchmark.table import dte_error

from planetary_twin_py._core import DTE
from planetary_twin_py.run.engine import Engine

RATE, SPAN = 50_000.0, 180e-6  # [Hz], [s]


@pytest.mark.exhaustive
@pytest.mark.slow
def test_flanks_that_meet_within_one_step_are_not_missed():
    """At 156 us a planet touches the coast flank of the ring for 0.6 us: 1e-5 of the error."""
    scene = next(case for case in CASES if case.name.startswith("resonance")).compared()
    true = Reference(scene).run(SPAN, RATE)[:, DTE]
    engine = Engine(scene, 1e-8, "rosenbrock")
    found = samples_until(engine, SPAN, 1, RATE, len(true)).mesh[:, DTE]
    assert dte_error(found, true) < 1e-7
