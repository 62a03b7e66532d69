"""Lines of the spectrum of a gearbox: which member has them, and how far they can be trusted."""
