"""Figure 4: mesh stiffness over the meshing cycle."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from planetary_twin_core_parts import find_segment, mesh_stiffness

from planetary_twin_py.model.gearbox import Gearbox
from planetary_twin_py.plots.style import panels
from planetary_twin_py.scene import Scene

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import agrees
from .pitch_point import KINDS, RING, SUN

SAMPLES = 2000  # of one cycle
LAWS: dict[str, dict[str, Any]] = {
    "constant (Table 4)": {"mesh.double_pair_ratio": 1.0, "mesh.ramp": 0.0},
    "rectangular": {"mesh.ramp": 0.0},
    "ramped (scene paper)": {},
    "from the teeth": {"mesh.stiffness": "involute"},
}


def meshing_cycle(evidence: Evidence) -> Entry:
    """Figure 4."""
    scene = evidence.scene
    curves = {name: _curves(scene.replace(**changes)) for name, changes in LAWS.items()}
    cycle = curves["rectangular"]
    shares = [float((k > 1.01 * k.min()).mean()) for k in cycle]
    ratios = [mesh.path.contact_ratio for mesh in scene.gearset.geometry.meshes]
    levels = [len(np.unique(np.round(k, -3))) for k in cycle]
    teeth = curves["from the teeth"]
    return Entry(
        number="Figure 4",
        title="meshing cycle of the spur gear pair",
        claims=(
            Claim(
                says="stiffness alternates between one and two tooth pairs, once per cycle",
                ours=f"{levels[SUN]} and {levels[RING]} levels; two pairs for {shares[SUN]:.1%} "
                f"(sun-planet) and {shares[RING]:.1%} (planet-ring) of the cycle",
                holds=levels == [2, 2] and agrees(shares, np.array(ratios) - 1.0, 2.0 / SAMPLES),
                printed="constant: Table 4 has no value for two pairs",
            ),
        ),
        remarks=f"The shares are the contact ratios {ratios[SUN]:.4f} and {ratios[RING]:.4f} minus "
        f"one. The stiffness of two pairs is {scene.mesh.double_pair_ratio:g} times that of one, "
        "which is the slope of c_gamma in ISO 6336-1. The stiffness computed from the teeth "
        f"(`mesh.stiffness: involute`) is {teeth[SUN].min():.2g} to {teeth[SUN].max():.2g} N/m at "
        "the sun.",
        picture=_draw(curves),
        figures={"share_of_two_pairs": shares, "contact_ratios": ratios},
    )


def _curves(scene: Scene) -> list[np.ndarray]:
    """Stiffness [N/m] of both kinds of mesh over one cycle."""
    train = Gearbox(scene).train
    first = {SUN: 0, RING: train.meshes // 2}  # mesh of each kind
    return [
        np.array(
            [
                mesh_stiffness(train, first[kind], find_segment(train, kind, x, 1.0), x)
                for x in _CYCLE
            ]
        )
        for kind in (SUN, RING)
    ]


_CYCLE = (np.arange(SAMPLES) + 0.5) / SAMPLES


def _draw(curves: dict[str, list[np.ndarray]]) -> Figure:
    figure, axes = panels(2, 2.9)
    for kind, (place, name) in enumerate(zip(axes, KINDS, strict=True)):
        for label, stiffness in curves.items():
            place.plot(_CYCLE, 1e-8 * stiffness[kind], label=label)
        place.set_title(name)
        place.set_xlabel("mesh cycles since a pair was at the pitch point")
        place.set_ylim(0, 6)
    axes[0].set_ylabel("mesh stiffness [1e8 N/m]")
    axes[0].legend(loc="lower center", ncols=2)
    return figure
