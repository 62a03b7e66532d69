"""Stribeck curve of a gearbox: one mesh cycle at each of many speeds, lambda ratio computed.

Without vibration: what is looked for is the friction of a load that stays as it is.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from ..scene import Scene
from ..twin import LOWEST_SAMPLE_RATE, Twin
from ..window import Window
from .axes import Axis, Span
from .measures import row
from .plan import Point, grid, told
from .sweep import Hearer
from .work import Crew, Failure, Found

if TYPE_CHECKING:
    import pyarrow as pa

LAWS = {"dynamics": "quasi_static", "lubrication.lambda_ratio": "computed"}
"""In which the study's scene differs from the one that is given."""


@dataclass(frozen=True)
class Cycle:
    """What is done at each point; travels to other processes and machines."""

    scene: Scene
    samples: int = 256
    """In the mesh cycle; more where it is slower than a second for each."""
    tolerance: float = 1e-4

    def __call__(self, point: Point) -> Found:
        """The figures of one mesh cycle, or why there are none."""
        try:
            scene = self.scene.replace(**point.changes)
            return row(scene, self._run(scene))
        except (ValueError, ArithmeticError) as reason:
            return Failure(f"{told(point.changes)}: {reason}")

    def _run(self, scene: Scene) -> Window:
        frequency = Twin(scene, tolerance=self.tolerance).advance(_GLANCE).mesh_frequency
        if not frequency > 0.0:
            raise ValueError("the teeth do not move: must be a speed other than 0")
        rate = max(self.samples * frequency, LOWEST_SAMPLE_RATE)
        return Twin(scene, rate, self.tolerance).advance(1.0 / frequency)


_GLANCE = 1e-6  # [s] in which a twin says how fast teeth pass


def stribeck(
    scene: Scene, axis: Axis | Span, crew: Crew, hear: Hearer = lambda done, failure: None
) -> pa.Table:
    """The table of a sweep over `axis`, mostly the input speed, with `scene` under LAWS.

    Raises:
        ValueError: the axis or the scene cannot be.
    """
    from .table import tabulate

    study = grid(scene.replace(**LAWS), [axis])
    cycle = Cycle(study.scene)
    found: dict[int, Found] = {}
    for point, outcome in crew.do(cycle, study.points):
        found[point.place] = outcome
        hear(1, outcome if isinstance(outcome, Failure) else None)
    settings = asdict(cycle)
    del settings["scene"]
    table = tabulate(study, found)
    return table.replace_schema_metadata(
        {**table.schema.metadata, b"settings": json.dumps(settings).encode()}
    )
