"""Static load sharing of the planets at several positions.

Meshes have their stiffness at each position, on both flanks of a tooth if both touch; bearings have
stiffness and clearance. The carrier turns at the speed of the operating point, so bodies have their
centrifugal forces. Friction, inertia at changing speeds and faults of teeth are omitted. With all
teeth in contact and equal stiffnesses, the shares are those of Singh 2005 and Ligata, Kahraman and
Singh 2008, on epicyclic load sharing.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from .._core import RollingBearing
from ..model.layout import Layout
from ..model.limits import displacement_limit
from ..model.moving_axes import linear_bearing
from ..model.planar_rows import CENTRAL, COAST, DRIVE
from ..model.rolling_bearings import largest_element_load, rolling_bearing
from ..model.teeth import build_teeth, stiffness_at
from ..scene import Scene, SceneError
from ..scene.given import check_scene
from ..scene.support_rules import unsupported
from ..scene.supports import Support, Supports
from .centrifugal import centrifugal
from .errors import Displacements, displacements
from .statics import Equilibrium, Springs, eccentricities, equilibrium
from .weight import weight_forces

POSITIONS = 64  # in a mesh cycle, if the load repeats with it
PER_CYCLE = 8  # in a mesh cycle, if the load repeats after several cycles
MOST_CYCLES = 2000
SIDES = (DRIVE, COAST)


class LoadSharing(NamedTuple):
    """Static forces and displacements at P positions of N planets."""

    turns: np.ndarray
    """Turns of the first motor, (P,)."""
    mesh_force: np.ndarray
    """Force of the drive flanks, then of the coast flanks, of each mesh, those with the sun first
    [N], (P, 2, 2 N)."""
    share: np.ndarray
    """Torque that each planet carries over the mean of all planets, (P, N)."""
    planet_bearing: np.ndarray
    """Force of each planet on its pin, radial and tangential [N], (P, N, 2)."""
    bearing: np.ndarray
    """Force of sun, ring and carrier on their bearings, x and y in the frame of the carrier [N],
    (P, 3, 2)."""
    displacement: np.ndarray
    """Displacement of sun, ring and carrier, x and y in the carrier's frame [m], (P, 3, 2): of an
    axis with `errors.*_offset`, from that offset."""
    element_load: np.ndarray
    """Load of the most loaded rolling element in the bearings of sun, ring, carrier and planets,
    NaN in other bearings [N], (P, 3 + N)."""
    mesh_cycle: np.ndarray
    """Number of the mesh cycle of each position, from 0, (P,)."""

    @property
    def factor(self) -> float:
        """The largest share of a planet at any position, with the ripple of the tooth pairs."""
        return float(self.share.max())

    @property
    def mean_factor(self) -> float:
        """Load sharing factor K_gamma: the largest mean share of a planet over a mesh cycle."""
        _, cycle = np.unique(self.mesh_cycle, return_inverse=True)
        sums = np.zeros((cycle.max() + 1, self.share.shape[1]))
        np.add.at(sums, cycle, self.share)
        return float((sums / np.bincount(cycle)[:, None]).max())

    @property
    def both_flanks(self) -> bool:
        """Whether both flanks of a mesh touch at any position."""
        return bool((self.mesh_force > 0.0).all(axis=1).any())

    def figures(self) -> dict[str, Any]:
        """The result for JSON, in SI: arrays over positions, those of bearings by body."""
        planets = (f"planet_{n}" for n in range(1, self.share.shape[1] + 1))
        loads = zip((*CENTRAL, *planets), self.element_load.T, strict=True)
        names = ("turns", "share", "mesh_force", "planet_bearing")
        return {
            "factor": self.factor,
            "mean_factor": self.mean_factor,
            "both_flanks": self.both_flanks,
            **{name: getattr(self, name).tolist() for name in names},
            "element_load": {b: load.tolist() for b, load in loads if not np.isnan(load).all()},
            "bearing": {body: self.bearing[:, k].tolist() for k, body in enumerate(CENTRAL)},
            "displacement": {
                body: self.displacement[:, k].tolist() for k, body in enumerate(CENTRAL)
            },
        }


def load_sharing(scene: Scene, turns: np.ndarray | None = None) -> LoadSharing:
    """Static load sharing among the planets.

    Bearings are those of `scene.supports`; without these, all axes are held. Speeds have no effect
    but for the centrifugal forces on a turning carrier.

    Args:
        scene: scene with torque, backlash and speeds in its operating point.
        turns: turns of the first motor, (P,); default: a mesh cycle, or with runout and offsets the
            number of cycles until their angles repeat, at most 2000.

    Returns:
        Forces and displacements at each position.

    Raises:
        ValueError: the torque is 0, the teeth are impossible, bearings cannot hold the load, or an
            axis is displaced so far that teeth no longer mesh.
    """
    check_scene(scene)
    if scene.operating_point.input_torque == 0.0:
        raise ValueError("input_torque = 0: must not be 0, as there is no load to share")
    if scene.supports is not None:
        for error in unsupported(scene.supports):
            raise SceneError(error)
    layout = Layout(scene)
    turns = _positions(layout) if turns is None else np.asarray(turns, dtype=float)
    errors = displacements(layout, turns)
    basis = _free_coordinates(layout)
    inertia = centrifugal(layout)
    springs = _springs(layout, errors, turns, basis, inertia.softening)
    weight = weight_forces(layout, turns)
    force = (_input_force(layout) + weight + inertia.force) @ basis
    driven = np.sign(layout.mesh_force(scene.operating_point.input_torque))
    closed = np.repeat([driven > 0.0, driven < 0.0], 2 * scene.gearset.planets)
    solution = equilibrium(springs, force, closed)
    if scene.supports is not None:
        _check_displacements(layout, eccentricities(springs, solution.displacement))
    elements = _element_loads(scene, springs, solution)
    on_bodies = weight + inertia.on(solution.displacement @ basis.T)
    return _assemble_result(layout, turns, errors, basis, solution, on_bodies, elements)


def _check_displacements(layout: Layout, displaced: np.ndarray) -> None:
    """Check displacements in the bearings [m], (P, bearings, 2)."""
    try:
        displacement_limit(layout).check(np.linalg.norm(displaced, axis=2))
    except ArithmeticError as reason:
        raise ValueError(f"{reason}") from None


def _positions(layout: Layout) -> np.ndarray:
    """Turns of the first motor at which the load is evaluated."""
    scene = layout.scene
    teeth, runout, errors = scene.gearset.tooth_numbers, scene.mesh.runout, scene.errors
    uneven = [kind for kind in teeth._fields if getattr(runout, kind)]
    cycles = math.lcm(*(getattr(teeth, kind) for kind in uneven))
    per_turn, carrier = layout.cycles[0], layout.ratios["carrier"][0]
    heavy = scene.supports is not None and scene.supports.gravity > 0.0
    turns_back = heavy or errors.ring_offset.size or errors.carrier_offset.size
    if turns_back and carrier:
        cycles = math.lcm(cycles, abs((per_turn / carrier).numerator))
    cycles = min(cycles, MOST_CYCLES)
    count = POSITIONS if cycles == 1 else PER_CYCLE * cycles
    # Middles of intervals, so that no position is at the start or end of a tooth contact.
    return np.asarray((np.arange(count) + 0.5) / count * cycles / abs(float(per_turn)))


def _free_coordinates(layout: Layout) -> np.ndarray:
    """Displacement of each coordinate per free coordinate, (coordinates, free).

    The input member can turn, the other central members cannot. Without bearings the axes are held,
    and planets move with the carrier.
    """
    scene, rows = layout.scene, layout.rows
    basis = np.eye(len(rows.coordinates))
    fixed = [f"{body}.u" for body in CENTRAL if body != scene.drive.input.member]
    if scene.supports is None:
        fixed += [f"{body}.{motion}" for body in CENTRAL for motion in "xy"]
        for planet in layout.planets:
            fixed += [f"{planet}.xi", f"{planet}.eta"]
            basis[rows.place(f"{planet}.eta"), rows.place("carrier.u")] = 1.0
    return np.delete(basis, [rows.place(name) for name in fixed], axis=1)


def _input_force(layout: Layout) -> np.ndarray:
    """Force of the input torque on each coordinate [N], (coordinates,)."""
    scene, rows = layout.scene, layout.rows
    member = scene.drive.input.member
    force = np.zeros(len(rows.coordinates))
    force[rows.place(f"{member}.u")] = (
        scene.operating_point.input_torque / layout.planar_radii[member]
    )
    return force


def _springs(
    layout: Layout,
    errors: Displacements,
    turns: np.ndarray,
    basis: np.ndarray,
    softening: np.ndarray,
) -> Springs:
    scene, rows = layout.scene, layout.rows
    flanks = np.vstack([rows.flanks(side) for side in SIDES])
    displaced = errors.toothing
    if scene.supports is None:
        displaced = displaced + _held_pins(layout, errors)
    backlash = scene.operating_point.backlash
    _, offset = scene.mesh.flanks(backlash, scene.gearset.transverse.pressure_angle)
    form = _harmonic_errors(layout, turns)
    apart = offset - errors.closing + errors.worn
    gap = np.concatenate([side * form + a for side, a in zip(SIDES, apart, strict=True)], axis=1)
    stiffness = np.concatenate([_stiffness(layout, turns, side) for side in SIDES], axis=1)
    bearing, radial, clearance, centre = _bearings(layout, errors)
    return Springs(
        basis.T @ softening @ basis,
        flanks @ basis,
        stiffness,
        gap - displaced @ flanks.T,
        bearing @ basis,
        radial,
        clearance,
        centre,
        _rolling_laws(scene),
    )


def _held_pins(layout: Layout, errors: Displacements) -> np.ndarray:
    """Displacements of planets by errors of their pins, and of held axes, (P, n)."""
    rows = layout.rows
    displaced = np.zeros((len(errors.axis), len(rows.coordinates)))
    for place, body in enumerate(CENTRAL):
        for direction, motion in enumerate("xy"):
            displaced[:, rows.place(f"{body}.{motion}")] = errors.axis[:, place, direction]
    carried = -rows.pin @ displaced.T  # displacements of the pins with the axis of the carrier
    for i, planet in enumerate(layout.planets):
        for direction, motion in enumerate(("xi", "eta")):
            place = rows.place(f"{planet}.{motion}")
            displaced[:, place] = errors.pin[i, direction] + carried[i, direction]
    return displaced


def _bearings(
    layout: Layout, errors: Displacements
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Rows, stiffness, clearance and centre of the bearings: sun, ring, carrier, planets."""
    supports, rows, count = layout.scene.supports, layout.rows, len(errors.axis)
    if supports is None:
        none = np.zeros((0, 2, len(rows.coordinates)))
        return none, np.zeros(0), np.zeros(0), np.zeros((count, 0, 2))
    central = np.zeros((3, 2, len(rows.coordinates)))
    for place, body in enumerate(CENTRAL):
        for direction, motion in enumerate("xy"):
            central[place, direction, rows.place(f"{body}.{motion}")] = 1.0
    pins = np.tile(errors.pin, (count, 1, 1))
    stiffness, clearance = _bearing_data(layout, supports)
    return (
        np.concatenate([central, rows.pin]),
        stiffness,
        clearance,
        np.concatenate([errors.axis, pins], axis=1),
    )


def _body_kinds(scene: Scene) -> list[str]:
    """Kinds of the bodies on bearings: sun, ring, carrier, planets."""
    return [*CENTRAL, *["planet"] * scene.gearset.planets]


def _bearing_data(layout: Layout, supports: Supports) -> tuple[np.ndarray, np.ndarray]:
    kinds, torque = _body_kinds(layout.scene), layout.scene.operating_point.input_torque
    stiffness = np.array([linear_bearing(layout, name, torque)[0] for name in layout.bearings])
    return stiffness, np.array([getattr(supports, kind).clearance for kind in kinds])


def _rolling_laws(scene: Scene) -> tuple[RollingBearing | None, ...]:
    """Laws of the rolling bearings, None for the others."""
    if scene.supports is None:
        return ()
    given = (getattr(scene.supports, kind).rolling for kind in _body_kinds(scene))
    return tuple(rolling_bearing(rolling) if rolling else None for rolling in given)


def _mesh_cycles(layout: Layout, turns: np.ndarray) -> np.ndarray:
    """Cycles since a pair was at the pitch point of each mesh, on drive flanks, (P, meshes)."""
    phases = np.array([float(phase) for kind in layout.phases for phase in kind])
    return np.asarray(float(layout.cycles[0]) * turns[:, None] - phases)


def _harmonic_errors(layout: Layout, turns: np.ndarray) -> np.ndarray:
    """Transmission errors of the teeth, harmonics of the mesh frequency [m], (P, meshes)."""
    scene, planets = layout.scene, len(layout.planets)
    cycles = _mesh_cycles(layout, turns)
    errors = np.zeros_like(cycles)
    for kind, error in enumerate((scene.mesh.sun_planet_error, scene.mesh.planet_ring_error)):
        meshes = slice(kind * planets, (kind + 1) * planets)
        phases = error.phases or (0.0,) * len(error.amplitudes)
        for n, (size, phase) in enumerate(zip(error.amplitudes, phases, strict=True), 1):
            errors[:, meshes] += size * np.sin(2.0 * np.pi * n * cycles[:, meshes] + phase)
    return errors


def _stiffness(layout: Layout, turns: np.ndarray, side: float) -> np.ndarray:
    """Stiffness of each mesh on the flanks of one side [N/m], (P, meshes)."""
    scene = layout.scene
    teeth, planets = build_teeth(scene), scene.gearset.planets
    kinds = np.repeat([0, 1], planets)
    lead = np.array([mesh.coast_lead for mesh in scene.gearset.geometry.meshes])[kinds]
    cycles = side * _mesh_cycles(layout, turns) + (lead if side == COAST else 0.0)
    fractions = cycles - np.floor(cycles)
    nominal = [stiffness_at(teeth, kind, fractions[:, i]) for i, kind in enumerate(kinds)]
    factors = [scene.errors.of_planet(i).stiffness for i in range(planets)]
    return np.column_stack(nominal) * np.tile(factors, 2)


def _assemble_result(
    layout: Layout,
    turns: np.ndarray,
    errors: Displacements,
    basis: np.ndarray,
    solution: Equilibrium,
    on_bodies: np.ndarray,
    elements: np.ndarray,
) -> LoadSharing:
    scene, rows = layout.scene, layout.rows
    planets, count = len(layout.planets), len(turns)
    forces = solution.contact_force.reshape(count, 2, 2 * planets)
    sun_mesh = forces[:, 0, :planets] - forces[:, 1, :planets]
    moved = (solution.displacement @ basis.T)[:, : 3 * len(CENTRAL)].reshape(count, 3, 3)
    flanks = np.vstack([rows.flanks(side) for side in SIDES])
    on_bodies = on_bodies - solution.contact_force @ flanks
    pins = on_bodies[:, 3 * len(CENTRAL) :].reshape(count, planets, 3)[:, :, :2]
    bearing = on_bodies[:, : 3 * len(CENTRAL)].reshape(count, 3, 3)[:, :, :2]
    on_carrier = -np.einsum("pid,idn->pn", pins, rows.pin)
    place = rows.place("carrier.x")
    return LoadSharing(
        turns,
        forces,
        sun_mesh / sun_mesh.mean(axis=1, keepdims=True),
        pins,
        bearing + np.eye(3)[2][:, None] * on_carrier[:, None, place : place + 2],
        moved[:, :, :2] - (0.0 if scene.supports is None else errors.axis),
        elements,
        np.floor(np.abs(float(layout.cycles[0]) * turns)).astype(int),
    )


def _element_loads(scene: Scene, springs: Springs, solution: Equilibrium) -> np.ndarray:
    """Load of the most loaded rolling element of each bearing, (P, bearings)."""
    loads = np.full((len(solution.displacement), len(_body_kinds(scene))), np.nan)
    size = np.linalg.norm(eccentricities(springs, solution.displacement), axis=-1)
    for b, kind in enumerate(_body_kinds(scene)):
        support: Support | None = getattr(scene.supports, kind, None)
        if support is not None and support.rolling is not None:
            loads[:, b] = largest_element_load(support.rolling, support.clearance, size[:, b])
    return loads
