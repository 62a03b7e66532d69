"""Two gears in the plane whose teeth press on each other: finite elements with unilateral contact.

An oracle that shares nothing with springs behind gaps but the outlines of the teeth. Every node on
the flanks of three teeth of each gear, its tip included, may touch the flank of the mating tooth.
The second gear is held, and the first one turned until its torque is reached.
Lengths are metres, the material has E = 1 Pa; forces are per metre of face width.
"""

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import nnls
from tooth.plane_strain import GearModel, halved

TEETH = (0, 1, -1)  # of a gear model
HEAVY = 1e4  # weight of the torque in the least squares, over that of the compliances
RIDGE = 1e-10  # of the largest compliance: nodes of both flanks may be at one place


class Gear(GearModel):
    """A gear with three teeth whose flanks have elements of equal length."""

    def __init__(self, profile, held, smallest):
        super().__init__(profile, held, profile.gear.pitch_radius, smallest)
        first = len(self._radii) - len(self._flank(None))
        self.radius = self._radii[first:]  # of the nodes of a flank
        self.nodes_of = np.concatenate([number[first:, 0] for number in self.tooth])
        self.compliance = self._compliance()

    def _flank(self, load_radius):
        start, tip = self.profile.flank_start, self.gear.tip_radius
        flank = halved(np.linspace(start, tip, math.ceil(abs(tip - start) / self.smallest) + 1))
        return flank[:: 1 if tip > start else -1]

    def _compliance(self):
        """Displacements of the flanks' nodes under forces on them, (2 n, 2 n)."""
        dof = (2 * self.nodes_of[:, None] + [0, 1]).ravel()
        place = np.searchsorted(self.free, dof)
        force = np.zeros((len(self.free), len(dof)))
        force[place, np.arange(len(dof))] = 1.0
        found = self.solver.solve(force)[place]
        return 0.5 * (found + found.T)


class Placed(NamedTuple):
    """A gear in the plane of the mesh: the map of its own plane, its turn and its tooth 0."""

    model: Gear
    centre: complex
    turn: complex
    mirrored: bool

    def out(self, own, direction=False):
        """Complex points or directions of the gear in the plane of the mesh."""
        turned = (np.conj(own) if self.mirrored else own) * self.turn
        return turned if direction else turned + self.centre

    def into(self, there):
        own = (there - self.centre) / self.turn
        return np.conj(own) if self.mirrored else own

    def node(self, tooth, row):
        """Number of a node of the flanks."""
        return TEETH.index(tooth) * len(self.model.radius) + row

    def flank(self, tooth):
        """Nodes of the flank of a tooth in the plane of the mesh."""
        gear = self.model.gear
        angle = gear.half_thickness(self.model.radius) + tooth * 2 * math.pi / gear.teeth
        return self.out(self.model.radius * np.exp(1j * angle))

    def foot(self, point, tooth):
        """Gap of a point to a flank, radius of its foot, and the normal into the flank.

        Parallel involutes have the same distance everywhere: base radius times angle.
        """
        gear, own = self.model.gear, self.into(point)
        radius = abs(own)
        if radius <= gear.base_radius:
            return None
        pitch = 2 * math.pi / gear.teeth
        behind = np.angle(own * np.exp(-1j * tooth * pitch))
        gap = gear.base_radius * (behind - float(gear.half_thickness(np.array(radius))))
        tangent = math.sqrt(radius**2 - gear.base_radius**2) + (gap if gear.internal else -gap)
        at = math.hypot(gear.base_radius, tangent)
        low, high = sorted((self.model.radius[0], self.model.radius[-1]))
        if tangent <= 0.0 or not low <= at <= high * (1 + 1e-12):
            return None
        angle = float(self.model.profile.load(np.array([at])).angle[0])
        inwards = 1.0 if gear.internal else -1.0
        normal = complex(inwards * math.sin(angle), -math.cos(angle))
        return gap, at, self.out(normal * np.exp(1j * tooth * pitch), direction=True)


class Contact(NamedTuple):
    """Loads of the pairs at a position, and the turn of the first gear times its base radius."""

    deflection: float
    loads: np.ndarray
    """Of the pairs `TEETH` ahead, along the line of action."""


class PlaneMesh:
    """Two gears in contact, `mesh` their `WorkingMesh`."""

    def __init__(self, mesh, first, second):
        self.mesh, self.first, self.second = mesh, first, second

    def _placed(self, position):
        mesh, along = self.mesh, position * self.mesh.base_pitch
        half = [
            float(model.gear.half_thickness(np.array(radius)))
            for model, radius in zip((self.first, self.second), mesh.pitch_radii, strict=True)
        ]
        turned = along / mesh.first.base_radius - half[0]
        first = Placed(self.first, 0.0, np.exp(1j * turned), False)
        turned = along / mesh.second.base_radius + half[1]
        if mesh.internal:
            return first, Placed(self.second, -mesh.centre_distance, np.exp(1j * turned), True)
        return first, Placed(self.second, mesh.centre_distance, -np.exp(-1j * turned), False)

    def press(self, position, force, within):
        """Contact under a force along the line of action.

        Args:
            position: of the pair 0 [base pitches].
            force: per face width.
            within: largest gap that is looked at.
        """
        placed = self._placed(position)
        gaps, arms, pairs, sides = [], [], [], ([], [])
        for tooth in TEETH:
            for slave, sign in ((0, 1), (1, -1)):
                self._touching(placed, tooth, slave, sign, within, (gaps, arms, pairs, sides))
        gap, arm, pair = np.array(gaps), np.array(arms), np.array(pairs)
        compliance = sum(
            np.array(rows) @ model.compliance @ np.array(rows).T
            for rows, model in zip(sides, (self.first, self.second), strict=True)
        )
        load = _unilateral(compliance, gap, arm, force)
        touched = load > 0.0
        opened = (compliance @ load + gap)[touched] / arm[touched]
        loads = np.array([(load * arm)[pair == tooth].sum() for tooth in TEETH])
        return Contact(float(np.average(opened, weights=load[touched])), loads)

    def _touching(self, placed, tooth, slave, sign, within, into):
        """Add the nodes of a flank that may touch the mating flank; teeth count both ways."""
        gaps, arms, pairs, sides = into
        own, mate = placed[slave], placed[1 - slave]
        for row, point in enumerate(own.flank(sign * tooth)):
            found = mate.foot(point, -sign * tooth)
            if found is None or found[0] > within:
                continue
            gap, at, normal = found
            closing = (np.conj(1j * point) * normal).real / self.mesh.first.base_radius
            gaps.append(gap)
            arms.append(closing if slave == 0 else -closing)
            pairs.append(tooth)
            rows = [np.zeros(len(side.model.compliance)) for side in placed]
            _add(rows[slave], own, own.node(sign * tooth, row), -normal)
            for number, share in _between(mate.model.radius, at):
                _add(rows[1 - slave], mate, mate.node(-sign * tooth, number), share * normal)
            for side, each in zip(sides, rows, strict=True):
                side.append(each)


def _add(row, placed, node, direction):
    own = placed.into(direction + placed.centre)
    row[2 * node] += own.real
    row[2 * node + 1] += own.imag


def _between(radii, at):
    """Nodes of a flank next to a radius, and their shares."""
    order = np.argsort(radii)
    place = np.interp(at, radii[order], np.arange(len(radii)))
    low = min(int(place), len(radii) - 2)
    return (int(order[low]), 1.0 - (place - low)), (int(order[low + 1]), place - low)


def _unilateral(compliance, gap, arm, force):
    """Loads >= 0 of least energy that carry the force."""
    size = np.trace(compliance) / len(gap)
    root = np.linalg.cholesky(compliance / size + RIDGE * np.eye(len(gap)))
    rows = np.vstack([root.T, HEAVY * arm])
    right = np.append(-np.linalg.solve(root, gap / size / force), HEAVY)
    return force * nnls(rows, right, maxiter=100 * len(gap))[0]
