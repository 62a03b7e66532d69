"""Studies change the dynamics of scenes with all that only their own dynamics can have."""

from typing import get_args

import numpy as np
import pytest

from planetary_twin_py import Scene, load_scene
from planetary_twin_py.explanation.oil import oil_figures
from planetary_twin_py.explanation.terms import terms
from planetary_twin_py.run.heat_curve import heat_over
from planetary_twin_py.scene.other_dynamics import under
from planetary_twin_py.studies.lost_motion import lost_motion
from planetary_twin_py.studies.stribeck import stribeck_scene

NAMES = get_args(Scene.model_fields["dynamics"].annotation)
DYNAMICS = [name for name in NAMES if name != "auto" and "spatial" not in name]
ROLLERS = {"mass": 0.177, "bearing": None, "rolling": {"rollers": 14, "length": 0.012}}
HELD = {"gearset.held": "ring", "drive.output.member": "carrier", "supports.planet": ROLLERS}


@pytest.fixture(scope="module")
def full():
    """Axes that move, with sensors, faults and ratings that held axes cannot have."""
    rating = {"rating": 5e4, "kind": "roller"}
    growth = {"time": [0.0, 1.0], "stiffness_loss": [0.0, 0.1]}
    pit = {"kind": "bearing", "planet": 2, "element": "outer", "ratio": 0.2, "depth": 1e-6}
    return load_scene("floating_sun").replace(
        **HELD,
        sensors=[
            {"name": "ring", "kind": "accelerometer", "rate": 6400.0, "path": {"law": "rigid"}},
            {"name": "probe", "kind": "proximity", "body": "sun", "rate": 3200.0},
        ],
        faults=[
            pit,
            {"kind": "crack", "gear": "ring", "stiffness_loss": 0.0, "growth": growth},
            {"kind": "pin", "planet": 1, "radial": 1e-6},
        ],
        durability={"bearings": {"planet": rating, "carrier": rating}},
    )


@pytest.mark.parametrize("dynamics", DYNAMICS)
def test_what_other_dynamics_lack_is_left_out(full, dynamics):
    there = full.replace(**under(full, dynamics))
    kinds = [fault.kind for fault in there.faults]
    assert kinds == (["bearing"] if dynamics == "planar" else []) + ["crack", "pin"]
    assert (there.faults[-2].growing is None) == dynamics.startswith("quasi_static")
    assert (there.durability.bearings.carrier is None) != dynamics.endswith("planar")
    assert there.durability.bearings.planet == full.durability.bearings.planet


def test_studies_of_other_dynamics_take_such_a_scene(full):
    assert oil_figures(full).iso_vg == oil_figures(full.replace(sensors=[])).iso_vg
    assert stribeck_scene(full).dynamics == "quasi_static_planar"
    assert (heat_over(full, np.array([320.0])) > 0.0).any()
    assert lost_motion(full, 20.0, levels=3).lost_motion > 0.0
    without = [full.replace(**term.without) for term in terms(full.replace(sensors=()))]
    assert [scene.dynamics for scene in without].count("torsional") == 1
