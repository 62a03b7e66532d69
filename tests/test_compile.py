"""Kernels are compiled once, never because a number has changed, and to the same machine code."""

import os
import subprocess
import sys
import time
from statistics import median

import pytest

import planetary_twin_py as pt
from planetary_twin_py._program import Kernel

CHANGES = [
    {"backlash": 0.0},
    {"backlash": 4e-7},
    {"lambda_ratio": 2},
    {"oil_temperature": 300.0},
    {"input_speed": 0},
    {"input_speed": -2.0},
    {"input_torque": -20.0},
    {"input_torque": 0.0, "torque_ripple": 3.0},
]


def compiled():
    """Number of machine codes of every kernel that Python calls."""
    kernels = {
        value
        for name, module in list(sys.modules.items())
        if name.startswith("planetary_twin_py")
        for value in vars(module).values()
        if isinstance(value, Kernel)
    }
    return {kernel.py_func.__qualname__: len(kernel.program.overloads) for kernel in kernels}


@pytest.mark.parametrize("name", pt.packaged_scenes())
def test_no_change_and_no_scene_compiles_anything_after_the_first_twin(name):
    pt.Twin(pt.load_scene("paper")).advance(1e-3)
    before = compiled()
    assert before["advance"] == 1
    twin = pt.Twin(pt.load_scene(name), sample_rate=1000.0)
    for change in CHANGES:
        twin.set(**change)
        twin.advance(0.5e-3)
    assert compiled() == before


def test_a_change_takes_less_than_5_milliseconds_of_the_processor():
    twin, taken = pt.Twin(pt.load_scene("paper")), []
    for change in CHANGES * 3:
        twin.advance(1.23e-3)  # ends within a step, part of which is made again
        begin = time.thread_time()
        twin.set(**change)
        taken.append(time.thread_time() - begin)
    assert median(taken) < 5e-3


def digits(cache):
    """What a run computes in a process of its own, to the last bit."""
    source = """
import hashlib
import planetary_twin_py as pt
result = pt.simulate(pt.load_scene("paper"), 0.02)
print(hashlib.sha256(result.dte.tobytes()).hexdigest())
"""
    environment = os.environ | {"NUMBA_CACHE_DIR": str(cache)}
    return subprocess.run(
        [sys.executable, "-c", source], check=True, capture_output=True, text=True, env=environment
    ).stdout


@pytest.mark.exhaustive
@pytest.mark.slow
def test_a_process_that_compiles_computes_the_same_digits_as_one_that_loads(tmp_path):
    compiling = digits(tmp_path)
    assert list(tmp_path.rglob("*.nbc"))
    assert compiling == digits(tmp_path)
