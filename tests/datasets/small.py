"""A data set that takes a second, and what is done with it."""

import hashlib

from planetary_twin_py.datasets.folder import write_dataset
from planetary_twin_py.datasets.plan import DatasetPlan
from planetary_twin_py.datasets.spec import read_spec
from planetary_twin_py.simulation.threads import Threads

SPEC = """
name: small
description: Two faults of a small gearbox.
scene: paper
set:
  sensors: [{name: ring, kind: accelerometer, rate: 5 kHz, noise: 0.1 m/s^2}]
specimens: 5
drawn:
  errors.pin_tangential: normal(0 um,2 um)
  mesh.sun_planet_stiffness: 1.9e8 N/m:2.1e8 N/m
  sensors.0.noise: 0.02:0.05
faults:
  - {kind: crack, gear: sun, tooth: 0:29, stiffness_loss: 0.05:0.4:log}
  - [{label: worn, kind: wear, gear: planet, planet: 1:3, depth: 1um:3um},
     {label: cracked, kind: crack, gear: ring, stiffness_loss: 0.2}]
operating_points:
  - {input_speed: 900rpm:1100rpm, input_torque: 50:63, speed_wander: 0.01, torque_wander: 0.02}
duration: 0.05 s
settling: 0.02 s
tolerance: 1e-3
seed: 3
"""


def plan_of(folder, text=SPEC, **changes):
    """The plan of a specification, in which fields of the first level are replaced."""
    path = folder / "spec.yaml"
    path.write_text(text + "".join(f"\n{name}: {value}" for name, value in changes.items()))
    return DatasetPlan(*read_spec(path))


def without(text, *names):
    """A specification of which fields on a line of their own are left out."""
    starts = tuple(f"{name}:" for name in names)
    return "\n".join(line for line in text.splitlines() if not line.startswith(starts))


def written(plan, out, executor=None):
    """Write the data set of a plan; returns what it has."""
    records = list(plan.records())
    executor = executor or Threads(2)
    return write_dataset(plan, records, out, executor, lambda done, failure: None)


def digests(folder):
    """SHA-256 of every file of a folder, by path."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }
