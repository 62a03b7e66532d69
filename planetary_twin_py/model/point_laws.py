"""How the records of a run depend on its operating point, for the compiled equations."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import (
    BY_MACHINE,
    BY_MOTION,
    BY_TORQUE,
    POINT_FIELDS,
    Backlash,
    Operation,
    PointLaws,
    Train,
)
from ..scene import OperatingPoint
from .layout import Layout
from .speed_loop import Gains

_CAUSALITIES = {
    "machine": BY_MACHINE,
    "torque": BY_TORQUE,
    "motion": BY_MOTION,
    "brake": BY_MOTION,
}


def point_laws(layout: Layout, train: Train, gains: Gains) -> PointLaws:
    """Collect what depends on the operating point, and what does not.

    Args:
        layout: of the scene.
        train: of the layout.
        gains: of its speed loop.

    Returns:
        The laws, see core/run/operating_point.hpp.
    """
    scene, torques = layout.scene, layout.torques
    control, mesh = scene.drive.speed_control, scene.mesh
    half_backlash_factor, least = mesh.flanks(1.0, scene.gearset.transverse.pressure_angle)
    started = control.start_speed
    return PointLaws(
        constant=Operation(
            backlash=Backlash(release=1.0 if mesh.backlash == "dead_zone" else 0.0),
            slew_rate=control.slew_rate,
            ripple_order=float(control.ripple_order),
            inertia=gains.inertia,
            proportional=gains.proportional,
            trim_gain=gains.trim,
            load_proportional=gains.load_proportional,
            port=[_CAUSALITIES[port] for port in scene.drive.ports],
        ),
        half_backlash_factor=half_backlash_factor,
        from_zero=least == 0.0,
        torque=layout.machine_torques,
        ratio=train.body.ratio[train.coupling.ends[: len(scene.drive.ports), 0]],
        starts_elsewhere=started is not None,
        start_speed=0.0 if started is None else started,
        force_share=[torques["sun"], torques[scene.drive.input.member]],
        force_lever=layout.radii["sun"] * scene.gearset.planets,
        stiffness=float(np.min(train.teeth.stiffness)),
    )


def record_of(point: OperatingPoint) -> _core.OperatingPoint:
    """An operating point as a record.

    Returns:
        The record, without the oil's temperature, of which the records of an oil are built.
    """
    return _core.OperatingPoint(**{name: getattr(point, name) for name in POINT_FIELDS})
