"""What whoever reads the figures of a run must know of it, in lines."""

from __future__ import annotations

from collections.abc import Iterator

from ..result import Result
from ..scene import Scene
from ..studies.measures import SIDES

TOLD = 0.01  # share of the time in contact from which a clipped friction is told


def clipped_friction(scene: Scene, run: Result) -> dict[str, float]:
    """Share of the time in contact in which viscous friction is clipped to zero, by `SIDES`.

    Then no tooth pair of a mesh has any though they carry load. That friction fades out at the
    pitch point does not count: `viscous_friction` is that of the plateau there, too. 0 of a scene
    without friction, or a run without contact.
    """
    planets, shares = len(run.meshes) // 2, []
    for meshes in (slice(planets), slice(planets, None)):
        loaded = run.mesh_force[:, meshes] != 0.0
        clipped = loaded & (run.viscous_friction[:, meshes] == 0.0)
        rubs = scene.lubrication.friction and loaded.any()
        shares.append(clipped.sum() / loaded.sum() if rubs else 0.0)
    return dict(zip(SIDES, map(float, shares), strict=True))


def remarks(scene: Scene, run: Result) -> Iterator[str]:
    """What limits the figures of a `run` of `scene`."""
    told = [
        f"{100.0 * share:.3g} % ({side.replace('_', '-')} meshes)"
        for side, share in clipped_friction(scene, run).items()
        if share > TOLD
    ]
    if told:
        yield (
            f"viscous friction is clipped to zero for {' and '.join(told)} of the time in contact: "
            "the pressure is too low for its law, and the power loss comes out too low"
        )
