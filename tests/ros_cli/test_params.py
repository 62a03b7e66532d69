"""`ros2 param` takes numbers as people type them, and loads what it has dumped."""

from pathlib import Path

import pytest
import yaml

from .command import Ros2


@pytest.mark.parametrize(
    ("name", "typed", "shown"),
    [
        ("backlash", "3e-7", "3e-07"),
        ("backlash", "2.5e-7", "2.5e-07"),
        ("lambda_ratio", "2", "2.0"),
        ("tolerance", "1e-3", "0.001"),
    ],
)
def test_numbers_are_accepted_as_typed(
    ros2: Ros2, twin: str, name: str, typed: str, shown: str
) -> None:
    assert ros2("param", "set", twin, name, typed).strip() == "Set parameter successful"
    assert ros2.value(twin, name) == shown


def test_a_dumped_file_loads_and_starts(ros2: Ros2, twin: str) -> None:
    for name, value in (("backlash", "3e-7"), ("lambda_ratio", "2"), ("tolerance", "1e-4")):
        ros2("param", "set", twin, name, value)
    dumped = ros2("param", "dump", twin)
    file = Path(ros2.folder, "dumped.yaml")
    file.write_text(dumped, encoding="utf-8")
    for name, value in (("backlash", "1e-7"), ("input_torque", "20"), ("tolerance", "0")):
        ros2("param", "set", twin, name, value)

    loaded = ros2("param", "load", twin, str(file))
    assert "failed" not in loaded, loaded
    assert ros2("param", "dump", twin) == dumped

    renamed = yaml.safe_load(dumped)
    file.write_text(yaml.dump({"/copy/simulation": renamed[twin]}), encoding="utf-8")
    place = ("--ros-args", "-r", "__ns:=/copy", "--params-file", str(file))
    ros2.start("run", "planetary_twin", "simulation", *place)
    ros2.until("active [3]", "lifecycle", "get", "/copy/simulation")
    again = yaml.safe_load(ros2("param", "dump", "/copy/simulation"))
    assert again["/copy/simulation"] == renamed[twin]
