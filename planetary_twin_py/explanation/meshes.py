"""Key figures of the two kinds of mesh of a scene at its operating point."""

from __future__ import annotations

import math
from typing import NamedTuple

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
from .friction import friction_figures
from .pressure import pitch_pressure


class MeshFigures(NamedTuple):
    """Key figures of a mesh between two kinds of gears, with healthy teeth."""

    teeth: tuple[int, int]
    pressure_angle: float  # working pressure angle [rad]
    contact_ratio: float
    overlap_ratio: float  # of helical teeth
    driver: str | None  # gear that drives the other in the frame of the carrier; None: no power
    # Path of contact from the tip of the driven gear to the pitch point, and after it [base
    # pitches]; without power as if power came from the sun.
    approach: float
    recess: float
    geometric_backlash: (
        float  # by profile shift and centre distance alone, along the line of action [m]
    )
    tip_clearances: tuple[float, float]  # of the tips of both gears from the mating root [m]
    single_stiffness: float  # largest of one pair on its path of contact [N/m]
    mean_stiffness: float  # over the mesh cycle [N/m]
    iso_stiffness: float  # c_gamma of ISO 6336-1 for solid discs with these teeth [N/m]
    natural_frequency: float  # of the two gears alone, with one pair in contact [Hz]
    damping_ratio: float  # of this mode at the operating point [-]
    static_force: float  # mean under the torque of the operating point, without friction [N]
    axial_force: float  # of helical teeth under the same [N]
    pitch_pressure: (
        float  # largest Hertz pressure at or next to the pitch point, force on one pair [Pa]
    )
    # H_v (Ohlendorf 1958): relative loss = H_v times mean friction coefficient [-].
    loss_factor: float  # pairs in contact share the load equally
    loaded_loss_factor: float | None  # with the loads of the pairs in the model; None: no force
    backlash: float  # total, along the line of action [m]
    friction: float  # mean coefficient by the laws of the scene, static force [-]
    friction_eyring: float  # the same with this law of viscous friction [-]
    friction_evans_johnson: float | None  # None outside the range of this law
    friction_schlenk: float  # regression of measured gear losses, includes boundary friction
    tooth_loss: (
        float  # H_v of the loads times mean coefficient times power of all meshes of the kind [W]
    )
    shear_number: float  # eta Vs/(h tau0) of the film at its mean pressure [-]
    film_laws_in_range: tuple[str, ...]  # eyring always, evans_johnson on its plateau


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
    load = gearbox.load(point)
    passing = float(train.cycles @ load.target_speed)
    frequency = abs(passing) / (2.0 * math.pi)
    natural, mean = natural_frequencies(gearbox, train.stiffness), mean_stiffness(train)
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
            single_stiffness=float(train.stiffness[kind]),
            mean_stiffness=float(mean[kind]),
            iso_stiffness=_iso_stiffness(scene, working_meshes[kind]),
            natural_frequency=float(natural[kind]) / (2.0 * math.pi),
            damping_ratio=0.5 * damping_time(train, kind, frequency) * float(natural[kind]),
            static_force=force,
            axial_force=force * abs(math.tan(gearset.base_helix)),
            pitch_pressure=pressure[kind],
            loss_factor=loss_factors[kind],
            backlash=2.0 * float(load.half_backlash),
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
