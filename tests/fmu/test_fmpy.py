"""FMUs in FMPy: they fulfil the standard, and run in a process without the package."""

import json
import subprocess
import sys

import pytest
from ports.ports_of_paper import driven

import planetary_twin_py as pt

pytest.importorskip("fmpy")
from fmpy.validation import validate_fmu

PORTS = [("torque", "motion"), ("motion", "torque"), ("machine", "machine")]


@pytest.mark.parametrize("version", ["3.0", "2.0"])
@pytest.mark.parametrize("ports", PORTS, ids="-".join)
def test_the_model_description_fulfils_the_standard(tmp_path, version, ports):
    """FMPy compares it with the schema of the standard, and its variables with each other."""
    path = pt.export_fmu(driven(*ports), tmp_path / "gearbox.fmu", version=version)
    assert validate_fmu(str(path)) == []


RUN = """
import json, sys
import numpy as np
from fmpy import simulate_fmu
given = np.array([(0.0, 70.0), (1.0, 70.0)], dtype=[("time", float), ("input.torque", float)])
found = simulate_fmu(sys.argv[1], stop_time=0.1, output_interval=1e-3, input=given,
    start_values={"operating_point.backlash": 1e-6}, output=["input.speed", "output.angle"])
assert "planetary_twin_py" not in sys.modules
print(json.dumps([found["input.speed"].tolist(), found["output.angle"].tolist()]))
"""


@pytest.mark.parametrize("version", ["3.0", "2.0"])
def test_fmpy_has_the_bits_of_a_twin(tmp_path, version):
    scene = driven("torque", "torque")
    path = pt.export_fmu(scene, tmp_path / "gearbox.fmu", version=version)
    done = subprocess.run(
        [sys.executable, "-c", RUN, str(path)], capture_output=True, text=True, cwd=tmp_path
    )
    assert done.returncode == 0, done.stderr
    speeds, angles = json.loads(done.stdout.splitlines()[-1])
    twin = pt.Twin(scene.replace(backlash=1e-6))
    shown = [twin.step(1e-3, input_torque=70.0).copy() for _ in range(100)]
    assert speeds[1:] == [each.input_speed for each in shown]
    assert angles[1:] == [each.output_angle for each in shown]
