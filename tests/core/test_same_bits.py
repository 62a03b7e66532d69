"""Results do not depend on the C library's functions, whose last digits differ by processor."""

import os
import subprocess
import sys

import pytest

# What a processor without fused multiplication has, in glibc: other variants of its functions.
OLDER = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"}
LIBRARY = """
import math
print(hash(tuple(f(x / 1000) for f in (math.sin, math.exp, math.log) for x in range(1, 5000))))
"""
COMPUTE = """
import hashlib
import warnings
import planetary_twin_py as pt
warnings.simplefilter("ignore")
paper = pt.load_scene("paper")
scenes = {
    "ripple": paper.replace(input_torque=0.3, torque_ripple=3.0),
    "runout": paper.replace(
        backlash=2e-5, **{"mesh.runout.sun": 3e-6, "mesh.runout.ring": 2e-6},
    ),
    "creep": paper.replace(input_speed=0.1),
    "bearings and churning": pt.load_scene("reference_gearbox_stage"),
    "stiff": paper.replace(input_speed=pt.rpm(30)),
    "quasi-static": paper.replace(dynamics="quasi_static", torque_ripple=3.0),
}
for name, scene in scenes.items():
    run = pt.simulate(scene, 0.02, 20_000.0, tolerance=1e-3)
    parts = (run.dte, run.speed, run.film_thickness, run.total_power_loss)
    print(name, hashlib.sha256(b"".join(part.tobytes() for part in parts)).hexdigest())
"""


def printed(code, **environment):
    """What Python prints in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.splitlines()


@pytest.mark.exhaustive
def test_samples_have_the_same_bits_with_other_variants_of_the_c_librarys_functions():
    if printed(LIBRARY) == printed(LIBRARY, **OLDER):
        pytest.skip("the C library of this machine has no other variants")
    assert printed(COMPUTE) == printed(COMPUTE, **OLDER)
