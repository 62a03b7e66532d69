"""Names of kinds of studies, in the metadata `study` of their tables."""

from __future__ import annotations

BIFURCATION = "bifurcation"
