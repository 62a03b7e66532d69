"""The logger node."""
