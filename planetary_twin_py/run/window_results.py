"""Results of a window, from the records of the core."""

from __future__ import annotations

from dataclasses import replace

from .._core import PUBLISHED, MeshSums, WindowEnd
from ..durability.account import Account
from ..durability.damage import Damage
from ..durability.turning import PARTS as SHAFT_PARTS
from ..durability.turning import read_turning
from ..gearset.kinematics import mesh_frequency
from ..model.clock import TICKS
from ..model.gearbox import Gearbox
from .axes.motion import axes_of_waves
from .counters import Course
from .interface import Run
from .warming import mean_heat
from .window import Waveform, Window, by_name
from .window_plan import Plan


class WindowResults:
    """Computes the results of windows of a scene."""

    def __init__(self, gearbox: Gearbox) -> None:
        scene, train = gearbox.scene, gearbox.train
        self._core, self._train, self._report = gearbox.core, train, gearbox.report
        self._bodies, self._meshes = gearbox.body_names.names, gearbox.mesh_names.names
        members = [machine.member for machine in gearbox.machines.values()]
        self._members = tuple(self._bodies.index(member) for member in members)
        self._teeth, self._sun = scene.gearset.tooth_numbers, self._bodies.index("sun")
        self._planets = scene.gearset.planets
        places = gearbox.mesh_names.place
        self._account = Account(scene, places) if scene.durability is not None else None
        self._shafts = self._account is not None and not set(SHAFT_PARTS).isdisjoint(
            self._account.parts
        )
        self._warms = scene.thermal is not None
        self._sums: MeshSums | None = None
        self.point = scene.operating_point
        """The present operating point."""
        # Views of the record, which is filled again for every window.
        record = self._record = gearbox.core.Figures()
        bodies, count = len(self._bodies), int(train.machines)
        self._angle, self._mean_speed = record.angle[:bodies], record.mean_speed[:bodies]
        self._machine_speed = record.machine_speed[:count]
        self._machine_torque = record.machine_torque[:count]
        self._machine_power = record.machine_power[:count]
        self._statistics = record.statistics[:, : len(self._meshes)]

    def evaluate(self, begin: WindowEnd, end: WindowEnd, plan: Plan) -> None:
        """Compute means, powers and statistics of a window.

        Args:
            begin: record of the run at the start of the window.
            end: record of the run at its end.
            plan: the window.
        """
        duration = (plan.end - plan.begin) / TICKS
        self._sums = end.sums
        self._core.window_figures(self._train, self._report, begin, end, duration, self._record)
        self._heat = mean_heat(begin, end, duration) if self._warms else {}

    def window(self, plan: Plan, tolerance: float, course: Course, run: Run) -> Window:
        """Assemble the results of the window that was evaluated last.

        Args:
            plan: the window, with its samples.
            tolerance: relative local error tolerance.
            course: counters of the window, which show its accuracy.
            run: the run at its end.
        """
        mean_speed, record = self._mean_speed.copy(), self._record
        published = plan.waves.asked_of_meshes[:PUBLISHED]
        mesh = by_name(self._statistics.copy())
        frequency = mesh_frequency(self._teeth, mean_speed[self._sun], mean_speed[-1])
        return Window(
            start=plan.begin / TICKS,
            end=plan.end / TICKS,
            tolerance=tolerance,
            sample_rate=plan.rate,
            repeated=plan.repeated,
            bodies=self._bodies,
            meshes=self._meshes,
            waveform=Waveform(plan.waves.time, *published, period=1.0 / plan.rate),
            mesh=mesh,
            angle=self._angle.copy(),
            mean_speed=mean_speed,
            mesh_frequency=frequency,
            machine_speed=self._machine_speed.copy(),
            machine_torque=self._machine_torque.copy(),
            machine_power=self._machine_power.copy(),
            power_loss=record.power_loss,
            stored_power=record.stored_power,
            stored_energy=record.stored_energy,
            residual_power=record.residual_power,
            course=course,
            given=dict(plan.given),
            axes=axes_of_waves(plan.waves, self._planets, mesh["mesh_force_mean"], frequency),
            members=self._members,
            sensors=dict(plan.sensors),
            point=self.point,
            severities=run.severities,
            damage=self._damage(plan, run),
            temperatures={} if run.warming is None else run.warming.temperatures,
            heat=self._heat,
        )

    def _damage(self, plan: Plan, run: Run) -> Damage | None:
        if self._account is None or self._sums is None:
            return None
        found = self._account.damage(self._sums, (plan.end - plan.begin) / TICKS)
        return replace(found, turning=read_turning(run.passages)) if self._shafts else found
