"""The paper's gearbox with other members held, driven and loaded."""

import pytest

from planetary_twin_py.scene import load_scene

# held, input, output, torque [N m] that loads every mesh as 63 N m at the sun do
FLOWS = [
    ("carrier", "sun", "ring", 63.0),
    ("carrier", "ring", "sun", 147.0),
    ("ring", "sun", "carrier", 63.0),
    ("ring", "carrier", "sun", -210.0),
    ("sun", "carrier", "ring", -210.0),
    ("sun", "ring", "carrier", 147.0),
]
ALL_FLOWS = pytest.mark.parametrize("flow", FLOWS, ids=lambda flow: "-".join(flow[:3]))


def scene_of(flow, **changes):
    held, first, second, torque = flow
    members = {
        "gearset.held": held,
        "drive.input.member": first,
        "drive.output.member": second,
        "input_torque": torque,
    }
    return load_scene("paper").replace(**{**members, **changes})
