"""What is exported, and what is refused."""

import re
import subprocess
import zipfile
from xml.etree import ElementTree

import pytest
from command_line import invoke
from ports.ports_of_paper import PAPER, driven

import planetary_twin_py as pt
from planetary_twin_py.fmu.export import LIBRARIES, VERSIONS


def described(scene, folder, version="3.0"):
    """Variables of the model description, by name."""
    path = pt.export_fmu(scene, folder / "gearbox.fmu", version=version)
    with zipfile.ZipFile(path) as archive:
        root = ElementTree.fromstring(archive.read("modelDescription.xml"))
    return {each.get("name"): each for each in root.find("ModelVariables")}


@pytest.mark.parametrize("library", sorted(LIBRARIES.glob("*.so")), ids=lambda path: path.name)
def test_a_library_needs_the_c_library_only(library):
    text = subprocess.run(["readelf", "-d", library], capture_output=True, text=True).stdout
    needed = set(re.findall(r"NEEDED.*\[(.*)\]", text))
    assert "libc.so.6" in needed
    loaders = {"ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
    assert needed - loaders <= {"libc.so.6", "libm.so.6"}


@pytest.mark.parametrize("version", VERSIONS)
def test_ports_choose_the_inputs(tmp_path, version):
    found = described(driven("torque", "motion"), tmp_path, version)
    inputs = {name for name, each in found.items() if each.get("causality") == "input"}
    assert inputs == {"input.torque", "output.speed"}
    assert found["input.speed"].get("causality") == "output"


def test_a_backlash_with_runout_is_not_tunable(tmp_path):
    """The scene refuses a backlash that the runout would close."""
    scene = PAPER.replace(**{"mesh.runout.sun": 5e-6, "backlash": 2e-5})
    with pytest.raises(ValueError, match="runout"):
        scene.replace(backlash=0.0, input_torque=0.0)
    assert "operating_point.backlash" not in described(scene, tmp_path)


def test_the_same_scene_gives_the_same_file(tmp_path):
    first, second = (pt.export_fmu(PAPER, tmp_path / f"{n}.fmu").read_bytes() for n in range(2))
    assert first == second


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        ("differential", "gearset.held = 'none': must be sun, ring or carrier"),
        ("floating_sun", "dynamics = 'planar': must be torsional"),
    ],
)
def test_a_scene_that_an_fmu_cannot_hold_is_refused(tmp_path, scene, message):
    loaded = pt.load_scene(scene)
    if scene == "floating_sun":
        loaded = loaded.replace(dynamics="planar")
    with pytest.raises(ValueError, match=re.escape(message)):
        pt.export_fmu(loaded, tmp_path / "gearbox.fmu")
    assert not (tmp_path / "gearbox.fmu").exists()


def test_the_command_names_its_option_for_the_version(tmp_path):
    arguments = ["export-fmu", "paper", "--fmi", "4", "--out", str(tmp_path / "gearbox.fmu")]
    answer = invoke(*arguments)
    assert answer.exit_code == 2
    assert "--fmi = '4': must be 3.0 or 2.0\n" in answer.output
