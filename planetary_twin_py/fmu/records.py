"""Converts a scene to the records that the library of an FMU reads, see core/fmu/exported.hpp."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from .. import _core
from .._core import DIGEST, SOURCES, VARIABLE_KINDS, Exported
from ..durability.account import Account
from ..model.cycle import common_cycles, turns_per_cycle
from ..model.error_scale import POINTS, new_integrator
from ..model.point_laws import record_of
from ..run.limits import Limits
from ..run.port_engine import DrivenEngine
from ..run.tolerance import TOLERANCES
from ..scene import Scene
from ..scene.thermal import COLDEST, HOTTEST
from .variables import Variable

SETTABLE = {"input": 1, "tunable": 1, "fixed": 2}
"""When a variable may be set: at any time, or up to the end of the initialisation."""


def build_records(scene: Scene, tolerance: float) -> Exported:
    """Build the records of a scene.

    Args:
        scene: the scene.
        tolerance: relative local error tolerance.

    Returns:
        The records, without the variables.

    Raises:
        ValueError: the tolerance is out of range, or the scene cannot be built.
    """
    engine = DrivenEngine(scene, tolerance)
    control, integrator = new_integrator(_core, "auto").control.copy(), engine.integrator
    control.acceleration_deflection, control.speed_per_deflection = (
        integrator.control.acceleration_deflection,
        integrator.control.speed_per_deflection,
    )
    least, points = zip(*POINTS, strict=True)
    exported = Exported(
        model=engine.model,
        control=control,
        pause=integrator.periodic.pause,
        limits=Limits(engine.gearbox).record,
        ranges=engine.port_ranges,
        report=engine.gearbox.report,
        laws=engine.laws,
        point=record_of(scene.operating_point),
        linear=scene.drive.interpolation == "linear",
        tolerance=tolerance,
        tolerances=TOLERANCES,
        least_tolerance=least,
        points=points,
    )
    _put_repetitions(scene, engine, exported)
    _put_warming(scene, engine, exported)
    _put_damage(scene, exported)
    return exported


def _put_repetitions(scene: Scene, engine: DrivenEngine, exported: Exported) -> None:
    """Store the number of mesh cycles in a period, without and with torque ripple."""
    operation = engine.model.operation.copy()
    for place, ripple in zip(exported.repetition, (0.0, 1.0), strict=True):
        operation.ripple = ripple
        cycles = 0 if scene.drive.ports.given else common_cycles(engine.train, operation)
        turns = abs(cycles * turns_per_cycle(engine.train)) if cycles else Fraction(0)
        place.cycles, place.numerator, place.denominator = (
            cycles, turns.numerator, turns.denominator,
        )  # fmt: skip


def _put_warming(scene: Scene, engine: DrivenEngine, exported: Exported) -> None:
    """Store the temperatures at the start, if they are states."""
    if scene.thermal is None or engine.warming is None:
        return
    place = exported.warming
    place.network, place.period = engine.warming.network, engine.warming.period
    place.starts_ambient = scene.thermal.start == "ambient"
    place.lowest, place.highest = COLDEST, HOTTEST


def _put_damage(scene: Scene, exported: Exported) -> None:
    """Store the damage of each part over that of the meshes, of which it is a linear function."""
    if scene.durability is None:
        return
    account = Account(scene, exported.report.mesh[: exported.report.meshes])
    for row, mesh in np.ndindex(exported.of_part.shape[1:]):
        sums = _core.MeshSums()
        sums.damage[row, mesh] = 1.0
        exported.of_part[: len(account.parts), row, mesh] = account.damage(sums, 1.0).damage


def put_variables(exported: Exported, variables: list[Variable]) -> None:
    """Write the variables into the records.

    Args:
        exported: the records.
        variables: variables in the order of their value references.

    Raises:
        ValueError: there are too many variables, or a name is too long.
    """
    if len(variables) > _core.VARIABLES:
        raise ValueError(f"an FMU has room for {_core.VARIABLES} variables, not {len(variables)}")
    exported.variables = len(variables)
    for place, variable in zip(exported.variable, variables, strict=False):
        name = variable.name.encode()
        if len(name) >= _core.NAME:
            raise ValueError(f"{variable.name}: must have fewer than {_core.NAME} characters")
        place.kind, place.index = VARIABLE_KINDS[variable.kind], variable.index
        settable = variable.causality if variable.causality == "input" else variable.variability
        place.given = SETTABLE.get(settable, 0)
        place.lowest, place.highest = variable.minimum, variable.maximum
        place.name = list(name)


def file_of(exported: Exported) -> bytes:
    """Make the file that the library reads: digest of the core, then the records.

    Args:
        exported: the records.

    Returns:
        Contents of the file.
    """
    return SOURCES.encode().ljust(DIGEST, b"\0") + exported.raw().tobytes()
