"""Bags and messages as ROS 2 and rosbag2 define them, written and read without ROS."""
