"""The URDF, read by Rerun's own parser, stands as the absolute angles of the bodies say."""

import cmath
import math
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np
import pytest
from rerun.urdf import UrdfJoint, UrdfTree

import planetary_twin_py as pt
from planetary_twin_py.gearset.involute import SpurGear
from planetary_twin_py.gearset.kinematics import speed_ratios
from planetary_twin_py.robot import robot_description
from planetary_twin_py.scene.gearset import Gearset
from planetary_twin_py.scene.sensors import Accelerometer, Proximity, Tachometer
from planetary_twin_py.scene.sensors.paths import ResolvedWindow

TURN = 2.0 * math.pi
REFERENCE = {"carrier": "sun", "ring": "sun", "sun": "carrier"}


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
def test_visible_teeth_are_in_the_gaps_of_their_mates(
    gearset: Gearset, tmp_path: Path, held: str, turned: float
) -> None:
    tree = _tree(gearset, tmp_path)
    angles = _angles(gearset, held, turned)
    positions = {f"{body}_joint": angle for body, angle in angles.items()}
    robot = ElementTree.fromstring(robot_description(gearset))

    def pitches(body: str, direction: float, teeth: int) -> float:
        """Teeth between tooth 0 of what is seen of `body` and `direction`."""
        pose = _pose(tree, body, positions)
        boxes = [box.at for box in _boxes(robot, body) if box.material == "mark"]
        tooth = math.atan2(pose[1, 0], pose[0, 0]) + cmath.phase(sum(boxes))
        return teeth * (direction - tooth) / TURN

    sun, planet, ring = gearset.tooth_numbers
    for i, psi in enumerate(gearset.planet_angles):
        place, name = psi + angles["carrier"], f"planet_{i + 1}"
        outer = pitches("sun", place, sun) + pitches(name, place + math.pi, planet)
        inner = pitches("ring", place, ring) - pitches(name, place, planet)
        assert abs(outer % 1.0 - 0.5) < 1e-4
        assert abs(inner % 1.0 - 0.5) < 1e-4


def test_joints_are_those_of_the_joint_states(gearset: Gearset, tmp_path: Path) -> None:
    tree = _tree(gearset, tmp_path)
    free = {joint.name for joint in tree.joints() if joint.mimic is None}
    assert free == {f"{body}_joint" for body in _angles(gearset, "carrier", 0.0)}
    assert {joint.joint_type for joint in tree.joints()} == {"continuous"}
    assert tree.root_link().name == "gearbox"


@pytest.mark.parametrize(
    ("sensor", "axis"),
    [
        (Accelerometer(name="top", angle=0.5), 0.5),
        (
            Accelerometer(
                name="top", angle=2.0, direction="tangential", path=ResolvedWindow(law="resolved")
            ),
            2.0 + 0.25 * TURN,
        ),
        (Proximity(kind="proximity", name="top", body="sun", angle=-1.0), -1.0),
    ],
    ids=["radial", "tangential", "probe"],
)
def test_a_sensor_on_the_housing_has_a_fixed_link(
    gearset: Gearset, tmp_path: Path, sensor: Accelerometer | Proximity, axis: float
) -> None:
    file = tmp_path / "gearbox.urdf"
    elsewhere = Tachometer(kind="tachometer", name="key")
    text = robot_description(gearset, sensors=[sensor, elsewhere])
    file.write_text(text, encoding="utf-8")
    tree = UrdfTree.from_file_path(file)
    (joint,) = (joint for joint in tree.joints() if joint.joint_type == "fixed")
    assert (joint.parent_link, joint.child_link) == ("gearbox", "sensor_top")
    pose = _matrix(joint, 0.0)
    assert np.allclose(pose[:2, 0], [math.cos(axis), math.sin(axis)], atol=2e-6)
    place = np.array([math.cos(sensor.angle), math.sin(sensor.angle)])
    radius = float(pose[:2, 2] @ place)
    assert np.allclose(pose[:2, 2], radius * place, atol=1e-8)
    assert radius > gearset.geometry.ring.root_radius


class Box(NamedTuple):
    """What is seen of a link: at x + iy [m], turned about z [rad], of `size` x and y [m]."""

    material: str
    at: complex
    angle: float
    size: tuple[float, float]


def _boxes(robot: Element, link: str) -> list[Box]:
    found = []
    for visual in robot.iterfind(f"link[@name='{link}']/visual"):
        shape, origin, material = (
            visual.find(f"{path}") for path in ("geometry/box", "origin", "material")
        )
        if shape is None or origin is None or material is None:
            continue
        x, y, _ = map(float, origin.attrib["xyz"].split())
        *level, yaw = map(float, origin.attrib["rpy"].split())
        assert level == [0.0, 0.0]
        size_x, size_y, _ = map(float, shape.attrib["size"].split())
        found.append(Box(material.attrib["name"], complex(x, y), yaw, (size_x, size_y)))
    return found


def _covered(points: np.ndarray, boxes: list[Box]) -> np.ndarray:
    """Which of the points x + iy [m] lie in one of the boxes or more."""
    inside = np.zeros(points.shape, dtype=bool)
    for box in boxes:
        seen = (points - box.at) * cmath.exp(-1j * box.angle)
        inside |= (abs(seen.real) <= 0.5 * box.size[0]) & (abs(seen.imag) <= 0.5 * box.size[1])
    return inside


@pytest.mark.parametrize("scene", ["paper", "wind_turbine_stage"])
@pytest.mark.parametrize("part", ["sun", "planet_1", "ring"])
def test_boxes_fill_the_involute_teeth(scene: str, part: str) -> None:
    gearset = pt.load_scene(scene).gearset
    robot = ElementTree.fromstring(robot_description(gearset))
    teeth = getattr(gearset.teeth, part.split("_")[0])
    internal = part == "ring"
    gear = SpurGear(teeth, gearset.module, gearset.pressure_angle, gearset.addendum, internal)
    boxes = _boxes(robot, part)
    tooth_0 = cmath.phase(sum(box.at for box in boxes if box.material == "mark"))
    allowed = 0.16 * gear.module
    ends = sorted((gear.root_radius, gear.tip_radius))
    radius = np.linspace(ends[0] + allowed, ends[1] - allowed, 60)[:, None]
    for number in (0, 1, teeth // 2):
        middle = tooth_0 + 2.0 * math.pi * number / teeth
        half, within = gear.half_thickness(radius), allowed / radius
        for sign in (-1.0, 1.0):
            flank = middle + sign * half
            inwards = flank - sign * np.linspace(within, half, 20)[..., 0].T
            outwards = flank + sign * np.linspace(within, math.pi / teeth - half, 20)[..., 0].T
            assert _covered(radius * np.exp(1j * inwards), boxes).all()
            assert not _covered(radius * np.exp(1j * outwards), boxes).any()


def test_the_solids_of_every_body_are_seen(gearset: Gearset) -> None:
    robot = ElementTree.fromstring(robot_description(gearset))
    for body in _angles(gearset, "carrier", 0.0):
        assert robot.find(f"link[@name='{body}']/visual") is not None
    disc = robot.find("link[@name='sun']/visual/geometry/cylinder")
    sun = SpurGear(gearset.teeth.sun, gearset.module, gearset.pressure_angle, gearset.addendum)
    assert disc is not None and math.isclose(float(disc.attrib["radius"]), sun.root_radius)
