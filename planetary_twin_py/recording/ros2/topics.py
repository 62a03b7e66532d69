"""Names of the twin's topics, as they stand in a recording behind a namespace."""

STATE = "gearbox_state"
WAVEFORM = "mesh_waveform"
JOINTS = "joint_states"
POINT = "operating_point"
ORIGIN = "run_origin"
DESCRIPTION = "robot_description"
REAL_TIME = "simulation: real time"  # a report in /diagnostics


def status_name(report: str, namespace: str) -> str:
    """
    Return the name of a status in /diagnostics, which viewers and aggregators tell apart by name.

    Parameters:
        report: what it reports, such as `REAL_TIME`.
        namespace: of the twin, such as `/left`.
    """
    return "/".join(filter(None, (namespace.strip("/"), report)))


def is_status(name: str, report: str) -> bool:
    """Whether a status called `name` is the `report` of a twin, in whichever namespace."""
    return name == report or name.endswith(f"/{report}")
