"""How the records of a run depend on its operating point, for the compiled equations."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import POINT_FIELDS, Backlash, Operation, PointLaws, Train
from ..scene import OperatingPoint, Scene
from .bodies import base_radii
from .speed_loop import bandwidth, speed_loop_gains
from .static_load import parts, static_torques


def point_laws(scene: Scene, train: Train, port: list[int]) -> PointLaws:
    """Collect what depends on the operating point, and what does not.

    Args:
        scene: scene of the drive.
        train: of `build_train`.
        port: what acts on the shafts of motor and load.

    Returns:
        The laws, see core/run/operating_point.hpp.
    """
    control, mesh = scene.drive.speed_control, scene.mesh
    gains = speed_loop_gains(scene, train, bandwidth(scene))
    half_backlash_factor, least = mesh.flanks(1.0, scene.gearset.transverse.pressure_angle)
    started, torques = control.start_speed, parts(scene)
    return PointLaws(
        constant=Operation(
            backlash=Backlash(release=1.0 if mesh.backlash == "dead_zone" else 0.0),
            slew_rate=control.slew_rate,
            ripple_order=float(control.ripple_order),
            inertia=gains.inertia,
            proportional=gains.proportional,
            trim_gain=gains.trim,
            load_proportional=gains.load_proportional,
            port=port,
        ),
        half_backlash_factor=half_backlash_factor,
        from_zero=least == 0.0,
        torque=static_torques(scene),
        ratio=train.body.ratio[train.coupling.ends[: len(scene.drive.ports), 0]],
        starts_elsewhere=started is not None,
        start_speed=0.0 if started is None else started,
        force_share=[torques["sun"], torques[scene.drive.input.member]],
        force_lever=base_radii(scene)["sun"] * scene.gearset.planets,
        stiffness=float(np.min(train.teeth.stiffness)),
    )


def record_of(point: OperatingPoint) -> _core.OperatingPoint:
    """An operating point as a record.

    Args:
        point: the operating point.

    Returns:
        The record, without the temperature, of which the records of an oil are built.
    """
    return _core.OperatingPoint(**{name: getattr(point, name) for name in POINT_FIELDS})
