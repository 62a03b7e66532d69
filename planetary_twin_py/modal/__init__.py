"""Natural modes of the gearset, from models that are lists of springs."""
