"""Names of the twin's topics, without namespace."""

STATE = "gearbox_state"
WAVEFORM = "mesh_waveform"
AXES_STATE = "axes_state"  # only of a twin whose axes move
AXES_WAVEFORM = "axes_waveform"  # only of a twin whose axes move
JOINTS = "joint_states"
POINT = "operating_point"
ORIGIN = "run_origin"
DAMAGE, DAMAGE_TEETH = "damage_state", "damage_teeth"  # of a scene with the section durability
GIVEN = "applied_commands"  # not of a quasi-static twin
DESCRIPTION = "robot_description"
REAL_TIME = "simulation: real time"  # a report in /diagnostics


def status_name(report: str, namespace: str) -> str:
    """
    Return the name of a status in /diagnostics, unique for each twin.

    Args:
        report: kind of report, such as `REAL_TIME`.
        namespace: namespace of the twin, such as `/left`.
    """
    return "/".join(filter(None, (namespace.strip("/"), report)))


def is_status(name: str, report: str) -> bool:
    """Whether `name` is that of a status of kind `report`, in any namespace."""
    return name == report or name.endswith(f"/{report}")
