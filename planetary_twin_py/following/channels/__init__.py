"""Sensors of one value at a time; `all` lists them."""
