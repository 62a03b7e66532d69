"""The cases whose speed and error are reported."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from planetary_twin_py.scene import Scene, load_scene
from planetary_twin_py.units.conversion import rpm

from .timing import repeats


class Case(NamedTuple):
    """A scene, and the interval that is compared with the reference."""

    name: str
    changes: dict[str, Any]
    duration: float  # [s] compared
    repeats: int  # largest ratio of the timed to the compared interval
    # Changes that start the run at the compared interval; such a case is timed as a whole.
    stretch: dict[str, Any] | None = None
    base: str = "paper"  # packaged scene

    def scene(self) -> Scene:
        """The packaged scene with the changes of the case."""
        return load_scene(self.base).replace(**self.changes)

    def compared(self) -> Scene:
        """The scene that is compared with the reference."""
        return self.scene().replace(**(self.stretch or {}))

    def timed(self, seconds: float) -> float:
        """Duration of the timed run [s] if the compared interval takes `seconds` to compute."""
        whole = self.stretch is not None
        return self.duration * (self.repeats if whole else repeats(seconds, self.repeats))


FRICTIONLESS = {"lubrication.friction": False}
RECTANGULAR = {"mesh.ramp": 0.0}
RUN_UP = {
    "input_speed": rpm(1000),
    "drive.speed_control.start_speed": rpm(5),
    "drive.speed_control.slew_rate": rpm(1000 - 5) / 0.5,
}
FROM_500_RPM = {"drive.speed_control.start_speed": rpm(500)}
# On average flanks separate and meet 27 times in a mesh period, when the torque is lowest. The
# motion is chaotic: after two dozen impacts any two methods have diverged.
DOUBLE_SIDED_RATTLE = {
    "input_torque": 0.3,
    "torque_ripple": 0.3,
    "backlash": 5e-7,
    "mesh.damping.law": "viscous",
    "mesh.damping.damping_ratio": 0.01,
}
ZETA_004 = {"mesh.damping.law": "viscous", "mesh.damping.damping_ratio": 0.04}
# Gears of half the mass, with a natural mode at the meshing frequency of this speed.
RESONANCE = {
    **ZETA_004,
    "gearset.equivalent_mass.sun": 0.136,
    "gearset.equivalent_mass.planet": 0.05,
    "gearset.equivalent_mass.ring": 0.3895,
    "gearset.planet_mass": 0.05,
    "drive.speed_limit": rpm(18_000),
    "input_speed": rpm(17_000),
}

CASES = (
    Case("steady 1000 rpm", {}, 0.01, 40),
    Case("steady, no friction", FRICTIONLESS, 0.01, 40),
    Case("steady 1000 rpm, rectangular stiffness", RECTANGULAR, 0.01, 40),
    Case("steady, rectangular, no friction", RECTANGULAR | FRICTIONLESS, 0.01, 40),
    Case("steady 3000 rpm", {"input_speed": rpm(3000)}, 0.01, 20),
    Case("stiff 100 rpm", {"input_speed": rpm(100)}, 0.02, 50),
    Case("rattle", {"input_torque": 0.3, "torque_ripple": 3.0}, 0.03, 20),
    Case("rattle, 27 events per mesh period", DOUBLE_SIDED_RATTLE, 0.0215, 20),
    # At lower speeds the printed damping is so high that an explicit reference takes minutes.
    Case("run-up 5 to 1000 rpm in 0.5 s", RUN_UP, 0.02, 25, FROM_500_RPM),
    Case("light damping 1000 rpm", {"mesh.damping.law": "viscous"}, 0.01, 20),
    Case("light damping zeta 0.04", ZETA_004, 0.01, 20),
    Case("resonance 17 000 rpm", RESONANCE, 0.001, 100),
)

# Masses of Chaari et al. 2006, bearings half as stiff as a tooth pair.
MASSES = {"sun": 0.46, "planet": 0.177, "ring": 0.588, "carrier": 3.0}
SUPPORTS = {body: {"mass": mass, "bearing": 1e8} for body, mass in MASSES.items()}
PLANAR = {
    "dynamics": "planar",
    "gearset.planet_mass": MASSES["planet"],
    "supports": SUPPORTS,
    "backlash": 1e-4,
}
FLOATING = {"supports": SUPPORTS | {"sun": {"mass": MASSES["sun"], "bearing": 0.0}}}
IN_PHASE = {
    "gearset.teeth": {"sun": 36, "planet": 18, "ring": 72},
    "gearset.planet_angles": tuple(math.radians(90.0 * k) for k in range(4)),
}
LEANING = {body: support | {"axial": 5e7, "tilting": 5e7} for body, support in SUPPORTS.items()}
HELICAL = {"gearset.helix_angle": 0.1}
SPATIAL = PLANAR | HELICAL | {"dynamics": "spatial", "supports": LEANING}
# Other solvers have no equations for these.
PLANAR_CASES = (
    Case("planar", PLANAR, 0.01, 40),
    Case("planar, floating sun", PLANAR | FLOATING, 0.01, 40),
    Case("planar, 4 planets in phase", PLANAR | IN_PHASE, 0.01, 40),
    Case("planar, helical", PLANAR | HELICAL, 0.01, 40),
    Case("spatial", SPATIAL, 0.01, 40),
)
# Slow shafts, whose damping decays over milliseconds.
STAGE_CASES = (
    Case("wind turbine stage", {}, 0.2, 40, base="wind_turbine_stage"),
    Case("helical stage", {}, 0.2, 40, base="helical_stage"),
)
