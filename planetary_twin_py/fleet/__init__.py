"""Estimates friction of many gearboxes of one type from readings of a SCADA system."""
