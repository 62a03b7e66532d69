"""The manifests of the packages: versions, REP 149, dependencies."""

import re
import sys
import tomllib
from pathlib import Path

from catkin_pkg.package import parse_package
from packaging.version import Version

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
MANIFESTS = [
    ROOT / folder / "package.xml"
    for folder in ("planetary_twin_py", "msgs_spec", "ros_ws/src/planetary_twin")
]


def test_all_have_the_same_version():
    version = PROJECT["version"]
    assert len(Version(version).release) == 3
    assert {str(parse_package(str(file)).version) for file in MANIFESTS} == {version}
    setup = (ROOT / "ros_ws/src/planetary_twin/setup.py").read_text()
    assert re.findall(r'version="(.+)"', setup) == [version]
    cited = (ROOT / "CITATION.cff").read_text()
    assert re.findall(r"^version: (.+)$", cited, re.MULTILINE) == [version]
    assert re.search(
        rf"^## \[({re.escape(version)}|Unreleased)\]", (ROOT / "CHANGELOG.md").read_text(), re.M
    )


def test_the_nodes_depend_on_every_ros_package_they_import():
    nodes = ROOT / "ros_ws/src/planetary_twin"
    text = "\n".join(file.read_text() for file in nodes.rglob("*.py") if "build" not in file.parts)
    imported = set(re.findall(r"^\s*(?:from|import) (\w+)", text, re.MULTILINE))
    declared = {need.name for need in parse_package(str(MANIFESTS[2])).exec_depends}
    share = Path(sys.prefix, "share")
    ros = {name for name in imported if (share / name / "package.xml").exists()}
    assert {"rclpy", "sensor_msgs"} <= ros
    assert ros - {"planetary_twin"} <= declared
