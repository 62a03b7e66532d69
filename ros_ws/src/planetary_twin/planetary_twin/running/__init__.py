"""One run: two nodes as processes, changes of the operating point, and the outcome."""
