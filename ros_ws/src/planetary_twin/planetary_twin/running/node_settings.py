"""Parameters of the simulation node from the command line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields

from planetary_twin_py.scene.names import did_you_mean

from ..simulation.parameters import SimulationSettings

_OF_THE_RUN = ("rate_factor", "wait_for")  # set by the command itself
_CLOCK = "use_sim_time"
_OWN_CLOCK = (
    "run uses the system clock, and publishes no /clock; to follow one of another node, start the "
    "node simulation with -p use_sim_time:=true, or twin.launch.py with use_sim_time:=true"
)
NAMES = tuple(each.name for each in fields(SimulationSettings) if each.name not in _OF_THE_RUN)


def node_settings(given: Sequence[str]) -> dict[str, str]:
    """
    Return the values of `given`, each NAME=VALUE, by name; the node checks the values.

    Raises `ValueError` for a name that is not in `NAMES`.
    """
    settings = {}
    for text in given:
        name, equals, value = text.partition("=")
        if name == _CLOCK:
            raise ValueError(f"--param {text!r}: {_OWN_CLOCK}")
        if name not in NAMES and (near := did_you_mean(name, NAMES)):
            raise ValueError(f"--param {text!r}: no such parameter{near}")
        if name not in NAMES or not equals or not value:
            raise ValueError(
                f"--param {text!r}: must be NAME=VALUE, with NAME of {', '.join(NAMES)}"
            )
        settings[name] = value
    return settings
