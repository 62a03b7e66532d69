"""A ROS workspace holds the model as a link, compiles its core and installs it whole."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def configure(folder):
    """Configure the package as colcon does, in a new folder; returns the environment."""
    venv = Path(sys.prefix)
    tools = {"PATH": f"{venv / 'bin'}:{os.environ['PATH']}"}
    prefixes = {"AMENT_PREFIX_PATH": str(venv), "CMAKE_PREFIX_PATH": str(venv)}
    environment = os.environ | tools | prefixes
    run(
        environment, "-S", ROOT / "ros_ws/src/planetary_twin_py", "-B", folder / "build",
        f"-DCMAKE_INSTALL_PREFIX={folder / 'install'}", f"-DPython3_EXECUTABLE={sys.executable}",
    )  # fmt: skip
    return environment


def run(environment, *arguments):
    done = subprocess.run(["cmake", *arguments], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_core_is_installed_into_the_package(tmp_path):
    configure(tmp_path)
    installed = (tmp_path / "build/core/cmake_install.cmake").read_text()
    cores = re.findall(r'INSTALL DESTINATION "\$\{CMAKE_INSTALL_PREFIX\}/([^"]*_core)"', installed)
    assert cores
    assert all(
        re.fullmatch(r"lib/python3\.\d+/.*-packages/planetary_twin_py/_core", c) for c in cores
    )


@pytest.mark.exhaustive  # compiles the core once more
def test_the_linked_model_is_installed_with_its_scenes(tmp_path):
    environment = configure(tmp_path)
    run(environment, "--build", tmp_path / "build")
    run(environment, "--install", tmp_path / "build")
    (scene,) = (tmp_path / "install").glob("lib/python3*/site-packages/*/scene/packaged/paper.yaml")
    assert scene.read_text() == (ROOT / "planetary_twin_py/scene/packaged/paper.yaml").read_text()
    package = scene.parents[2]
    code = "import planetary_twin_py._core as c; print(c.__file__, c.BodyArrays(mass=[3]).mass[0])"
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(package.parent)},
        capture_output=True,
        text=True,
    )
    assert done.stdout.split() == [str(package / "_core/__init__.py"), "3.0"], done.stderr
    (built,) = (tmp_path / "build/core").rglob("_core/*.so")
    assert (package / "_core" / built.name).stat().st_size == built.stat().st_size
