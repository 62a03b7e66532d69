"""Changes of the operating point leave no memory in use."""

import subprocess
import sys

import pytest

# In a process of its own, whose heap nothing else changes. What is kept for reuse reaches its size
# in the first `warm` changes. `mallinfo2` (glibc 2.33) counts what the C++ core and NumPy hold,
# `getallocatedblocks` the objects of Python.
PROGRAM = """
import ctypes, gc, random, sys
import planetary_twin_py as pt

class Info(ctypes.Structure):
    names = "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost"
    _fields_ = [(name, ctypes.c_size_t) for name in names.split()]

mallinfo2 = ctypes.CDLL(None).mallinfo2
mallinfo2.restype = Info

def in_use():
    gc.collect()
    info = mallinfo2()
    return info.uordblks + info.hblkhd, sys.getallocatedblocks()

def change(count):
    repeated = 0
    for n in range(count):
        twin.set(lambda_ratio=1.5 + 0.5 * (n % 2), backlash=1e-7 * (2 + n % 3))
        twin.set_tolerance(draw.choice(tolerances))
        twin.advance(draw.uniform(0.001, 0.01))
        repeated += sum(twin.advance(0.1).repeated for _ in range(windows))
        del twin.log[:-1]
    return repeated

warm, measured, windows = map(int, sys.argv[1:])
tolerances, draw = (1e-2, 1e-3, 1e-4, 1e-5), random.Random(1)
twin = pt.Twin(pt.load_scene("paper"))
change(warm)
before = in_use()
repeated = change(measured)
after = in_use()
print(after[0] - before[0], after[1] - before[1], repeated)
"""


def growth(warm: int, measured: int, windows: int) -> tuple[int, int, int]:
    """Bytes and Python objects that `measured` changes leave, and windows that were repeated."""
    command = [sys.executable, "-c", PROGRAM, str(warm), str(measured), str(windows)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    held, objects, repeated = map(int, done.stdout.split())
    return held, objects, repeated


@pytest.mark.exhaustive
def test_a_thousand_changes_leave_no_memory_in_use() -> None:
    held, objects, repeated = growth(warm=500, measured=1000, windows=0)
    assert repeated == 0
    assert held < 20_000  # bytes; a leak of 20 bytes per change would reach it
    assert objects < 100


@pytest.mark.slow
@pytest.mark.exhaustive
def test_changes_between_repeated_cycles_leave_no_memory() -> None:
    held, objects, repeated = growth(warm=18, measured=18, windows=25)
    assert repeated > 18  # the tables of the repeated cycle are computed again after each change
    assert held < 20_000  # bytes; tables with memory of their own grow by six times as much
    assert objects < 100
