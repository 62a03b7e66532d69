"""Lin and Parker 1999 on their own data, and the structure of modes they proved."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planetary_twin_py.modal.modes import modes_of
from planetary_twin_py.modal.planar import planar_model
from planetary_twin_py.modal.supported_set import Body, SupportedSet


def lin_parker(angles, **changes):
    angle = math.radians(24.6)
    data = {
        "sun": Body(0.4, 0.39, 1e8),
        "ring": Body(2.35, 3.0, 1e8, 1e9),
        "carrier": Body(5.43, 6.29, 1e8),
        "planet": Body(0.66, 0.61, 1e8),
        "planet_angles": tuple(angles),
        "sun_planet": 5e8,
        "planet_ring": 5e8,
        "sun_angle": angle,
        "ring_angle": angle,
    }
    return SupportedSet(**(data | changes))


def equal(planets):
    return [2 * math.pi * k / planets for k in range(planets)]


def of_kind(modes, kind):
    return modes.frequencies[[k == kind for k in modes.kinds]]


# Frequencies [Hz]: rotational (with the rigid one), translational (each twice).
PUBLISHED = {
    3: (
        [0.0, 1475.75, 1930.35, 2658.32, 7462.80, 11775.27],
        [743.16, 1102.42, 1896.02, 2276.38, 6986.30, 9647.91],
    ),
    4: (
        [0.0, 1536.54, 1970.59, 2625.65, 7773.55, 13071.11],
        [727.27, 1091.16, 1892.82, 2342.50, 7189.95, 10437.56],
    ),
}
PLANET_MODES = [1808.18, 5963.76, 6981.71]


@pytest.mark.parametrize("planets", PUBLISHED)
def test_frequencies_of_the_published_set(planets):
    modes = modes_of(planar_model(lin_parker(equal(planets))))
    rotational, translational = PUBLISHED[planets]
    assert np.append(of_kind(modes, "rigid"), of_kind(modes, "rotational")) == pytest.approx(
        rotational, abs=0.05
    )
    assert of_kind(modes, "translational") == pytest.approx(np.repeat(translational, 2), abs=0.05)


@pytest.mark.parametrize("planets", [3, 4, 5, 6, 7])
def test_modes_are_six_rotational_six_double_three_of_planets(planets):
    modes = modes_of(planar_model(lin_parker(equal(planets))))
    assert len(of_kind(modes, "rigid")) + len(of_kind(modes, "rotational")) == 6
    pairs = of_kind(modes, "translational").reshape(-1, 2)
    assert len(pairs) == 6
    assert pairs[:, 0] == pytest.approx(pairs[:, 1])
    expected = np.repeat(PLANET_MODES, planets - 3)
    assert of_kind(modes, "planet") == pytest.approx(expected, abs=0.05)


def random_set(draw):
    positive = st.floats(0.1, 10.0)
    stiff = st.floats(1e6, 1e10)
    body = st.builds(Body, positive, positive, stiff, st.sampled_from([0.0, 1e8]))
    angles = draw(st.lists(st.floats(0.0, 6.28), min_size=2, max_size=7))
    return SupportedSet(
        *(draw(body) for _ in range(4)),
        tuple(angles),
        draw(stiff),
        draw(stiff),
        draw(st.floats(0.2, 0.5)),
        draw(st.floats(0.2, 0.5)),
    )


@settings(max_examples=60, deadline=None, derandomize=True)
@given(data=st.data())
def test_stiffness_is_symmetric_and_never_negative(data):
    gearset = random_set(data.draw)
    model = planar_model(gearset)
    k = model.stiffness
    assert np.abs(k - k.T).max() < 1e-12 * np.abs(k).max()
    assert np.linalg.eigvalsh(k).min() > -1e-9 * np.abs(k).max()
    backwards = SupportedSet(**{**vars(gearset), "planet_angles": gearset.planet_angles[::-1]})
    first, second = (modes_of(m).frequencies for m in (model, planar_model(backwards)))
    assert first == pytest.approx(second, rel=1e-6, abs=1e-3 * first[-1])


def test_free_set_has_the_rigid_motions_of_the_plane():
    """18 motions, 6 meshes and 6 springs of the pins: 6 motions stretch none of them."""
    free = {
        name: Body(body.mass, body.rim_mass, 0.0)
        for name, body in vars(lin_parker(equal(3))).items()
        if name in ("sun", "ring", "carrier")
    }
    modes = modes_of(planar_model(lin_parker(equal(3), **free)))
    assert modes.kinds.count("rigid") == 6
