"""The energy ledger with each causality: power in = power out + losses + what is stored."""

import itertools

import numpy as np
import pytest
from planar.moving_scenes import planar
from ports.ports_of_paper import CAUSALITIES, NO_FRICTION, PAPER, course, driven, exact_end
from stability.sound import turnover

import planetary_twin_py as pt

PORTS = [pair for pair in itertools.product(CAUSALITIES, repeat=2) if pair != ("machine",) * 2]


SCENES = {
    "paper": PAPER,
    "differential": pt.load_scene("differential"),
    "planar": planar(),
    "floating": pt.load_scene("floating_sun").replace(dynamics="planar"),
    "spatial": pt.load_scene("helical_stage"),
}


CASES = [
    (name, ports)
    for name, ports in itertools.product(SCENES, PORTS)
    if (name, ports[1]) != ("differential", "machine")  # which it cannot have
]


@pytest.mark.parametrize("interpolation", ["hold", "linear"])
@pytest.mark.parametrize(("name", "ports"), CASES, ids=str)
def test_the_ledger_closes_under_commands(name, ports, interpolation):
    scene = driven(*ports, SCENES[name], **{"drive.interpolation": interpolation})
    count = 40 if name in ("paper", "differential") else 20
    commands = course(SCENES[name], ports, interpolation, count)
    energy = pt.simulate(scene, 1.25e-3 * count, tolerance=1e-5, commands=commands).energy
    assert energy.friction > 0.0
    assert abs(energy.residual) < 1e-6 * turnover(energy)


def test_work_at_a_port_is_the_integral_of_torque_times_speed():
    """From what every step shows of the ports, at steps far shorter than their vibration."""
    twin, dt, work = pt.Twin(driven("motion", "torque"), tolerance=1e-5), 1e-5, np.zeros(2)

    def ledger():
        return exact_end(twin).ledger[:2]

    def powers(shown):
        return np.array(
            [shown.input_torque * shown.input_speed, shown.output_torque * shown.output_speed]
        )

    last = powers(twin.step(dt))
    before = ledger()
    for _ in range(2000):
        now = powers(twin.step(dt))
        work += 0.5 * dt * (last + now)
        last = now
    assert work == pytest.approx(ledger() - before, rel=1e-6)


def test_efficiency_counts_work_put_in_before_and_after_reversal():
    """From what every step shows of the ports, at steps far shorter than their vibration."""
    scene, dt = driven("torque", "motion", **{"drive.interpolation": "linear"}), 1e-4
    time, torque = np.array([0.0, 0.15, 0.25, 0.4]), np.array([63.0, 63.0, -63.0, -63.0])
    twin, put_in = pt.Twin(scene, tolerance=1e-4), 0.0
    for end in dt * np.arange(1, 4001):
        shown = twin.step(dt, input_torque=float(np.interp(end, time, torque)))
        powers = (shown.input_torque * shown.input_speed, shown.output_torque * shown.output_speed)
        put_in += dt * sum(max(power, 0.0) for power in powers)
    run = pt.simulate(scene, 0.4, commands=pt.Commands(time, input_torque=torque))
    energy = run.energy
    assert energy.both_ways > 0.9 * put_in  # without these, no work would be left
    assert energy.driving_work == pytest.approx(put_in, rel=0.01)
    assert run.efficiency == pytest.approx(1.0 - energy.friction / put_in, abs=2e-4)


DRIVES = {
    "steady": {},
    "ripple": {"torque_ripple": 20.0},
    "fast ripple": {"torque_ripple": 20.0, "drive.speed_control.ripple_order": 29},
    "run-up": {"drive.speed_control.start_speed": 50.0, "torque_ripple": 20.0},
    "rattle": {"torque_ripple": 0.6, "input_torque": 0.3, "input_speed": 300.0, "backlash": 1e-4},
}
METHODS = ("march", "auto", "collocation", "rosenbrock")


@pytest.mark.parametrize("changes", DRIVES.values(), ids=DRIVES)
@pytest.mark.parametrize("ports", list(itertools.product(CAUSALITIES, repeat=2)), ids="-".join)
def test_all_methods_find_same_work_of_every_drive_at_every_port(ports, changes):
    scene = driven(*ports, **changes)
    found = [pt.simulate(scene, 0.01, 1e4, method, 1e-6).energy for method in METHODS]
    for energy in found:
        assert abs(energy.residual) < 1e-7 * turnover(energy)
        assert energy.machines == pytest.approx(found[-1].machines, rel=1e-5)


@pytest.mark.filterwarnings("ignore:the energy ledger")  # at 1e-4, and names a remedy
def test_energy_converges_where_shafts_swing_in_free_flight():
    """Light gears with runout, and a stiff shaft whose swing lasts a small part of a step."""
    scene = pt.load_scene("paper").replace(
        **{
            "gearset.equivalent_mass": {"sun": 4e-3, "planet": 0.02, "ring": 0.04, "carrier": 0.02},
            "mesh.runout": {"sun": 2e-6, "planet": 2e-6},
            "mesh.damping.law": "natural_frequency",
            "drive.input.member": "ring",
            "drive.input.inertia": 9e-7,
            "drive.input.coupling_stiffness": 12.0,
            "drive.input.coupling_damping": 1e-4,
            "drive.output.member": "sun",
            "drive.output.inertia": 5e-7,
            "drive.output.coupling_stiffness": 3400.0,
            "drive.output.coupling_damping": 8e-4,
            "input_speed": 0.73,
            "input_torque": 0.6,
            "torque_ripple": 0.18,
            "backlash": 1e-4,
        },
        **NO_FRICTION,
    )
    for tolerance, allowed in ((1e-4, 1e-4), (1e-6, 1e-5), (1e-8, 1e-8)):
        run = pt.simulate(scene, 0.02, 2e4, "march", tolerance)
        assert run.stats.flank_events > 50
        assert abs(run.energy.residual) < allowed * turnover(run.energy)
