"""Base of the nodes: life cycle, parameters, topics, clocks."""
