"""Gear sets with profile shift, with their published figures."""

import math

from planetary_twin_py.gearset.gear_set import GearSet, Sizes, build_gear_set
from planetary_twin_py.gearset.kinematics import Teeth
from planetary_twin_py.gearset.shift import PerGear

TWENTY = math.radians(20.0)

# Nejad, Guo, Gao and Moan 2016, Wind Energy (5 MW reference gearbox), both planetary stages.
STAGE_1 = Sizes(Teeth(19, 17, 56), 45e-3, TWENTY, 1.0, PerGear(0.617, 0.802, -0.501), 0.863)
STAGE_2 = Sizes(Teeth(18, 36, 93), 21e-3, TWENTY, 1.0, PerGear(0.389, 0.504, 0.117), 0.584)
# A test run of a design program (L. Kos, University of Ljubljana, Analysis of Planetary
# Transmissions, listing on the web page of the program).
LJUBLJANA = Sizes(Teeth(21, 43, 108), 1.75e-3, TWENTY, 1.0, PerGear(0.438, 0.0426, 0.0), 56.8e-3)
# Tooth numbers of public rigs; their shifts are not published, these are chosen.
RIG_31 = Sizes(Teeth(31, 31, 95), 1e-3, TWENTY, 1.0, PerGear(0.26, 0.25, -0.2), 31.5e-3)
RIG_21 = Sizes(Teeth(21, 31, 84), 1e-3, TWENTY, 1.0, PerGear(0.25, 0.25, -0.25))
OH_58 = Sizes(Teeth(27, 35, 99), 2.868e-3, math.radians(24.6), 1.0, PerGear(0.25, 0.25, 0.24))

SETS = {
    "5 MW, first stage": STAGE_1,
    "5 MW, second stage": STAGE_2,
    "Ljubljana": LJUBLJANA,
    "31/31/95": RIG_31,
    "21/31/84": RIG_21,
    "27/35/99": OH_58,
    "paper": Sizes(Teeth(30, 20, 70), 0.8e-3, math.radians(21.34)),
}


def gear_set(name: str) -> GearSet:
    """The gears of one of `SETS`."""
    return build_gear_set(SETS[name])
