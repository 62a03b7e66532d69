"""Prescribed motions and forces of a gearbox for its sensors."""

import math
from itertools import pairwise

import numpy as np
from analysis.gear_sets import gear_set
from planar.moving_scenes import supports

from planetary_twin_py.model.layout import Layout
from planetary_twin_py.sensors.bank import SensorBank
from planetary_twin_py.sensors.sensed import Sensed, joined_readings

QUIET = {"noise": 0.0}


def scene_with(*sensors, teeth=(21, 39, 99), **fields):
    """A set whose ring is held, with sensors without noise unless given."""
    own = [{"name": f"sensor_{n}", **QUIET, **sensor} for n, sensor in enumerate(sensors)]
    return gear_set(teeth, sensors=own, **fields)


def moving(*sensors, **fields):
    """The same with axes that move in the plane."""
    return scene_with(*sensors, dynamics="planar", backlash=1e-4, supports=supports(), **fields)


def turning(scene, time, carrier_speed, **given):
    """Samples of gears that turn without vibration, at times from 0 on."""
    gears, layout = scene.gearset, Layout(scene)
    bodies, machines = gears.planets + 3, len(layout.machines)
    speed = np.zeros((len(time), bodies))
    teeth = gears.teeth
    speed[:, 0] = carrier_speed * (1.0 + teeth.ring / teeth.sun)
    speed[:, -1] = carrier_speed
    samples = {
        "angle": speed * time[:, None],
        "speed": speed,
        "mesh_force": np.zeros((len(time), 2 * gears.planets)),
        "torque": np.zeros((len(time), machines)),
        "displacement": np.zeros((len(time), bodies, 2)) if scene.moving_axes else None,
        "oil_temperature": 350.0,
    }
    return Sensed(0, **(samples | given))


def times(bank, duration):
    """Times of the samples of a bank [s]."""
    return np.arange(round(duration * bank.rate)) / bank.rate


def read(scene, sensed, cuts=()):
    """All readings of the sensors of a scene; `cuts` are limits of the windows."""
    bank = SensorBank(Layout(scene))
    limits = [0, *cuts, sensed.end]
    parts = [bank.feed(sensed.part(*pair)) for pair in pairwise(limits)]
    return [joined_readings(every) for every in zip(*parts, bank.end(), strict=True)]


def line(values, rate, frequency):
    """Complex amplitude of a line, with a window that hides others."""
    weight = np.blackman(len(values) + 2)[1:-1]
    turn = np.exp(-2j * math.pi * frequency / rate * np.arange(len(values)))
    return 2.0 * np.sum(weight * values * turn) / weight.sum()


def line_of(readings, frequency):
    """Complex amplitude of a line in readings, with its phase at time 0."""
    found = line(readings.values, 1.0 / readings.period, frequency)
    return found * np.exp(-2j * math.pi * frequency * readings.first)
