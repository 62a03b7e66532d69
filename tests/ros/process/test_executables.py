"""The process of a node, before ROS and the model are loaded."""

import subprocess
import sys

NUMPY_ALONE = """
import os, types
from planetary_twin import executables

def load(name, package):
    import numpy
    return types.SimpleNamespace(main=lambda: len(os.listdir("/proc/self/task")))

executables.import_module = load
print(executables.run("follower.node"))
"""


def test_numpy_starts_no_threads_in_a_node():
    done = subprocess.run(
        [sys.executable, "-c", NUMPY_ALONE], capture_output=True, text=True, check=True
    )
    assert int(done.stdout) == 1
