"""Published figures of other gearboxes: actuators, helicopter stages, trends, modes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

import planetary_twin_py as pt
from planetary_twin_py.gearset.kinematics import Teeth

from .row import MISSES, Row, verdict

EXAMPLES = Path(__file__).parents[2] / "docs/examples"


def gallery_scene(name: str) -> pt.Scene:
    """The scene of this name in the gallery."""
    return pt.load_scene(str(EXAMPLES / f"{name}.yaml"))


def two_actuators() -> Iterator[Row]:
    """Loss against torque of two 6:1 actuators back to back."""
    joint = gallery_scene("robot_joint").replace(
        dynamics="quasi_static", **{"losses.sun_drag.coulomb": 0.0}
    )
    low, high = (pt.simulate(joint.replace(input_torque=t), 0.1) for t in (0.1, 0.5))
    slope = _loss_torque(high) - _loss_torque(low)
    share = slope / (6.0 * (0.5 - 0.1))
    yield Row(
        "loss per output torque, one gearbox",
        "0.047",
        f"{share:.3f}, teeth alone",
        verdict(abs(share / 0.047 - 1.0) < 0.3),
        "bound: 30 %; both losses are referred to the output. The teeth of the actuator are not "
        "published: the twin has those of the robot joint in the gallery. Bearings, whose friction "
        "rises with load, are in the measured figure and not in the scene.",
    )
    drag = gallery_scene("robot_joint").replace(dynamics="quasi_static")
    light, heavy = (pt.simulate(drag.replace(input_torque=t), 0.1).efficiency for t in (0.1, 0.5))
    yield Row(
        "efficiency from light to heavy load",
        "rises, 83 to 93 %",
        f"{'rises' if heavy > light else 'falls'}, {100 * light:.0f} to {100 * heavy:.0f} %",
        verdict(heavy > light),
        "only the sign is compared; the drag of the scene is chosen.",
    )


def _loss_torque(run: pt.Result) -> float:
    """Loss [N m], referred to the output."""
    carrier = run.bodies.index("carrier")
    return float(run.mean_power_loss / abs(run.mean_speed[carrier]))


def helicopter() -> Iterator[Row]:
    """Efficiencies of helicopter transmissions."""
    stage = gallery_scene("helicopter_stage").replace(dynamics="quasi_static")
    points = [
        stage.replace(input_speed=pt.rpm(speed), input_torque=torque, oil_temperature=oil)
        for speed in (400.0, 800.0, 1600.0)
        for torque in (300.0, 700.0, 1300.0)
        for oil in (338.0, 373.0)
    ]
    found = [run.result.efficiency for run in pt.simulate_many(points, duration=0.05)]
    yield Row(
        "planetary stage alone, 124 conditions",
        "98.64 to 99.83 %",
        f"{100 * min(found):.2f} to {100 * max(found):.2f} %, {len(found)} conditions",
        verdict(min(found) >= 0.9864 and max(found) <= 0.9983),
        "bound: within the measured range. The stage of the gallery has teeth, oil and conditions "
        "of its own; the tested ones are not all published.",
    )
    cold, hot = (
        pt.simulate(stage.replace(oil_temperature=t), 0.05).efficiency for t in (355.0, 373.0)
    )
    yield Row(
        "whole OH-58A transmission, 224 kW",
        "98.3 to 98.8 %",
        f"{100 * hot:.2f} %, planetary stage alone",
        verdict(hot > 0.988),
        "bound: above the whole transmission, which also has a spiral bevel stage and seals.",
    )
    yield Row(
        "its efficiency as the oil gets hotter",
        "mostly rises",
        f"{'rises' if hot > cold else 'falls'} by {100 * abs(hot - cold):.3f} points over 18 K",
        verdict(hot > cold),
        "in the scene, boundary friction rises more with a thinner film than viscous losses fall. "
        "Seals and a bevel stage, whose drag falls with temperature, are not in it.",
    )


def trends() -> Iterator[Row]:
    """Signs of the losses in Talbot, Kahraman and Singh 2012."""
    stage = gallery_scene("helicopter_stage").replace(dynamics="quasi_static", input_torque=300.0)
    two = stage.replace(**{"gearset.planet_angles": tuple(np.radians([90.0, 270.0]))})
    hot, cold = (stage.replace(oil_temperature=t) for t in (373.0, 338.0))
    smooth = stage.replace(**{"lubrication.composite_roughness": 0.25e-6})
    base = pt.simulate(hot, 0.05).energy
    fewer, colder, finer = (pt.simulate(scene, 0.05).energy for scene in (two, cold, smooth))
    names = (
        "spin loss, fewer planets",
        "spin loss, hotter oil",
        "tooth loss, colder oil",
        "tooth loss, smoother flanks",
    )
    changes = (
        fewer.bearing / base.bearing,
        base.bearing / colder.bearing,
        colder.friction / base.friction,
        finer.friction / base.friction,
    )
    for what, ratio in zip(names, changes, strict=True):
        twin = f"{'falls' if ratio < 1.0 else 'rises'} by {100 * abs(ratio - 1.0):.1f} %"
        yield Row(what, "falls", twin, verdict(ratio < 1.0), "only the sign is compared.")


def others() -> Iterator[Row]:
    """Load sharing, natural frequencies under load, and frequencies of two test rigs."""
    stage = gallery_scene("helicopter_stage")
    force = pt.simulate(stage, 0.05, settling=0.05).mesh["mesh_force_mean"][:3]
    share = float(max(force) / np.mean(force))
    yield Row(
        "load of the most loaded of three planets over the mean (NREL)",
        "1.08; 1.16 with a bending moment",
        f"{share:.3f}",
        verdict(abs(share - 1.08) < 0.02),
        "bound: 0.02. The scene holds its axes and has no errors of pins, so planets share the "
        "load equally. A bending moment is not modelled.",
    )
    light, heavy = (
        pt.natural_modes(stage.replace(input_torque=torque), stiffness="mean").frequencies
        for torque in (300.0, 1300.0)
    )
    rise = float(max(heavy[1:] / light[1:])) - 1.0
    yield Row(
        "natural frequencies with torque (Ericson and Parker)",
        "rise",
        "do not change" if abs(rise) < 1e-9 else f"change by {100 * rise:+.2f} %",
        verdict(rise > 1e-9),
        "only the sign is compared: from 300 to 1300 N m. Flanks get stiffer under load; the teeth "
        "in contact and their modification stay as they are.",
    )
    rig = 595.6 / 60.0 * float(pt.mesh_order(Teeth(21, 31, 84), "ring", "sun"))
    yield Row(
        "mesh frequency of a 21/31/84 gear set at 595.6 rpm",
        "166.75 Hz by vibration, 166.80 Hz by encoder",
        f"{rig:.2f} Hz",
        verdict(abs(rig - 166.775) < 0.05),
        "bound: 0.05 Hz. Kinematics only.",
    )
    yield Row(
        "first carrier sideband over the mesh line, 31/31/95 gear set (SNU)",
        "left 0.92 to 1.11, planet fault 1.70 to 3.71; right 0.10 to 0.36, sun fault 0.40 to 1.20",
        "-",
        MISSES,
        "the twin has no housing on which a sensor sees planets pass.",
    )
