"""Orders at which faults of teeth and bearings have lines."""
