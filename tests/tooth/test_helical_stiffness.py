"""Mean stiffness of helical teeth of one normal module, against ISO 6336-1 from 0 to 35 deg."""

import math

import pytest

import planetary_twin_py as pt
from planetary_twin_py.explanation.meshes import describe_meshes
from planetary_twin_py.tooth.iso import IsoPair
from planetary_twin_py.tooth.material import Material

PAPER = pt.load_scene("paper")
TEETH, TWENTY, WIDTH = (30, 25, 80), math.radians(20.0), 0.05


def figures(degrees, teeth=TEETH, line_load=5e5, module=8e-3):
    """Figures of both kinds of mesh under a force per face width [N/m]."""
    cosine = math.cos(math.radians(degrees))
    transverse = math.atan(math.tan(TWENTY) / cosine)
    lever = 0.5 * module * teeth[0] / cosine * math.cos(transverse)
    step = 2.0 * math.pi / (teeth[0] + teeth[2])
    scene = PAPER.replace(**{
        "gearset.module": None,
        "gearset.pressure_angle": None,
        "gearset.normal_module": module,
        "gearset.normal_pressure_angle": TWENTY,
        "gearset.helix_angle": math.radians(degrees),
        "gearset.teeth": dict(zip(("sun", "planet", "ring"), teeth, strict=True)),
        "gearset.planet_angles": [step * round(n * math.pi / 1.5 / step) for n in range(3)],
        "gearset.face_width": WIDTH,
        "mesh.stiffness": "involute",
        "drive.torque_limit": 1e6,
        "input_torque": 3.0 * line_load * WIDTH * lever,
    })  # fmt: skip
    found = describe_meshes(scene)
    assert found.sun_planet.static_force == pytest.approx(line_load * WIDTH, rel=1e-9)
    return found.sun_planet, found.planet_ring


def iso(kind, degrees, ratio):
    """c_gamma of ISO 6336-1 per face width, of z/(cos^2(beta_b) cos(beta)) teeth."""
    helix = math.radians(degrees)
    base = math.asin(math.sin(helix) * math.cos(TWENTY))
    sun, planet = (z / (math.cos(base) ** 2 * math.cos(helix)) for z in TEETH[:2])
    teeth = ((planet, sun), (planet, math.inf))[kind]
    return IsoPair(teeth, TWENTY, helix_angle=helix).mesh(Material(206e9, 0.3), ratio)


@pytest.mark.parametrize("degrees", [0.0, 15.0, 25.0, 35.0])
def test_mean_stiffness_is_within_5_percent_of_iso_6336(degrees):
    for kind, mesh in enumerate(figures(degrees)):
        expected = iso(kind, degrees, mesh.contact_ratio) * PAPER.lubrication.youngs_modulus / 206e9
        assert mesh.mean_stiffness / WIDTH == pytest.approx(expected, rel=0.05)
        assert mesh.iso_stiffness / WIDTH == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("teeth", [(21, 39, 99), (18, 36, 90)])
@pytest.mark.parametrize("line_load", [1e5, 1e6])
def test_the_helix_changes_the_stiffness_as_in_iso_6336(teeth, line_load):
    """Over 35 deg within 9 %, also where the load and the body set it apart from ISO by more."""
    spur, helical = (figures(degrees, teeth, line_load) for degrees in (0.0, 35.0))
    for before, after in zip(spur, helical, strict=True):
        drift = after.mean_stiffness / after.iso_stiffness
        drift /= before.mean_stiffness / before.iso_stiffness
        assert drift == pytest.approx(1.0, abs=0.09)
