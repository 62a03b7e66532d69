"""The energy ledger with each causality: power in = power out + losses + what is stored."""

import itertools

import numpy as np
import pytest
from ports_of_paper import CAUSALITIES, RATIO, driven

import planetary_twin_py as pt

PORTS = [pair for pair in itertools.product(CAUSALITIES, repeat=2) if pair != ("machine",) * 2]


def course(ports, interpolation):
    """Commands every millisecond at both ports, as these take them."""
    time = np.arange(0, 40) * 1e-3
    wave = np.sin(2.0 * np.pi * 60.0 * time)
    every = {
        "input_torque": 63.0 + 15.0 * wave,
        "input_speed": 104.7 + (0.3 * wave if interpolation == "linear" else 0.0),
        "output_torque": 147.0 + 20.0 * wave,
        "output_speed": RATIO * (104.7 + (0.3 * wave if interpolation == "linear" else 0.0)),
    }
    names = {"torque": "torque", "motion": "speed"}
    sides = zip(("input", "output"), ports, strict=True)
    used = [f"{side}_{names[port]}" for side, port in sides if port != "machine"]
    return pt.Commands(time, **{name: every[name] for name in used})


def turnover(energy):
    return sum(map(abs, energy.machines)) + abs(energy.kinetic) + abs(energy.elastic)


@pytest.mark.parametrize("interpolation", ["hold", "linear"])
@pytest.mark.parametrize("ports", PORTS, ids="-".join)
def test_the_ledger_closes_under_commands(ports, interpolation):
    scene = driven(*ports, **{"drive.interpolation": interpolation})
    energy = pt.simulate(scene, 0.05, tolerance=1e-5, commands=course(ports, interpolation)).energy
    assert energy.friction > 0.0
    assert abs(energy.residual) < 1e-6 * turnover(energy)


@pytest.mark.parametrize("ports", [("torque", "motion"), ("motion", "torque")], ids="-".join)
def test_the_ledger_closes_by_rosenbrocks_method(ports):
    scene = driven(*ports, **{"drive.interpolation": "linear"})
    residuals = []
    for tolerance in (1e-4, 1e-6):
        run = pt.simulate(
            scene, 0.05, 1e4, "rosenbrock", tolerance, commands=course(ports, "linear")
        )
        residuals.append(abs(run.energy.residual) / turnover(run.energy))
    assert residuals[1] < 1e-6
    assert residuals[1] < residuals[0]


def test_work_at_a_port_is_the_integral_of_torque_times_speed():
    """From what every step shows of the ports, at steps far shorter than their vibration."""
    scene = driven("motion", "torque")
    twin, dt, work = pt.Twin(scene, tolerance=1e-5), 1e-5, np.zeros(2)
    last = twin.step(dt).copy()
    begin = twin.time
    for _ in range(2000):
        shown = twin.step(dt).copy()
        for port, side in enumerate(("input", "output")):
            before, now = (
                getattr(state, f"{side}_torque") * getattr(state, f"{side}_speed")
                for state in (last, shown)
            )
            work[port] += 0.5 * dt * (before + now)
        last = shown
    run = pt.simulate(scene, twin.time - begin, 1e4, tolerance=1e-5, settling=begin)
    assert work[0] == pytest.approx(run.energy.machines[0], rel=1e-4)
    assert work[1] == pytest.approx(run.energy.machines[1], rel=1e-4)
