"""The paper's gearbox with other members held, driven and loaded."""

import pytest

from planetary_twin_py.scene import load_scene
from planetary_twin_py.units.conversion import rpm

# held, input, output, torque [N m] that loads every mesh as 63 N m at the sun do
FLOWS = [
    ("carrier", "sun", "ring", 63.0),
    ("carrier", "ring", "sun", 147.0),
    ("ring", "sun", "carrier", 63.0),
    ("ring", "carrier", "sun", -210.0),
    ("sun", "carrier", "ring", -210.0),
    ("sun", "ring", "carrier", 147.0),
]
# no member held: inputs, output, torque of the first input, speeds of both [rpm]
DIFFERENTIALS = [
    (("sun", "carrier"), "ring", 63.0, (1000.0, 500.0)),
    (("carrier", "sun"), "ring", -210.0, (300.0, -900.0)),
    (("ring", "sun"), "carrier", 147.0, (600.0, 1000.0)),
]


def flow_name(flow):
    return "-".join(
        part if isinstance(part, str) else "+".join(part)
        for part in flow[:3]
        if not isinstance(part, float)
    )


ALL_FLOWS = pytest.mark.parametrize("flow", FLOWS + DIFFERENTIALS, ids=flow_name)


def scene_of(flow, **changes):
    """The paper's gearbox in one of these power flows, at 1000 rpm where one speed is given."""
    scene = load_scene("paper")
    machine = scene.drive.output.model_dump()
    if flow in DIFFERENTIALS:
        (first, second), output, torque, speeds = flow
        members = {
            "gearset.held": "none",
            "drive.second_input": {**machine, "member": second},
            "input_speed": rpm(speeds[0]),
            "second_input_speed": rpm(speeds[1]),
        }
    else:
        held, first, output, torque = flow
        members = {"gearset.held": held}
    machines = {
        "drive.input.member": first,
        "drive.output.member": output,
        "input_torque": torque,
    }
    return scene.replace(**{**members, **machines, **changes})
