"""One run: two nodes as processes, a user who turns the knobs, and what came of it."""
