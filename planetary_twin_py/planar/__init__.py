"""A gear set whose axes move in the plane: rows of its springs, errors, static load sharing."""
