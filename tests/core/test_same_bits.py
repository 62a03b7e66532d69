"""Results do not depend on libraries whose last digits differ by processor."""

import os
import subprocess
import sys

import pytest
from numpy._core._multiarray_umath import __cpu_dispatch__, __cpu_features__

# An older processor has other variants of functions of the C library, numpy and LAPACK.
OLDER = {
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2",
    "OPENBLAS_CORETYPE": "Prescott",
    "NPY_DISABLE_CPU_FEATURES": " ".join(f for f in __cpu_dispatch__ if __cpu_features__[f]),
}
LIBRARY = """
import hashlib
import math
import numpy as np
print(hash(tuple(f(x / 1000) for f in (math.sin, math.exp, math.log) for x in range(1, 5000))))
matrix = np.sin(np.arange(2500.0)).reshape(50, 50)
print(hashlib.sha256(np.linalg.solve(matrix, matrix.T).tobytes()).hexdigest())
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
    "profile shift": pt.load_scene("reference_gearbox_stage"),
    "stiff": paper.replace(input_speed=pt.rpm(30)),
    "quasi-static": paper.replace(dynamics="quasi_static", torque_ripple=3.0),
    "crack": pt.load_scene("cracked_tooth"),
    "floating sun": pt.load_scene("floating_sun"),
    "helical": pt.load_scene("helical_stage"),
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
def test_an_older_processor_gives_the_same_bits():
    if printed(LIBRARY) == printed(LIBRARY, **OLDER):
        pytest.skip("the libraries of this machine have no other variants")
    assert printed(COMPUTE) == printed(COMPUTE, **OLDER)
