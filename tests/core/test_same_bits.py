"""Results do not depend on libraries whose last digits differ by processor."""

import os
import subprocess
import sys
from pathlib import Path

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
PRINTED_BITS = Path(__file__).with_name("printed_bits.py").read_text()


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
    assert printed(PRINTED_BITS) == printed(PRINTED_BITS, **OLDER)
