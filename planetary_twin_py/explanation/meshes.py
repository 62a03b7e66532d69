"""Key figures of the two kinds of mesh of a scene at its operating point."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from .._core import damping_time
from ..gearset.working import WorkingMesh
from ..lubrication.ohlendorf import tooth_loss_factor
from ..mesh.overlap import overlap_ratio
from ..model.gearbox import Gearbox
from ..model.mean_stiffness import mean_stiffness
from ..model.mesh_damping import natural_frequencies
from ..model.stiffness_laws import GEARS, loaded_force
from ..scene import Scene
from ..tooth.iso import iso_pair
from ..tooth.material import Material
from ..units.catalogue import Quantity
from .friction import friction_figures
from .pressure import pitch_pressure
from .root_stress import root_stresses


class MeshFigures(NamedTuple):
    """Key figures of a mesh between two kinds of gears, with healthy teeth."""

    teeth: Annotated[tuple[int, int], Quantity("teeth")]
    pressure_angle: Annotated[float, Quantity("working pressure angle", "rad")]
    contact_ratio: Annotated[float, Quantity("contact ratio")]
    overlap_ratio: Annotated[float, Quantity("overlap ratio")]
    driver: Annotated[str | None, Quantity("driving gear, in the frame of the carrier")]
    """None: no power."""
    approach: Annotated[float, Quantity("length of approach in base pitches")]
    """From the tip of the driven gear to the pitch point; without power as if power came from the
    sun, as the next one."""
    recess: Annotated[float, Quantity("length of recess in base pitches")]
    geometric_backlash: Annotated[
        float, Quantity("backlash by profile shift and centre distance", "m")
    ]
    """Along the line of action."""
    tip_clearances: Annotated[
        tuple[float, float], Quantity("clearance of both tips from the mating root", "m")
    ]
    single_stiffness: Annotated[
        float, Quantity("stiffness of one pair, largest on its path", "N/m")
    ]
    mean_stiffness: Annotated[float, Quantity("stiffness, mean over the mesh cycle", "N/m")]
    iso_stiffness: Annotated[
        float, Quantity("the same of solid discs by ISO 6336-1, c_gamma", "N/m")
    ]
    natural_frequency: Annotated[
        float, Quantity("natural frequency of the two gears alone, one pair in contact", "Hz")
    ]
    damping_ratio: Annotated[float, Quantity("damping ratio of this mode")]
    static_force: Annotated[float, Quantity("static mesh force", "N")]
    """Mean under the torque of the operating point, without friction."""
    axial_force: Annotated[float, Quantity("axial part of the same", "N")]
    pitch_pressure: Annotated[
        float,
        Quantity(
            "Hertz pressure at or next to the pitch point, one pair carries the static force", "Pa"
        ),
    ]
    root_stress: Annotated[
        tuple[float, ...],
        Quantity(
            "root stress of external teeth by ISO 6336-3, one pair, static force",
            "Pa",
        ),
    ]
    """None of helical teeth."""
    loss_factor: Annotated[
        float, Quantity("tooth loss factor H_v, equal loads of the pairs in contact")
    ]
    """Ohlendorf 1958: relative loss = H_v times mean friction coefficient."""
    loaded_loss_factor: Annotated[
        float | None, Quantity("the same with the loads of the pairs in this model")
    ]
    """None: no force."""
    backlash: Annotated[float, Quantity("backlash on the line of action", "m")]
    friction: Annotated[float, Quantity("friction coefficient, mean over the path of contact")]
    """By the laws of the scene, under the static force."""
    friction_eyring: Annotated[float, Quantity("the same with eyring")]
    friction_evans_johnson: Annotated[float | None, Quantity("the same with evans_johnson")]
    """None outside the range of this law."""
    friction_schlenk: Annotated[float, Quantity("the same with schlenk")]
    """Regression of measured gear losses, includes boundary friction."""
    tooth_loss: Annotated[
        float,
        Quantity("tooth loss of all planets: friction coefficient, last H_v and power", "W"),
    ]
    shear_number: Annotated[float, Quantity("shear number of the film, above 1 shear-thinning")]
    """eta Vs/(h tau0) of the film at its mean pressure."""
    film_laws_in_range: Annotated[tuple[str, ...], Quantity("film laws within their range")]
    """eyring always, evans_johnson on its plateau."""


class Meshes(NamedTuple):
    """Key figures of both kinds of mesh, and the mesh frequency, at the operating point."""

    mesh_frequency: float  # [Hz]
    sun_planet: MeshFigures
    planet_ring: MeshFigures


def describe_meshes(scene: Scene) -> Meshes:
    """Key figures of the meshes of `scene` at its operating point.

    Raises:
        ValueError: the tooth geometry is impossible, or the contact ratio is below 1.
    """
    gearbox = Gearbox(scene).held
    scene, train, point = gearbox.scene, gearbox.train, scene.operating_point
    operation = gearbox.operation(point)
    passing = float(train.cycle.per_turn @ operation.target_speed)
    frequency = abs(passing) / (2.0 * math.pi)
    natural, mean = natural_frequencies(gearbox, train.teeth.stiffness), mean_stiffness(train.teeth)
    sun_force = gearbox.mesh_force(point.input_torque)
    force, from_sun = abs(sun_force), sun_force * passing
    pressure = [pitch_pressure(scene, force, kind) for kind in range(len(GEARS))]
    gearset, teeth = scene.gearset, scene.gearset.tooth_numbers._asdict()
    working_meshes = gearset.geometry.meshes
    paths = [mesh.path for mesh in working_meshes]
    loss_factors = [
        tooth_loss_factor(
            mesh.path, mesh.first.teeth, mesh.second.teeth, mesh.internal, gearset.base_helix
        )
        for mesh in working_meshes
    ]
    sides = [(path.approach, path.recess)[:: -1 if from_sun < 0.0 else 1] for path in paths]
    sun_planet, planet_ring = (
        MeshFigures(
            teeth=(teeth[first], teeth[second]),
            pressure_angle=working_meshes[kind].pressure_angle,
            contact_ratio=paths[kind].contact_ratio,
            overlap_ratio=overlap_ratio(
                gearset.face_width, gearset.base_helix, working_meshes[kind].base_pitch
            ),
            driver=_driver(from_sun, first, second),
            approach=sides[kind][0],
            recess=sides[kind][1],
            geometric_backlash=working_meshes[kind].backlash,
            tip_clearances=working_meshes[kind].tip_clearances,
            single_stiffness=float(train.teeth.stiffness[kind]),
            mean_stiffness=float(mean[kind]),
            iso_stiffness=_iso_stiffness(scene, working_meshes[kind]),
            natural_frequency=float(natural[kind]) / (2.0 * math.pi),
            damping_ratio=0.5 * damping_time(train, kind, frequency) * float(natural[kind]),
            static_force=force,
            axial_force=force * abs(math.tan(gearset.base_helix)),
            pitch_pressure=pressure[kind],
            root_stress=root_stresses(scene, force, kind),
            loss_factor=loss_factors[kind],
            backlash=2.0 * float(operation.backlash.half),
            **friction_figures(scene, kind, (sun_force, pressure[kind]), frequency),
        )
        for kind, (first, second) in enumerate(GEARS)
    )
    return Meshes(frequency, sun_planet, planet_ring)


def _iso_stiffness(scene: Scene, mesh: WorkingMesh) -> float:
    gearset, oil = scene.gearset, scene.lubrication
    material, width = Material(oil.youngs_modulus, oil.poisson_ratio), gearset.face_width
    pair = iso_pair(mesh, gearset.helix_angle)
    return width * pair.mesh(material, mesh.path.contact_ratio, loaded_force(scene) / width)


def _driver(from_sun: float, first: str, second: str) -> str | None:
    """The driving one of two gears; the first is on the side of the sun, whose power is given."""
    if from_sun == 0.0:
        return None
    return first if from_sun > 0.0 else second
