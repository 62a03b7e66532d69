"""Prints the oil of a scene, and its tooth loss by two friction laws."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from ..scene import Scene


def print_oil(console: Console, scene: Scene) -> dict[str, Any]:
    """Print the oil of a scene, unless its teeth have no friction at the operating point.

    Args:
        console: where to print.
        scene: the scene.

    Returns:
        The figures for JSON, by `oil`.
    """
    from ..explanation.oil import oil_figures

    oil = oil_figures(scene)
    if oil is None:
        return {"oil": None}
    for line in oil.lines:
        console.print(line, markup=False)
    return {"oil": oil.as_figures()}
