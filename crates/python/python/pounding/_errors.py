"""Exceptions: their text says what is wrong, where, and what to do about it."""

from __future__ import annotations

from collections.abc import Sequence


class PoundingError(Exception):
    """Anything that keeps pounding from an answer.

    Attributes
    ----------
    faults : list of (message, help)
        All that is wrong, each with its place and, where one is known, a remedy.
    """

    def __init__(self, text: str, faults: Sequence[tuple[str, str | None]] = ()) -> None:
        super().__init__(text)
        self.faults: list[tuple[str, str | None]] = list(faults)

    @property
    def help(self) -> str | None:
        """The remedy of the first fault."""
        return self.faults[0][1] if self.faults else None


class CaseError(PoundingError, ValueError):
    """A case, a study or an argument that cannot be used."""


class RecordError(CaseError):
    """A record of a ground motion that cannot be read or used."""


class ComputationError(PoundingError, RuntimeError):
    """A run that could not be brought to its end: an energy ledger that does not close, a step
    that cannot be made small enough."""


class OutputError(PoundingError, OSError):
    """A file that could not be written; what stood under its name is untouched."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""
