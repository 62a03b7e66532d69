"""Recordings: bag folders with one MCAP file, written and read without ROS."""
