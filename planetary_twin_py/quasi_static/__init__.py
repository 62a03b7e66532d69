"""A train without dynamics: it turns rigidly, and its loads are in static equilibrium."""
