"""The COMPAct test rig: losses, lost motion, stiffness and spectral lines.

Repository singhaman1750/COMPAct, ICRA 2026, arXiv 2510.07197, MIT licence.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import planetary_twin_py as pt

from .compact_readings import RIG, highest_between, measured_line, measured_lost_motion
from .row import INPUT, UNDECIDED, Row, verdict

CLEAR = 1.2  # times the highest value where the twin has no line
RESOLUTION = 0.25  # orders of the measured spectrum
FITTED = "lubrication.boundary_coefficient", "losses.sun_drag.coulomb"
CARRIER_SPEED = 10.0 / 60.0  # [turns/s] of the output while the spectra were measured


@cache
def fitted_rig() -> tuple[pt.Scene, tuple[float, ...]]:
    """The rig's scene with friction and drag that `fit` estimates from losses.csv, and both."""
    with tempfile.TemporaryDirectory() as folder:
        recording, found = f"{folder}/rig", f"{folder}/fit.json"
        scene = ["--scene", str(RIG / "scene.yaml"), "--out", recording]
        _command("import", str(RIG / "losses.csv"), *scene)
        window = ["--observe", "power_loss", "--from", "0", "--to", "22.5"]
        _command("fit", recording, *window, "--free", ",".join(FITTED), "--json", found)
        parameters = json.loads(Path(found).read_text())["parameters"]
    values = tuple(parameters[name]["estimate"] for name in FITTED)
    return pt.load_scene(RIG / "scene.yaml").replace(
        **dict(zip(FITTED, values, strict=True))
    ), values


def _command(*words: str) -> None:
    program = Path(sys.executable).with_name("planetary-twin")
    subprocess.run([program, *words], check=True, stdout=subprocess.DEVNULL)


def rig_losses() -> Iterator[Row]:
    """Losses at the operating points that `fit` has not used, and efficiencies."""
    rig, _ = fitted_rig()
    table = np.loadtxt(RIG / "efficiency.csv", delimiter=",", skiprows=1)
    used = {name.split("_")[0] for name in _operating_points()}
    held_out = table[[f"{torque:.2f}" not in used for torque in table[:, 0]]]
    points = [
        rig.replace(input_speed=pt.rpm(speed), input_torque=torque)
        for speed, torque in held_out[:, 2:4]
    ]
    loss = np.array([run.result.mean_power_loss for run in pt.simulate_many(points, duration=0.1)])
    error = loss / held_out[:, 4] - 1.0
    rms = float(np.sqrt(np.mean(error**2)))
    yield Row(
        f"power loss at {len(points)} operating points that the fit did not use",
        f"{held_out[:, 4].min():.2f} to {held_out[:, 4].max():.2f} W",
        f"rms error {100 * rms:.1f} %, largest {100 * np.abs(error).max():.1f} %",
        verdict(rms < 0.10),
        "bound: 10 % rms. Two parameters, boundary friction and drag, are fitted to nine other "
        "operating points. The rig commands the motor torque and does not measure it.",
    )
    given = held_out[:, 3] * held_out[:, 2] * np.pi / 30.0
    for torque in np.unique(held_out[:, 0])[::5]:
        rows = held_out[:, 0] == torque
        measured, twin = (
            1.0 - np.mean(lost[rows] / given[rows]) for lost in (held_out[:, 4], loss)
        )
        yield Row(
            f"efficiency at {torque:g} N m",
            f"{100 * measured:.1f} %",
            f"{100 * twin:.1f} %",
            verdict(abs(measured - twin) < 0.03),
            "bound: 3 percentage points.",
        )


def _operating_points() -> list[str]:
    lines = (RIG / "losses.csv").read_text().splitlines()[1:]
    return [line.split(",")[1] for line in lines]


def rig_compliance() -> Iterator[Row]:
    """Lost motion and stiffness at the output, with stiffness from the shape of the teeth."""
    scene = pt.load_scene(RIG / "scene.yaml").replace(**{"mesh.stiffness": "involute"})
    gears = scene.gearset
    radius = (
        0.5 * gears.module * (gears.teeth.sun + gears.teeth.planet) * np.cos(gears.pressure_angle)
    )
    measured = measured_lost_motion()
    backlash = measured * radius
    scene = scene.replace(backlash=backlash)

    def twist(torque: float) -> float:
        """Angle of the carrier [rad] against a held sun, with half the lost motion."""
        dte = pt.simulate(scene.replace(input_torque=torque), 0.2).mesh["dte_mean"]
        return float(np.mean(dte[:3] + dte[3:]) / (2.0 * radius))

    lost = twist(1e-3) - twist(-1e-3)
    yield Row(
        "lost motion at the output",
        f"{np.degrees(measured):.3f} deg",
        f"{np.degrees(lost):.3f} deg with a backlash of {1e3 * backlash:.3f} mm in every mesh",
        INPUT,
        "backlash is a parameter; the row only shows which value gives this lost motion.",
    )
    ratio = 1.0 + gears.teeth.ring / gears.teeth.sun
    stiffness = 2.0 * ratio / (twist(2.5) - twist(0.5))
    yield Row(
        "stiffness at the output",
        "243 N m/rad",
        f"{stiffness:.3g} N m/rad, teeth alone",
        verdict(abs(stiffness / 243.0 - 1.0) < 0.3),
        "bound: 30 %. The rig's figure includes carrier pins, bearings, shafts and housing, all of "
        "printed plastic. The scene has teeth and couplings only: give the measured stiffness as "
        "`drive.output.coupling_stiffness`.",
    )


def rig_orders() -> Iterator[Row]:
    """Lines in the spectrum of one sun mesh, whose gears have runout."""
    scene = pt.load_scene(RIG / "scene.yaml").replace(
        **{"mesh.stiffness": "involute", "mesh.runout": {"sun": 2e-5, "planet": 2e-5}},
        backlash=2e-4,
        input_speed=2.0 * np.pi * 7.2 * CARRIER_SPEED,
    )
    zs, zp, zr = scene.gearset.teeth.sun, scene.gearset.teeth.planet, scene.gearset.teeth.ring
    rate = 400.0
    force = pt.simulate(scene, 200.0, sample_rate=rate).mesh_force[:, 0]
    spectrum = pt.amplitude_spectrum(force, rate)
    order = spectrum.frequency / CARRIER_SPEED
    planet, sun = zr / zp, zr / zs  # orders of their turns against the carrier
    lines = {
        "mesh line, per turn of the output": zr,
        "sideband: mesh - planet": zr - planet,
        "sideband: mesh + planet": zr + planet,
        "sideband: mesh - sun": zr - sun,
        "sideband: mesh + motor": zr + sun + 1.0,
    }
    for what, cause in lines.items():
        measured, height = measured_line(cause)
        clear = height > CLEAR * highest_between()
        found = _nearest_line(order, spectrum.amplitude, measured)
        same = abs(found - cause) < 0.01
        yield Row(
            what,
            f"{measured:.2f}, {height:.1f} times the median",
            f"{found:.2f}",
            verdict(abs(found - measured) < RESOLUTION) if same and clear else UNDECIDED,
            f"bound: {RESOLUTION} orders, the resolution of one run. The twin's line is the "
            "nearest in the force of one sun mesh that has a tenth of the height of the mesh "
            "line. A runout of 20 um is assumed. The rig's lines are in its motor speed, mean of "
            "18 runs up to 10 rpm. "
            + ("" if same else "The twin's line is mesh + 3 planet, too near to be separated. ")
            + ("" if clear else "The rig's line does not stand out."),
        )


def _nearest_line(
    order: NDArray[np.float64], amplitude: NDArray[np.float64], place: float
) -> float:
    """The order nearest to `place` of a line with a tenth of the height of the mesh line."""
    near = np.abs(order - 155.0) < 10.0
    lines = pt.strongest_lines(order[near], amplitude[near], 100)
    high = [line.place for line in lines if line.amplitude > 0.1 * lines[0].amplitude]
    return min(high, key=lambda found: abs(found - place))
