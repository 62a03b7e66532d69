"""The follower node."""
