"""One mass on one mesh, put together from the package's own records.

Kahraman and Singh 1990 (J. Sound Vib. 142, 49): x'' + 2 zeta x' + g(x) = F_m + F_ah W^2 cos(W t)
with the dead zone g of width 2, in units of mass, stiffness and half backlash. x is the squeeze
d - e of a mesh between the mass and the ground, the excitation is its error of form e, the damper
is a coupling without stiffness to a motor too heavy to be moved. That one acts on d', not on x',
which adds -2 zeta e' to the forcing; the amplitude of e makes both together F_ah W^2.
"""

import math

import numpy as np

from planetary_twin_py._core import DRIVE_SIDE, TOTAL, Integrator, Model, advance, cut, radau
from planetary_twin_py.model.clock import NEVER, Instant, instant, sampling
from planetary_twin_py.model.layout import LOAD_MACHINE
from planetary_twin_py.run.samples import new_samples

MASS, MOTOR, GROUND = 0, 1, 2
PER_PERIOD = 64


class Oscillator:
    """The oscillator at a frequency ratio W, which may be changed while it swings."""

    def __init__(self, zeta=0.05, mean=0.1, alternating=0.05, tolerance=1e-6):
        self.zeta, self.alternating = zeta, alternating
        self.model, self.integrator = Model(), Integrator()
        train, load = self.model.train, self.model.load
        train.bodies, train.meshes, train.axes, train.machines = 2, 1, 1, 2
        train.mass[:3] = 1.0, 1e30, 1.0
        train.lanes, train.slots, train.copies[0] = 4, 1, 1.0
        train.radius[:3] = train.inverse_radius[:3] = 1.0
        train.ratio[MOTOR, 0] = 1.0
        train.body[0] = MASS, GROUND, GROUND
        train.sign[0] = 1.0, 0.0, 0.0
        train.sun = train.carrier = GROUND
        train.cycles[0] = 1.0
        train.cycles_numerator[0] = 1
        train.cycles_denominator[:] = 1
        train.stiffness[0] = train.stiffness_base[0] = train.stiffness_factor[0] = 1.0
        train.lowest_frequency = 1.0
        train.segments[0], train.present[0, 0], train.terms = 1, 1, 2
        train.edge[0, 1:] = 1.0
        train.weight[0, 0, [0, TOTAL], 0] = 1.0
        train.lines[0], train.line_harmonic[0, 0], train.line_period[:] = 1, 1.0, 1
        train.coupling[:2] = (MOTOR, GROUND), (MASS, MOTOR)
        train.coupling_damping[LOAD_MACHINE] = 2.0 * zeta
        load.half_backlash = load.offset = load.release = 1.0
        load.torque[LOAD_MACHINE] = mean
        load.slew_rate = 1.0
        self.integrator.run.nodes = radau(5)
        control = self.integrator.control
        control.tolerance, control.speed_per_deflection = tolerance, 1.0
        control.deflection = control.elastic_deflection = 1.0
        control.next_step = control.next_stiff = control.step = 1e-3
        control.longest = 0.2
        for state in (self.integrator.begin, self.integrator.end):
            state.side[0] = DRIVE_SIDE
            state.x[MASS] = 1.0 + mean
        self.set(0.1)

    def set(self, ratio):
        """Change the frequency ratio."""
        self.ratio = ratio
        size = self.alternating * ratio / math.hypot(ratio, 2.0 * self.zeta)
        cut(
            self.model,
            self.integrator,
            Instant(self.integrator.end.seconds, self.integrator.end.time),
        )
        self.model.train.line_tangential[0, 0] = self.error = size
        self.integrator.end.speed[0] = self.integrator.end.set_speed[0] = ratio
        self.model.load.target_speed[0] = ratio

    def run(self, periods):
        """Squeeze x over `periods`, PER_PERIOD samples each."""
        rate = PER_PERIOD * self.ratio / (2.0 * math.pi)
        first = math.ceil((self.integrator.end.seconds + self.integrator.end.time) * rate) + 1
        count = periods * PER_PERIOD
        samples = new_samples(self.model.train, count + 1)
        until = instant((first + count) / rate)
        advance(self.model, self.integrator, until, NEVER, sampling(first, rate), samples)
        angle = 2.0 * math.pi * samples.turns[:, 0] + samples.angle[:, MOTOR]
        return (samples.mesh[:, 0, 0] - self.error * np.sin(angle))[:count]

    def settled(self, periods=60, measured=10):
        """Squeeze over some periods after the transient of `periods` has died out."""
        self.run(periods)
        return self.run(measured)


def amplitude(x):
    """Amplitude of the fundamental."""
    turn = np.exp(-2j * math.pi * np.arange(len(x)) / PER_PERIOD)
    return 2.0 * abs(np.mean(turn * x))
