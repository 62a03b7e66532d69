"""Follows many gearboxes of one type at the rates of a SCADA system, with arrays over gearboxes."""
