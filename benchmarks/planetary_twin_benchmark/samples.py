"""Samples of all quantities of a run, without windows."""

from __future__ import annotations

from fractions import Fraction

from planetary_twin_py.model.clock import NEVER, instant, sampling
from planetary_twin_py.run.engine import Engine
from planetary_twin_py.run.samples import Samples, new_samples


def samples_until(
    engine: Engine, until: float | Fraction, first: int, rate: float, room: int
) -> Samples:
    """Integrate to a time, and sample on the way.

    Args:
        engine: the run, which is not stopped by its limits meanwhile.
        until: time that it reaches [s].
        first: number of the first sample.
        rate: sample times are integer multiples of its inverse [Hz].
        room: number of samples.

    Returns:
        The samples.
    """
    samples, at = new_samples(engine.train, room + 1), sampling(first, rate)  # one is at the end
    engine._core.advance(engine.model, engine.integrator, instant(until), NEVER, at, samples)
    return Samples(*(values[:room] for values in samples))
