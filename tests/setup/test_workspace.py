"""A ROS workspace holds the model as a link, and installs it whole."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


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
