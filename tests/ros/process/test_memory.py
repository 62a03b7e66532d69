"""Memory that a process has freed goes back to the system."""

import subprocess
import sys

# Blocks of varying sizes, as the chunks of a recording, with small objects between them that
# stay. What the process keeps beyond these is memory that the heap has not returned.
PROGRAM = """
import os, random, sys
from planetary_twin_live.process import own_memory
from planetary_twin.process.memory import return_large_blocks

if "returned" in sys.argv:
    return_large_blocks()
sizes, kept = random.Random(0), []
before = own_memory(os.getpid())
for _ in range(400):
    waiting = [bytes(sizes.randrange(200_000, 2_000_000)) for _ in range(8)]
    sizes.shuffle(waiting)
    kept.append(bytes(20_000))
    waiting.clear()
print(own_memory(os.getpid()) - before - sum(map(len, kept)) / 1e6)
"""


def kept(*arguments):
    """Memory that the process keeps after freeing its blocks [MB]."""
    command = [sys.executable, "-c", PROGRAM, *arguments]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def test_freed_large_blocks_are_returned_and_by_default_are_not():
    assert kept("returned") < 1.0 < kept()
