"""Natural modes of a gearset, from models of masses and springs."""
