"""A scene as an initial value problem, and results from the states of a solver."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from planetary_twin_py._core import (
    LIGHTEST_MESH_LOAD,
    Model,
    derivative,
    frame_cycle_rate,
    repeat_derivative,
    show_states,
)
from planetary_twin_py._core import Problem as Record
from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.model.oil import build_oil
from planetary_twin_py.model.start import start_state
from planetary_twin_py.model.train import lightest_body
from planetary_twin_py.scene import Scene

CALLS = 100_000  # of the right-hand side, to time it


class Problem:
    """y' = f(t, y), y(0) = 0, and the magnitudes of the entries of y."""

    def __init__(self, scene: Scene) -> None:
        gearbox, point = Gearbox(scene), scene.operating_point
        train = gearbox.train
        model = Model(train=train, oil=build_oil(scene, point), load=gearbox.load(point))
        start = start_state(gearbox, model)[0]
        self.record = Record(model=model, start=start)
        self.bodies, self.axes, self.meshes = train.bodies, train.axes, train.meshes
        self.size = 2 * self.bodies + self.axes
        self.scale = self._scale(gearbox)
        frequency = max(abs(frame_cycle_rate(train, start)), train.lowest_frequency)
        self.mesh_period = 1.0 / frequency  # at the start [s]

    def _scale(self, gearbox: Gearbox) -> np.ndarray:
        """Magnitudes of the entries of y (size,): deflection and fastest vibration of a mesh."""
        train, point = gearbox.train, gearbox.scene.operating_point
        force = abs(gearbox.mesh_force(abs(point.input_torque) + point.torque_ripple))
        stiffness = float(train.stiffness.min())
        deflection = max(force, LIGHTEST_MESH_LOAD) / stiffness + 0.5 * point.backlash
        fastest = np.sqrt(2.0 * stiffness / lightest_body(train))
        motor = deflection / float(train.radius[train.coupling[0, 0]])
        sizes = [deflection, deflection * fastest, motor]
        return np.repeat(sizes, [self.bodies, self.bodies, self.axes])

    def function(self, check: Callable[[], None]) -> Callable[[float, np.ndarray], np.ndarray]:
        """The right-hand side f(t, y), for a solver that calls Python; `check` is called first."""
        record = self.record

        def slope(t: float, y: np.ndarray) -> np.ndarray:
            check()
            dy = np.empty_like(y)
            derivative(record, t, y, dy)
            return dy

        return slope

    def seconds_per_call(self) -> float:
        """Time of the right-hand side, called from compiled code, over one mesh cycle [s]."""
        y, dy = np.zeros(self.size), np.zeros(self.size)
        begin = time.thread_time()
        repeat_derivative(self.record, self.mesh_period / CALLS, y, dy, CALLS)
        return (time.thread_time() - begin) / CALLS

    def observe(self, times: np.ndarray, states: np.ndarray) -> tuple[np.ndarray, float]:
        """Transmission errors (samples, meshes) [m] and mean power loss [W] of states at times."""
        dte = np.zeros((len(times), self.meshes))
        return dte, show_states(self.record, times, np.ascontiguousarray(states), dte)


def sample_times(duration: float, sample_rate: float) -> np.ndarray:
    """Instants of the benchmark: integer multiples of 1/sample_rate [s], from 1 on."""
    return np.arange(1, round(duration * sample_rate) + 1) / sample_rate
