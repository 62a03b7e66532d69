"""One table or figure of the paper: its statements, the computed values and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Verdict(StrEnum):
    """Whether a table or figure of the paper is reproduced; the values are those in JSON."""

    REPRODUCED = "reproduced"
    TREND = "trend reproduced"
    CANNOT = "cannot be, because"

    @property
    def text(self) -> str:
        """The verdict for people."""
        return "cannot be reproduced" if self is Verdict.CANNOT else str(self)


@dataclass(frozen=True, kw_only=True)
class Claim:
    """One statement of the paper, compared with computed values."""

    says: str
    """The statement."""
    ours: str
    """Values of the default scene."""
    holds: bool
    """Whether they agree with the statement."""
    printed: str = "-"
    """Values of the printed forms."""
    printed_holds: bool = False
    """Whether they agree with the statement."""
    kind: Literal["number", "trend"] = "trend"
    """Facts are of kind "number"."""
    why: str = ""
    """The reason if the values of the default scene do not agree."""

    @property
    def reached(self) -> bool:
        """Whether the values of one of the two scenes agree with the statement."""
        return self.holds or self.printed_holds


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A table or figure with number and title of the paper."""

    number: str
    title: str
    claims: tuple[Claim, ...]
    remarks: str = ""
    picture: Figure | None = None
    figures: Mapping[str, Any] = field(default_factory=dict)
    """Values for JSON, in SI."""

    @property
    def verdict(self) -> Verdict:
        """The verdict, which follows from the claims.

        Reproduced: all claims are reached, and at least one is a number. Trend: there are trends
        and all are reached, but there is no number or one is not reached. Otherwise not reproduced.
        """
        numbers = [claim.reached for claim in self.claims if claim.kind == "number"]
        trends = [claim.reached for claim in self.claims if claim.kind == "trend"]
        if not all(trends):
            return Verdict.CANNOT
        if numbers and all(numbers):
            return Verdict.REPRODUCED
        return Verdict.TREND if trends else Verdict.CANNOT

    @property
    def reason(self) -> str:
        """Reasons for claims that are not reached, or only in the printed form."""
        missed = [claim.why for claim in self.claims if not claim.reached and claim.why]
        printed = [
            f"one statement is reached in the printed form only, because {claim.why}"
            for claim in self.claims
            if claim.reached and not claim.holds and claim.why
        ]
        return "; ".join(dict.fromkeys(missed + printed))

    @property
    def slug(self) -> str:
        """Name of its picture, without suffix."""
        return self.number.lower().replace(" ", "_")
