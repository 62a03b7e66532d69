"""The catalogue of quantities agrees with the message definitions and with the scene."""

import re
from pathlib import Path

import pytest

from planetary_twin_py.units.catalogue import (
    AXES_WAVEFORM,
    MESH,
    SIDES,
    TRAIN,
    WAVEFORM,
    axes_fields,
)

MESSAGES = Path(__file__).parents[2] / "msgs_spec/msg"
FIELD = re.compile(r"^\w+(\[\S*\])? (\w+) +# \[(.*?)\]", re.MULTILINE)


def units(message: str) -> dict[str, str]:
    """Unit of each field of a message, from its comment; empty for a dimensionless number."""
    text = (MESSAGES / f"{message}.msg").read_text()
    return {name: unit.removeprefix("-") for _, name, unit in FIELD.findall(text)}


def test_the_state_has_every_quantity_of_the_train_in_its_unit():
    recorded = units("GearboxState")
    assert {name: quantity.si for name, quantity in TRAIN.items()} == {
        name: recorded[name] for name in TRAIN
    }


@pytest.mark.parametrize("side", SIDES)
def test_the_state_has_its_mesh_statistics_in_their_units(side):
    of_meshes = {
        name.removeprefix(f"{side}_"): unit
        for name, unit in units("GearboxState").items()
        if name.startswith(side)
    }
    assert of_meshes == {name: quantity.si for name, quantity in MESH.items()}


def test_the_waveform_has_its_quantities_in_their_units():
    recorded = units("MeshWaveform")
    assert all(recorded[name] == quantity.si for name, quantity in WAVEFORM.items())


def test_the_state_has_its_axes_in_their_units():
    general = {"simulated_time", "interval", "sample_rate", "planets"}
    recorded = {name: unit for name, unit in units("AxesState").items() if name not in general}
    assert recorded == {name: quantity.si for name, quantity in axes_fields().items()}
    assert list(recorded) == list(axes_fields())


def test_the_waveform_of_axes_has_its_quantities_in_their_units():
    recorded = units("AxesWaveform")
    assert all(recorded[name] == quantity.si for name, quantity in AXES_WAVEFORM.items())
