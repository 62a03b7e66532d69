"""A gear set whose axes tilt and move along themselves: rows of its meshes, what bearings need."""
