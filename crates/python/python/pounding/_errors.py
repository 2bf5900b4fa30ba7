"""Exceptions: their text says what is wrong, where, and what to do about it."""

from __future__ import annotations

import operator
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
    """A case, a study or an argument that cannot be used; a ``TypeError`` too where a value is of a
    kind that has no place in a case."""


class CaseTypeError(CaseError, TypeError):
    """A value of a kind that has no place in a case."""


class RecordError(CaseError):
    """A record of a ground motion that cannot be read or used."""


class ComputationError(PoundingError, RuntimeError):
    """A run that could not be brought to its end: an energy ledger that does not close, a step
    that cannot be made small enough."""


class OutputError(PoundingError, OSError):
    """A file that could not be written; what stood under its name is untouched."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


def refused(
    message: str, remedy: str, kind: type[CaseError] = CaseError
) -> CaseError:
    """An exception for an argument that cannot be used."""
    return kind(f"{message}\n  help: {remedy}", [(message, remedy)])


def whole(value: object, name: str, least: int, most: int = 2**31 - 1) -> int:
    """The value of an argument that is a count."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        what = f"{name} is {value!r}, which is no whole number"
        raise refused(what, f"give one from {least} on", CaseTypeError)
    count = operator.index(value)
    if not least <= count <= most:
        raise refused(f"{name} is {count}", f"give a whole number from {least} to {most}")
    return count


def text(value: object, name: str) -> str:
    """The value of an argument that is a text, not an empty one."""
    if not isinstance(value, str):
        raise refused(f"{name} is {value!r}, which is no text", "give a text", CaseTypeError)
    if not value:
        raise refused(f"{name} is empty", "give a text, or leave it out")
    return value
