"""The paper's gearbox with given ports, and closed forms of its rigid train."""

import numpy as np

import planetary_twin_py as pt
from planetary_twin_py.model.gearbox import Gearbox

PAPER = pt.load_scene("paper")
RATIO = -3.0 / 7.0  # of the output's speed to the input's
NO_FRICTION = {"lubrication.friction": False}
CAUSALITIES = ("machine", "torque", "motion")


def driven(input, output, scene=PAPER, **changes):
    """The paper's gearbox, or another one, with these ports."""
    return scene.replace(**{"drive.input.port": input, "drive.output.port": output, **changes})


def course(scene, ports, interpolation, count=40):
    """Commands around steady running, each millisecond, as the ports take them."""
    shown, time = pt.Twin(driven("motion", "motion", scene)).port_states, np.arange(count) * 1e-3
    wave = np.sin(2.0 * np.pi * 70.0 * time)
    swing = {"torque": 0.2 * wave, "speed": 3e-3 * wave * (interpolation == "linear")}
    names = {"torque": "torque", "motion": "speed"}
    sides = zip(("input", "output"), ports, strict=True)
    used = [(f"{side}_{names[port]}", names[port]) for side, port in sides if port != "machine"]
    return pt.Commands(
        time, **{name: getattr(shown, name) * (1.0 + swing[kind]) for name, kind in used}
    )


def at_rest(input, output, **changes):
    """The same, at rest and without load."""
    still = {"input_speed": 0.0, "input_torque": 0.0}
    return driven(input, output, **still, **NO_FRICTION, **changes)


def inertia_at_input(scene, without=()):
    """Inertia of the rigid train at the input, from J/r^2 of all bodies [kg m^2]."""
    bodies = Gearbox(scene).bodies
    squares = bodies.copies * bodies.mass * (bodies.radius * bodies.ratio[:, 0]) ** 2
    squares = squares[:-1]  # the ground
    left_out = [bodies.place[name] for name in without]
    return float(np.delete(squares, left_out).sum())


def momentum(scene, result, states):
    """Angular momentum along the rigid motion [kg m^2/s], from gears and the ports' shafts.

    Forces between the bodies do no work in a rigid motion, so only torques at the ports change it.
    """
    gearbox = Gearbox(scene)
    bodies = gearbox.bodies
    total = 0.0
    for n, name in enumerate(result.bodies):
        at = bodies.place[name]
        if at == len(bodies.mass) - 1:
            continue
        total += (
            bodies.mass[at] * bodies.radius[at] ** 2 * bodies.ratio[at, 0] * result.speed[-1, n]
        )
    shafts = (states.input_speed, states.output_speed)
    for (name, _), speed in zip(gearbox.machines.items(), shafts, strict=True):
        at = bodies.place[name]
        total += bodies.mass[at] * bodies.radius[at] ** 2 * bodies.ratio[at, 0] * speed
    return float(total)


def exact_end(twin):
    """Ledger since the last window and energies of a twin, at its present time."""
    end = twin._engine._core.WindowEnd()
    twin._engine.exact_end(twin._windows.ticks, end)
    return end
