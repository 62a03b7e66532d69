"""The Stribeck curve: friction of one tooth contact from no film to a thick one."""

import math

import numpy as np
import pytest
from lubrication.pitch_point import LOAD, oil_of, pitch_point
from planetary_twin_core_parts import film_share, lambda_ratio_of

from planetary_twin_py._core import tooth_contact
from planetary_twin_py.scene import load_scene

SLIDING = 0.2  # slide-to-roll ratio
THINNEST = 1e-12  # lambda ratio, in place of 0: its logarithm is finite
FULL_FILM = (1 / 0.82) ** (1 / 0.28)  # lambda ratio from which the film carries all
MIXED = load_scene("paper").replace(
    **{
        "lubrication.boundary": "load_sharing",
        "lubrication.lambda_ratio": "computed",
        "lubrication.film": "dowson_toyoda",
        "lubrication.rolling": "goksem_hargreaves",
    }
)


def coefficients(scene, speeds, load=LOAD):
    """Friction coefficient, rolling resistance included, and lambda ratio at mean speeds [m/s]."""
    oil, radius = oil_of(scene), pitch_point("sp", 1000).radius
    rho = 2.0 * radius
    found = []
    for speed in speeds:
        w1, w2 = speed * (1 + SLIDING / 2) / rho, -speed * (1 - SLIDING / 2) / rho
        signed, _, _, log_film, sliding, _, _, rolling_power = tooth_contact(
            oil, (rho, rho, 1.0, w1, w2, load)
        )
        ratio = lambda_ratio_of(oil, log_film)
        found.append(((signed * sliding + rolling_power) / (load * sliding), ratio))
    return np.array(found).T


def test_boundary_mixed_and_full_film_follow_one_another():
    speeds = np.logspace(-3, 4, 141)
    mu, ratio = coefficients(MIXED, speeds)
    assert np.all(np.diff(ratio) > 0.0)
    assert mu[0] == pytest.approx(0.1, abs=0.015)  # boundary lubrication
    lowest = int(np.argmin(mu))
    assert ratio[lowest] > FULL_FILM
    assert mu[lowest] < 0.5 * mu[0]
    assert np.all(np.diff(mu[: lowest + 1]) < 0.0)
    assert np.all(np.diff(mu[lowest:]) > 0.0)  # the film's own resistance
    assert mu[-1] > 2.0 * mu[lowest]


def test_printed_model_has_no_boundary_regime():
    """Asperities carry 3 % of the load at lambda = 0: friction stays below that of the film."""
    printed = load_scene("paper").replace(**{"lubrication.lambda_ratio": "computed"})
    mu, ratio = coefficients(printed, np.logspace(-3, 0, 31))
    assert ratio[0] < 0.1
    assert mu.max() < 0.06


SHARES = [(0.0, 0.0), (1.0, 0.82), (2.0, 0.82 * 2**0.28), (2.1, 1.0)]


@pytest.mark.parametrize("ratio, share", SHARES)
def test_share_of_the_film(ratio, share):
    assert film_share(math.log(max(ratio, THINNEST))) == pytest.approx(share, abs=1e-3)


def test_film_thinner_than_a_molecule_carries_less_in_proportion():
    whole = film_share(math.log(0.1))
    assert film_share(math.log(0.1), 1.0) == whole  # thicker
    for part in (0.5, 1e-3, 1e-9):
        assert film_share(math.log(0.1), math.log(part)) == pytest.approx(part * whole)


# Scenes that do not name their laws get these: a shear-thinning film and load sharing.
DEFAULT = load_scene("wind_turbine_stage")


@pytest.mark.parametrize("roughness", [5e-8, 2e-7, 8e-7])
@pytest.mark.parametrize("share", [1e-3, 1e-2, 0.1, 1.0])
def test_default_laws_rise_to_left_of_the_full_film_down_to_none(share, roughness):
    """Boundary and viscous friction; beyond, a cool film rises, and a warm one falls again."""
    scene = load_scene("paper").replace(
        **{
            "lubrication.boundary": DEFAULT.lubrication.boundary,
            "lubrication.traction": DEFAULT.lubrication.traction,
            "lubrication.lambda_ratio": DEFAULT.lubrication.lambda_ratio,
            "lubrication.composite_roughness": roughness,
        }
    )
    oil, rho, load = oil_of(scene), 2.0 * pitch_point("sp", 1000).radius, share * LOAD
    speeds = np.logspace(-9, 1.5, 211)
    turns = np.outer(speeds / rho, [1 + SLIDING / 2, -1 + SLIDING / 2])
    pairs = [tooth_contact(oil, (rho, rho, 1.0, *w, load)) for w in turns]
    mu = np.array([boundary + viscous for _, boundary, viscous, *_ in pairs]) / load
    film = np.exp([log_film for _, _, _, log_film, *_ in pairs])
    mixed = film < FULL_FILM * roughness
    assert mixed[0] and not mixed[-1]
    assert np.all(np.diff(mu[mixed]) < 0.0)
    assert mu[0] > 0.105  # of 0.11 without a film
    assert mu[mixed][-1] < 0.06
