"""An FMU in a program in C: no Python, no environment."""

import platform
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest
from ports.ports_of_paper import driven

import planetary_twin_py as pt

COMPILER = shutil.which("cc") or shutil.which("c++")
STEPS = 40
OUTPUTS = 7  # the time, then angle, speed and torque of both shafts
INPUT = 3  # value reference of input.torque


@pytest.fixture(scope="module")
def importer(tmp_path_factory):
    """The program, compiled."""
    assert COMPILER, "the set-up of the project needs a C++ compiler"
    program = tmp_path_factory.mktemp("importer") / "importer"
    source = Path(__file__).with_name("importer.c")
    subprocess.run([COMPILER, "-x", "c", source, "-o", program, "-ldl"], check=True)
    return program


def test_a_program_in_c_has_the_bits_of_a_twin(importer, tmp_path):
    scene = driven("torque", "torque")
    with zipfile.ZipFile(pt.export_fmu(scene, tmp_path / "gearbox.fmu")) as archive:
        archive.extractall(tmp_path)
    (library,) = (tmp_path / "binaries" / f"{platform.machine()}-linux").iterdir()
    words = [importer, library, tmp_path / "resources", str(INPUT), str(OUTPUTS), str(STEPS)]
    done = subprocess.run(words, env={}, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    twin = pt.Twin(scene)
    for n in range(STEPS):
        shown = twin.step(1e-3, input_torque=60.0 + n % 5)
    expected = [getattr(shown, f"{side}_{kind}") for side in ("input", "output")
                for kind in ("angle", "speed", "torque")]  # fmt: skip
    assert [float(line) for line in done.stdout.split()] == [shown.time, *expected]
