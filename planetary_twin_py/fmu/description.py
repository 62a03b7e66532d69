"""Model descriptions of FMI 3.0.2 and 2.0.4, which importing tools read."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as Xml

from .variables import Variable

UNITS = {
    "s": {"s": 1},
    "m": {"m": 1},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N m": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3},
    "K": {"K": 1},
}
"""Exponents of the base units of FMI, by unit."""
NAMES = {"N m": "N.m"}
"""Units with another name in model descriptions."""
CAPABILITIES_3 = {
    "canHandleVariableCommunicationStepSize": "true",
    "canGetAndSetFMUState": "true",
}
CAPABILITIES_2 = {
    "canHandleVariableCommunicationStepSize": "true",
    "canGetAndSetFMUstate": "true",
}
STEP = 1e-3  # [s] proposed communication step
STOP = 1.0  # [s] proposed stop time


@dataclass(frozen=True)
class Description:
    """Contents of a model description."""

    name: str
    """Name of the model."""
    identifier: str
    """Name of the library, a valid identifier in C."""
    text: str
    """Description of the model."""
    token: str
    """Token that identifies the FMU."""
    tool: str
    """Name and version of the exporting tool."""
    tolerance: float
    """Proposed relative tolerance."""
    variables: Sequence[Variable]
    """Variables in the order of their value references."""


def model_description_3(about: Description) -> bytes:
    """Model description of FMI 3.0.

    Args:
        about: contents of the description.

    Returns:
        The XML file.
    """
    root = _root(about, CAPABILITIES_3, fmiVersion="3.0", instantiationToken=about.token)
    model_variables = Xml.SubElement(root, "ModelVariables")
    for reference, variable in enumerate(about.variables):
        values = _attributes(reference, variable) | _values(variable)
        Xml.SubElement(model_variables, "Float64", values)
    structure = Xml.SubElement(root, "ModelStructure")
    for element in ("Output", "InitialUnknown"):
        for reference, variable in enumerate(about.variables):
            if variable.causality == "output":
                Xml.SubElement(structure, element, valueReference=str(reference))
    return _file(root)


def model_description_2(about: Description) -> bytes:
    """Model description of FMI 2.0.

    Args:
        about: contents of the description.

    Returns:
        The XML file.
    """
    root = _root(about, CAPABILITIES_2, fmiVersion="2.0", guid=about.token)
    model_variables = Xml.SubElement(root, "ModelVariables")
    for reference, variable in enumerate(about.variables):
        attributes = _attributes(reference, variable)
        scalar = Xml.SubElement(model_variables, "ScalarVariable", attributes)
        Xml.SubElement(scalar, "Real", _values(variable))
    structure = Xml.SubElement(root, "ModelStructure")
    for element in ("Outputs", "InitialUnknowns"):
        unknowns = Xml.SubElement(structure, element)
        for place, variable in enumerate(about.variables, start=1):
            if variable.causality == "output":
                Xml.SubElement(unknowns, "Unknown", index=str(place))
    return _file(root)


def _root(about: Description, capabilities: dict[str, str], **of_version: str) -> Xml.Element:
    """What both versions have in common, up to the variables."""
    root = Xml.Element(
        "fmiModelDescription",
        of_version,
        modelName=about.name,
        description=about.text,
        generationTool=about.tool,
        license="Apache-2.0",
        variableNamingConvention="structured",
    )
    Xml.SubElement(root, "CoSimulation", {"modelIdentifier": about.identifier} | capabilities)
    _put_units(root, about.variables)
    _put_experiment(root, about.tolerance)
    return root


def _attributes(reference: int, variable: Variable) -> dict[str, str]:
    values: dict[str, str] = {
        "name": variable.name,
        "valueReference": str(reference),
        "causality": variable.causality,
        "variability": variable.variability,
    }
    if variable.causality == "parameter":
        values["initial"] = "exact"
    if variable.causality == "output":
        values["initial"] = "calculated"
    return values | {"description": variable.description}


def _values(variable: Variable) -> dict[str, str]:
    values = {"unit": _unit_name(variable.unit)} if variable.unit else {}
    if variable.start is None:
        return values
    bounds = {"min": variable.minimum, "max": variable.maximum, "start": variable.start}
    return values | {name: repr(float(value)) for name, value in bounds.items()}


def _unit_name(unit: str) -> str:
    return NAMES.get(unit, unit)


def _put_units(root: Xml.Element, variables: Sequence[Variable]) -> None:
    used = {variable.unit for variable in variables}
    definitions = Xml.SubElement(root, "UnitDefinitions")
    for name, exponents in UNITS.items():
        if name in used:
            unit = Xml.SubElement(definitions, "Unit", name=_unit_name(name))
            base = {symbol: str(exponent) for symbol, exponent in exponents.items()}
            Xml.SubElement(unit, "BaseUnit", base)
            if name == "rad/s":
                Xml.SubElement(unit, "DisplayUnit", name="rpm", factor=repr(30.0 / math.pi))


def _put_experiment(root: Xml.Element, tolerance: float) -> None:
    Xml.SubElement(
        root,
        "DefaultExperiment",
        startTime="0.0",
        stopTime=repr(STOP),
        tolerance=repr(tolerance),
        stepSize=repr(STEP),
    )


def _file(root: Xml.Element) -> bytes:
    Xml.indent(root)
    return Xml.tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"
