"""Python ends while other threads compute."""

import subprocess
import sys

import pytest

# Threads that return from the core and ask for the interpreter's lock all the time.
PROGRAM = """
import threading, time
import planetary_twin_py as pt

def run(twin):
    while True:
        twin.advance(1e-4)

for _ in range(4):
    twin = pt.Twin(pt.load_scene("paper"), sample_rate=1000.0)
    threading.Thread(target=run, args=(twin,), daemon=True).start()
time.sleep(0.3)
print("ends")
"""
PROCESSES = 6  # one alone may end at a favourable time


@pytest.mark.exhaustive
def test_threads_in_the_core_do_not_abort_a_process_that_ends():
    running = [
        subprocess.Popen(
            [sys.executable, "-c", PROGRAM],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for _ in range(PROCESSES)
    ]
    ended = [(*process.communicate(timeout=300), process.returncode) for process in running]
    assert ended == PROCESSES * [("ends\n", "", 0)]
