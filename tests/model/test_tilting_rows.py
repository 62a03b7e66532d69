"""Rows of meshes beyond the plane, against rigid motions and slices of the face."""

import math

import numpy as np
import pytest

from planetary_twin_py.modal.spatial import spatial_model
from planetary_twin_py.modal.supported_set import Body, SupportedSet
from planetary_twin_py.model.planar_rows import COAST, DRIVE, planar_rows
from planetary_twin_py.model.tilting_rows import MeshOfKind, leaning_row

ANGLE, HELIX, WIDTH, STIFFNESS = 0.37, 0.21, 0.03, 2e8
SUN, PLANET, ARM = 0.05, 0.04, 0.09
RING = ARM + PLANET
AXIS = np.array([0.0, 0.0, 1.0])
PSI = 0.7
SIDES = pytest.mark.parametrize("side", [DRIVE, COAST])
MESHES = pytest.mark.parametrize("internal", [False, True])


def mesh(internal):
    return MeshOfKind(internal, ANGLE, HELIX, RING if internal else SUN, PLANET)


def normal(internal, side):
    """Vector along which the row counts, r = n_t + hand tan(beta_b) e_z, from an angle alone."""
    lean = -1.0 if internal else 1.0
    outwards = np.array([math.cos(PSI), math.sin(PSI), 0.0])
    across = np.array([-math.sin(PSI), math.cos(PSI), 0.0])
    flat = math.cos(ANGLE) * across + side * lean * math.sin(ANGLE) * outwards
    return flat + lean * math.tan(HELIX) * np.array([0.0, 0.0, 1.0])


def moved(internal, side, shift, turn, centre, place):
    """Way of the point at `place` along the row, of a body at `centre` that moves rigidly."""
    return normal(internal, side) @ (shift + np.cross(turn, place - centre))


def by_row(internal, side, k, shift, turn):
    """What `leaning_row` says of the axial displacement and the tilts of gear k."""
    row = leaning_row(mesh(internal), side, PSI)
    if k == 1:  # about the radial and the tangential direction
        cosine, sine = math.cos(PSI), math.sin(PSI)
        turn = np.array([cosine * turn[0] + sine * turn[1], cosine * turn[1] - sine * turn[0]])
    return row.axial[k] * shift[2] + row.tilt[k] @ turn[:2]


@SIDES
@MESHES
def test_rows_are_those_of_pitch_point_in_the_middle_of_the_face(internal, side):
    rng = np.random.default_rng(1)
    outwards = np.array([math.cos(PSI), math.sin(PSI), 0.0])
    point = (RING if internal else SUN) * outwards
    for k, centre in enumerate((np.zeros(3), ARM * outwards)):
        shift = np.array([0.0, 0.0, rng.normal()])
        turn = np.array([*rng.normal(size=2), 0.0])
        expected = moved(internal, side, shift, turn, centre, point)
        sense = 1.0 if k == 0 else -1.0
        assert by_row(internal, side, k, shift, turn) == pytest.approx(sense * expected, rel=1e-12)


@SIDES
@MESHES
def test_rigid_motion_of_both_gears_gives_no_approach(internal, side):
    """Any displacement and any turn of sun or ring and planet together, all six coordinates."""
    rng = np.random.default_rng(2)
    rows = planar_rows([PSI], ANGLE, ANGLE)
    name, radius = ("ring", RING) if internal else ("sun", SUN)
    shift, turn = rng.normal(size=3), rng.normal(size=3)
    cosine, sine = math.cos(PSI), math.sin(PSI)
    outwards = np.array([cosine, sine, 0.0])
    centre = shift + np.cross(turn, ARM * outwards)
    q = np.zeros(len(rows.coordinates))
    for motion, value in (
        (f"{name}.x", shift[0]),
        (f"{name}.y", shift[1]),
        (f"{name}.u", radius * math.cos(ANGLE) * turn[2]),
        ("planet_1.xi", cosine * centre[0] + sine * centre[1]),
        ("planet_1.eta", cosine * centre[1] - sine * centre[0]),
        ("planet_1.u", PLANET * math.cos(ANGLE) * turn[2] * 1.0),
    ):
        q[rows.place(motion)] = value
    place = 1 if internal else 0
    in_plane = (rows.tangential + side * rows.radial)[place] @ q
    beyond = by_row(internal, side, 0, shift, turn) + by_row(internal, side, 1, centre, turn)
    assert in_plane + beyond == pytest.approx(0.0, abs=1e-14)
    row = leaning_row(mesh(internal), side, PSI)
    leaning = np.array([cosine * turn[0] + sine * turn[1], cosine * turn[1] - sine * turn[0]])
    assert row.slope[0] @ turn[:2] + row.slope[1] @ leaning == pytest.approx(0.0, abs=1e-14)


@SIDES
@MESHES
def test_energy_of_the_slope_is_that_of_slices_along_the_face(internal, side):
    """Slices of stiffness k/L at the pitch line: k d^2/2 + k L^2 s^2/24."""
    rng = np.random.default_rng(3)
    turn, count = np.array([*rng.normal(size=2), 0.0]), 4001
    outwards = np.array([math.cos(PSI), math.sin(PSI), 0.0])
    point = (RING if internal else SUN) * outwards
    z = WIDTH * ((np.arange(count) + 0.5) / count - 0.5)
    ways = np.array(
        [moved(internal, side, np.zeros(3), turn, np.zeros(3), point + a * AXIS) for a in z]
    )
    energy = 0.5 * STIFFNESS * np.mean(ways**2)
    row = leaning_row(mesh(internal), side, PSI)
    d, slope = row.tilt[0] @ turn[:2], row.slope[0] @ turn[:2]
    found = STIFFNESS * (0.5 * d**2 + WIDTH**2 * slope**2 / 24.0)
    assert found == pytest.approx(energy, rel=1e-6)


def test_rows_are_those_of_the_spatial_modes():
    """The same normals as `modal.spatial`, which counts along n and not along n/cos(beta_b)."""
    cosine = math.cos(ANGLE)
    bodies = {
        name: Body(1.0, 1.0, 0.0, radius=radius)
        for name, radius in (
            ("sun", SUN * cosine), ("ring", RING * cosine), ("planet", PLANET * cosine),
            ("carrier", ARM),
        )
    }  # fmt: skip
    model = spatial_model(
        SupportedSet(**bodies, planet_angles=(PSI,), sun_planet=STIFFNESS, planet_ring=STIFFNESS,
                     sun_angle=ANGLE, ring_angle=ANGLE, base_helix=HELIX, face_width=WIDTH)
    )  # fmt: skip
    kinds = {"sun": "sun_planet", "ring": "planet_ring"}
    for name, kind in kinds.items():
        row = leaning_row(mesh(name == "ring"), DRIVE, PSI)
        (spring,) = (one for one in model.springs if one.kind == kind)
        (tilting,) = (one for one in model.springs if one.kind == f"{kind}_tilting")
        assert tilting.stiffness == pytest.approx(STIFFNESS * WIDTH**2 / 12.0)
        for k, (body, scale) in enumerate(((name, 1.0), ("planet_1", 1.0))):
            at = {m: model.coordinates.index(f"{body}.{m}") for m in ("z", "wx", "wy")}
            r = bodies[body.split("_")[0]].radius
            along = spring.row / math.cos(HELIX) * scale
            turned = row.tilt[k] if k == 0 else _in_frame(row.tilt[k])
            slope = row.slope[k] if k == 0 else _in_frame(row.slope[k])
            assert along[at["z"]] == pytest.approx(row.axial[k], rel=1e-12)
            assert along[[at["wx"], at["wy"]]] * r == pytest.approx(turned, rel=1e-9)
            assert tilting.row[[at["wx"], at["wy"]]] * r == pytest.approx(slope, rel=1e-9)


def _in_frame(parts):
    """Parts about x and y from those about the radial and the tangential direction."""
    cosine, sine = math.cos(PSI), math.sin(PSI)
    return [cosine * parts[0] - sine * parts[1], sine * parts[0] + cosine * parts[1]]
