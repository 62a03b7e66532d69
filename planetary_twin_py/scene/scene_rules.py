"""Rules across the sections of a scene: what must fit together."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..gearset.kinematics import MEMBERS
from .errors import PER_PLANET
from .mesh import TipReliefs
from .operating_point import TUNABLES
from .parts import LIMITS, SceneParts
from .sensors.rules import errors_of_sensors
from .support_rules import missing_stiffnesses, unsupported, unsupported_along
from .worn import WornFlanks

SPECIFIC_STIFFNESS = 2e10  # [Pa], of a mesh per face width (ISO 6336-1, 20 N/(mm um))


def errors_of_scene(scene: SceneParts) -> Iterator[str]:
    """Errors of parts that do not fit together, a line each."""
    for rule in RULES:
        yield from rule(scene)


def machines(scene: SceneParts) -> Iterator[str]:
    """Errors of the drive: a machine on the fixed member, or a wrong number of inputs."""
    held = scene.gearset.held
    default = "" if "held" in scene.gearset.model_fields_set else f" (default: {held})"
    for side in ("input", "second_input", "output"):
        machine = getattr(scene.drive, side)
        if machine is not None and machine.member == held:
            yield (
                f"drive.{side}.member = {held!r}: is fixed by gearset.held{default}, so "
                f"drive.{side}.member must be {' or '.join(_free_members(scene))}"
            )
    if (scene.drive.second_input is None) != (held != "none"):
        needed = "requires" if held == "none" else "does not allow"
        yield f"gearset.held = {held!r}: {needed} drive.second_input"
    if scene.drive.second_input is None and scene.operating_point.second_input_speed != 0.0:
        speed = scene.operating_point.second_input_speed
        yield f"second_input_speed = {speed!r}: must be 0 without a second input"


def _free_members(scene: SceneParts) -> list[str]:
    """Members that are not fixed and have no machine."""
    machines = (scene.drive.input, scene.drive.second_input, scene.drive.output)
    taken = {scene.gearset.held, *(machine.member for machine in machines if machine)}
    return [member for member in MEMBERS if member not in taken]


def _ports(scene: SceneParts) -> Iterator[str]:
    """Errors of ports at which torque or motion is given."""
    second, ports = scene.drive.second_input, scene.drive.ports
    if second is not None and second.port != "machine":
        yield f"drive.second_input.port = {second.port!r}: must be machine"
    if second is not None and ports.given and ports.output == "machine":
        yield (
            f"drive.input.port = {ports.input!r}: requires drive.output.port = torque or "
            "motion in a differential (gearset.held = 'none')"
        )
    if ports.output == "brake":
        yield "drive.output.port = 'brake': only drive.input.port can be brake"
    for side, port in ports._asdict().items():
        if port != "machine" and scene.quasi_static:
            yield f"drive.{side}.port = {port!r}: requires dynamics other than quasi-static"


def limits(scene: SceneParts) -> Iterator[str]:
    """Errors of the operating point: values outside the limits of the drive."""
    for name, tunable in TUNABLES.items():
        value = getattr(scene.operating_point, name)
        reach = getattr(scene.drive, LIMITS[name]) if name in LIMITS else math.inf
        if abs(value) > reach or not tunable.minimum <= value <= tunable.maximum:
            why = f" (drive.{LIMITS[name]})" if name in LIMITS else ""
            yield f"{name} = {value!r}: {scene.tunables[name].range}{why}"


def faulty_teeth(scene: SceneParts) -> Iterator[str]:
    """Errors of the faults: missing teeth or planets, or a crack depth without geometry."""
    yield from scene.errors_of_faults(scene.faults)


def _closed_backlash(scene: SceneParts) -> Iterator[str]:
    """Error of a runout that presses both flanks of a tooth into their neighbours."""
    if scene.moving_axes or scene.dynamics == "auto":
        return  # there both flanks have their forces, or dynamics without them is refused later
    runout, angle = scene.mesh.runout, scene.gearset.transverse.pressure_angle
    backlash = scene.operating_point.backlash
    half = scene.mesh.flanks(backlash, angle)[0]
    sines = [math.sin(mesh.pressure_angle) for mesh in scene.gearset.geometry.meshes]
    most = max(sine * a for sine, a in zip(sines, (runout.sun, runout.ring), strict=True))
    closed = max(sines) * runout.planet + most - half
    opened = _least_deflection(scene)
    if 2.0 * closed > 0.5 * opened:  # half of it may be lost to vibration
        least = 1.005 * (closed + half) / scene.mesh.flanks(1.0, angle)[0]  # rounded upwards
        yield (
            f"backlash = {backlash!r}: must be at least {least:.3g} m, as mesh.runout closes "
            f"the backlash by {2.0 * closed:.3g} m more than there is, of which the load opens "
            f"{0.5 * opened:.3g} m: both flanks of a tooth would touch at once"
        )


def _relief(scene: SceneParts) -> Iterator[str]:
    """Errors of loaded entry, wear and relief: of helical teeth, or longer than the path."""
    if scene.mesh.entry == "loaded" and scene.gearset.helix_angle != 0.0:
        yield "mesh.entry = 'loaded': requires spur teeth, gearset.helix_angle = 0"
    if scene.mesh.worn != WornFlanks() and scene.gearset.helix_angle != 0.0:
        yield "mesh.worn: requires spur teeth, gearset.helix_angle = 0"
    if scene.mesh.tip_relief == TipReliefs():
        return
    if scene.gearset.helix_angle != 0.0:
        yield "mesh.tip_relief: requires spur teeth, gearset.helix_angle = 0"
    for mesh in scene.gearset.geometry.meshes:
        longest = mesh.path.contact_ratio * mesh.base_pitch
        for name in mesh.names:
            relief = getattr(scene.mesh.tip_relief, name)
            if relief is not None and relief.length > longest:
                yield (
                    f"mesh.tip_relief.{name}.length = {relief.length:g}: must be at most "
                    f"{longest:.4g} m, the path of contact of {' and '.join(mesh.names)}"
                )


def _heat_of_friction(scene: SceneParts) -> Iterator[str]:
    """Error of a friction torque that is not the heat of its mesh."""
    if scene.thermal is not None and scene.lubrication.friction_torque == "printed":
        yield (
            "lubrication.friction_torque = 'printed': must be sliding with thermal, because "
            "the printed torques do not dissipate the friction loss"
        )


def _errors_of_planets(scene: SceneParts) -> Iterator[str]:
    """Errors of lists that have no entry for each planet."""
    planets = scene.gearset.planets
    for name in PER_PLANET:
        count = len(getattr(scene.errors, name))
        if count not in (0, planets):
            yield f"errors.{name}: has {count} entries: must have {planets}, one a planet"
    for name, worn in scene.mesh.worn:
        if worn is not None and len(worn.planets) not in (0, planets):
            yield (
                f"mesh.worn.{name}.planets: has {len(worn.planets)} entries: must have "
                f"{planets}, one a planet"
            )
    if scene.errors.pin_stiffness and scene.supports and scene.supports.planet.rolling:
        yield (
            "errors.pin_stiffness: requires planets on linear bearings, without "
            "supports.planet.rolling"
        )
    if scene.errors.of_axes and scene.gearset.held == "none":
        yield "errors: ring_offset and carrier_offset require a fixed member (gearset.held)"


def _moving_axes(scene: SceneParts) -> Iterator[str]:
    """Errors of a scene whose axes move: what its dynamics lack or do not hold."""
    if not scene.moving_axes:
        return
    held, supports = scene.gearset.held, scene.supports
    why = f"with dynamics = {scene.dynamics!r}"
    if supports is None:
        yield f"supports: missing; {why} all masses and bearings are required"
    else:
        missing = [*missing_stiffnesses(supports)] if scene.tilting_axes else []
        if missing:
            yield (
                f"{', '.join(missing)}: missing; {why} every body requires an axial and a "
                "tilting stiffness, 0 where it floats"
            )
        yield from unsupported(supports)
        if scene.tilting_axes and scene.gearset.helix_angle != 0.0:
            yield from unsupported_along(supports)
        for name in ("sun", "ring", "carrier"):
            torsion = getattr(supports, name).torsion
            if torsion != 0.0 and name != held:
                yield f"supports.{name}.torsion = {torsion!r}: must be 0 {why}, as {name} turns"
    if scene.lubrication.friction_torque == "printed":
        yield f"lubrication.friction_torque = 'printed': must be 'sliding' {why}"
    if scene.mesh.backlash == "regulatory_factor":
        yield f"mesh.backlash = 'regulatory_factor': must be 'dead_zone' {why}"


def _rated_members(scene: SceneParts) -> Iterator[str]:
    """Errors of rated bearings whose loads are not known, because the axes are held."""
    if scene.moving_axes or scene.durability is None:
        return
    for member in ("sun", "ring", "carrier"):
        if getattr(scene.durability.bearings, member) is not None:
            yield (
                f"durability.bearings.{member}: must be left out with dynamics = "
                f"{scene.dynamics!r}, where its load is not known: use planar or spatial"
            )


def _unfit_sensors(scene: SceneParts) -> Iterator[str]:
    """Errors of sensors that need other dynamics or shafts, or do not fit each other."""
    yield from errors_of_sensors(scene.sensors, scene.surroundings)


def _least_deflection(scene: SceneParts) -> float:
    """Deflection [m] of the stiffer meshes under the least torque, all pairs in contact."""
    gearset, mesh, point = scene.gearset, scene.mesh, scene.operating_point
    teeth = gearset.teeth
    # Torques of sun, ring and carrier are as these tooth numbers.
    driven = {"sun": teeth.sun, "ring": teeth.ring, "carrier": teeth.sun + teeth.ring}
    count = driven[scene.drive.input.member]
    radius = 0.5 * gearset.transverse.module * count * math.cos(gearset.transverse.pressure_angle)
    torque = max(abs(point.input_torque) - abs(point.torque_ripple), 0.0)
    force = torque / (gearset.planets * radius)
    given = mesh.sun_planet_stiffness, mesh.planet_ring_stiffness
    single = max(k or SPECIFIC_STIFFNESS * gearset.face_width for k in given)
    return force / (single * max(mesh.double_pair_ratio, 1.0))


RULES = (
    machines, _ports, limits, faulty_teeth, _closed_backlash, _relief, _errors_of_planets,
    _moving_axes, _rated_members, _unfit_sensors, _heat_of_friction,
)  # fmt: skip
