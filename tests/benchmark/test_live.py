"""The live benchmark measures a separate process correctly."""

import numpy as np
import pytest
from planetary_twin_live.figures import Slope
from planetary_twin_live.measure import Bench


@pytest.mark.parametrize("correlation", [0.0, 0.5, 0.9])
def test_the_error_of_a_slope_is_its_scatter(
    correlation: float,
) -> None:
    time, random, slopes = np.linspace(0.0, 1.0, 500), np.random.default_rng(2), []
    for _ in range(200):
        noise = np.zeros(500)
        for n, step in enumerate(random.normal(0.0, 0.1, 499), start=1):
            noise[n] = correlation * noise[n - 1] + step
        slopes.append(Slope.of(time, noise))
    scatter = np.std([slope.value for slope in slopes])
    assert np.mean([slope.error for slope in slopes]) == pytest.approx(scatter, rel=0.25)


@pytest.mark.exhaustive
def test_a_short_measurement_gives_plausible_figures(
    domain: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("planetary_twin_live.measure.SETS", 5)
    monkeypatch.setattr("planetary_twin_live.measure.SETTLING", 1.5)
    said: list[str] = []
    found = Bench(2.0, said.append).punctuality(100.0)
    assert found.messages > 0 and found.lost == 0
    assert 0.0 < found.sent.p50 <= found.sent.p99 <= found.sent.max
    # A value appears at the end of the interval after the one in which it was set.
    assert found.answer.p50 < found.shown.p50
    assert found.shown.p50 > 0.01
    cost = Bench(2.0, said.append).cost("paper", 1e-3, 2)
    assert cost.tolerance == 1e-3 and cost.listeners == 2
    assert 0.01 < cost.cores < 2.0
    assert said
