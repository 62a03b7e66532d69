"""A scene as it is computed: the description from which runs and studies start."""

from __future__ import annotations

from functools import cached_property
from types import ModuleType

from .._core import Operation, PointLaws, Report, Train, operation_at
from ..scene import OperatingPoint
from ..scene.other_dynamics import under
from .bodies import Bodies, BodyNames, MeshNames, body_names, build_bodies, build_report, mesh_names
from .layout import Layout
from .library import library
from .point_laws import point_laws, record_of
from .speed_loop import default_bandwidth, speed_loop_gains
from .train import build_train


class Gearbox(Layout):
    """A scene translated to bodies, meshes and laws; computed once, when first read.

    Args:
        scene: the scene. Its operating point is that at the start of a run.
    """

    @property
    def core(self) -> ModuleType:
        """Build of the core on which the scene runs, see `library`."""
        return library(self.scene)

    @cached_property
    def bodies(self) -> Bodies:
        """Bodies that are integrated."""
        return build_bodies(self)

    @cached_property
    def body_names(self) -> BodyNames:
        """Bodies that a result reports."""
        return body_names(self, self.bodies)

    @cached_property
    def mesh_names(self) -> MeshNames:
        """Meshes that a result reports."""
        return mesh_names(self)

    @cached_property
    def report(self) -> Report:
        """What the core reports: all bodies and meshes, in the order of their names."""
        return build_report(self, self.body_names, self.mesh_names)

    @cached_property
    def train(self) -> Train:
        """Arrays for the core. They do not depend on quantities that may change in a run.

        Raises:
            ValueError: there is an instant without contact of teeth (see `pair_table`).
        """
        return build_train(self, self.bodies)

    @property
    def held(self) -> Gearbox:
        """The same with held axes, for results that do not depend on their motion."""
        return self._held if self.scene.moving_axes else self

    @cached_property
    def _held(self) -> Gearbox:
        return Gearbox(self.scene.model_copy(update=under(self.scene, "torsional")))

    @cached_property
    def bandwidth(self) -> float:
        """Bandwidth of the speed loop [Hz]: given by the scene, or derived from its train.

        Raises:
            ValueError: there is an instant without contact of teeth.
        """
        given = self.scene.drive.speed_control.bandwidth
        return default_bandwidth(self, self.held.train) if given is None else given

    @cached_property
    def laws(self) -> PointLaws:
        """How the operation depends on the operating point."""
        return point_laws(self, self.train, speed_loop_gains(self, self.train, self.bandwidth))

    def operation(self, point: OperatingPoint) -> Operation:
        """Loads on the train at an operating point.

        Returns:
            Backlash, torques and speeds; what is prescribed is that of steady running there.
        """
        operation: Operation = operation_at(self.laws, record_of(point))
        return operation
