"""Export of a scene as a functional mock-up unit (FMU) for co-simulation."""

from .export import VERSIONS, export_fmu

__all__ = ["VERSIONS", "export_fmu"]
