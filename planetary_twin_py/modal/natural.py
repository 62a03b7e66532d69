"""Natural modes of a scene, by one of several models."""

from __future__ import annotations

from ..model.layout import Layout
from ..scene import Scene, SceneError
from ..scene.given import check_scene
from ..scene.other_dynamics import under
from ..scene.supports import Support
from ..statics.loaded_planets import carrying
from ..statics.small_motion import radial_stiffness
from .mesh_stiffness import MeshStiffness, mesh_stiffness
from .modes import NaturalModes, modes_of
from .planar import planar_model
from .printed import PrintedSet, printed_model
from .spatial import spatial_model
from .springs import SpringModel
from .supported_set import Body, SupportedSet
from .torsional import torsional_model
from .turning import turning_modes, turning_terms

MOVING_AXES = ("planar", "spatial")
MODELS = ("torsional", "machines", "printed", "planar", "spatial")


def model_of(scene: Scene) -> str:
    """The model with the motions of a scene: "torsional", "planar" or "spatial".

    That of a quasi-static dynamics has the same axes as the dynamics that vibrates.

    Args:
        scene: the scene, whose dynamics is not auto.
    """
    if scene.tilting_axes:
        return "spatial"
    return "planar" if scene.moving_axes else "torsional"


def natural_modes(
    scene: Scene,
    model: str | None = None,
    stiffness: str = "single",
    input_speed: float | None = None,
) -> NaturalModes:
    """Natural modes of a scene without damping, at rest or turning at a constant speed.

    Args:
        scene: the scene.
        model: "torsional", gears and carrier as in a simulation (Kahraman 1994); "machines", the
            same with motor and load, where the end of a shaft whose motion is given is at rest;
            "printed", eqs. (32)-(38) of Salagianni et al. 2017; "planar", Lin and Parker 1999;
            "spatial", six motions of every body. The last two require `scene.supports`, whose
            rolling bearings and bearings with clearance are linear about the static equilibrium at
            the torque of the scene. None: that of the dynamics of the scene, see `model_of`. But
            for "printed", meshes that carry no load in static equilibrium have no stiffness, see
            `carrying_planets`.
        stiffness: stiffness of every mesh. "single": one tooth pair is in contact; "mean": mean
            over the mesh cycle, which gives the modes at which a simulation resonates.
        input_speed: speed of the first motor [rad/s]; the second one of a differential has that of
            the scene. For the models planar and spatial, the frequencies are those in the frame of
            the carrier, with gyroscopic and centripetal terms (Lin and Parker 1999). It has no
            effect in the others. None: nothing turns.

    Returns:
        Frequencies [Hz] (modes,), mass-normalised shapes [kg^-1/2] (coordinates, modes), and kinds
        of the modes (modes,).

    Raises:
        ValueError: the model or the stiffness is unknown, the scene lacks data of the model, or the
            stiffness is "mean" and at times no tooth pair is in contact; or centrifugal forces
            exceed the stiffness of bearings.
    """
    check_scene(scene)
    model = model_of(scene) if model is None else model
    springs = spring_model(scene, model, stiffness)
    if input_speed is None or model not in MOVING_AXES:
        return modes_of(springs)
    speeds = Layout(scene).speeds(input_speed, scene.operating_point.second_input_speed)
    if not any(speeds.values()):
        return modes_of(springs)
    angles = scene.gearset.planet_angles
    return turning_modes(springs, turning_terms(springs, speeds["carrier"], speeds, angles))


def spring_model(scene: Scene, model: str | None = None, stiffness: str = "single") -> SpringModel:
    """Masses and springs of a scene.

    Args:
        scene: the scene.
        model: see `natural_modes`.
        stiffness: see `natural_modes`.

    Raises:
        ValueError: see `natural_modes`.
    """
    model = model_of(scene) if model is None else model
    if model not in MODELS:
        raise ValueError(f"model = {model!r}: must be one of {', '.join(MODELS)}")
    mesh = mesh_stiffness(scene, stiffness)
    if model in ("torsional", "machines"):
        return torsional_model(scene, mesh, _mesh_factors(scene, model), model == "machines")
    if model == "printed":
        return printed_model(_printed_set(scene, mesh))
    build = planar_model if model == "planar" else spatial_model
    built = build(_supported_set(scene, mesh, _mesh_factors(scene, model)))
    return built.holding(f"{scene.gearset.held}.u")


def carrying_planets(scene: Scene, model: str) -> tuple[float, ...]:
    """Part of the time in which each planet carries load in static equilibrium, as a model has it.

    The stiffness of its meshes has this factor.

    Args:
        scene: the scene.
        model: see `natural_modes`; all planets of "printed" carry.

    Returns:
        Shares, 0 to 1, (planets,).
    """
    if model == "printed":
        return (1.0,) * scene.gearset.planets
    if model in MOVING_AXES:
        return carrying(scene)
    return carrying(scene.model_copy(update=under(scene, "torsional") | {"supports": None}))


def _mesh_factors(scene: Scene, model: str) -> tuple[float, ...]:
    """Factors of the planets on the stiffness of their meshes."""
    shares = enumerate(carrying_planets(scene, model))
    return tuple(scene.errors.of_planet(i).stiffness * share for i, share in shares)


def _printed_set(scene: Scene, mesh: MeshStiffness) -> PrintedSet:
    if scene.errors.planet_stiffness:
        raise ValueError("errors.planet_stiffness: model = 'printed' has equal planets only")
    mass, gearset = scene.gearset.rim_masses, scene.gearset
    return PrintedSet(
        mass.sun,
        mass.planet,
        mass.ring,
        mass.carrier,
        mesh.sun_planet,
        mesh.planet_ring,
        planets=gearset.planets,
    )


def loaded_planar_model(scene: Scene) -> SpringModel:
    """Masses and springs in the plane at mean mesh stiffness, with load on every planet.

    Args:
        scene: scene with supports.

    Returns:
        The spring model; it does not depend on static equilibrium if bearings are linear.
    """
    every = tuple(scene.errors.of_planet(i).stiffness for i in range(scene.gearset.planets))
    built = planar_model(_supported_set(scene, mesh_stiffness(scene, "mean"), every))
    return built.holding(f"{scene.gearset.held}.u")


def _supported_set(scene: Scene, mesh: MeshStiffness, factors: tuple[float, ...]) -> SupportedSet:
    if scene.supports is None:
        raise SceneError("supports: missing; planar and spatial models require masses and bearings")
    layout, supports, gearset = Layout(scene), scene.supports, scene.gearset
    rim, radius = layout.polar_masses, layout.planar_radii
    sun_planet, planet_ring = gearset.geometry.meshes

    def body(name: str) -> Body:
        support: Support = getattr(supports, name)
        along, across = radial_stiffness(scene, name)
        return Body(
            support.mass,
            rim[name],
            along,
            support.torsion,
            across,
            radius[name],
            support.diametral(rim[name]),
            support.axial or 0.0,
            support.tilting or 0.0,
        )

    return SupportedSet(
        body("sun"),
        body("ring"),
        body("carrier"),
        body("planet"),
        gearset.planet_angles,
        *mesh,
        sun_planet.pressure_angle,
        planet_ring.pressure_angle,
        factors,
        tuple(scene.errors.of_planet(i).pin_stiffness for i in range(gearset.planets)),
        gearset.base_helix,
        gearset.face_width,
    )
