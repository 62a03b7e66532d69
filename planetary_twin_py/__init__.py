"""Digital twin of a planetary gearbox: the model and all tools that do not require ROS.

import planetary_twin_py as pt

scene = pt.load_scene("paper").replace(lambda_ratio=1.5, input_speed=pt.rpm(2000))
result = pt.simulate(scene, duration=0.2)
result.efficiency
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._core import PortStates
    from .analysis.faults.fault_orders import FaultOrders, fault_orders
    from .analysis.gears.gear_signals import GearSignals, gear_signals
    from .analysis.gears.indicators import ConditionIndicators, condition_indicators
    from .analysis.gears.mesh_band import MeshBand, mesh_band
    from .analysis.gears.planet_separation import Separated, separate
    from .analysis.gears.synchronous_average import SynchronousAverage, time_synchronous_average
    from .analysis.shaft.orders import (
        ByAngle,
        OrderMap,
        OrderSpectrum,
        mesh_order,
        order_map,
        order_spectrum,
        resample_by_angle,
    )
    from .analysis.shaft.tacholess import angle_from_line
    from .analysis.shaft.tachometer import TachometerAngle, pulse_times, tachometer_angle
    from .analysis.spectra.cepstrum import pre_whitened, real_cepstrum
    from .analysis.spectra.envelope import envelope, squared_envelope_spectrum
    from .analysis.spectra.spectral_kurtosis import SpectralKurtosis, spectral_kurtosis
    from .analysis.spectra.spectrum import (
        Line,
        PowerDensity,
        Spectrum,
        amplitude_spectrum,
        power_density,
        strongest_lines,
    )
    from .checks.exchange import check_exchange
    from .checks.load_sharing import load_sharing
    from .durability.damage import Damage, DamageTotal
    from .durability.parts import part_names
    from .fleet.fleet import Fleet, FleetEstimate, FleetEvent, FleetScatter
    from .fmu.export import export_fmu
    from .following.balance.balances import Innovation
    from .following.channels.encoders import EncoderFormat, EncoderSamples
    from .following.estimate import Estimate, Event
    from .following.follower import Follower
    from .following.input_error import InputError
    from .following.readings import Readings
    from .following.sensors import Sensors
    from .following.state import Following
    from .following.teeth.baseline import LearnedCell
    from .following.teeth.changed import ToothState
    from .lifetime.duty_life import duty_life
    from .lifetime.duty_result import DutyLife
    from .lifetime.duty_table import Duty, read_duty
    from .modal.modes import NaturalModes
    from .plots.study import plot_study
    from .run.commands import Commands
    from .run.dynamics_choice import DynamicsChoice
    from .run.energy import Energy
    from .run.limits import RunawayError
    from .run.result import Result, Stats
    from .run.twin import Change, Twin
    from .run.twins import Twins
    from .run.vibration import SensorSamples, measure_vibration
    from .run.window import Waveform, Window
    from .scene import (
        TUNABLES,
        OperatingPoint,
        Scene,
        SceneError,
        Tunable,
        friction_table,
        load_scene,
        packaged_scenes,
        parse_scene,
    )
    from .scene.sensors import Accelerometer, FlexibleRing, TransferWindow
    from .simulation.batch import Outcome, simulate_many
    from .simulation.choose_dynamics import choose_dynamics
    from .simulation.natural_modes import natural_modes
    from .simulation.simulate import simulate
    from .statics.load_sharing import LoadSharing
    from .studies.wear.result import Wear
    from .studies.wear.wear import wear
    from .text.warning_types import AccuracyWarning, LedgerWarning
    from .units.conversion import rpm

_EXPORTS = {
    "analysis.shaft.orders": (
        "ByAngle", "OrderMap", "OrderSpectrum", "mesh_order", "order_map", "order_spectrum",
        "resample_by_angle",
    ),
    "analysis.spectra.cepstrum": ("pre_whitened", "real_cepstrum"),
    "analysis.spectra.envelope": ("envelope", "squared_envelope_spectrum"),
    "analysis.gears.gear_signals": ("GearSignals", "gear_signals"),
    "analysis.gears.indicators": ("ConditionIndicators", "condition_indicators"),
    "analysis.gears.mesh_band": ("MeshBand", "mesh_band"),
    "analysis.gears.planet_separation": ("Separated", "separate"),
    "analysis.spectra.spectral_kurtosis": ("SpectralKurtosis", "spectral_kurtosis"),
    "analysis.gears.synchronous_average": ("SynchronousAverage", "time_synchronous_average"),
    "analysis.shaft.tachometer": ("TachometerAngle", "pulse_times", "tachometer_angle"),
    "analysis.shaft.tacholess": ("angle_from_line",),
    "analysis.faults.fault_orders": ("FaultOrders", "fault_orders"),
    "analysis.spectra.spectrum": (
        "Line", "PowerDensity", "Spectrum", "amplitude_spectrum", "power_density",
        "strongest_lines",
    ),
    "text.warning_types": ("AccuracyWarning", "LedgerWarning"),
    "_core": ("PortStates",),
    "run.dynamics_choice": ("DynamicsChoice",),
    "simulation.choose_dynamics": ("choose_dynamics",),
    "run.commands": ("Commands",),
    "simulation.batch": ("Outcome", "simulate_many"),
    "checks.exchange": ("check_exchange",),
    "fleet.fleet": ("Fleet", "FleetEstimate", "FleetEvent", "FleetScatter"),
    "following.balance.balances": ("Innovation",),
    "following.teeth.baseline": ("LearnedCell",),
    "following.channels.encoders": ("EncoderFormat", "EncoderSamples"),
    "following.input_error": ("InputError",),
    "following.estimate": ("Estimate", "Event"),
    "following.follower": ("Follower",),
    "following.readings": ("Readings",),
    "following.state": ("Following",),
    "following.sensors": ("Sensors",),
    "following.teeth.changed": ("ToothState",),
    "fmu.export": ("export_fmu",),
    "lifetime.duty_life": ("duty_life",),
    "lifetime.duty_result": ("DutyLife",),
    "lifetime.duty_table": ("Duty", "read_duty"),
    "modal.modes": ("NaturalModes",),
    "simulation.natural_modes": ("natural_modes",),
    "statics.load_sharing": ("LoadSharing",),
    "checks.load_sharing": ("load_sharing",),
    "plots.study": ("plot_study",),
    "studies.wear.result": ("Wear",),
    "studies.wear.wear": ("wear",),
    "durability.damage": ("Damage", "DamageTotal"),
    "durability.parts": ("part_names",),
    "run.energy": ("Energy",),
    "run.result": ("Result", "Stats"),
    "run.limits": ("RunawayError",),
    "scene": (
        "TUNABLES", "OperatingPoint", "Scene", "SceneError", "Tunable", "friction_table",
        "load_scene",
        "packaged_scenes", "parse_scene",
    ),
    "scene.sensors": ("Accelerometer", "FlexibleRing", "TransferWindow"),
    "run.vibration": ("SensorSamples", "measure_vibration"),
    "simulation.simulate": ("simulate",),
    "run.twin": ("Change", "Twin"),
    "run.twins": ("Twins",),
    "units.conversion": ("rpm",),
    "run.window": ("Waveform", "Window"),
}  # fmt: skip
_MODULE_OF = {name: module for module, names in _EXPORTS.items() for name in names}

__all__ = [
    "TUNABLES",
    "Accelerometer",
    "AccuracyWarning",
    "ByAngle",
    "Change",
    "Commands",
    "ConditionIndicators",
    "Damage",
    "DamageTotal",
    "Duty",
    "DutyLife",
    "DynamicsChoice",
    "EncoderFormat",
    "EncoderSamples",
    "Energy",
    "Estimate",
    "Event",
    "FaultOrders",
    "Fleet",
    "FleetEstimate",
    "FleetEvent",
    "FleetScatter",
    "FlexibleRing",
    "Follower",
    "Following",
    "GearSignals",
    "Innovation",
    "InputError",
    "LearnedCell",
    "LedgerWarning",
    "Line",
    "LoadSharing",
    "MeshBand",
    "NaturalModes",
    "OperatingPoint",
    "OrderMap",
    "OrderSpectrum",
    "Outcome",
    "PortStates",
    "PowerDensity",
    "Readings",
    "Result",
    "RunawayError",
    "Scene",
    "SceneError",
    "SensorSamples",
    "Sensors",
    "Separated",
    "SpectralKurtosis",
    "Spectrum",
    "Stats",
    "SynchronousAverage",
    "TachometerAngle",
    "ToothState",
    "TransferWindow",
    "Tunable",
    "Twin",
    "Twins",
    "Waveform",
    "Wear",
    "Window",
    "amplitude_spectrum",
    "angle_from_line",
    "check_exchange",
    "choose_dynamics",
    "condition_indicators",
    "duty_life",
    "envelope",
    "export_fmu",
    "fault_orders",
    "friction_table",
    "gear_signals",
    "load_scene",
    "load_sharing",
    "measure_vibration",
    "mesh_band",
    "mesh_order",
    "natural_modes",
    "order_map",
    "order_spectrum",
    "packaged_scenes",
    "parse_scene",
    "part_names",
    "plot_study",
    "power_density",
    "pre_whitened",
    "pulse_times",
    "read_duty",
    "real_cepstrum",
    "resample_by_angle",
    "rpm",
    "separate",
    "simulate",
    "simulate_many",
    "spectral_kurtosis",
    "squared_envelope_spectrum",
    "strongest_lines",
    "tachometer_angle",
    "time_synchronous_average",
    "wear",
]


def __dir__() -> list[str]:
    """Public names, including those that are not imported yet."""
    return sorted(__all__)


def __getattr__(name: str) -> Any:
    """Import on first use, because loading NumPy and SciPy takes a while."""
    if name not in _MODULE_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_MODULE_OF[name]}", __name__), name)
    globals()[name] = value
    return value
