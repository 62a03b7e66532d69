"""Extrusion of flat shapes in polar coordinates to triangle meshes."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class TriangleMesh:
    """Triangles with one normal per vertex."""

    vertices: NDArray[np.float32]
    """[m], (n, 3)."""
    normals: NDArray[np.float32]
    """Unit vectors, (n, 3)."""
    faces: NDArray[np.uint32]
    """Indices of vertices, (m, 3)."""

    def __add__(self, other: TriangleMesh) -> TriangleMesh:
        return TriangleMesh(
            np.concatenate((self.vertices, other.vertices)),
            np.concatenate((self.normals, other.normals)),
            np.concatenate((self.faces, other.faces + np.uint32(len(self.vertices)))),
        )

    def twisted(self, rate: float) -> TriangleMesh:
        """The same body with each section turned about the z axis in proportion to its z.

        Args:
            rate: turn [rad] per z [m].

        Returns:
            The twisted body; its normals are turned with their sections.
        """
        turn = rate * self.vertices[:, 2]
        c, s = np.cos(turn), np.sin(turn)

        def turned(points: NDArray[np.float32]) -> NDArray[np.float32]:
            x, y, z = points.T
            return np.column_stack((c * x - s * y, s * x + c * y, z)).astype(np.float32)

        return TriangleMesh(turned(self.vertices), turned(self.normals), self.faces)


def extrude(
    inner: NDArray[np.float64] | float,
    outer: NDArray[np.float64] | float,
    low: float,
    high: float,
    layers: int = 1,
) -> TriangleMesh:
    """Solid between two closed outlines about the z axis; faces share no vertices.

    Args:
        inner: outline as polar points (radius [m], angle [rad]) counter-clockwise, (n, 2), or
            radius [m]; 0 for a solid without hole. At least one outline must be points; two must
            have the same angles.
        outer: as `inner`.
        low: lowest z [m].
        high: highest z [m].
        layers: number of layers of the walls along z, for a body that is twisted afterwards.

    Returns:
        The closed surface.
    """
    angles = next(edge[:, 1] for edge in (inner, outer) if isinstance(edge, np.ndarray))
    edges = [
        edge
        if isinstance(edge, np.ndarray)
        else np.column_stack((np.full_like(angles, edge), angles))
        for edge in (inner, outer)
    ]
    inside, outside = (
        np.column_stack((r * np.cos(a), r * np.sin(a))) for r, a in (edge.T for edge in edges)
    )
    thick = np.linalg.norm(outside - inside, axis=1) > 1e-9 * np.abs(outside).max()
    walled = thick | np.roll(thick, -1)  # no solid where the outlines coincide
    mesh = _face(inside, outside, high, up=True) + _face(inside, outside, low, up=False)
    levels = np.linspace(low, high, layers + 1)
    for below, above in itertools.pairwise(levels):
        mesh += _wall(outside, walled, below, above)
        if not np.allclose(inside, 0.0):
            mesh += _wall(inside[::-1], np.roll(walled[::-1], -1), below, above)
    return mesh


def circle(radius: float) -> NDArray[np.float64]:
    """A circle of a radius [m] as polar points (radius [m], angle [rad]), (64, 2)."""
    return np.column_stack((np.full(64, radius), np.linspace(0, 2 * np.pi, 64, False)))


def _quads(corners: list[NDArray[np.float64]], normals: NDArray[np.float64]) -> TriangleMesh:
    """One flat quadrilateral per row: corners a, b, c, d counter-clockwise seen from outside."""
    rows = len(normals)
    vertices = np.stack(corners, axis=1).reshape(-1, 3)
    first = 4 * np.arange(rows)[:, None]
    faces = np.concatenate((first + np.array([0, 1, 2]), first + np.array([0, 2, 3])))
    flat = TriangleMesh(
        vertices.astype(np.float32),
        np.repeat(normals, 4, axis=0).astype(np.float32),
        faces.astype(np.uint32),
    )
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return TriangleMesh(flat.vertices, flat.normals, flat.faces[area > 1e-9 * area.max()])


def _at(points: NDArray[np.float64], z: float) -> NDArray[np.float64]:
    return np.column_stack((points, np.full(len(points), z)))


def _face(
    inside: NDArray[np.float64], outside: NDArray[np.float64], z: float, up: bool
) -> TriangleMesh:
    """The annulus between the outlines at height `z`, seen from above or from below."""
    corners = [inside, outside, np.roll(outside, -1, 0), np.roll(inside, -1, 0)]
    normals = np.tile([0.0, 0.0, 1.0 if up else -1.0], (len(inside), 1))
    return _quads([_at(points, z) for points in (corners if up else corners[::-1])], normals)


def _wall(
    points: NDArray[np.float64], kept: NDArray[np.bool_], low: float, high: float
) -> TriangleMesh:
    """Side of the solid from each `kept` point to the next; its outside is on their right."""
    following = np.roll(points, -1, 0)[kept]
    points = points[kept]
    along = following - points
    normals = np.column_stack((along[:, 1], -along[:, 0], np.zeros(len(along))))
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    corners = [_at(points, low), _at(following, low), _at(following, high), _at(points, high)]
    return _quads(corners, normals)
