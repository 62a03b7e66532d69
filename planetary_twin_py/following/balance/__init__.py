"""Estimates friction from the balance of torques and speeds."""
