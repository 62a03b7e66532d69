"""Losses that a scene contains, and those that it leaves out."""

from __future__ import annotations

from ..scene import Scene

KINDS = ("planet", "sun", "ring", "carrier")


def bearings_with_losses(scene: Scene) -> list[str]:
    """Kinds of members whose bearings have losses."""
    return [kind for kind in KINDS if getattr(scene.losses, f"{kind}_bearing") is not None]


def members_with_drag(scene: Scene) -> list[str]:
    """Members with a drag of seals and grease."""
    drags = {kind: getattr(scene.losses, f"{kind}_drag") for kind in ("sun", "ring", "carrier")}
    return [kind for kind, drag in drags.items() if drag.coulomb or drag.viscous]


def losses(scene: Scene) -> tuple[list[str], list[str]]:
    """Names of the losses that power loss and efficiency contain, and of those left out."""
    contained = {
        "tooth friction": scene.lubrication.friction,
        "bearings": bool(bearings_with_losses(scene)),
        "seals and grease": bool(members_with_drag(scene)),
        "churning": scene.losses.churning is not None,
    }
    names = [name for name, there in contained.items() if there]
    return names, [name for name, there in contained.items() if not there]


def losses_in_words(scene: Scene) -> str:
    """For example "tooth friction only, without bearings, seals and grease, churning"."""
    contained, missing = losses(scene)
    if not contained:
        return "the scene has no losses"
    only = " only" if len(contained) == 1 else ""
    without = f", without {', '.join(missing)}" if missing else ""
    return f"{', '.join(contained)}{only}{without}"
