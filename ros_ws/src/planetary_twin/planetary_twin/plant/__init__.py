"""The plant node."""
