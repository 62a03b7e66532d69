"""Plane-strain elasticity of a body from its outline alone: the direct boundary element method.

The outline is a closed chain of elements with three nodes each, on which positions, displacements
and tractions are quadratic. Kelvin's solution of a point force gives what every element does to
every node (Somigliana's identity; Brebbia, Telles and Wrobel 1984, Boundary Element Techniques,
eq. 5.12 and 5.13). Lengths are metres, Young's modulus is 1 Pa; forces are per metre of width.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
POINTS = 12  # of a Gauss rule on an element
NODES = np.array([-1.0, 0.0, 1.0])  # of an element
STRESS_POINTS = np.array([-1.0, 1.0]) / math.sqrt(3.0)  # where slopes of parabolas are exact to h^3


def shapes(at: Array) -> tuple[Array, Array]:
    """Quadratic shape functions of an element and their slopes, (..., 3).

    Args:
        at: places on it, from -1 to 1, (...).
    """
    values = np.stack([0.5 * at * (at - 1.0), 1.0 - at**2, 0.5 * at * (at + 1.0)], axis=-1)
    return values, np.stack([at - 0.5, -2.0 * at, at + 0.5], axis=-1)


@dataclass(frozen=True)
class Outline:
    """A body by its outline, held along a part of it.

    Args:
        nodes: points of the outline counter-clockwise, of which every second one ends an element,
            as complex numbers [m], (2 m,).
        held: elements that do not move, (m,).
        poisson: Poisson's ratio.
    """

    nodes: Complex
    held: NDArray[np.bool_]
    poisson: float

    @cached_property
    def elements(self) -> NDArray[np.int64]:
        """Nodes of the elements, (m, 3)."""
        first = 2 * np.arange(len(self.held))
        return np.stack([first, first + 1, (first + 2) % len(self.nodes)], axis=1)

    def displacements(self, traction: Complex) -> Complex:
        """Displacements of the nodes [m].

        Args:
            traction: on the nodes of the elements, in several loads [Pa], (loads, m, 3).
        """
        pull, push = self._influence
        fixed = np.zeros(len(self.nodes), dtype=bool)
        fixed[self.elements[self.held]] = True
        unknown = push.copy()
        for element in np.flatnonzero(self.held):
            for k, node in enumerate(self.elements[element]):
                if fixed[node]:
                    unknown[:, :, node] = 0.0
                    fixed[node] = False
                unknown[:, :, node] -= pull[:, :, element, k]
        size = 2 * len(self.nodes)
        load = np.stack([traction.real, traction.imag], axis=-1)
        right = np.einsum("paekb,lekb->lpa", pull, load).reshape(len(traction), size)
        found = np.linalg.solve(unknown.reshape(size, size), right.T).T.reshape(
            *traction.shape[:1], -1, 2
        )
        found[:, self.elements[self.held].ravel()] = 0.0
        return np.asarray(found[..., 0] + 1j * found[..., 1])

    def stress(self, moved: Complex) -> Array:
        """Stress along the outline where no force acts on it [Pa], (loads, m, 2).

        Args:
            moved: displacements of the nodes, (loads, 2 m).
        """
        _, slope = shapes(STRESS_POINTS)
        along = self.nodes[self.elements] @ slope.T
        stretch = np.real((moved[:, self.elements] @ slope.T) / along)
        return np.asarray(stretch / (1.0 - self.poisson**2))

    @cached_property
    def _influence(self) -> tuple[Array, Array]:
        """What tractions and displacements of the elements do to the nodes.

        Returns:
            Of tractions on the nodes of each element, (nodes, 2, m, 3, 2), and of displacements of
            the nodes, (nodes, 2, nodes, 2).
        """
        at, weight = np.polynomial.legendre.leggauss(POINTS)
        rule = (np.broadcast_to(at, (1, POINTS)), np.broadcast_to(weight, (1, POINTS)))
        everywhere = np.arange(len(self.held))
        pull, push = self._integrals(self.nodes[:, None], everywhere, *rule)
        for k, rule in enumerate(_singular_rules(at, weight)):
            own = self.nodes[self.elements[:, k], None]
            for element in everywhere:
                node = self.elements[element, k]
                found = self._integrals(own[[element]], everywhere[[element]], *rule)
                pull[node, :, element], push[node, :, element] = (
                    found[0][0, :, 0],
                    found[1][0, :, 0],
                )
        together = np.zeros((len(self.nodes), 2, len(self.nodes), 2))
        for k in range(3):
            together[:, :, self.elements[:, k]] += push[:, :, :, k]
        itself = np.arange(len(self.nodes))
        together[itself, :, itself] = 0.0
        # a body that moves as a whole is free of stress
        together[itself, :, itself] = -together.sum(axis=2)
        return pull, together

    def _integrals(
        self, source: Complex, elements: NDArray[np.int64], at: Array, weight: Array
    ) -> tuple[Array, Array]:
        """Integrals of Kelvin's tractions and displacements over elements, (n, 2, m, 3, 2).

        Args:
            source: where the point forces act, (n, 1).
            elements: the elements, (m,).
            at: places on them, (1, points).
            weight: of the places, (1, points).
        """
        nu, shear = self.poisson, 0.5 / (1.0 + self.poisson)
        value, slope = shapes(at[0])
        corner = self.nodes[self.elements[elements]]
        field, along = corner @ value.T, corner @ slope.T  # (m, points)
        arc = np.abs(along) * weight
        apart = field - source[..., None]
        distance = np.abs(apart)
        towards, normal = apart / distance, -1j * along / np.abs(along)
        unit = np.stack([towards.real, towards.imag], axis=-1)
        out = np.broadcast_to(np.stack([normal.real, normal.imag], axis=-1), unit.shape)
        both = unit[..., :, None] * unit[..., None, :]
        turned = out[..., :, None] * unit[..., None, :] - unit[..., :, None] * out[..., None, :]
        leaving = np.sum(unit * out, axis=-1)[..., None, None]
        same = np.eye(2)
        factor = 1.0 / (8.0 * math.pi * shear * (1.0 - nu))
        pull = factor * (both - (3.0 - 4.0 * nu) * np.log(distance)[..., None, None] * same)
        push = leaving * ((1.0 - 2.0 * nu) * same + 2.0 * both) + (1.0 - 2.0 * nu) * turned
        push = push / (-4.0 * math.pi * (1.0 - nu) * distance[..., None, None])
        scaled = arc[..., None] * value  # (m, points, 3)
        return tuple(np.einsum("nmpab,mpk->namkb", each, scaled) for each in (pull, push))


def _singular_rules(at: Array, weight: Array) -> list[tuple[Array, Array]]:
    """Rules for an element around each of its own nodes, where the integrands are logarithmic.

    Cubes of the places of a Gauss rule cluster at the node (after Telles 1987, Int. J. Numer.
    Methods Eng. 24, 959).
    """
    half = 0.5 * (at + 1.0)
    rules = []
    for node in NODES:
        places, weights = [], []
        for end in (-1.0, 1.0):
            length = end - node
            if length != 0.0:
                places.append(node + length * half**3)
                weights.append(abs(length) * 1.5 * half**2 * weight)
        rules.append((np.concatenate(places)[None], np.concatenate(weights)[None]))
    return rules
