"""
Recordings: bag folders with MCAP files, written and read without ROS.

Four layers, of which each imports only those before it: `container` knows MCAP, `ros2` knows
messages and bags, `runs` knows what was simulated, `tables` exchanges data with other tools.
"""
