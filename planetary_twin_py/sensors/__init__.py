"""What sensors on a gearbox measure."""
