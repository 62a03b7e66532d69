"""Errors of transmission error and loss over random scenes, against the other method, converged.

Speeds run from 0.001 to 20 000 rpm in both senses, with standstill; gear sets, power flows, laws,
faults and errors of planets are drawn; with planar dynamics masses, bearings and weight as well.
Prints a line for each scene whose error exceeds ten tolerances, with "warned" where its run says
so, or whose ledger misses a millionth of the turnover at 1e-5; then how many there are.
With spatial dynamics, teeth are helical, and bearings have axial and tilting stiffnesses.
`--dynamics any` draws dynamics, ports and differentials, too, and compares every printed figure.

    python benchmarks/random_scenes.py --count 100 --seed 1 --tolerance 1e-4
    python benchmarks/random_scenes.py --count 100 --seed 1 --dynamics planar
    python benchmarks/random_scenes.py --count 100 --seed 1 --dynamics spatial
    python benchmarks/random_scenes.py --count 10 --seed 1 --dynamics any
"""

from __future__ import annotations

import argparse
import math
import warnings
from typing import Any, NamedTuple

import numpy as np

import planetary_twin_py as pt

SETS = [(30, 20, 70, 3), (36, 18, 72, 4), (24, 24, 72, 3), (40, 30, 100, 2), (30, 20, 70, 5)]
FASTEST_ROSENBROCK = 3000.0  # [Hz] mesh frequency above which collocation is the reference
CRACK = {"kind": "crack", "gear": "sun", "tooth": 0, "stiffness_loss": 0.4}
ERROR = 1e-6  # [m] largest error of a pin or a tooth
LEAST_SHARE = 1e-3  # of the power that passes: losses below it are compared with it


class Errors(NamedTuple):
    """Of one scene."""

    dte: float  # rms of the difference over rms
    loss: float  # relative
    ledger: float  # residual over turnover, at 1e-5
    warnings: tuple[str, ...]  # of the run

    def within(self, tolerance: float) -> bool:
        """Whether the errors are below ten tolerances."""
        return max(self.dte, self.loss) < 10.0 * tolerance

    @property
    def closed(self) -> bool:
        """Whether the ledger closes."""
        return self.ledger < 1e-6


def random_changes(random: np.random.Generator) -> dict[str, Any]:
    """Settings of a random scene, beside those of `paper`."""

    def logarithmic(low: float, high: float) -> float:
        return float(10.0 ** random.uniform(math.log10(low), math.log10(high)))

    def one(*choices: Any) -> Any:
        return choices[random.integers(len(choices))]

    sun, planet, ring, planets = SETS[random.integers(len(SETS))]
    held, first, last = (str(name) for name in random.permutation(["sun", "ring", "carrier"]))
    speed = one(0.0, *[logarithmic(1e-3, 20_000.0)] * 9)
    places = [round(n * (sun + ring) / planets) / (sun + ring) for n in range(planets)]
    changes = {
        "gearset.teeth": {"sun": sun, "planet": planet, "ring": ring},
        "gearset.planet_angles": tuple(2.0 * math.pi * place for place in places),
        "gearset.held": held,
        "drive.input.member": first,
        "drive.output.member": last,
        "drive.speed_limit": pt.rpm(25_000.0),
        "input_speed": one(1.0, -1.0) * pt.rpm(speed),
        "input_torque": one(1.0, -1.0) * logarithmic(1.0, 300.0),
        "torque_ripple": one(0.0, 0.0, 5.0),
        "backlash": one(0.0, 2e-7, 1e-6, 1e-5),
        "lambda_ratio": float(random.uniform(0.0, 4.0)),
        "oil_temperature": float(random.uniform(273.0, 400.0)),
        "mesh.sun_planet_stiffness": logarithmic(3e7, 6e8),
        "mesh.planet_ring_stiffness": logarithmic(3e7, 6e8),
        "mesh.double_pair_ratio": float(random.uniform(1.0, 2.0)),
        "mesh.ramp": one(0.0, 0.03, 0.1),
        "mesh.damping.law": one("viscous", "meshing_frequency", "natural_frequency"),
        "mesh.runout": one({}, {"sun": "2 um"}),
        "faults": one([], [], [CRACK]),
        "errors": errors_of_planets(random.spawn(1)[0], planets),
        "lubrication.film": one("dowson_higginson", "dowson_toyoda", "salagianni"),
        "lubrication.lambda_ratio": one("prescribed", "computed"),
        "lubrication.boundary": one("greenwood_tripp", "load_sharing"),
        "lubrication.traction": one("eyring", "evans_johnson", "schlenk"),
        "lubrication.rolling": one("none", "goksem_hargreaves"),
    }
    if changes["mesh.runout"]:
        changes["backlash"] += 2e-6  # runout closes 1.5 um of it
    if changes["errors"]:
        changes["backlash"] += 8.0 * ERROR  # more than all errors close
    return changes


def errors_of_planets(random: np.random.Generator, planets: int) -> dict[str, Any]:
    """Errors of pins and of the thickness of planets, of each another; none in two of three."""
    if random.integers(3) > 0:
        return {}

    def each() -> tuple[float, ...]:
        return tuple(random.uniform(-ERROR, ERROR, planets))

    return {"pin_radial": each(), "pin_tangential": each(), "planet_thickness": each()}


def moving_axes(random: np.random.Generator, planets: int) -> dict[str, Any]:
    """Further settings of a random scene whose axes move: masses, bearings, larger errors."""

    def logarithmic(low: float, high: float) -> float:
        return float(10.0 ** random.uniform(math.log10(low), math.log10(high)))

    def support(floats: bool) -> dict[str, Any]:
        given = {"mass": logarithmic(0.05, 5.0), "bearing": logarithmic(1e6, 1e10)}
        if random.integers(3) == 0:
            given["clearance"] = logarithmic(1e-6, 5e-5)
        if floats and random.integers(3) == 0:
            given |= {"bearing": 0.0, "clearance": 0.0}
        return given

    changes: dict[str, Any] = {
        "dynamics": "planar",
        "supports": {name: support(name == "sun") for name in ("sun", "planet", "ring", "carrier")}
        | {"gravity": (0.0, 0.0, 9.81)[random.integers(3)]},
    }
    if random.integers(3) > 0:
        largest = logarithmic(1e-6, 3e-5)
        changes["errors"] = {
            name: tuple(random.uniform(-largest, largest, planets))
            for name in ("pin_radial", "pin_tangential", "planet_thickness")
        }
        changes["backlash"] = logarithmic(1e-6, 2e-4)
    return changes


def tilting_axes(random: np.random.Generator) -> dict[str, Any]:
    """Further settings of a random scene whose axes move and tilt: helix and bearings."""

    def stiffness() -> float:
        return float(10.0 ** random.uniform(6.0, 10.0))

    helix = (0.0, *random.uniform(-0.2, 0.2, 5))[random.integers(6)]
    bearings = {
        f"supports.{body}.{way}": stiffness()
        for body in ("sun", "planet", "ring", "carrier")
        for way in ("axial", "tilting")
    }
    return {"dynamics": "spatial", "gearset.helix_angle": float(helix)} | bearings


def any_scene(random: np.random.Generator) -> pt.Scene:
    """A random scene of any dynamics and power flow; its ports have machines, torques or motions.

    Raises:
        ValueError: the scene is not valid.
    """

    def one(*choices: Any) -> Any:
        return choices[random.integers(len(choices))]

    changes, paper = random_changes(random), pt.load_scene("paper")
    dynamics = one("torsional", "torsional", "planar", "planar", "spatial")
    if dynamics != "torsional":
        changes |= moving_axes(random, len(changes["gearset.planet_angles"]))
    for side in ("input", "output"):
        changes[f"drive.{side}.port"] = one("machine", "torque", "motion")
    if one(True, False, False, False):
        motor = paper.drive.output.model_dump() | {"member": changes["gearset.held"]}
        speed = float(random.uniform(-150.0, 150.0))
        changes |= {"drive.second_input": motor, "second_input_speed": speed}
        changes["gearset.held"] = "none"
    scene = paper.replace(**changes)
    return scene.replace(**tilting_axes(random)) if dynamics == "spatial" else scene


def printed(run: pt.Result) -> dict[str, tuple[np.ndarray, float]]:
    """Figures that `simulate` prints, and the size that their errors are compared with."""
    mesh, dte = run.mesh, float(np.abs(run.mesh["dte_mean"]).max() + run.mesh["dte_rms"].max())
    force, loss = float(mesh["mesh_force_peak"].max()), abs(1.0 - run.efficiency)
    found = {name: (mesh[name], dte) for name in ("dte_mean", "dte_rms", "dte_peak")}
    found |= {name: (mesh[name], force) for name in ("mesh_force_mean", "mesh_force_peak")}
    found["contact_fraction"] = mesh["contact_fraction"], 1.0
    if np.isfinite(loss):
        found["efficiency"] = np.array([run.efficiency]), max(loss, LEAST_SHARE)
    if run.axes is not None:
        moved = np.linalg.norm(run.axes.displacement, axis=2).max(axis=0)
        held = np.linalg.norm(run.axes.bearing_force, axis=2).max(axis=0)
        found["displacement_peak"] = moved, float(moved.max())
        found["bearing_force_peak"] = held, max(force, float(held.max()))
        found["load_share"] = run.axes.mean_load_share, 1.0
    return found


def compare_printed(scene: pt.Scene, tolerance: float) -> tuple[dict[str, float], tuple[str, ...]]:
    """Errors of printed figures in tolerances, and the warnings of the run."""
    duration, method = _course(scene)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        run = pt.simulate(scene, duration, tolerance=tolerance)
        texts = tuple(str(each.message) for each in warned)
        # Rosenbrock's method needs a step for each oscillation of stiff axes that tilt.
        other = "collocation" if scene.tilting_axes else method
        exact = printed(pt.simulate(scene, duration, tolerance=1e-7, method=other))
    errors = {
        name: float(np.nanmax(np.abs(values - exact[name][0]))) / exact[name][1] / tolerance
        for name, (values, _) in printed(run).items()
        if name in exact and exact[name][1] > 0.0
    }
    return errors, texts


def _course(scene: pt.Scene) -> tuple[float, str]:
    """Duration of a run of some mesh cycles [s], and the method that it is compared with."""
    speed = abs(scene.operating_point.input_speed)
    frequency = speed * scene.gearset.teeth.ring / (2.0 * math.pi)  # at most
    duration = min(max(4.0 / frequency, 0.004), 0.02) if frequency > 0.0 else 0.02
    return duration, "collocation" if frequency > FASTEST_ROSENBROCK else "rosenbrock"


def measure(scene: pt.Scene, tolerance: float) -> Errors:
    """Compare a run of some mesh cycles with one of the other method at 1e-7."""
    duration, method = _course(scene)
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        run = pt.simulate(scene, duration, tolerance=tolerance)
    closer = pt.simulate(scene, duration, tolerance=1e-5).energy
    exact = pt.simulate(scene, duration, tolerance=1e-7, method=method)
    passing = sum(map(abs, exact.energy.machines)) / duration
    losses = [float(each.mesh["power_loss"].sum()) for each in (run, exact)]
    turnover = sum(map(abs, closer.machines)) + abs(closer.kinetic) + abs(closer.elastic)
    return Errors(
        float(np.sqrt(np.mean((run.dte - exact.dte) ** 2) / np.mean(exact.dte**2))),
        abs(losses[0] - losses[1]) / max(abs(losses[1]), LEAST_SHARE * passing, 1e-9),
        abs(closer.residual) / max(turnover, 1e-6 * closer.stored),
        tuple(str(each.message) for each in warned),
    )


def print_any(seed: int, count: int, tolerance: float) -> None:
    """Print the largest error of the printed figures of each scene."""
    random = np.random.default_rng(seed)
    for number in range(count):
        try:
            scene = any_scene(random)
            errors, warned = compare_printed(scene, tolerance)
        except (ValueError, pt.RunawayError) as refusal:
            print(f"{number:4d}  refused: {str(refusal)[:110]}", flush=True)
            continue
        worst = max(errors, key=lambda name: errors[name])
        found = f"{worst} {errors[worst]:.3g} tolerances  {'warned' if warned else ''}"
        print(
            f"{number:4d}  {scene.dynamics:10s}{'-'.join(scene.drive.ports):18s}{found}", flush=True
        )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100, help="scenes to draw")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tolerance", type=float, default=1e-4)
    parser.add_argument(
        "--dynamics", choices=("torsional", "planar", "spatial", "any"), default="torsional"
    )
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    if given.dynamics == "any":
        return print_any(given.seed, given.count, given.tolerance)
    random, paper = np.random.default_rng(given.seed), pt.load_scene("paper")
    compared = beyond = unwarned = unclosed = 0
    for number in range(given.count):
        try:
            changes = random_changes(random)
            if given.dynamics != "torsional":
                changes |= moving_axes(random, len(changes["gearset.planet_angles"]))
            scene = paper.replace(**changes)
            if given.dynamics == "spatial":
                scene = scene.replace(**tilting_axes(random))
            found = measure(scene, given.tolerance)
        except (ValueError, pt.RunawayError) as refusal:
            print(f"{number:4d}  refused: {str(refusal)[:90]}")
            continue
        compared += 1
        within = found.within(given.tolerance)
        beyond += not within
        unwarned += not within and not found.warnings
        unclosed += not found.closed
        if not (within and found.closed):
            point = scene.operating_point
            print(
                f"{number:4d}  {point.input_speed / pt.rpm(1.0):10.4g} rpm "
                f"{point.input_torque:8.3g} N m  DTE {found.dte:.1e}  loss {found.loss:.1e}  "
                f"ledger {found.ledger:.1e}  {'warned' if found.warnings else ''}",
                flush=True,
            )
    print(
        f"{compared} scenes compared, {beyond} beyond ten tolerances of {given.tolerance:g}, "
        f"{unwarned} of them without a warning; {unclosed} ledgers miss a millionth of the turnover"
    )


if __name__ == "__main__":
    main()
