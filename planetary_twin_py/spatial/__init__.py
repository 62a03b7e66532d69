"""A gear set whose axes tilt and move axially: rows of its meshes, requirements on bearings."""
