"""Exceptions: their text says what is wrong, where, and what to do about it."""

from __future__ import annotations

import importlib
import operator
import os
from collections.abc import Sequence
from typing import Any

import numpy as np


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


class MissingPackageError(PoundingError, ModuleNotFoundError):
    """A package that is not installed, and without which something has no answer."""


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


def needs(what: str, *packages: str, extra: str = "xarray") -> None:
    """Refuses what needs packages that are not there, before it is begun."""
    for package in packages:
        try:
            importlib.import_module(package)
        except ImportError as error:
            message = f"{what} needs the package {package}: {error}"
            remedy = f'pip install "pounding[{extra}]"'
            raise MissingPackageError(f"{message}\n  help: {remedy}", [(message, remedy)]) from error


def listed(values: object, name: str, of: str) -> list[Any]:
    """The entries of an argument that is a list, not a text."""
    if not isinstance(values, (str, bytes)):
        try:
            entries = iter(values)  # type: ignore[call-overload]
        except TypeError:
            pass
        else:
            return list(entries)
    what = f"{name} is {_brief(values)}, which is no list"
    raise refused(what, f"give a list of {of}", CaseTypeError)


def whole(value: object, name: str, least: int, most: int = 2**31 - 1) -> int:
    """The value of an argument that is a count."""
    try:
        if isinstance(value, bool):
            raise TypeError
        # Arrays have the method whatever they hold.
        count = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        what = f"{name} is {_brief(value)}, which is no whole number"
        raise refused(what, f"give one from {least} on", CaseTypeError) from None
    if not least <= count <= most:
        raise refused(f"{name} is {count}", f"give a whole number from {least} to {most}")
    return count


def text(value: object, name: str) -> str:
    """The value of an argument that is a text, not an empty one."""
    if not isinstance(value, str):
        raise refused(f"{name} is {_brief(value)}, which is no text", "give a text", CaseTypeError)
    if not value:
        raise refused(f"{name} is empty", "give a text, or leave it out")
    return encoded(value, name)


def optional_text(value: object, name: str) -> str | None:
    """The same of one that may be left out."""
    return None if value is None else text(value, name)


def one_of(value: object, name: str, *words: str) -> str:
    """The value of an argument that is one of a few words."""
    kind = CaseError if isinstance(value, str) else CaseTypeError
    # An array beside a text compares each of its values.
    if kind is CaseTypeError or value not in words:
        shown = " or ".join(f'"{word}"' for word in words)
        raise refused(f"{name} is {_brief(value)}", f"it is {shown}", kind)
    return str(value)


def encoded(value: str, name: str) -> str:
    """A text that a file can hold."""
    try:
        value.encode()
    except UnicodeEncodeError:
        what = f"{name} has characters that no file can hold"
        raise refused(what, "write the text anew") from None
    return value


def flag(value: object, name: str) -> bool:
    """The value of an argument that is true or false."""
    if not isinstance(value, (bool, np.bool_)):
        what = f"{name} is {_brief(value)}, which is neither True nor False"
        raise refused(what, "give True or False", CaseTypeError)
    return bool(value)


def path(value: object, name: str) -> str:
    """The value of an argument that is a path: a text, bytes as the system has them, or an object
    that stands for one."""
    try:
        made = os.fsdecode(value)  # type: ignore[arg-type]
    except TypeError:
        what = f"{name} is {_brief(value)}, which is no path"
        raise refused(what, "give a text or a pathlib.Path", CaseTypeError) from None
    try:
        os.fsencode(made)
    except UnicodeEncodeError:
        what = f"{name} has characters that no path can hold"
        raise refused(what, "write the path anew") from None
    return made


def _brief(value: object) -> str:
    """A value in a message, which may have many entries."""
    shown = repr(value)
    return shown if len(shown) <= 60 else f"a {type(value).__name__}"
