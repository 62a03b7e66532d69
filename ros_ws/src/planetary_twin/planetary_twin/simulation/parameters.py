"""The parameters of the simulation node."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter

import planetary_twin_py as pt
from planetary_twin_py.run.dynamics_choice import AUTO
from planetary_twin_py.run.quality_control import QualityControl, Setting, settings_of
from planetary_twin_py.run.start import check_point
from planetary_twin_py.run.tolerance import AUTOMATIC, TOLERANCES, ladder_of
from planetary_twin_py.scene.live import LIVE, PORT_FIELDS
from planetary_twin_py.scene.unused import without_effect

from ..base.parameter_node import ParameterNode
from ..base.parameters import (
    brief,
    declare,
    declare_geometry,
    declare_port,
    declare_tunable,
    number,
)
from ..base.rate_factor import FASTEST, SLOWEST, UNLIMITED, check_rate_factor
from ..base.subscription_wait import TIMEOUT

SILENCE = ("hold", "zero", "brake")
"""Reaction to missing commands: hold the last one, remove it, or brake the input shaft."""
TOLERANCE = pt.Tunable(
    "tolerance",
    "",
    f"relative error of a step, {TOLERANCES[0]:g} to {TOLERANCES[1]:g}; 0: the tightest that "
    "computing time allows",
    AUTOMATIC,
    TOLERANCES[1],
)
# Changes after which the speed loop may not be stable.
_CONTROLLED = ("input_speed", "second_input_speed", *PORT_FIELDS)
_GEARSET = "gearset"
_SHORTEST_LAG = 0.01  # [s] late wake-ups of a thread are no lag
SETTINGS = (
    "frame_id",
    "frame_prefix",
    "tf",
    "continuous_joints",
    "publish_rate",
    "wait_for",
    "clock",
    "sample_rate",
    "rate_factor",
    "compute_share",
    "max_lag",
    "command_timeout",
    "command_silence",
)
"""Parameters that may be set until the node is configured."""


class SimulationParameters:
    """
    Declares the parameters on `node`, validates them and gives their values.

    Raises `ValueError` if a value given at the start is invalid.
    """

    def __init__(self, node: ParameterNode) -> None:
        self._node = node
        given = node.given
        self._chosen: dict[str, Any] = {
            name: number(name, given[name]) for name in pt.TUNABLES if name in given
        } | {name: given[name] for name in PORT_FIELDS if name in given}
        """Quantities and ports that have been set; they keep their values if the scene changes."""
        name = declare(node, "scene", "paper", "packaged scene, or path of a YAML file")
        self.scene = pt.load_scene(name)
        """The scene as loaded, at the operating point given at the start."""
        # Changeable parameters first: tools such as rqt_reconfigure list them in this order.
        ladder_of(declare_tunable(node, TOLERANCE, AUTOMATIC, "/diagnostics"))
        self._declare_scene()
        _declare_settings(node)
        self.scene = self.scene_now()
        check_point(self.scene, self.scene.operating_point)
        self._wanted = self.scene
        self._open = self.scene.dynamics == AUTO
        self.choice: pt.DynamicsChoice | None = None
        """Selection of the dynamics for a scene with `dynamics: auto`; None for others."""
        self.read()
        node.add_on_set_parameters_callback(self._validate)
        node.add_post_set_parameters_callback(self._follow)

    def read(self) -> None:
        """Read the parameters, which may have been set while the node was unconfigured."""
        value = {name: self._node.get_parameter(name).value for name in SETTINGS}
        self.frame: str = value["frame_id"]
        self.frame_prefix: str = value["frame_prefix"]
        self.tf: bool = value["tf"]
        self.continuous_joints: bool = value["continuous_joints"]
        self.rate: float = value["publish_rate"]
        self.wait_for: str = value["wait_for"]
        self.clock: bool = value["clock"]
        self.sample_rate: float = value["sample_rate"]
        self.rate_factor: float = value["rate_factor"]
        self._compute_share: float = value["compute_share"]
        self.max_lag: float = value["max_lag"]
        _check_lag(self.max_lag)
        self.command_timeout: float = value["command_timeout"]
        self.command_silence: str = value["command_silence"]
        _check_silence(self.command_silence)

    @property
    def period(self) -> float:
        """Wall time of an interval [s]; its simulated time if the rate factor is 0."""
        return 1.0 / (self.rate * (self.rate_factor or 1.0))

    def live_values(self) -> dict[str, Any]:
        """Return operating point and ports of the parameters, by the arguments of `Twin.set`."""
        return {name: self._node.get_parameter(name).value for name in LIVE}

    def remark(self, parameters: list[Parameter]) -> str:
        """Return which of `parameters` have no effect in the scene, and why."""
        names = [p.name for p in parameters if p.name in LIVE]
        return "; ".join(without_effect(self.scene_now(), names))

    def scene_now(self) -> pt.Scene:
        """Return the scene at that operating point, with those ports."""
        return self.scene.replace(**self.live_values())

    def pick_dynamics(self) -> None:
        """Pick the dynamics at the present operating point, if the scene leaves them open."""
        if not self._open:
            self.choice = None
            return
        self.choice = pt.choose_dynamics(self.scene_now().replace(dynamics=AUTO))
        self.scene = self.scene.replace(dynamics=self.choice.dynamics)

    def quality(self, twin: pt.Twin) -> QualityControl:
        """Return the quality control for the parameters, starting at the twin's setting."""
        wanted = self._node.get_parameter(TOLERANCE.name).value
        begin = Setting(twin.tolerance, twin.sample_rate)
        settings = settings_of(ladder_of(wanted), self.sample_rate)
        quality = QualityControl(settings, self._compute_share, self.period, begin)
        return quality if self.rate_factor else quality.without_deadline()

    def _declare_scene(self) -> None:
        """Declare operating point, ports and geometry of the scene."""
        for tunable in self.scene.tunables.values():
            own = getattr(self.scene.operating_point, tunable.name)
            declare_tunable(self._node, tunable, own, "operating_point")
        for name, side in PORT_FIELDS.items():
            declare_port(self._node, name, side, getattr(self.scene.drive.ports, side))
        declare_geometry(self._node, _GEARSET, self.scene.gearset)

    def _validate(self, parameters: list[Parameter]) -> SetParametersResult:
        values = {p.name: p.value for p in parameters}
        try:
            scene = pt.load_scene(values["scene"]) if "scene" in values else self.scene
            changed = scene.replace(**self._chosen | changing(parameters))
            if "scene" in values or any(name in _CONTROLLED for name in values):
                check_point(changed, changed.operating_point)
            for name, check in _CHECKS.items():
                if name in values:
                    check(values[name])
        except ValueError as refusal:
            return SetParametersResult(successful=False, reason=str(refusal))
        self._wanted = scene
        return SetParametersResult(successful=True)

    def _follow(self, parameters: list[Parameter]) -> None:
        """Keep the values that were set, and change the scene if it was set."""
        self._chosen |= changing(parameters)
        if any(p.name == "scene" for p in parameters):
            self._change_scene(self._wanted)

    def _change_scene(self, scene: pt.Scene) -> None:
        """Declare geometry and operating point again, with the ranges of another scene."""
        node = self._node
        node.remove_on_set_parameters_callback(self._validate)  # the point is incomplete meanwhile
        geometry = [f"{_GEARSET}.{name}" for name in node.get_parameters_by_prefix(_GEARSET)]
        for name in (*geometry, *LIVE):
            node.undeclare_parameter(name)
        self.scene = scene.replace(**self._chosen)
        self._open = scene.dynamics == AUTO
        self._declare_scene()
        node.add_on_set_parameters_callback(self._validate)


def _declare_settings(node: ParameterNode) -> None:
    """Declare the parameters that may be set until the node is configured."""
    declare(node, "frame_id", "gearbox", "base frame of the gearbox")
    declare(node, "frame_prefix", "", "prefix of all frame names, for several twins")
    declare(node, "tf", True, "publish /tf; false if robot_state_publisher does")
    declare(
        node,
        "continuous_joints",
        False,
        "joint positions count whole turns instead of wrapping at one turn",
    )
    declare(node, "publish_rate", 100.0, "messages per simulated second [Hz]", (10.0, 1000.0))
    declare(
        node,
        "wait_for",
        "",
        f"node that records, such as logger or /rosbag2_recorder: the twin starts when it has "
        f"subscribed, after {TIMEOUT:g} s at most, and waits for it above real time and in steps",
    )
    declare(node, "clock", False, "publish simulated time on /clock")
    declare(node, "sample_rate", 50e3, "sample rate of mesh_waveform [Hz]", (1e3, 1e6))
    check_rate_factor(
        declare(
            node,
            "rate_factor",
            1.0,
            f"simulated seconds per second, {SLOWEST:g} to {FASTEST:g}; "
            "0: as fast as possible [-]",
            (UNLIMITED, FASTEST),
        )
    )
    declare(
        node,
        "max_lag",
        0.0,
        "lag of stamps behind ROS time above which they skip it [s], 0.01 at least; 0: never",
        (0.0, 60.0),
    )
    declare(
        node,
        "compute_share",
        0.4,
        "share of the time that computing may take if the tolerance is automatic [-]",
        (0.05, 0.9),
    )
    declare(
        node,
        "command_timeout",
        0.0,
        "time without a command after which command_silence applies [s]; 0: never",
        (0.0, 10.0),
    )
    declare(
        node,
        "command_silence",
        "hold",
        "after command_timeout: hold the last command; zero torque and speed; or brake the input "
        "shaft to rest at the slew rate of the drive",
    )


def _check_lag(value: float) -> None:
    if 0.0 < value < _SHORTEST_LAG:
        raise ValueError(f"max_lag = {value:g} s: must be 0, or within {_SHORTEST_LAG:g} and 60 s")


def _check_silence(value: str) -> None:
    if value not in SILENCE:
        raise ValueError(f"command_silence = {brief(value)}: must be one of {', '.join(SILENCE)}")


_CHECKS: dict[str, Callable[[Any], object]] = {
    TOLERANCE.name: ladder_of,
    "rate_factor": check_rate_factor,
    "max_lag": _check_lag,
    "command_silence": _check_silence,
}
"""Checks beyond the ranges."""


def changing(parameters: list[Parameter]) -> dict[str, Any]:
    """Return the values in `parameters` of operating point and ports, as for `Twin.set`."""
    return {p.name: p.value for p in parameters if p.name in LIVE}
