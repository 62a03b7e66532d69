"""The parameters of the simulation node."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.parameter import Parameter

import planetary_twin_py as pt
from planetary_twin_py.run.dynamics_choice import AUTO
from planetary_twin_py.run.quality_control import QualityControl, Setting
from planetary_twin_py.run.quality_control import settings_of as settings_of_quality
from planetary_twin_py.run.start import check_point, check_severities
from planetary_twin_py.run.tolerance import AUTOMATIC, TOLERANCES, ladder_of
from planetary_twin_py.scene.live import FAULTS, LIVE, PORT_FIELDS
from planetary_twin_py.scene.unused import without_effect

from ..base.parameter_node import ParameterNode
from ..base.parameters import (
    brief,
    declare,
    declare_geometry,
    declare_oil_state,
    declare_port,
    declare_settings,
    declare_tunable,
    number,
    setting,
    settings_of,
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


@dataclass(frozen=True)
class SimulationSettings:
    """Parameters that may be set until the node is configured; raises `ValueError` if invalid."""

    damage_file: str = setting(
        "",
        "JSON file with the damage of the gearbox, from which it continues; written each minute "
        "and at the end. The scene needs its section durability; empty: damage starts at 0",
    )
    frame_id: str = setting("gearbox", "base frame of the gearbox")
    frame_prefix: str = setting("", "prefix of all frame names, for several twins")
    tf: bool = setting(True, "publish /tf; false if robot_state_publisher does")
    continuous_joints: bool = setting(
        False, "joint positions count whole turns instead of wrapping at one turn"
    )
    publish_rate: float = setting(100.0, "messages per simulated second [Hz]", (10.0, 1000.0))
    wait_for: str = setting(
        "",
        f"node that records, such as logger or /rosbag2_recorder: the twin starts when it has "
        f"subscribed, after {TIMEOUT:g} s at most, and waits for it above real time and in steps",
    )
    clock: bool = setting(False, "publish simulated time on /clock")
    sample_rate: float = setting(50e3, "sample rate of mesh_waveform [Hz]", (1e3, 1e6))
    rate_factor: float = setting(
        1.0,
        f"simulated seconds per second, {SLOWEST:g} to {FASTEST:g}; 0: as fast as possible [-]",
        (UNLIMITED, FASTEST),
    )
    compute_share: float = setting(
        0.4,
        "share of the time that computing may take if the tolerance is automatic [-]",
        (0.05, 0.9),
    )
    max_lag: float = setting(
        0.0,
        "lag of stamps behind ROS time above which they skip it [s], 0.01 at least; 0: never",
        (0.0, 60.0),
    )
    command_timeout: float = setting(
        0.0,
        "time without a command after which command_silence applies [s]; 0: never",
        (0.0, 10.0),
    )
    command_silence: str = setting(
        "hold",
        "after command_timeout: hold the last command; zero torque and speed; or brake the input "
        "shaft to rest at the slew rate of the drive",
    )

    def __post_init__(self) -> None:
        """Check what the ranges do not."""
        check_rate_factor(self.rate_factor)
        _check_lag(self.max_lag)
        _check_silence(self.command_silence)

    @property
    def period(self) -> float:
        """Wall time of an interval [s]; its simulated time if the rate factor is 0."""
        return 1.0 / (self.publish_rate * (self.rate_factor or 1.0))


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
        self._chosen |= {n: number(n, v) for n, v in given.items() if n.startswith(FAULTS)}
        """Quantities and ports that have been set; they keep their values if the scene changes."""
        name = declare(node, "scene", "paper", "packaged scene, or path of a YAML file")
        self.scene = pt.load_scene(name)
        """The scene as loaded, at the operating point given at the start."""
        # Changeable parameters first: tools such as rqt_reconfigure list them in this order.
        ladder_of(declare_tunable(node, TOLERANCE, AUTOMATIC, "/diagnostics"))
        self._declare_scene()
        declare_settings(node, SimulationSettings)
        self.scene = self.scene_now()
        check_point(self.scene, self.scene.operating_point)
        self._wanted = self.scene
        self._open = self.scene.dynamics == AUTO
        self.choice: pt.DynamicsChoice | None = None
        """Selection of the dynamics for a scene with `dynamics: auto`; None for others."""
        self.settings = settings_of(node, SimulationSettings)
        """The other parameters, as of the last `read`."""
        node.add_on_set_parameters_callback(self._validate)
        node.add_post_set_parameters_callback(self._follow)

    def read(self) -> None:
        """Read the parameters, which may have been set while the node was unconfigured."""
        self.settings = settings_of(self._node, SimulationSettings)

    def live_values(self) -> dict[str, Any]:
        """Return operating point and ports of the parameters, by the arguments of `Twin.set`."""
        return {name: self._node.get_parameter(name).value for name in self._live}

    def changes_of(self, twin: pt.Twin) -> dict[str, Any]:
        """Return the values that differ from those that were last set; faults may have grown."""
        values, set_last = self.live_values(), twin.scene.severities
        return {n: v for n, v in values.items() if n not in set_last or v != set_last[n]}

    @property
    def _live(self) -> tuple[str, ...]:
        """Names of the parameters that may change while the twin runs."""
        return (*LIVE, *self.scene.severities)

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
        given = self.settings
        ladder = settings_of_quality(ladder_of(wanted), given.sample_rate)
        quality = QualityControl(ladder, given.compute_share, given.period, begin)
        return quality if given.rate_factor else quality.without_deadline()

    def _declare_scene(self) -> None:
        """Declare operating point, ports and geometry of the scene."""
        for tunable in self.scene.tunables.values():
            own = getattr(self.scene.operating_point, tunable.name)
            if tunable.name == "oil_temperature" and self.scene.thermal is not None:
                declare_oil_state(self._node, tunable, own)
            else:
                declare_tunable(self._node, tunable, own, "operating_point")
        for tunable in self.scene.severity_tunables.values():
            own = self.scene.severities[tunable.name]
            declare_tunable(self._node, tunable, own, "operating_point")
        for name, side in PORT_FIELDS.items():
            declare_port(self._node, name, side, getattr(self.scene.drive.ports, side))
        declare_geometry(self._node, _GEARSET, self.scene.gearset)

    def _validate(self, parameters: list[Parameter]) -> SetParametersResult:
        values = {p.name: p.value for p in parameters}
        try:
            if any(name.startswith(FAULTS) for name in values):
                check_severities(self.scene, changing(parameters))
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
        for name in (*geometry, *self._live):
            node.undeclare_parameter(name)
        self._chosen = {n: v for n, v in self._chosen.items() if not n.startswith(FAULTS)}
        self.scene = scene.replace(**self._chosen)
        self._open = scene.dynamics == AUTO
        self._declare_scene()
        node.add_on_set_parameters_callback(self._validate)


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
    return {p.name: p.value for p in parameters if p.name in LIVE or p.name.startswith(FAULTS)}
