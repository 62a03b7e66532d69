"""Bags and messages of ROS 2 and rosbag2, written and read without ROS."""
