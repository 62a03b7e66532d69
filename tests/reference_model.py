"""The gearbox of a scene once more, in absolute angles and plain NumPy, to check the compiled one.

Equations of motion as in Salagianni et al. 2017, (18)-(20), with friction as a generalised force;
nothing here comes from the package but the numbers of the scene and of its speed loop. DOP853 at a
tolerance near rounding, restarted wherever a tooth pair or a flank changes.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp

from planetary_twin_py.model.gearbox import Gearbox

DRIVE, OPEN, COAST = 1, 0, -1
PAIRS = np.arange(-2, 3)  # tooth pairs considered, by their distance in base pitches


class Reference:
    """Bodies: sun, planets, ring, carrier, motor, load; meshes: of the sun, then of the ring.

    Laws: film (15), prescribed lambda ratio.
    """

    def __init__(self, scene):
        self.scene, gears, self.mesh = scene, scene.gearset, scene.mesh
        zs, zp, zr = gears.teeth.sun, gears.teeth.planet, gears.teeth.ring
        n, cosine, sine = (
            gears.planets,
            math.cos(gears.pressure_angle),
            math.sin(gears.pressure_angle),
        )
        pitch = gears.module / 2 * np.array([zs, zp, zr])
        base = pitch * cosine
        self.n, self.teeth = n, zs
        self.base_pitch = math.pi * gears.module * cosine
        places = {"sun": 0, "ring": n + 1, "carrier": n + 2}
        self.carrier, self.bodies = n + 2, n + 5
        arm = pitch[0] + pitch[1]
        mass = gears.equivalent_mass
        inertia = [mass.sun * pitch[0] ** 2, *[mass.planet * pitch[1] ** 2] * n]
        inertia += [mass.ring * pitch[2] ** 2, (mass.carrier + n * gears.planet_mass) * arm**2]
        self.machines = [scene.drive.input, scene.drive.output]
        self.inertia = np.array(inertia + [m.inertia for m in self.machines])
        self.shafts = [places[m.member] for m in self.machines]
        self.held = places[gears.held]

        # d = rows @ angles, for the sun meshes and then the ring meshes
        self.rows = np.zeros((2 * n, self.bodies))
        for i in range(n):
            self.rows[i, [0, 1 + i, n + 2]] = base[0], base[1], -(base[0] + base[1])
            self.rows[n + i, [1 + i, n + 1, n + 2]] = -base[1], base[2], -(base[2] - base[1])
        self.first = np.array([0] * n + list(range(1, n + 1)))
        self.second = np.array([*range(1, n + 1), *[n + 1] * n])
        self.external = np.repeat([1.0, -1.0], n)[:, None]
        self.rho1 = np.repeat(pitch[:2] * sine, n)[:, None]
        self.rho2 = np.repeat(pitch[1:] * sine, n)[:, None]
        psi = (np.array(gears.planet_angles) - gears.planet_angles[0]) / (2 * math.pi)
        self.phase = np.concatenate([zs * psi, -zr * psi + 0.5 * (zp % 2 == 0)])

        # Paths of contact: how far beyond the pitch point the tip circles reach
        def tip(z, addendum):
            radius, root = z / 2 + addendum, z / 2 * cosine
            return abs(math.sqrt(radius**2 - root**2) - z / 2 * sine) / (math.pi * cosine)

        a = gears.addendum
        self.approach = np.repeat([tip(zp, a), tip(zr, -a)], n)[:, None]
        self.recess = np.repeat([tip(zs, a), tip(zp, a)], n)[:, None]
        self.stiffness = np.repeat(
            [self.mesh.sun_planet_stiffness, self.mesh.planet_ring_stiffness], n
        )
        rim = np.array([mass.sun, mass.planet, mass.ring]) / cosine**2
        own = np.repeat(rim[:2] * rim[1:] / (rim[:2] + rim[1:]), n)
        self.viscous_time = 2 * self.mesh.damping.damping_ratio * np.sqrt(own / self.stiffness)
        self._drive(zs, zp, zr)

    def _drive(self, zs, zp, zr):
        """Speeds in rigid motion, by Willis, and the speed control."""
        n, point = self.n, self.scene.operating_point
        relative = np.array([1.0, *[-zs / zp] * n, -zs / zr, 0.0])
        ratio = relative - relative[self.held]
        ratio /= ratio[self.shafts[0]]
        self.ratio = np.append(ratio, ratio[self.shafts])
        self.total = self.inertia @ self.ratio**2
        self.bandwidth = 2 * math.pi * Gearbox(self.scene).bandwidth
        self.point, self.half = point, 0.5 * point.backlash

    def damping_time(self, motor_speed):
        law = self.mesh.damping
        if law.law == "viscous":
            return self.viscous_time
        cycles = self.teeth * (self.ratio[0] - self.ratio[self.carrier])
        frequency = abs(cycles * motor_speed) / (2 * math.pi)
        return law.loss_factor / max(frequency, law.lowest_frequency)

    def cycle(self, angle, side):
        """Base pitches the flanks of each mesh have gone past its pitch point, not reduced."""
        drive = self.teeth * (angle[0] - angle[self.carrier]) / (2 * math.pi) - self.phase
        return np.where(side == COAST, 0.5 - drive, drive)

    def pairs(self, cycle):
        """Positions [base pitches] and weights of the tooth pairs, (meshes, pairs)."""
        s = (cycle - np.floor(cycle))[:, None] + PAIRS
        rising, falling = s + self.approach, self.recess - s
        return s, np.clip(np.minimum(rising, falling) / self.mesh.ramp, 0.0, 1.0)

    def stretch(self, angle, speed, side):
        """Per mesh: d, d', stiffness, positions and weights of the pairs."""
        s, weight = self.pairs(self.cycle(angle, side))
        gain = self.mesh.double_pair_ratio - 1.0
        k = self.stiffness * (1.0 + gain * (weight.sum(axis=1) - 1.0))
        return self.rows @ angle, self.rows @ speed, k, s, weight

    def friction_torques(self, force, s, weight, speed):
        load = np.maximum(force, 0.0)[:, None] * weight / weight.sum(axis=1, keepdims=True)
        used = load > 1e-9
        rho1 = self.rho1 + s * self.base_pitch
        rho2 = self.rho2 - self.external * s * self.base_pitch
        load, rho1, rho2 = np.where(used, [load, rho1, rho2], [[[1.0]], [[1.0]], [[2.0]]])
        w1 = (speed[self.first] - speed[self.carrier])[:, None]
        w2 = (speed[self.second] - speed[self.carrier])[:, None]
        sliding = rho1 * w1 + self.external * rho2 * w2
        entrain = np.maximum(np.abs(rho1 * w1 - self.external * rho2 * w2) / 2, 1e-3)
        radius = 1.0 / (1.0 / rho1 + self.external / rho2)
        f = np.where(used, self.friction(load, radius, entrain, sliding), 0.0)
        torque = np.zeros(self.bodies)
        np.add.at(torque, self.first, -(f * rho1).sum(axis=1))
        np.add.at(torque, self.second, -(f * self.external * rho2).sum(axis=1))
        torque[self.carrier] += (f * (rho1 + self.external * rho2)).sum()
        return torque

    def friction(self, load, radius, speed, sliding):
        oil, length = self.scene.lubrication, self.scene.gearset.face_width
        modulus = oil.youngs_modulus / (1 - oil.poisson_ratio**2)  # E' = 2 E*
        half_width = np.sqrt(8 * load * radius / (math.pi * length * modulus))
        area = 2 * half_width * length
        p, alpha, tau0 = load / area, oil.pressure_viscosity, oil.shear_stress
        film = 2.5 * radius * (speed * oil.viscosity * alpha / radius) ** 0.7
        film = np.maximum(film * (alpha * modulus) ** 0.1 / (alpha * p) ** 0.26, 1e-9)
        x = self.point.lambda_ratio
        f2 = math.exp(np.polyval([0.00130501, -0.0241815, -0.275167, -1.59436, -0.693356], x))
        f52 = math.exp(np.polyval([0.00117382, -0.0230728, -0.270566, -1.74266, -0.483601], x))
        rough = oil.roughness_parameter**2
        real_area = math.pi**2 * rough * area * f2
        carried = 16 * math.sqrt(2) / 15 * math.pi * rough * math.sqrt(oil.asperity_slope)
        carried = carried * modulus / 2 * area * f52
        boundary = tau0 * real_area + oil.pressure_coefficient * carried
        solid = oil.solid_conductivity * oil.solid_density * oil.solid_heat_capacity
        zeta = 4 / math.pi * oil.oil_conductivity / (film / radius)
        zeta = zeta * np.sqrt(p / (modulus * radius * solid * speed))
        root = 2 * oil.oil_conductivity * oil.viscosity / oil.temperature_viscosity
        plateau = np.log(1.2 / (tau0 * film) * np.sqrt(root / (1 + 9.6 * zeta)))
        viscous = load * (0.87 * alpha * tau0 + 1.74 * tau0 / p * plateau)
        sense = np.tanh(sliding / speed / oil.sliding_threshold)
        return (boundary + np.maximum(viscous, 0.0)) * sense

    def rate(self, time, y, side):
        tau = self.damping_time(y[2 * self.bodies - 2])
        angle, speed, trim = y[: self.bodies], y[self.bodies : -1], y[-1]
        d, rate, k, s, weight = self.stretch(angle, speed, side)
        force = np.where(side == OPEN, 0.0, k * (side * d - self.half + tau * side * rate))
        torque = -self.rows.T @ (side * force)
        if self.scene.lubrication.friction:
            torque += self.friction_torques(force, s, weight, speed)
        for machine, shaft, body in zip(self.machines, self.shafts, (-2, -1), strict=True):
            twist = machine.coupling_stiffness * (angle[body] - angle[shaft])
            twist += machine.coupling_damping * (speed[body] - speed[shaft])
            torque[body] -= twist
            torque[shaft] += twist
        point, order = self.point, self.scene.drive.speed_control.ripple_order
        lag = point.input_speed - speed[-2]
        torque[-2] += point.input_torque + point.torque_ripple * math.sin(order * angle[-2])
        torque[-2] += self.total * self.bandwidth * lag
        trimmed = point.input_torque - self.total * self.bandwidth**2 / 4 * trim
        torque[-1] -= trimmed / self.ratio[-1]
        torque[self.held] = 0.0
        return np.concatenate([speed, torque / self.inertia, [lag]])

    def margin(self, y, i, side):
        """Falls through zero where the contact of mesh i changes [m]."""
        d, rate = self.rows[i] @ y[: self.bodies], self.rows[i] @ y[self.bodies : -1]
        tau = self.damping_time(y[2 * self.bodies - 2])
        push = d + np.broadcast_to(tau, self.phase.shape)[i] * rate
        if side[i] != OPEN:
            return side[i] * push - self.half
        return self.half - max(min(d, push), min(-d, -push))

    def _events(self, y, side):
        """Contact changes of all meshes, then the next corner of the weights of closed ones."""
        cycle = self.cycle(y, side)
        forward = self.cycle(y + 1e-6 * np.append(self.ratio, np.zeros(self.bodies + 1)), side)
        forward = (forward - cycle) * (1 if self.point.input_speed >= 0 else -1) > 0
        ramp = self.mesh.ramp
        ends = [-self.approach, ramp - self.approach, self.recess - ramp, self.recess]
        events = []
        for i in range(len(side)):
            events.append(lambda t, y, i=i: self.margin(y, i, side))
            events[-1].direction = -1
        for i in np.flatnonzero(side):
            ahead = (np.hstack(ends)[i] - cycle[i]) * (1 if forward[i] else -1)
            distance = np.min(ahead - np.floor(ahead - 1e-9))
            edge = cycle[i] + (distance if forward[i] else -distance)
            events.append(lambda t, y, i=i, edge=edge: self.cycle(y, side)[i] - edge)
        for event in events:
            event.terminal = True
        return events

    def transmission_errors(self, y, side, times):
        """d of every mesh at `times` [s], shape (times, meshes), from the state y at time zero."""
        side, begin, result = np.array(side), 0.0, np.zeros((len(times), len(side)))
        flank_events = 0
        while begin < times[-1]:
            run = solve_ivp(
                self.rate, (begin, times[-1]), y, "DOP853", dense_output=True, args=(side,),
                events=self._with_arguments(self._events(y, side)), rtol=1e-10, atol=1e-13,
            )  # fmt: skip
            assert run.success, run.message
            inside = (times > begin) & (times <= run.t[-1])
            if inside.any():
                result[inside] = (self.rows @ run.sol(times[inside])[: self.bodies]).T
            begin, y = run.t[-1], run.y[:, -1]
            for i in range(len(side)):
                if len(run.t_events[i]):
                    flank_events += 1
                    d = self.rows[i] @ y[: self.bodies]
                    side[i] = OPEN if side[i] != OPEN else self.closed_side(i, d)
        return result, flank_events

    def closed_side(self, i, d):
        """Side on which mesh i closes at a transmission error d."""
        return DRIVE if d > 0 else COAST

    @staticmethod
    def _with_arguments(events):
        """solve_ivp passes the arguments of the rate to its events, too."""

        def wrapped(event):
            def call(t, y, *_):
                return event(t, y)

            call.terminal, call.direction = True, getattr(event, "direction", 0)
            return call

        return [wrapped(event) for event in events]
