"""Stribeck curve of a gearbox: one mesh cycle at each of many speeds, lambda ratio computed.

The model is quasi-static, so that the load is the same at all speeds.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from ..run.twin import Twin
from ..run.window import Window
from ..run.window_plan import LOWEST_SAMPLE_RATE
from ..scene import Scene
from ..scene.other_dynamics import static_dynamics, under
from .axes import Axis, Normal, Span
from .measures import row
from .plan import Point, describe, grid
from .sweep import sweep
from .work import Executor, Failure, Found, Report

if TYPE_CHECKING:
    import pyarrow as pa


def stribeck_scene(scene: Scene) -> Scene:
    """The scene of a Stribeck curve: quasi-static with the axes of a scene, lambda ratio computed.

    Args:
        scene: the gearbox; with dynamics: auto, the axes are held.
    """
    still = under(scene, static_dynamics(scene))
    return scene.replace(**still, **{"lubrication.lambda_ratio": "computed"})


@dataclass(frozen=True)
class CycleEvaluation:
    """Evaluates one mesh cycle at a point; it is pickled for other processes."""

    scene: Scene
    samples: int = 256
    """Samples per mesh cycle; more if the cycle takes longer than a second for each."""
    tolerance: float = 1e-4

    def __call__(self, point: Point) -> Found:
        """Results of one mesh cycle, or the failure."""
        try:
            scene = self.scene.replace(**point.changes)
            return row(scene, self._run(scene))
        except (ValueError, ArithmeticError) as reason:
            return Failure(f"{describe(point.changes)}: {reason}")

    def _run(self, scene: Scene) -> Window:
        frequency = Twin(scene, tolerance=self.tolerance).advance(_SHORT).mesh_frequency
        if not frequency > 0.0:
            raise ValueError("the mesh frequency is 0: give a speed other than 0")
        rate = max(self.samples * frequency, LOWEST_SAMPLE_RATE)
        return Twin(scene, rate, self.tolerance).advance(1.0 / frequency)


_SHORT = 1e-6  # [s], a run from which to read the mesh frequency


def stribeck(
    scene: Scene,
    axis: Axis | Span | Normal,
    executor: Executor,
    report: Report = lambda done, failure: None,
) -> pa.Table:
    """Sweep over `axis`, usually the input speed, with the scene of `stribeck_scene`.

    Args:
        scene: the gearbox.
        axis: field and its values.
        executor: runs the points.
        report: called with the number of points completed since the last call, and the failure.

    Returns:
        A row per point, as from `sweep`.

    Raises:
        ValueError: the axis or the scene is invalid.
    """
    study = grid(stribeck_scene(scene), [axis])
    evaluation = CycleEvaluation(study.scene)
    table = sweep(study, executor, report=report, evaluate=evaluation)
    settings = asdict(evaluation)
    del settings["scene"]
    return table.replace_schema_metadata(
        {**table.schema.metadata, b"settings": json.dumps(settings).encode()}
    )
