"""What a process loads before it is needed."""

import subprocess
import sys

import pytest


def loaded_by(program: str) -> set[str]:
    """Names of the modules that a Python program has loaded at its end."""
    command = [sys.executable, "-c", f"{program}; import sys; print(*sys.modules)"]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return set(done.stdout.splitlines()[-1].split())


def test_a_scene_is_read_without_loading_scipy_pint_or_ros():
    loaded = loaded_by("import planetary_twin_py as pt; pt.load_scene('paper')")
    assert "planetary_twin_py.scene.scene" in loaded
    assert not {"scipy", "pint", "rclpy"} & loaded


@pytest.mark.parametrize("scene", ["paper", "floating_sun"])
def test_a_scene_in_frequent_units_loads_neither_scipy_nor_pint(scene):
    """Each takes as long to load as a second of the paper's scene to compute."""
    loaded = loaded_by(
        "import planetary_twin_py as pt; "
        f"pt.simulate(pt.load_scene({scene!r}).replace(dynamics='torsional'), 0.01)"
    )
    assert "planetary_twin_py._core" in loaded
    assert not {"scipy", "pint"} & loaded


@pytest.mark.parametrize("node", ["simulation", "logger"])
def test_a_node_starts_without_loading_scipy_or_pint(node):
    assert not {"scipy", "pint"} & loaded_by(f"import planetary_twin.{node}.node")
