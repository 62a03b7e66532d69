"""Layouts for PlotJuggler and Foxglove plot what there is."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

from planetary_twin_msgs.msg import GearboxState

LAYOUTS = Path(__file__).parents[2] / "ros_ws/src/planetary_twin/layouts"
CURVE = re.compile(r"^/planetary_twin/gearbox_state[./](?P<field>\w+)(\[(?P<place>\d)\])?$")


def assert_exists(curve: str) -> None:
    match = CURVE.match(curve)
    assert match, curve
    kind = GearboxState.get_fields_and_field_types()[match["field"]]
    if match["place"] is None:
        assert kind == "double", curve
    else:
        assert kind == "double[7]" and int(match["place"]) < 3, curve


def test_every_curve_of_plotjuggler_is_a_field() -> None:
    tree = ElementTree.parse(LAYOUTS / "plotjuggler.xml")
    curves = [curve.attrib["name"] for curve in tree.iter("curve")]
    assert len(curves) > 15
    for curve in curves:
        assert_exists(curve)


def test_every_path_of_foxglove_is_a_field_and_every_panel_is_shown() -> None:
    layout = json.loads((LAYOUTS / "foxglove.json").read_text())
    panels = layout["configById"]
    for panel in panels.values():
        for path in panel.get("paths", []):
            assert_exists(path["value"])

    def shown(part: str | dict) -> set[str]:
        if isinstance(part, str):
            return {part}
        return shown(part["first"]) | shown(part["second"])

    assert shown(layout["layout"]) == set(panels)
