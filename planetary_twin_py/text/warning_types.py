"""Warnings about the results of a run."""


class AccuracyWarning(UserWarning):
    """Results of a run are less accurate than its tolerance suggests."""


class LedgerWarning(UserWarning):
    """The energy ledger of a run does not balance."""
