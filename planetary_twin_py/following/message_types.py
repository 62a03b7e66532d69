"""Types of the messages of a measured gearbox."""

JOINTS = ("sensor_msgs/msg/JointState", "control_msgs/msg/DynamicJointState")
TEMPERATURE = "sensor_msgs/msg/Temperature"
ENCODERS = "planetary_twin_msgs/msg/EncoderBlock"
VIBRATION = "planetary_twin_msgs/msg/SampledBlock"
