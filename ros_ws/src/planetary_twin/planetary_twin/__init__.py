"""ROS 2 nodes of the planetary gearbox twin."""
