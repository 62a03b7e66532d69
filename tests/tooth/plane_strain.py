"""A gear with a few teeth as nine-node finite elements in plane strain.

An oracle that shares nothing with the beam and the ring of the model but the outline of a tooth.
Blocks of elements are mapped onto the body and the teeth, and joined where their nodes coincide.
Lengths are metres, the material has E = 1 Pa; forces are per metre of face width.
"""

import math
from itertools import product

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from planetary_twin_py.tooth.profile import POINTS

GAUSS = np.array([-math.sqrt(0.6), 0.0, math.sqrt(0.6)]), np.array([5.0, 8.0, 5.0]) / 9.0


def quadratic(x):
    """Shape functions and their slopes at x for nodes at -1, 0, 1."""
    return (
        np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]),
        np.array([x - 0.5, -2 * x, x + 0.5]),
    )


def stiffness_matrix(nodes, elements, nu):
    lame = nu / ((1 + nu) * (1 - 2 * nu))
    shear = 1 / (2 * (1 + nu))
    law = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
    xy = nodes[elements]
    matrix = np.zeros((len(elements), 18, 18))
    for (x, wx), (y, wy) in product(zip(*GAUSS, strict=True), repeat=2):
        (nx, dx), (ny, dy) = quadratic(x), quadratic(y)
        local = np.stack([np.outer(dx, ny).ravel(), np.outer(nx, dy).ravel()])
        jacobian = np.einsum("an,enb->eab", local, xy)
        size = np.linalg.det(jacobian)
        slope = np.linalg.solve(jacobian, np.broadcast_to(local, (len(xy), 2, 9)))
        strain = np.zeros((len(xy), 3, 18))
        strain[:, 0, 0::2] = strain[:, 2, 1::2] = slope[:, 0]
        strain[:, 1, 1::2] = strain[:, 2, 0::2] = slope[:, 1]
        matrix += (wx * wy * np.abs(size))[:, None, None] * (
            strain.transpose(0, 2, 1) @ law @ strain
        )
    dof = (2 * elements[:, :, None] + [0, 1]).reshape(len(elements), 18)
    rows, columns = np.repeat(dof, 18, axis=1).ravel(), np.tile(dof, 18).ravel()
    return coo_array((matrix.ravel(), (rows, columns))).tocsc()


class Blocks:
    """Blocks of nine-node elements; each an array (2 a + 1, 2 b + 1) of complex points."""

    def __init__(self):
        self.points, self.elements, self.count = [], [], 0

    def add(self, grid):
        number = self.count + np.arange(grid.size).reshape(grid.shape)
        a, b = np.meshgrid(
            np.arange(0, grid.shape[0] - 2, 2), np.arange(0, grid.shape[1] - 2, 2), indexing="ij"
        )
        around = [number[a + i, b + j].ravel() for i in range(3) for j in range(3)]
        self.elements.append(np.stack(around, axis=1))
        self.points.append(grid.ravel())
        self.count += grid.size
        return number

    def joined(self, tolerance):
        """Nodes (n, 2), elements, and the node of each point added."""
        at = np.concatenate(self.points)
        xy = np.stack([at.real, at.imag], axis=1)
        same = cKDTree(xy).query_pairs(tolerance, output_type="ndarray")
        links = coo_array((np.ones(len(same)), tuple(same.T)), shape=(len(at), len(at)))
        _, node = connected_components(links, directed=False)
        _, first = np.unique(node, return_index=True)
        return xy[first], node[np.concatenate(self.elements)], node


def halved(breaks):
    """Breakpoints with the middles between them, as nine-node elements have."""
    middles = 0.5 * (breaks[1:] + breaks[:-1])
    return np.sort(np.concatenate([breaks, middles]))


def towards(length, smallest, growth):
    """Breakpoints from 0 to `length` that start at `smallest` and grow."""
    steps = [smallest]
    while sum(steps) < length:
        steps.append(min(steps[-1] * growth, length / 6))
    return np.concatenate([[0.0], np.cumsum(steps) * length / sum(steps)])


class GearModel:
    """A loaded tooth and its two neighbours on the gear body held at `held` root radii.

    `load_radius` [m] is where the elements are refined down to `smallest` [m], at the flank.
    """

    JOINT = 0.3  # share of the fillet that is meshed with the body
    CRACK = 6  # row of the critical section

    def __init__(self, profile, held, load_radius, smallest, cracked=0, nu=0.3):
        self.profile, self.gear, self.nu = profile, profile.gear, nu
        self.smallest, self.cracked = smallest, 2 * cracked
        self.blocks = Blocks()
        self._columns = self._across()
        self._radii, self._halves = self._along(load_radius)
        self.tooth = self._teeth()
        self._body(held * self.gear.root_radius)
        self.nodes, self.elements, joined = self.blocks.joined(1e-4 * smallest)
        self.tooth = [joined[number] for number in self.tooth]
        self.fixed = joined[self.held]
        self._factorise()

    def _across(self):
        """From the loaded flank (+1) to the other (-1), fine at the loaded one."""
        width = (
            2
            * self.gear.pitch_radius
            * float(self.gear.half_thickness(np.array(self.gear.pitch_radius)))
        )
        steps = towards(1.0, self.smallest / width, 1.35)
        return halved(1.0 - 2.0 * steps)[::-1]

    def _along(self, load_radius):
        """Radii and half angles of the rows of a tooth, through the load."""
        height, _ = (x[:POINTS] for x in self.profile.outline)
        critical = np.interp(self.profile.critical_height, height, np.linspace(0, 1, POINTS))
        t = np.concatenate(
            [np.linspace(self.JOINT, critical, self.CRACK + 1), np.linspace(critical, 1.0, 7)[1:]]
        )
        radius, half = self.profile.fillet(t)
        flank = self._flank(load_radius)
        return (
            np.concatenate([radius, flank[1:]]),
            np.concatenate([half, self.gear.half_thickness(flank[1:])]),
        )

    def _flank(self, load_radius):
        """Radii of the rows of the flank from its start to the tip."""
        start, tip = self.profile.flank_start, self.gear.tip_radius
        down, up = (
            load_radius
            + math.copysign(1.0, end - load_radius)
            * towards(abs(end - load_radius), self.smallest, 1.35)
            for end in (start, tip)
        )
        flank = halved(np.sort(np.concatenate([down, up[1:]])))
        return flank[:: 1 if tip > start else -1]

    def _teeth(self):
        grid = self._radii[:, None] * np.exp(1j * self._halves[:, None] * self._columns)
        pitch = 2 * math.pi / self.gear.teeth
        self.crack_depth = float(abs(grid[self.CRACK, 0] - grid[self.CRACK, self.cracked]))
        above = grid[self.CRACK :].copy()
        above[0, : self.cracked] += (
            0.01 * self.smallest * np.sign(above[1, 0].real - above[0, 0].real)
        )
        loaded = [self.blocks.add(part) for part in (grid[: self.CRACK + 1], above)]
        return [
            np.concatenate([loaded[0], loaded[1][1:]]),
            *(self.blocks.add(grid * np.exp(1j * k * pitch)) for k in (1, -1)),
        ]

    def _body(self, held):
        pitch = 2 * math.pi / self.gear.teeth
        t = np.linspace(0.0, self.JOINT, 7)
        radius, half = self.profile.fillet(t)
        base = self._halves[0] * self._columns[::-1]  # from -half to half
        joint = np.full(len(base), self._radii[0])
        angle = np.concatenate([-half, base[1:-1], half[::-1]])
        outer = np.concatenate([radius, joint[1:-1], radius[::-1]])
        root = self.gear.root_radius
        land = np.linspace(half[0], pitch - half[0], 7)
        angle = np.concatenate([angle, land[1:]])
        outer = np.concatenate([outer, np.full(6, root)])
        angle = np.concatenate([angle - pitch, angle[1:], angle[1:] + pitch])
        outer = np.concatenate([outer, outer[1:], outer[1:]])
        rest = np.linspace(angle[-1], angle[0] + 2 * math.pi, 121)
        angle = np.concatenate([angle, rest[1:]])
        outer = np.concatenate([outer, np.full(120, root)])
        share = halved(towards(1.0, 0.01, 1.3))
        radial = outer + (held - outer) * share[:, None]
        number = self.blocks.add(radial * np.exp(1j * angle))
        self.held = number[-1]

    def _factorise(self):
        matrix = stiffness_matrix(self.nodes, self.elements, self.nu)
        held = np.zeros(len(self.nodes), dtype=bool)
        held[self.fixed] = True
        self.free = np.flatnonzero(~np.repeat(held, 2))
        self.solver = splu(matrix[self.free][:, self.free])

    def solve(self, force):
        """Displacements (n, 2) under nodal forces (n, 2)."""
        moved = np.zeros(2 * len(self.nodes))
        moved[self.free] = self.solver.solve(force.ravel()[self.free])
        return moved.reshape(-1, 2)

    def press(self, load_radius, half_width):
        """Elliptic pressure of resultant 1 on the loaded flank: forces (n, 2) and direction."""
        flank = self.tooth[0][:, 0]
        radius = np.hypot(*self.nodes[flank].T)
        along = np.hypot(
            *(self.nodes[flank] - self.nodes[flank][int(np.argmin(abs(radius - load_radius)))]).T
        )
        along = np.copysign(along, radius - load_radius)
        crossing, angle = self.profile.load(np.array([load_radius]))
        inwards = 1.0 if self.gear.internal else -1.0
        direction = np.array([inwards * math.sin(angle[0]), -math.cos(angle[0])])
        share = np.zeros(len(flank))
        points, weights = np.polynomial.legendre.leggauss(8)
        for i in range(0, len(flank) - 2, 2):
            ends = along[i], along[i + 1], along[i + 2]
            for x, w in zip(points, weights, strict=True):
                shape, slope = quadratic(x)
                s, ds = shape @ ends, abs(slope @ ends)
                if abs(s) < half_width:
                    share[i : i + 3] += w * ds * shape * math.sqrt(1 - (s / half_width) ** 2)
        share /= share.sum()
        force = np.zeros_like(self.nodes)
        np.add.at(force, flank, share[:, None] * direction)
        return force, direction, crossing[0]

    def centre_line(self, moved, crossing, tooth=0):
        """Displacement (2,) of the centre line at height `crossing` of a tooth, its own axes."""
        number = self.tooth[tooth]
        at = self.nodes[number] @ np.array([1, 1j])
        turn = np.exp(-1j * np.array([0, 1, -1])[tooth] * 2 * math.pi / self.gear.teeth)
        local, displaced = at * turn, (moved[number] @ np.array([1, 1j])) * turn
        chord = self.gear.root_radius * math.cos(self.profile.root_half_angle)
        x = chord + (-crossing if self.gear.internal else crossing)
        rows = [
            [np.interp(0.0, local[i, ::-1].imag, part[i, ::-1]) for i in range(len(local))]
            for part in (displaced.real, displaced.imag)
        ]
        order = np.argsort(local[:, 0].real)
        place = np.abs(self._radii)[order]
        return np.array([np.interp(x, place, np.array(row)[order]) for row in rows])
