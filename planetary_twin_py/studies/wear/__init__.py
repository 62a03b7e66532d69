"""Wear of all flanks with their passages, by the law of a scene."""
