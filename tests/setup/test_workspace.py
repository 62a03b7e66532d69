"""A ROS workspace holds the model as a link, compiles its core and installs it whole."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.exhaustive  # compiles the core once more
def test_the_linked_model_is_installed_with_its_scenes(tmp_path):
    venv = Path(sys.prefix)
    tools = {"PATH": f"{venv / 'bin'}:{os.environ['PATH']}"}
    prefixes = {"AMENT_PREFIX_PATH": str(venv), "CMAKE_PREFIX_PATH": str(venv)}
    for arguments in (
        [
            "-S",
            ROOT / "ros_ws/src/planetary_twin_py",
            "-B",
            tmp_path / "build",
            f"-DCMAKE_INSTALL_PREFIX={tmp_path / 'install'}",
            f"-DPython3_EXECUTABLE={sys.executable}",
        ],
        ["--build", tmp_path / "build"],
        ["--install", tmp_path / "build"],
    ):
        done = subprocess.run(
            ["cmake", *arguments], env=os.environ | tools | prefixes, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stdout + done.stderr
    (scene,) = (tmp_path / "install").glob("lib/python3*/site-packages/*/scene/packaged/paper.yaml")
    assert scene.read_text() == (ROOT / "planetary_twin_py/scene/packaged/paper.yaml").read_text()
    package = scene.parents[2]
    code = "import planetary_twin_py._core as c; print(c.__file__, c.Train(mass=[3]).mass[0])"
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(package.parent)},
        capture_output=True,
        text=True,
    )
    assert done.stdout.split() == [str(package / "_core/__init__.py"), "3.0"], done.stderr
    (compiled,) = (package / "_core").glob("*.so")
    built = next((tmp_path / "build").rglob(compiled.name))
    assert compiled.stat().st_size == built.stat().st_size
