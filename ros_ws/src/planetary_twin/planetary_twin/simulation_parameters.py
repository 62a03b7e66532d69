"""What the simulation node can be told: its parameters, and what they mean together."""

from __future__ import annotations

from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from rclpy.parameter import Parameter

import planetary_twin_py as pt
from planetary_twin_py.affordable import Affordable, Setting, settings_of
from planetary_twin_py.run import check_point
from planetary_twin_py.tolerance import AUTOMATIC, LIVE_TOLERANCE, TOLERANCES, ladder_of

from .audience import PATIENCE
from .parameters import (
    coerce,
    declare_bounded,
    declare_fixed,
    declare_geometry,
    declare_rate_factor,
    declare_tunable,
)

TOLERANCE = pt.Tunable(
    "tolerance",
    "",
    "relative error of a step; 0: the tightest that the time left allows",
    AUTOMATIC,
    TOLERANCES[1],
)
_SPEEDS = ("input_speed", "second_input_speed")


class SimulationParameters:
    """
    Declares them on `node`, refuses what cannot be, and says what they ask for.

    Raises `ValueError` where one that is given at the start is out of its range.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        name = declare_fixed(node, "scene", "paper", "packaged scene, or path of a YAML file")
        self.frame: str = declare_fixed(node, "frame_id", "gearbox", "frame of the gearbox's base")
        self.frame_prefix: str = declare_fixed(
            node, "frame_prefix", "", "before the names of all frames; for several twins"
        )
        self.tf: bool = declare_fixed(
            node, "tf", True, "publish /tf; false where robot_state_publisher does"
        )
        self.rate = declare_bounded(
            node, "publish_rate", 100.0, (10.0, 1000.0), "messages per simulated second [Hz]"
        )
        self.wait_for: str = declare_fixed(
            node,
            "wait_for",
            "",
            f"node that records, such as the logger: the twin begins when it has subscribed, "
            f"after {PATIENCE:g} s at most, and waits for it above real time and in steps",
        )
        self.clock: bool = declare_fixed(node, "clock", False, "publish simulated time on /clock")
        self.sample_rate = declare_bounded(
            node, "sample_rate", 50e3, (1e3, 1e6), "samples of mesh_waveform [Hz]"
        )
        self.rate_factor = declare_rate_factor(node)
        self._compute_share = declare_bounded(
            node,
            "compute_share",
            0.4,
            (0.05, 0.9),
            "share of the time that computing may take where the tolerance is automatic [-]",
        )
        ladder_of(declare_tunable(node, TOLERANCE, AUTOMATIC, "/diagnostics"))
        self.scene = pt.load_scene(name)
        """As loaded, at the operating point given at the start."""
        declare_geometry(node, "gearset", self.scene.gearset)
        for tunable in self.scene.tunables.values():
            default = getattr(self.scene.operating_point, tunable.name)
            declare_tunable(node, tunable, default, "operating_point")
        self.scene = self.scene_now()
        check_point(self.scene, self.scene.operating_point)
        numbers = {*pt.TUNABLES, TOLERANCE.name}
        node.add_pre_set_parameters_callback(lambda given: coerce(given, numbers))
        node.add_on_set_parameters_callback(self._validate)

    @property
    def period(self) -> float:
        """Wall time for an interval [s]; the simulated time where it goes as fast as it can."""
        return 1.0 / (self.rate * (self.rate_factor or 1.0))

    def point(self) -> dict[str, float]:
        """Return the operating point asked for now."""
        return {name: self._node.get_parameter(name).value for name in pt.TUNABLES}

    def scene_now(self) -> pt.Scene:
        """Return the scene at that operating point."""
        return self.scene.replace(**self.point())

    def affordable(self, twin: pt.Twin) -> Affordable:
        """Return what chooses the setting as asked for, from the twin's present one on."""
        wanted = self._node.get_parameter(TOLERANCE.name).value
        begin = Setting(twin.tolerance, twin.sample_rate)
        if self.rate_factor:
            settings = settings_of(ladder_of(wanted), self.sample_rate)
        else:  # nothing to keep up with
            settings = [Setting(wanted or LIVE_TOLERANCE, self.sample_rate)]
        return Affordable(settings, self._compute_share, self.period, begin)

    def _validate(self, parameters: list[Parameter]) -> SetParametersResult:
        try:
            changed = self.scene.replace(**self.point() | tunables(parameters))
            if any(p.name in _SPEEDS for p in parameters):
                check_point(self.scene, changed.operating_point)
            for wanted in (p.value for p in parameters if p.name == TOLERANCE.name):
                ladder_of(wanted)
        except ValueError as refusal:
            return SetParametersResult(successful=False, reason=str(refusal))
        return SetParametersResult(successful=True)


def tunables(parameters: list[Parameter]) -> dict[str, float]:
    """Those that change the operating point, by name."""
    return {p.name: p.value for p in parameters if p.name in pt.TUNABLES}
