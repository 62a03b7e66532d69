"""The model in space: it holds the planar one, knows rigid motion, and is one spring per mesh."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planetary_twin_paper.printed_spatial import (
    PinStiffness,
    carrier_block,
    coupling_block,
    mesh_block,
    planet_block,
)

from planetary_twin_py.modal.modes import modes_of
from planetary_twin_py.modal.planar import planar_model
from planetary_twin_py.modal.spatial import spatial_model
from planetary_twin_py.modal.supported_set import Body, SupportedSet

ANGLE = math.radians(24.6)
RADII = {"sun": 0.024, "planet": 0.016, "ring": 0.056}
CENTRES = (RADII["sun"] + RADII["planet"]) / math.cos(ANGLE)


def spatial(helix=0.0, planets=3, free=False, **changes):
    held = 0.0 if free else 1e8
    data = {
        "sun": Body(0.4, 0.39, held, 0.0, None, RADII["sun"], 0.2, 0.7 * held, 0.4 * held),
        "ring": Body(2.35, 3.0, held, 10 * held, None, RADII["ring"], 1.5, 0.7 * held, 0.4 * held),
        "carrier": Body(5.43, 6.29, held, 0.0, None, CENTRES, 3.1, 0.7 * held, 0.4 * held),
        "planet": Body(0.66, 0.61, 1e8, 0.0, None, RADII["planet"], 0.3, 0.9e8, 0.5e8),
        "planet_angles": tuple(2 * math.pi * k / planets for k in range(planets)),
        "sun_planet": 5e8,
        "planet_ring": 5e8,
        "sun_angle": ANGLE,
        "ring_angle": ANGLE,
        "base_helix": helix,
    }
    return SupportedSet(**(data | changes))


@pytest.mark.parametrize("planets", [3, 4, 5])
def test_spur_set_holds_all_modes_of_the_planar_model(planets):
    data = spatial(planets=planets)
    all_of_it = modes_of(spatial_model(data)).frequencies
    for frequency in modes_of(planar_model(data)).frequencies[1:]:
        assert np.abs(all_of_it / frequency - 1.0).min() < 1e-9


@pytest.mark.parametrize("helix", [0.0, 0.25, -0.4])
def test_moving_and_turning_the_unsupported_whole_stores_nothing(helix):
    model = spatial_model(spatial(helix, free=True))
    k = model.stiffness
    angles = spatial().planet_angles
    arms = {f"planet_{i + 1}": (math.cos(p), math.sin(p), 0.0) for i, p in enumerate(angles)}
    radius = RADII | {"carrier": CENTRES}
    for motion in np.eye(6):
        translation, rotation, q = motion[:3], motion[3:], []
        for name in dict.fromkeys(c.split(".")[0] for c in model.coordinates):
            centre = CENTRES * np.array(arms.get(name, (0.0, 0.0, 0.0)))
            turning = rotation * radius.get(name, RADII["planet"])
            q += [*(translation + np.cross(rotation, centre)), *turning]
        q = np.array(q)
        assert q @ k @ q == pytest.approx(0.0, abs=1e-9 * np.abs(k).max() * (q @ q))


@pytest.mark.parametrize("helix", [0.25, -0.4])
def test_a_planet_that_screws_along_its_helix_is_free(helix):
    model = spatial_model(spatial(helix))
    q = np.zeros(len(model.coordinates))
    q[model.coordinates.index("planet_1.z")] = 1.0
    q[model.coordinates.index("planet_1.u")] = math.tan(helix)
    stretch = [s.row @ q for s in model.springs if s.kind in ("sun_planet", "planet_ring")]
    assert stretch == pytest.approx(np.zeros(6), abs=1e-12)


def test_helical_modes_have_three_kinds():
    modes = modes_of(spatial_model(spatial(0.3, planets=5)))
    assert len(modes.frequencies) == 48
    assert "mixed" not in modes.kinds
    # Families: 2 motions of 3 members and 6 common to the planets; 4 of 3 and 6 twice; 6 (N - 3).
    # Planets that all tilt about their own radius move nothing else: a planet mode of the first.
    assert modes.kinds.count("rotational") + modes.kinds.count("rigid") == 12 - 1
    assert modes.kinds.count("translational") == 24
    assert modes.kinds.count("planet") == 12 + 1


@settings(max_examples=30, deadline=None, derandomize=True)
@given(
    helix=st.floats(-0.6, 0.6),
    angles=st.lists(st.floats(0.0, 6.28), min_size=2, max_size=7),
    ring=st.floats(1e6, 1e10),
)
def test_energy_is_never_negative_however_planets_are_named(helix, angles, ring):
    data = spatial(helix, planet_angles=tuple(angles), planet_ring=ring)
    other = spatial(helix, planet_angles=tuple(angles[::-1]), planet_ring=ring)
    k = spatial_model(data).stiffness
    assert np.linalg.eigvalsh(k).min() > -1e-9 * np.abs(k).max()
    first, second = (modes_of(spatial_model(d)).frequencies for d in (data, other))
    assert first == pytest.approx(second, rel=1e-6, abs=1e-4 * first[-1])


# The printed blocks.

PIN = PinStiffness(2.0, 3.0, 5.0, 0.7, 0.9)


def test_the_printed_mesh_block_is_no_spring_if_helical():
    assert np.linalg.matrix_rank(mesh_block(1.0, 0.7, 0.0)) == 1
    block = mesh_block(1.0, 0.7, 0.3)
    assert np.allclose(block, block.T)
    assert np.linalg.matrix_rank(block, tol=1e-9) > 1
    assert np.linalg.eigvalsh(block).min() < -1e-3


def test_printed_pin_resists_moving_carrier_and_planet_together():
    psi, gamma = 0.6, 2.0
    cross = coupling_block(PIN, psi, gamma)
    whole = np.block([[carrier_block(PIN, psi), cross], [cross.T, planet_block(PIN, gamma)]])
    along_y = np.zeros(12)
    along_y[[1, 7]] = 1.0
    assert np.abs(whole @ along_y).max() == pytest.approx((PIN.z - PIN.x) * math.sin(psi))
    assert np.linalg.eigvalsh(whole).min() < -1e-3
