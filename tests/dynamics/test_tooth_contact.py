"""Friction of a tooth pair stays in its bounds anywhere in the declared ranges."""

import math

from hypothesis import given, settings
from hypothesis import strategies as st

from planetary_twin_py.dynamics.oil import build_oil
from planetary_twin_py.dynamics.tooth_contact import choices, lambda_ratio_of, tooth_contact
from planetary_twin_py.scene import load_scene

PAPER = load_scene("paper")
LAWS = st.fixed_dictionaries(
    {
        "lubrication.film": st.sampled_from(["dowson_higginson", "dowson_toyoda", "salagianni"]),
        "lubrication.lambda_ratio": st.sampled_from(["prescribed", "computed"]),
        "lubrication.asperities": st.sampled_from(["exact", "printed"]),
        "lubrication.boundary": st.sampled_from(["greenwood_tripp", "load_sharing"]),
        "lubrication.traction": st.sampled_from(["evans_johnson", "printed"]),
        "lubrication.rolling": st.sampled_from(["none", "goksem_hargreaves"]),
        "oil_temperature": st.floats(233.15, 433.15),
        "lambda_ratio": st.floats(0.0, 10.0),
        "lubrication.viscosity": st.floats(1e-3, 10.0),
        "lubrication.composite_roughness": st.floats(1e-12, 1e-4),
    }
)
PAIR = st.tuples(
    st.floats(1e-4, 1.0),
    st.floats(1.01, 100.0),  # of the second radius of curvature over the first
    st.sampled_from([1.0, -1.0]),
    st.floats(-1e5, 1e5),
    st.floats(-1e5, 1e5),
    st.floats(0.0, 1e7),
)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(laws=LAWS, pair=PAIR)
def test_finite_dissipative_and_never_negative_unless_printed_so(laws, pair):
    scene = PAPER.replace(**laws)
    oil = build_oil(scene, scene.operating_point)
    rho1, factor, external, *rest = pair
    signed, boundary, viscous, log_film, sliding, slope, rolling, taken = tooth_contact(
        oil, choices(oil), (rho1, factor * rho1, external, *rest)
    )
    ratio = lambda_ratio_of(oil, oil.prescribed, log_film)
    for value in (signed, boundary, viscous, log_film, ratio, sliding, slope, rolling, taken):
        assert math.isfinite(value)
    assert math.exp(log_film) > 0.0 and ratio >= 0.0
    u1, u2 = rho1 * rest[0], -external * factor * rho1 * rest[1]
    assert rolling * (u1 + u2) >= 0.0 and taken >= 0.0
    if scene.lubrication.traction == "evans_johnson":
        assert viscous >= 0.0
        if scene.lubrication.asperities == "exact" or scene.lubrication.boundary == "load_sharing":
            assert boundary >= 0.0
            assert signed * sliding >= 0.0 and slope >= 0.0
