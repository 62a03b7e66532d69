"""One table or figure of the paper: what it claims, what comes out, and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Verdict(StrEnum):
    """How far a table or figure of the paper comes out."""

    REPRODUCED = "reproduced"
    TREND = "trend reproduced"
    CANNOT = "cannot be, because"


@dataclass(frozen=True, kw_only=True)
class Claim:
    """One statement of the paper, judged by computed numbers."""

    says: str
    ours: str
    holds: bool
    printed: str = "-"
    """What the printed forms give."""
    printed_holds: bool = False
    kind: Literal["number", "trend"] = "trend"
    why: str = ""
    """Where the default does not hold: the reason."""

    @property
    def reached(self) -> bool:
        """Whether either form agrees with the paper."""
        return self.holds or self.printed_holds


@dataclass(frozen=True, kw_only=True)
class Entry:
    """A table or figure, numbered and titled as in the paper."""

    number: str
    title: str
    claims: tuple[Claim, ...]
    remarks: str = ""
    picture: Figure | None = None
    figures: Mapping[str, Any] = field(default_factory=dict)
    """Numbers for machines, in SI."""

    @property
    def verdict(self) -> Verdict:
        """Follows from the claims alone.

        Reproduced if all of them are reached and one of them is a number; the trend, if there are
        trends and all of them are, but no number is stated or one is not reached; else not.
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
        """Why what does not come out does not, and what comes out in the printed form only."""
        missed = [claim.why for claim in self.claims if not claim.reached and claim.why]
        printed = [
            f"as printed only: {claim.why}"
            for claim in self.claims
            if claim.reached and not claim.holds and claim.why
        ]
        return "; ".join(dict.fromkeys(missed + printed))

    @property
    def slug(self) -> str:
        """Name of its picture."""
        return self.number.lower().replace(" ", "_")
