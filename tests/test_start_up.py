"""What a process loads before it is needed."""

import subprocess
import sys


def test_a_scene_is_read_without_loading_the_core():
    loaded = subprocess.run(
        [
            sys.executable,
            "-c",
            "import sys, planetary_twin_py as pt; pt.load_scene('paper'); print(*sys.modules)",
        ],
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    assert "planetary_twin_py.scene.scene" in loaded.split()
    assert not {"planetary_twin_py._core", "rclpy"} & set(loaded.split())
