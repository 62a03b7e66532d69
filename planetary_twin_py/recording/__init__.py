"""
Recordings: bag folders with MCAP files, written and read without ROS.

Four layers, each of which imports only the layers before it. `container`: MCAP files. `ros2`:
messages and bags. `runs`: simulation runs. `tables`: exchange of data with other tools.
"""
