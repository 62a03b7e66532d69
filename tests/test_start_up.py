"""What set-up has compiled is all that ever runs: a process that starts warm compiles nothing."""

import json
import subprocess
import sys

import pytest

# As `make setup` does.
SET_UP = 'import planetary_twin_py as pt; pt.Twin(pt.load_scene("paper"))'
USE = """
import json, sys
import planetary_twin_py as pt
from planetary_twin_py._program import Kernel

for name in pt.packaged_scenes():
    twin = pt.Twin(pt.load_scene(name), sample_rate=10000)
    twin.advance(0.001)
    twin.set(lambda_ratio=2, backlash=3e-7, input_torque=0)
    twin.set_tolerance(1e-2)
    twin.advance(0.001)
scene = pt.load_scene("paper")
pt.simulate(scene, duration=0.001)
pt.simulate(scene.replace(input_speed=5), duration=1, sample_rate=1000, method="auto")

modules = [m for name, m in sys.modules.items() if name.startswith("planetary_twin_py")]
programs = {k.program for m in modules for k in vars(m).values() if isinstance(k, Kernel)}
print(json.dumps({
    "loaded": sum(sum(p.stats.cache_hits.values()) for p in programs),
    "compiled": sorted(p.__name__ for p in programs if p.stats.cache_misses),
}))
"""


def python(source):
    return subprocess.run(
        [sys.executable, "-c", source], check=True, capture_output=True, text=True
    ).stdout


@pytest.mark.slow
def test_no_scene_and_no_argument_compiles_what_set_up_has_not_compiled():
    python(SET_UP)
    kernels = json.loads(python(USE))
    assert kernels["compiled"] == []
    assert kernels["loaded"] > 0


def test_a_scene_is_read_without_loading_the_compiler():
    loaded = python(
        "import sys, planetary_twin_py as pt; pt.load_scene('paper'); print(*sys.modules)"
    )
    assert "planetary_twin_py.scene.scene" in loaded.split()
    assert not {"numba", "rclpy"} & set(loaded.split())
