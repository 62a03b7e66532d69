"""SciPy's solvers at a loose tolerance step across the switches of rattling teeth.

They are given the self-written model of the whole gearbox as one right-hand side, each flank in
contact where it is squeezed and pushes, as is done where a solver knows no events.
"""

import math

import numpy as np
import pytest
from integrators.test_reference import RATE, RATTLE, absolute
from reference_model import COAST, DRIVE, OPEN, Reference
from scipy.integrate import solve_ivp
from stability.sound import PAPER
from tiers import first

from planetary_twin_py._core import DTE
from planetary_twin_py.run.engine import Engine

BEGIN, SPAN = 0.02, 4e-3  # [s]
SCENE = PAPER.replace(**RATTLE)
ABSOLUTE = 1e-9  # [rad], [rad/s]


class Rattle:
    """A stretch of rattle, and its solution by DOP853 near rounding, restarted at every switch."""

    def __init__(self, begin=BEGIN, span=SPAN):
        self.source = Engine(SCENE, 1e-6)
        self.source.advance(begin, 1, RATE, 0)
        self.start = self.source.integrator.end.time
        self.first = math.floor(self.start * RATE) + 1
        self.count = round(span * RATE)
        self.times = (self.first + np.arange(self.count)) / RATE - self.start
        self.model = Reference(SCENE)
        self.state, side = absolute(self.source)
        self.exact, self.flank_events = self.model.transmission_errors(self.state, side, self.times)

    def rate(self, time, y):
        model = self.model
        tau = model.damping_time(y[2 * model.bodies - 2])
        d, rate = model.rows @ y[: model.bodies], model.rows @ y[model.bodies : -1]
        push = d + tau * rate
        drive, coast = np.minimum(d, push) > model.half, np.minimum(-d, -push) > model.half
        side = np.where(drive, DRIVE, np.where(coast, COAST, OPEN))
        return model.rate(time, y, side)

    def error(self, dte):
        return np.sqrt(((dte - self.exact) ** 2).mean() / (self.exact**2).mean())

    def peer(self, method, tolerance):
        """Whether a solver of SciPy reports success, and its error."""
        run = solve_ivp(
            self.rate, (0.0, self.times[-1]), self.state, method, self.times,
            rtol=tolerance, atol=ABSOLUTE,
        )  # fmt: skip
        return run.success, self.error((self.model.rows @ run.y[: self.model.bodies]).T)

    def own(self, tolerance):
        """Error of the twin's integrator from the same state."""
        engine = Engine(SCENE, tolerance)
        engine.integrator.end = self.source.integrator.end
        until = self.start + self.times[-1]
        return self.error(engine.advance(until, self.first, RATE, self.count).mesh[:, DTE])


@pytest.fixture(scope="module")
def rattle():
    return Rattle()


@pytest.mark.exhaustive
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_dop853_reports_success_and_returns_garbage(rattle, tolerance):
    assert rattle.flank_events >= 5
    success, error = rattle.peer("DOP853", tolerance)
    assert success
    assert not error < 1.0  # as large as the motion itself


@pytest.mark.exhaustive
@pytest.mark.parametrize("start", first(1, [0.04, 0.038, 0.035, 0.03], pytest.mark.release))  # [s]
def test_dop853_is_off_by_a_thousand_tolerances(start):
    success, error = Rattle(start, 6e-3).peer("DOP853", 1e-4)
    assert success
    assert not error < 1000.0 * 1e-4


@pytest.mark.exhaustive
@pytest.mark.parametrize("method", ["RK45", "LSODA", "BDF"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_others_report_success_and_are_wrong(rattle, method, tolerance):
    success, error = rattle.peer(method, tolerance)
    assert success
    assert not error < 40.0 * tolerance


@pytest.mark.parametrize("tolerance", first(2, [1e-2, 1e-4, 1e-3, 1e-5]))
def test_the_twin_follows_the_same_rattle(rattle, tolerance):
    assert rattle.own(tolerance) < 10.0 * tolerance
