"""Names of the twin's topics, as they stand in a recording behind a namespace."""

STATE = "gearbox_state"
WAVEFORM = "mesh_waveform"
JOINTS = "joint_states"
POINT = "operating_point"
ORIGIN = "run_origin"
DESCRIPTION = "robot_description"
REAL_TIME = "simulation: real time"  # a report in /diagnostics
