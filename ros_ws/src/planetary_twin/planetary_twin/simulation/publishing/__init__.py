"""The messages of the simulation, and their stamps."""
