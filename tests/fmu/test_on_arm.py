"""The library of an FMU for 64-bit ARM, on an emulated processor: `make test-arm` compiles it."""

import os
import shutil
import subprocess
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import pytest
from ports.ports_of_paper import PAPER, driven

import planetary_twin_py as pt
from planetary_twin_py._core import FUSES

LIBRARIES = Path(os.environ.get("ARM_LIBRARIES", ""))  # which tools/test_arm sets
EMULATOR = ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"]
SOURCE = Path(__file__).with_name("importer.c")
OUTPUTS, STEPS = "20", "100"
TORQUE = {"drive.input.port": "torque"}
SCENES = {  # with the tolerance
    "both torques": (driven("torque", "torque"), 1e-3),
    "a fault": (pt.load_scene("cracked_tooth").replace(**TORQUE), 1e-4),
    "double precision": (PAPER.replace(**TORQUE), 1e-6),
    "helical": (pt.load_scene("helical_stage").replace(dynamics="torsional", **TORQUE), 1e-3),
}
pytestmark = [
    pytest.mark.skipif(not LIBRARIES.name, reason="make test-arm compiles it"),
    pytest.mark.skipif(not FUSES, reason="this processor has no fused products"),
]


@pytest.fixture(scope="module")
def programs(tmp_path_factory):
    """The importing program, compiled for this processor and for ARM."""
    folder = tmp_path_factory.mktemp("importers")
    for name, compiler in (("here", "cc"), ("arm", "aarch64-linux-gnu-gcc")):
        words = [compiler, "-x", "c", SOURCE, "-o", folder / name, "-ldl"]
        subprocess.run(words, check=True)
    return folder


@pytest.mark.parametrize(("scene", "tolerance"), SCENES.values(), ids=SCENES)
def test_arm_computes_the_bits_of_this_processor(programs, scene, tolerance, tmp_path):
    with zipfile.ZipFile(pt.export_fmu(scene, tmp_path / "it.fmu", tolerance=tolerance)) as archive:
        archive.extractall(tmp_path)
    variables = ElementTree.parse(tmp_path / "modelDescription.xml").find("ModelVariables")
    (torque,) = (each for each in variables if each.get("name") == "input.torque")
    (library,) = (tmp_path / "binaries").glob("*/*.so")
    shutil.copy(LIBRARIES / "armv8.so", tmp_path / "resources")
    words = [tmp_path / "resources", torque.get("valueReference"), OUTPUTS, STEPS]
    here, there = (
        subprocess.run([*command, *words], capture_output=True, text=True, check=True).stdout
        for command in (
            [programs / "here", library],
            [*EMULATOR, programs / "arm", LIBRARIES / "fmi.so"],
        )
    )
    assert len(here.split()) == int(OUTPUTS) and len(set(here.split())) > 10
    assert here == there
