"""The terms of a scene: name, law, and the changes that leave the term out."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ..model.layout import Layout
from ..model.moving_axes import linear_bearing
from ..model.stiffness_laws import stiffness_laws
from ..scene import Scene
from ..scene.faults import Fault, without_pits
from ..scene.other_dynamics import under
from .axes import meaning_of_held_axes
from .losses import KINDS, bearings_with_losses, losses, losses_in_words, members_with_drag

_FACTORS = ("planet_stiffness", "pin_stiffness")  # of scene.errors


class Term(NamedTuple):
    """A part of the model that can be left out."""

    name: str
    law: str
    without: dict[str, Any]  # changes to the scene that leave it out


class Limit(NamedTuple):
    """Something that is not modelled, and the consequence."""

    name: str
    meaning: str


NOT_MODELLED = (
    Limit(
        "flexibility of carrier, ring and shafts",
        "only the teeth and the couplings of motor and load are elastic",
    ),
    Limit("transient oil film", "film and traction follow load and speed without delay"),
)

HEATING = Limit(
    "heating",
    "the oil temperature is given and uniform; losses do not change it (section thermal)",
)


GROWTH = Limit(
    "growth of faults", "wear, spalls and cracks are constant during a run (growth of a fault)"
)


STATICS_ONLY = Limit("vibration", "the train turns rigidly (dynamics), without vibration or rattle")


HELIX = Limit(
    "axial forces",
    "contact lines move along the face, but axial force and tilting moments of the helix move no "
    "body and load no bearing: dynamics = spatial",
)


TRANSVERSE_RACK = Limit(
    "rack of the normal plane",
    "addendum, dedendum, fillet and shifts count in the transverse module that the scene gives; "
    "with gearset.normal_module, roots and tip clearances are those of a drawing",
)


IN_PLANE = Limit(
    "places of axes",
    "axes move in the plane; directions and lengths of the lines of action stay nominal",
)

FLAT = Limit(
    "tilting, axial motion",
    "only with dynamics = spatial and in `modal --model spatial`; no face load distribution",
)

SHUTTLING = Limit(
    "shuttling",
    "the resultant of a mesh stays in the middle of the face, and flanks touch all along it",
)

CAGE = Limit(
    "passing of rolling elements",
    "bearings have the mean stiffness over all positions of the cage, and no raceway waviness",
)

NOMINAL_LINES = (
    IN_PLANE,
    Limit("axial friction", "friction of teeth acts in the plane of the gears"),
)


def limits(scene: Scene) -> tuple[Limit, ...]:
    """Limits of the model, and losses that are left out, that apply to `scene`."""
    rack = scene.gearset.helix_angle != 0.0 and scene.gearset.normal_module is None
    transverse = (TRANSVERSE_RACK,) if rack else ()
    slow = (
        *((HEATING,) if scene.thermal is None else ()),
        *((GROWTH,) if all(fault.growing is None for fault in scene.faults) else ()),
    )
    return (*_limits_of_motion(scene), *transverse, *_missing_losses(scene), *slow, *NOT_MODELLED)


def _missing_losses(scene: Scene) -> tuple[Limit, ...]:
    _, missing = losses(scene)
    if not missing:
        return ()
    contained = f"power loss and efficiency: {losses_in_words(scene)}"
    fields = "lubrication.friction" if missing == ["tooth friction"] else "section losses"
    return (Limit(f"losses: {', '.join(missing)}", f"{contained} ({fields} of the scene)"),)


def _limits_of_motion(scene: Scene) -> tuple[Limit, ...]:
    statics = (STATICS_ONLY,) if scene.quasi_static else ()
    helix = (HELIX,) if scene.gearset.helix_angle != 0.0 else ()
    rolling = (CAGE,) if _rolling_elements(scene) is not None else ()
    if scene.tilting_axes:
        return (*statics, SHUTTLING, *NOMINAL_LINES, *rolling)
    if scene.moving_axes:
        return (*statics, *helix, IN_PLANE, FLAT, *rolling)
    axes = Limit("translation of axes", meaning_of_held_axes(scene))
    return (*statics, *helix, axes, FLAT)


def terms(scene: Scene) -> tuple[Term, ...]:
    """The terms that are on in `scene`."""
    found = (build(scene) for build in _TERMS)
    return tuple(term for term in found if term is not None)


def _dynamics(scene: Scene) -> Term | None:
    # A force that jumps at first contact has no equilibrium for loads below the jump. Without
    # dynamics, nothing can be given at the ports.
    jumps = scene.mesh.backlash == "regulatory_factor"
    if scene.quasi_static or jumps or scene.drive.ports.given:
        return None
    if scene.moving_axes:
        law = "rotation and displacement of every body; elastic bearings, couplings and teeth"
        if scene.tilting_axes:
            law = law.replace("displacement", "displacement, axial motion and tilts")
        return Term(f"{scene.dynamics} dynamics", law, under(scene, "torsional"))
    law = "rotation of every body, elastic couplings and teeth"
    return Term("torsional dynamics", law, under(scene, "quasi_static"))


def _friction(scene: Scene) -> Term | None:
    oil = scene.lubrication
    if not oil.friction:
        return None
    law = f"film {oil.film}, lambda ratio {oil.lambda_ratio}, {oil.traction}, {oil.boundary}"
    law = law.replace("_", " ")
    return Term("tooth friction", law, {"lubrication.friction": False})


def _boundary(scene: Scene) -> Term | None:
    if not scene.lubrication.friction:
        return None
    if scene.lubrication.lambda_ratio == "prescribed":
        smooth: dict[str, Any] = {"lambda_ratio": 10.0}
    else:
        smooth = {"lubrication.composite_roughness": 1e-12}
    return Term("asperities", "boundary friction at the lambda ratio", smooth)


def _rolling(scene: Scene) -> Term | None:
    if not scene.lubrication.friction or scene.lubrication.rolling == "none":
        return None
    return Term("rolling resistance", "Goksem and Hargreaves", {"lubrication.rolling": "none"})


def _backlash(scene: Scene) -> Term | None:
    backlash = scene.operating_point.backlash
    if backlash == 0.0:
        return None
    law = f"{scene.mesh.backlash.replace('_', ' ')}, {1e6 * backlash:g} um"
    return Term("backlash", law, {"backlash": 0.0})


def _tooth_pairs(scene: Scene) -> Term | None:
    mesh = scene.mesh
    constant: dict[str, Any] = {"mesh.double_pair_ratio": 1.0, "mesh.entry": "ramp"}
    if mesh.stiffness == "involute":
        law = "computed from the teeth, position by position"
        single = (law.single for law in stiffness_laws(scene))
        names = ("mesh.sun_planet_stiffness", "mesh.planet_ring_stiffness")
        constant |= {"mesh.stiffness": "given", **dict(zip(names, single, strict=True))}
        # The depth of a crack has a meaning only with the tooth geometry.
        constant["faults"] = [
            f for f in scene.faults if not (f.kind == "crack" and f.depth is not None)
        ]
    elif mesh.double_pair_ratio == 1.0:
        return None
    else:
        law = f"two pairs {mesh.double_pair_ratio:g} times as stiff as one"
    return Term("alternation of tooth pairs", law, constant)


def _ramp(scene: Scene) -> Term | None:
    ramp, name = scene.mesh.ramp, "gradual entry of teeth"
    if scene.mesh.entry == "loaded":
        return Term(
            name, "where the load closes their separation", {"mesh.entry": "ramp", "mesh.ramp": 0.0}
        )
    if ramp == 0.0:
        return None
    return Term(name, f"over {ramp:g} base pitches", {"mesh.ramp": 0.0})


def _errors(scene: Scene) -> Term | None:
    errors = (scene.mesh.sun_planet_error, scene.mesh.planet_ring_error)
    if not any(any(error.amplitudes) for error in errors):
        return None
    without: dict[str, Any] = {f"mesh.{kind}_error": {} for kind in ("sun_planet", "planet_ring")}
    return Term("static transmission error", "harmonics of the meshing frequency", without)


def _runout(scene: Scene) -> Term | None:
    runout = scene.mesh.runout
    if runout.sun == runout.planet == runout.ring == 0.0:
        return None
    return Term("runout", "once per turn of each gear", {"mesh.runout": {}})


def _positions(scene: Scene) -> Term | None:
    errors, planets = scene.errors, range(scene.gearset.planets)
    if not (errors.of_axes or any(any(errors.of_planet(i)[:3]) for i in planets)):
        return None
    without = {"errors": {name: getattr(errors, name) for name in _FACTORS}}
    return Term("errors of position", "pins, teeth and axes off their places", without)


def _unequal_stiffness(scene: Scene) -> Term | None:
    planets = [scene.errors.of_planet(i) for i in range(scene.gearset.planets)]
    meshes = len({planet.stiffness for planet in planets}) > 1
    pins = len({planet.pin_stiffness for planet in planets}) > 1 and scene.moving_axes
    parts = [name for name, differ in (("meshes", meshes), ("pins", pins)) if differ]
    if not parts:
        return None
    without: dict[str, Any] = {f"errors.{name}": () for name in _FACTORS}
    return Term("unequal stiffness", f"{' and '.join(parts)} of the planets", without)


def _damping(scene: Scene) -> Term | None:
    damping = scene.mesh.damping
    undamped = damping.law == "viscous" and damping.damping_ratio == 0.0
    if undamped or scene.quasi_static:
        return None
    law = f"{damping.law.replace('_', ' ')}, proportional to the stiffness"
    return Term("mesh damping", law, {"mesh.damping": {"law": "viscous", "damping_ratio": 0.0}})


def _place(fault: Fault) -> str:
    """Gear or bearing of a fault."""
    return str(getattr(fault, "gear", getattr(fault, "bearing", "planet")))


def _faults(scene: Scene) -> Term | None:
    if not scene.faults:
        return None
    law = ", ".join(f"{f.kind} of {_place(f)}" for f in scene.faults)
    return Term("faults", law, {"faults": ()})


def _ripple(scene: Scene) -> Term | None:
    ripple, order = scene.operating_point.torque_ripple, scene.drive.speed_control.ripple_order
    if ripple == 0.0:
        return None
    law = f"{ripple:g} N m, {order} cycles per turn"
    return Term("torque ripple", law, {"torque_ripple": 0.0})


def _bearings(scene: Scene) -> Term | None:
    kinds = bearings_with_losses(scene)
    if not kinds:
        return None
    without = {f"losses.{kind}_bearing": None for kind in kinds}
    return Term("bearings", f"Palmgren, of {', '.join(kinds)}", without)


def _rolling_elements(scene: Scene) -> Term | None:
    """Rolling elements; without them, bearings are linear, as stiff as under a nominal load."""
    supports = scene.supports
    if supports is None or not scene.moving_axes:
        return None
    rolling_of = {kind: getattr(supports, kind).rolling for kind in KINDS}
    names = [f"{kind} on {rolling.text}" for kind, rolling in rolling_of.items() if rolling]
    if not names:
        return None
    without: dict[str, Any] = {"faults": without_pits(scene.faults)}
    layout, torque = Layout(scene), scene.operating_point.input_torque
    for kind, rolling in rolling_of.items():
        if rolling:
            without[f"supports.{kind}.rolling"] = None
            without[f"supports.{kind}.bearing"], _ = linear_bearing(layout, kind, torque)
    return Term("rolling elements", f"Palmgren, {', '.join(names)}", without)


def _drag(scene: Scene) -> Term | None:
    kinds = members_with_drag(scene)
    if not kinds:
        return None
    without: dict[str, Any] = {f"losses.{kind}_drag": {} for kind in kinds}
    return Term("seals and grease", f"Coulomb and viscous, of {', '.join(kinds)}", without)


def _churning(scene: Scene) -> Term | None:
    if scene.losses.churning is None:
        return None
    return Term("churning", "discs in a housing, Daily and Nece", {"losses.churning": None})


_TERMS: tuple[Callable[[Scene], Term | None], ...] = (
    _dynamics,
    _tooth_pairs,
    _ramp,
    _backlash,
    _damping,
    _errors,
    _runout,
    _positions,
    _unequal_stiffness,
    _faults,
    _ripple,
    _friction,
    _boundary,
    _rolling,
    _bearings,
    _rolling_elements,
    _drag,
    _churning,
)
