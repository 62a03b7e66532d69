"""The URDF, read by Rerun's own parser, stands as the absolute angles of the bodies say."""

from __future__ import annotations

import math
from pathlib import Path
from urllib.parse import unquote, urlparse
from xml.etree import ElementTree

import numpy as np
import pytest
from rerun.urdf import UrdfJoint, UrdfTree

import planetary_twin_py as pt
from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import speed_ratios
from planetary_twin_py.robot import robot_description
from planetary_twin_py.scene.gearset import Gearset

TURN = 2.0 * math.pi
REFERENCE = {"carrier": "sun", "ring": "sun", "sun": "carrier"}


@pytest.fixture(autouse=True)
def cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """A cache folder of this test's own, with a name that a URI must escape."""
    folder = tmp_path / "a cache"
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder))
    return folder


@pytest.fixture
def gearset() -> Gearset:
    return pt.load_scene("paper").gearset


def _tree(gearset: Gearset, folder: Path) -> UrdfTree:
    file = folder / "gearbox.urdf"
    file.write_text(robot_description(gearset), encoding="utf-8")
    return UrdfTree.from_file_path(file)


def _matrix(joint: UrdfJoint, position: float) -> np.ndarray:
    """Parent from child in the plane, homogeneous."""
    transform = joint.compute_transform(position)
    x, y, _ = transform.translation.as_arrow_array()[0].as_py()
    a, b, c, d = transform.quaternion.as_arrow_array()[0].as_py()
    assert abs(a) + abs(b) < 1e-9, "turns about z alone"
    angle = 2.0 * math.atan2(c, d)
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([[cos, -sin, x], [sin, cos, y], [0.0, 0.0, 1.0]])


def _pose(tree: UrdfTree, link: str, positions: dict[str, float]) -> np.ndarray:
    """Base from `link`, with joints that mimic others as robot_state_publisher moves them."""
    pose = np.eye(3)
    while link != tree.root_link().name:
        joint = next(joint for joint in tree.joints() if joint.child_link == link)
        leader = joint.mimic
        value = (
            positions[leader.joint] * leader.multiplier + leader.offset
            if leader
            else positions[joint.name]
        )
        pose = _matrix(joint, value) @ pose
        link = joint.parent_link
    return pose


def _angles(gearset: Gearset, held: str, turned: float) -> dict[str, float]:
    """Absolute angles [rad] in [0, 2 pi) after the reference member has `turned`."""
    ratios = speed_ratios(gearset.tooth_numbers, held, REFERENCE[held])
    bodies = ["sun", *(f"planet_{i + 1}" for i in range(gearset.planets)), "ring", "carrier"]
    return {body: turned * float(ratios[body.split("_")[0]]) % TURN for body in bodies}


@pytest.mark.parametrize("held", ["carrier", "ring", "sun"])
@pytest.mark.parametrize("turned", [0.0, 0.4, -7.3, 100.0])
def test_links_stand_at_the_absolute_angles(
    gearset: Gearset, tmp_path: Path, held: str, turned: float
) -> None:
    tree = _tree(gearset, tmp_path)
    angles = _angles(gearset, held, turned)
    positions = {f"{body}_joint": angle for body, angle in angles.items()}
    for body, angle in angles.items():
        pose = _pose(tree, body, positions)
        assert np.allclose(pose[:2, 0], [math.cos(angle), math.sin(angle)], atol=2e-6)
        centre = np.zeros(2)
        if body.startswith("planet"):
            radius = 0.5 * gearset.module * (gearset.teeth.sun + gearset.teeth.planet)
            place = gearset.planet_angles[int(body[-1]) - 1] + angles["carrier"]
            centre = radius * np.array([math.cos(place), math.sin(place)])
        assert np.allclose(pose[:2, 2], centre, atol=1e-8)


@pytest.mark.parametrize("held", ["carrier", "ring", "sun"])
@pytest.mark.parametrize("turned", [0.0, 0.4, -7.3])
def test_the_teeth_one_sees_stand_in_the_gaps_of_their_mates(
    gearset: Gearset, tmp_path: Path, held: str, turned: float
) -> None:
    tree = _tree(gearset, tmp_path)
    angles = _angles(gearset, held, turned)
    positions = {f"{body}_joint": angle for body, angle in angles.items()}
    robot = ElementTree.fromstring(robot_description(gearset))

    def pitches(body: str, direction: float, teeth: int) -> float:
        """Teeth between tooth 0 of what is seen of `body` and `direction`."""
        pose = _pose(tree, body, positions)
        seen = robot.find(f"link[@name='{body}']/visual/origin")
        assert seen is not None
        tooth = math.atan2(pose[1, 0], pose[0, 0]) + float(seen.attrib["rpy"].split()[2])
        return teeth * (direction - tooth) / TURN

    sun, planet, ring = gearset.tooth_numbers
    for i, psi in enumerate(gearset.planet_angles):
        place, name = psi + angles["carrier"], f"planet_{i + 1}"
        outer = pitches("sun", place, sun) + pitches(name, place + math.pi, planet)
        inner = pitches("ring", place, ring) - pitches(name, place, planet)
        assert abs(outer % 1.0 - 0.5) < 1e-4
        assert abs(inner % 1.0 - 0.5) < 1e-4


def test_joints_are_those_of_the_joint_states_and_frames_that_follow(
    gearset: Gearset, tmp_path: Path
) -> None:
    tree = _tree(gearset, tmp_path)
    free = {joint.name for joint in tree.joints() if joint.mimic is None}
    assert free == {f"{body}_joint" for body in _angles(gearset, "carrier", 0.0)}
    assert {joint.joint_type for joint in tree.joints()} == {"continuous"}
    assert tree.root_link().name == "gearbox"


def test_meshes_are_sound_stl_files_of_the_size_of_the_gears(gearset: Gearset, cache: Path) -> None:
    robot = ElementTree.fromstring(robot_description(gearset))
    extents = {}
    for mesh in robot.iter("mesh"):
        file = Path(unquote(urlparse(mesh.attrib["filename"]).path))
        assert cache in file.parents
        corners = _read_stl(file)
        extents[file.stem] = np.hypot(corners[..., 0], corners[..., 1]).max()
        a, b, c = (corners[:, k].astype(float) for k in range(3))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0
        assert 0.0 < volume < math.pi * extents[file.stem] ** 2 * 1.3 * gearset.face_width
    assert set(extents) == {"sun", "planet", "ring", "carrier", "pin"}
    for name, teeth in (("sun", gearset.teeth.sun), ("planet", gearset.teeth.planet)):
        gear = SpurGear(teeth, gearset.module, gearset.pressure_angle, gearset.addendum)
        assert math.isclose(extents[name], gear.tip_radius, rel_tol=1e-4)


def _read_stl(file: Path) -> np.ndarray:
    """Corners (triangles, 3, 3) of a binary STL whose normals and windings agree."""
    content = file.read_bytes()
    count = int.from_bytes(content[80:84], "little")
    assert len(content) == 84 + 50 * count
    rows = np.frombuffer(content[84:], dtype=np.uint8).reshape(count, 50)[:, :48]
    numbers = rows.copy().view("<f4").reshape(count, 4, 3)
    assert np.isfinite(numbers).all()
    normal, corners = numbers[:, 0], numbers[:, 1:]
    winding = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ij,ij->i", normal, winding) > 0.0).all()
    return corners


def test_meshes_are_written_once_and_differ_with_the_gears(gearset: Gearset, cache: Path) -> None:
    first = robot_description(gearset)
    written = {file: file.stat().st_mtime_ns for file in cache.rglob("*.stl")}
    assert len(written) == 5
    assert robot_description(gearset) == first
    assert {file: file.stat().st_mtime_ns for file in cache.rglob("*.stl")} == written
    wider = gearset.model_copy(update={"face_width": 2.0 * gearset.face_width})
    assert robot_description(wider) != first
    assert len(list(cache.rglob("*.stl"))) == 10
    assert len([file for file in cache.rglob("*") if file.is_file()]) == 10


def test_a_cache_that_cannot_be_written_is_told(gearset: Gearset, cache: Path) -> None:
    cache.write_text("in the way")
    with pytest.raises(OSError, match="a cache"):
        robot_description(gearset)
