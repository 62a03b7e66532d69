"""Layouts for PlotJuggler and Foxglove plot existing fields, with keys that these tools read.

The keys were read in the sources of Lichtblick 1.28 and PlotJuggler 3.17. The layouts were seen
in Lichtblick 1.24.3 and PlotJuggler 3.9.3, in a window of 1280 x 800 pixels.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from planetary_twin_msgs.msg import AxesState, GearboxState

ROOT = Path(__file__).parents[4]
LAYOUTS = ROOT / "ros_ws/src/planetary_twin/layouts"
CURVE = re.compile(r"^/planetary_twin/(?P<topic>\w+)[./](?P<field>\w+)(\[(?P<place>\d)\])?$")
MESSAGES = {"gearbox_state": GearboxState, "axes_state": AxesState}
FIELD = re.compile(r"^float64\S*\s+(?P<name>\w+)\s+# \[(?P<unit>[^]]+)\]", re.MULTILINE)
UNITS = {
    field: unit
    for message in ("GearboxState", "AxesState")
    for field, unit in FIELD.findall((ROOT / f"msgs_spec/msg/{message}.msg").read_text())
}
PLOTS = {"": 12, "_axes": 4}
"""Plots of both layouts by the ending of their names: for every twin, and for moving axes."""
TITLES = ("lichtblickPanelTitle", "foxglovePanelTitle")
LENGTH = re.compile(r"^[\d.e-]+$")  # of a path that is a horizontal line


def field_of(curve: str) -> str:
    """The field of a message that a curve plots, which must have one value there."""
    match = CURVE.match(curve)
    assert match, curve
    kind = MESSAGES[match["topic"]].get_fields_and_field_types()[match["field"]]
    if match["place"] is None:
        assert kind == "double", curve
    else:
        assert kind == "double[7]" and int(match["place"]) < 3, curve
    return match["field"]


@pytest.fixture(scope="module", params=PLOTS, ids=lambda ending: ending or "every twin")
def ending(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def panels(ending: str) -> dict[str, Any]:
    text = (LAYOUTS / f"foxglove{ending}.json").read_text()
    panels: dict[str, Any] = json.loads(text)["configById"]
    return panels


@pytest.fixture(scope="module")
def docks(ending: str) -> list[ElementTree.Element]:
    return list(ElementTree.parse(LAYOUTS / f"plotjuggler{ending}.xml").iter("DockArea"))


def plots(panels: dict[str, Any]) -> Iterator[dict[str, Any]]:
    found = [panel for name, panel in panels.items() if name.startswith("Plot!")]
    assert len(found) in PLOTS.values()
    yield from found


def curves(panel: dict[str, Any]) -> list[dict[str, Any]]:
    return [path for path in panel["paths"] if not LENGTH.match(path["value"])]


def test_foxglove_plots_fields_in_their_unit(panels):
    for panel in plots(panels):
        (unit,) = {UNITS[field_of(path["value"])] for path in curves(panel)}
        assert all(panel[key].endswith(f" [{unit}]") for key in TITLES)
        labels = [path["label"] for path in panel["paths"]]
        assert len(set(labels)) == len(labels)


def test_the_gears_of_foxglove_come_from_the_robot_description(panels):
    (layer,) = panels["3D!gears"]["layers"].values()
    assert layer["layerId"] == "foxglove.Urdf" and layer["sourceType"] == "topic"
    assert layer["topic"] == "/planetary_twin/robot_description"


def test_plotjuggler_plots_fields_in_the_unit_of_the_title(docks):
    for dock in docks:
        curves = list(dock.iter("curve"))
        (unit,) = {UNITS[field_of(curve.attrib["name"])] for curve in curves}
        shown, scale = ("µm", 1e6) if unit == "m" else (unit, 1.0)
        assert dock.attrib["name"].endswith(f" [{shown}]")
        for curve in curves:
            transform = curve.find("transform[@name='Scale/Offset']")
            assert transform is not None
            options = transform.find("options")
            assert options is not None and float(options.attrib["value_scale"]) == scale
            assert {options.attrib[f"{of}_offset"] for of in ("time", "value")} == {"0"}
