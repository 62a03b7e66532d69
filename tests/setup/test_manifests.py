"""The manifest of the nodes names what they import."""

import re
import sys
from pathlib import Path

from catkin_pkg.package import parse_package

NODES = Path(__file__).parents[2] / "ros_ws/src/planetary_twin"


def test_the_nodes_depend_on_every_ros_package_they_import():
    text = "\n".join(file.read_text() for file in NODES.rglob("*.py") if "build" not in file.parts)
    imported = set(re.findall(r"^\s*(?:from|import) (\w+)", text, re.MULTILINE))
    declared = {need.name for need in parse_package(str(NODES / "package.xml")).exec_depends}
    share = Path(sys.prefix, "share")
    ros = {name for name in imported if (share / name / "package.xml").exists()}
    assert {"rclpy", "sensor_msgs"} <= ros
    assert ros - {"planetary_twin"} <= declared
