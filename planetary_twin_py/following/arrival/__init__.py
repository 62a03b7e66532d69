"""Puts readings of several senders in order, and averages them over bins."""
