"""A plant with hidden truth: plays a gearbox that changes, and the sensors that measure it."""
