"""Triangle meshes as binary STL, which every robot tool reads."""

from __future__ import annotations

import numpy as np

from ..gearset.solid import TriangleMesh

_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 80  # bytes


def to_stl(mesh: TriangleMesh) -> bytes:
    """The file's content; lengths stay in metres."""
    triangles = np.zeros(len(mesh.faces), dtype=_TRIANGLE)
    # Faces are flat: the normal of a corner is that of its triangle.
    triangles["normal"] = mesh.normals[mesh.faces[:, 0]]
    triangles["corners"] = mesh.vertices[mesh.faces]
    return bytes(_HEADER) + np.uint32(len(triangles)).tobytes() + triangles.tobytes()
