"""`Scene.replace` by paths through lists and into optional sections."""

import math

import pytest

import planetary_twin_py as pt
from planetary_twin_py.scene.fields import NUMBER, scene_sections
from planetary_twin_py.studies.axes import look_up

PAPER = pt.load_scene("paper")
CRACKED = pt.load_scene("cracked_tooth")
RATED = {"rating": 1e4, "kind": "roller"}
MEMBERS = tuple(f"durability.bearings.{member}." for member in ("sun", "ring", "carrier"))
BEARING = {"losses.planet_bearing.mean_diameter": "10 mm"}

TABLE = {"time": [0.0, 1.0], "stiffness_loss": [0.1, 0.2]}
PARIS = {"law": "paris", "constant": 1e-11, "exponent": 3, "stress_range": 2e8, "until": 5e-4}
ARCHARD = {
    "law": "archard", "coefficient": 1e-18, "pressure": 1e9, "half_width": 2e-4, "slip": 0.5,
    "until": 1e-5,
}  # fmt: skip


def test_field_of_entry_of_list_is_replaced_and_others_are_kept():
    scene = CRACKED.replace(**{"faults.0.depth": "0.5 mm", "faults.0.tooth": "7"})
    (crack,) = scene.faults
    assert (crack.depth, crack.tooth, crack.gear) == (pytest.approx(5e-4), 7, "sun")
    assert crack.angle == CRACKED.faults[0].angle
    assert CRACKED.faults[0].tooth == 0


def test_a_value_in_a_list_is_replaced():
    angles = PAPER.gearset.planet_angles
    step = 2 * math.pi / 100
    scene = PAPER.replace(**{"gearset.planet_angles.1": angles[1] + step})
    assert scene.gearset.planet_angles == (angles[0], angles[1] + step, angles[2])


def test_an_optional_section_starts_with_its_defaults():
    bearing = PAPER.replace(**BEARING, **{"losses.planet_bearing.f0": 3}).losses.planet_bearing
    assert (bearing.mean_diameter, bearing.f0, bearing.f1) == (pytest.approx(0.01), 3.0, 5e-4)


def test_an_incomplete_section_is_refused_with_what_is_missing():
    with pytest.raises(pt.SceneError) as refusal:
        PAPER.replace(**{"losses.planet_bearing.f0": 2})
    assert str(refusal.value) == "losses.planet_bearing.mean_diameter: missing"
    with pytest.raises(pt.SceneError, match=r"supports\.planet: missing"):
        PAPER.replace(**{"supports.sun.mass": 1.0})


@pytest.mark.parametrize(
    ("scene", "name", "reason"),
    [
        (PAPER, "faults.0.depth", "faults has 0 entries; set faults as a whole"),
        (CRACKED, "faults.1.depth", "faults has 1 entry, counted from 0"),
        (PAPER, "gearset.planet_angles.3", "gearset.planet_angles has 3 entries, counted from 0"),
        (CRACKED, "faults.0.dept", "no such field; did you mean faults.0.depth?"),
        (PAPER, "gearset.module.0", "no such field"),
    ],
)
def test_an_invalid_path_is_refused_with_the_reason(scene, name, reason):
    with pytest.raises(pt.SceneError) as refusal:
        scene.replace(**{name: 1.0})
    assert str(refusal.value).startswith(f"{name}: {reason}")


def test_every_listed_field_has_a_valid_path():
    """For a scene with every optional part; the paths are those of the reference."""
    bearings = {
        f"losses.{body}_bearing": {"mean_diameter": 0.01}
        for body in ("planet", "sun", "ring", "carrier")
    }
    support = {"mass": 1.0, "bearing": 1e8}
    relief = {"amount": 1e-6, "length": 1e-3}
    worn = {"position": [-0.5, 0.5], "first": [0.0, 1e-6], "second": [1e-6, 0.0]}
    shaft = {"range": 1e3}
    whole = pt.load_scene("differential").replace(
        **bearings,
        **{"mesh.tip_relief": dict.fromkeys(("sun", "planet", "ring"), relief)},
        **{"mesh.worn": dict.fromkeys(("sun_planet", "planet_ring"), worn)},
        durability={
            "bearings": {"planet": RATED},
            "shafts": {"input": shaft, "output": shaft},
            "scuffing": {"fzg_stage": 12},
            "micropitting": {"permissible_film": 0.1},
            "wear": {"coefficient": 1e-18},
        },
        **{"losses.churning": {"fill": 0.5, "gap": 0.01, "sun": 0.02}},
        **{"lubrication.friction_table": {"coefficient": [0.05]}},
        supports=dict.fromkeys(("sun", "planet", "ring", "carrier"), support),
        thermal={
            "oil": {"mass": 1.0},
            "gears": {"to_oil": 300.0},
            "housing": {"mass": 4.0, "area": 0.1, "height": 0.2, "from_oil": 10.0},
            "cooler": {"capacity": 80.0, "opens": 333.0},
            "start": dict.fromkeys(("oil", "sun", "planets", "ring", "housing"), 300.0),
        },
        faults=[
            {"kind": "crack", "gear": "sun", "stiffness_loss": 0.1},
            {"kind": "spall", "gear": "sun", "stiffness_loss": 0.1},
            {"kind": "wear", "gear": "sun", "depth": 1e-6},
            {"kind": "pitch", "gear": "sun", "grade": 6},
            {"kind": "pin", "planet": 2, "radial": 1e-6},
            {"kind": "spall", "gear": "sun", "stiffness_loss": 0.1, "growth": TABLE},
            {"kind": "crack", "gear": "sun", "depth": 1e-4, "growth": PARIS},
            {"kind": "wear", "gear": "sun", "depth": 1e-6, "growth": ARCHARD},
        ],
        **{"mesh.stiffness": "involute"},
    )
    kinds = ("crack", "spall", "wear", "pitch", "pin", "table", "paris", "archard")
    place = {"": "0"} | {kind: str(n) for n, kind in enumerate(kinds)}
    names = [
        field.name.replace(f".{NUMBER}.", f".{place[section.kind]}.")
        for section in scene_sections()
        for field in section.fields
        if not section.name.startswith("sensors.") and section.kind != "bearing"
    ]
    assert len(names) > 120
    inertia = dict.fromkeys(("sun", "planet", "ring", "carrier"), 0.01)
    other = whole.replace(**{"gearset.equivalent_mass": None, "gearset.inertia": inertia})
    elements = {"mass": 1.0, "rolling": {"rollers": 14, "length": 0.012}}
    rolling = whole.replace(supports=dict.fromkeys(("sun", "planet", "ring", "carrier"), elements))
    bodies = ("sun", "planet", "ring", "carrier")
    rated = PAPER.replace(
        dynamics="planar",
        supports=dict.fromkeys(bodies, elements),
        durability={"bearings": dict.fromkeys(bodies, RATED)},
    )
    for name in names:
        scene = other if name.startswith("gearset.inertia.") else whole
        if ".rolling." in name:
            scene = rolling
        elif name.startswith(MEMBERS):
            scene = rated
        _, value = look_up(scene, name)
        assert scene.replace(**{name: value}) == scene


def path_of(law, **path):
    return {"name": "a", "kind": "accelerometer", "path": {"law": law, **path}}


POLES = path_of("filter", poles=[{"frequency": 3e3}])
FILTERED = path_of("filter", table=[{"frequency": f, "magnitude": 1.0} for f in (0.0, 2e4)])
SENSORS = {  # by section
    ("sensors.N.path", "window"): path_of("window"),
    ("sensors.N.path", "resolved"): path_of("resolved"),
    ("sensors.N.path", "filter"): POLES,
    ("sensors.N.path.poles.N", ""): POLES,
    ("sensors.N.path.table.N", ""): FILTERED,
    ("sensors.N.path", "rigid"): path_of("rigid", radius=0.1),
    ("sensors.N.path", "flexible"): path_of("flexible", radius=0.1, area=1e-4, second_moment=1e-9),
    ("sensors.N", "encoder"): {"name": "a", "kind": "encoder", "lines": 1024},
    ("sensors.N", "proximity"): {"name": "a", "kind": "proximity", "body": "sun"},
    **{
        ("sensors.N", kind): {"name": "a", "kind": kind}
        for kind in ("accelerometer", "tachometer", "torque", "thermometer")
    },
}


def test_every_field_of_sensors_has_a_valid_path():
    held = {"gearset.held": "ring", "drive.output.member": "carrier"}
    moving = pt.load_scene("floating_sun").replace(**held)
    sections = [s for s in scene_sections() if s.name.startswith("sensors.")]
    assert {(section.name, section.kind) for section in sections} == set(SENSORS)
    for section in sections:
        scene = moving.replace(sensors=[SENSORS[section.name, section.kind]])
        for field in section.fields:
            name = field.name.replace(".N.", ".0.")
            _, value = look_up(scene, name)
            assert scene.replace(**{name: value}) == scene
