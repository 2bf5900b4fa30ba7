"""Cases: from a file, a dict, or buildings and gaps with keywords.

The keys are those of the case file (``docs/reference/case-file.md``): numbers are SI, texts
carry a unit, such as ``"20 mm"``.
"""

from __future__ import annotations

import contextlib
import copy
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ._errors import CaseTypeError, encoded, listed, refused
from ._errors import path as as_path
from ._motion import Motion
from ._native import Case as _NativeCase

__all__ = ["Analysis", "Building", "Case", "Gap", "GroundMotion", "Link", "Separation"]


class _Table(dict[str, Any]):
    """A table of the case file: a dict, whose keys are given as keywords."""

    def __init__(self, **keys: Any) -> None:
        super().__init__({key: _kept(value) for key, value in keys.items()})

    def _shown(self) -> str:
        return ", ".join(f"{key}={value!r}" for key, value in self.items())

    def __repr__(self) -> str:
        return f"pounding.{type(self).__name__}({self._shown()})"


class Building(_Table):
    """A building, storeys from the bottom.

    Parameters
    ----------
    name : str
        Its name in results.
    storeys : int, optional
        How many; follows from lists.
    mass, stiffness, height : float, str or list, optional
        Of a storey (kg, N/m, m): one value for all, or one for each.
    damping : dict, optional
        Such as ``{"stiffness_proportional": 0.05}``.
    **keys
        All other keys of ``[[building]]``: ``law``, ``stiffness_matrix``, ``isolator``,
        ``foundation``, ``plan``, ``ground``, ``initial_velocity`` and others.

    Examples
    --------
    >>> Building("light", storeys=3, mass=25e3, stiffness="3.46 MN/m", height=3.0,
    ...          damping={"stiffness_proportional": 0.05})["mass"]
    25000.0
    """

    def __init__(self, name: str, **keys: Any) -> None:
        super().__init__(name=name, **keys)


class Gap(_Table):
    """A gap between two neighbours, or a building and ``"wall"``.

    Parameters
    ----------
    left, right : str or Building
        Neighbours.
    width : float, str or list
        Width at rest (m).
    model : str
        Impact model: see :func:`pounding.models`.
    **keys
        Parameters of the model, such as ``stiffness`` and ``restitution``, and all other keys
        of ``[[gap]]``.
    """

    def __init__(self, left: str | Building, right: str | Building, **keys: Any) -> None:
        between = [side["name"] if isinstance(side, Building) else side for side in (left, right)]
        super().__init__(between=between, **keys)


class Link(_Table):
    """A link between floors of two neighbours, with a law: keys of ``[[link]]``."""

    def __init__(self, left: str | Building, right: str | Building, **keys: Any) -> None:
        between = [side["name"] if isinstance(side, Building) else side for side in (left, right)]
        super().__init__(between=between, **keys)


class GroundMotion(_Table):
    """A record of a file and how it is read and scaled: keys of ``[ground_motion]``."""

    def __init__(self, file: str | os.PathLike[str], **keys: Any) -> None:
        super().__init__(file=as_path(file, "file"), **keys)


class Analysis(_Table):
    """Method, duration, output step, tolerances: keys of ``[analysis]``."""


class Separation(_Table):
    """What provisions for the gap need to know: keys of ``[separation]``."""


class Case:
    """Buildings, gaps, ground motion and analysis: all that a run needs.

    Parameters
    ----------
    buildings : list of Building
        From the left; also a single one.
    gaps : list of Gap, optional
    ground_motion : GroundMotion, Motion or path
        A file, or a motion in memory.
    links : list of Link, optional
    analysis : Analysis or dict, optional
    separation : Separation or dict, optional
    title : str, optional
    folder : path, optional
        Where relative paths begin; the working folder by default.
    scale : optional
        How a motion in memory is scaled, as the key ``scale`` of ``[ground_motion]``.

    Raises
    ------
    CaseError
        All that is wrong with keys, kinds and units of values, each with its keys and what to do about
        it. What a model or a law does not take, such as an unknown model, and what is wrong with
        the record, is told by :meth:`check`, and by what runs the case.
    """

    _native: _NativeCase
    _made: tuple[Any, ...]
    _motion: Motion | None

    def __init__(
        self,
        buildings: Iterable[Mapping[str, Any]] | Mapping[str, Any],
        gaps: Iterable[Mapping[str, Any]] | Mapping[str, Any] = (),
        *,
        ground_motion: Motion | Mapping[str, Any] | str | os.PathLike[str],
        links: Iterable[Mapping[str, Any]] | Mapping[str, Any] = (),
        analysis: Mapping[str, Any] | None = None,
        separation: Mapping[str, Any] | None = None,
        title: str = "",
        folder: str | os.PathLike[str] = ".",
        scale: Any = None,
    ) -> None:
        tables: dict[str, Any] = {
            "building": _tables(buildings, "buildings"),
            "gap": _tables(gaps, "gaps"),
            "link": _tables(links, "links"),
        }
        tables = {key: value for key, value in tables.items() if value}
        # An empty one is none; what is no text is refused with the other keys.
        named = None if isinstance(title, str) and not title else title
        tables.update(title=named, analysis=analysis, separation=separation)
        motion = None
        if scale is not None and isinstance(ground_motion, Mapping) and ground_motion.get("scale") is not None:
            raise refused(
                f"ground_motion.scale is {ground_motion['scale']!r}, and `scale` is {scale!r}",
                "give one of the two: the argument is for motions in memory and plain paths",
            )
        if isinstance(ground_motion, Motion):
            motion = ground_motion
            tables["ground_motion"] = {"scale": scale}
        elif isinstance(ground_motion, Mapping):
            tables["ground_motion"] = {**ground_motion}
            if scale is not None:
                tables["ground_motion"]["scale"] = scale
        elif isinstance(ground_motion, _PATHS):
            tables["ground_motion"] = {"file": as_path(ground_motion, "ground_motion"), "scale": scale}
        else:
            motion = _as_motion(ground_motion)
        self.__setstate__(Case.from_dict(tables, folder=folder, motion=motion).__dict__)

    @classmethod
    def _of(cls, native: _NativeCase, made: tuple[Any, ...], motion: Motion | None) -> Case:
        """A case with how it is made again elsewhere: constructor and arguments."""
        case = cls.__new__(cls)
        case._native, case._made = native, made
        # The name of a motion may change, and the case was made with the one that it has now.
        case._motion = None if motion is None else Motion._of(motion._native, motion.name)
        return case

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    def __reduce__(self) -> tuple[Any, ...]:
        """Cases travel to other processes as their text or dict, with their motion."""
        return _restored, (*self._made, self._motion)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Case:
        """A case from its file (TOML)."""
        file = as_path(path, "path")
        native = _NativeCase.from_file(file)
        return cls._of(native, ("text", native.source, os.path.abspath(file)), None)

    @classmethod
    def from_text(cls, text: str, file: str | os.PathLike[str] = "case.toml") -> Case:
        """A case from the text of a case file; ``file`` names it and is the base of its paths."""
        if not isinstance(text, str):
            what = f"text is a {type(text).__name__}, which is no text"
            raise refused(what, "give the text of a case file", CaseTypeError)
        place = as_path(file, "file")
        native = _NativeCase.from_text(encoded(text, "text"), place)
        return cls._of(native, ("text", text, os.path.abspath(place)), None)

    @classmethod
    def from_dict(
        cls,
        tables: Mapping[str, Any],
        *,
        folder: str | os.PathLike[str] = ".",
        motion: Motion | None = None,
    ) -> Case:
        """A case from a dict with the tables and keys of the case file.

        Parameters
        ----------
        tables : dict
            ``building``, ``gap`` and ``link`` are lists. Values are numbers in SI units,
            texts with a unit, lists, arrays and dicts; ``None`` stands for a key that is
            not given. Iterators are read once, here.
        folder : path, optional
            Where relative paths begin.
        motion : Motion, optional
            Takes the place of the record of ``ground_motion``. Of its keys ``scale`` alone may
            stand there too, and ``file``, which is not read; others are errors.
        """
        if not isinstance(tables, Mapping):
            what = f"the case: a {type(tables).__name__} is given as its tables"
            raise refused(what, "give a dict with the tables of the case file", CaseTypeError)
        given = _plain(tables)
        base = as_path(folder, "folder")
        if motion is not None:
            motion = _as_motion(motion)
            ground = given.get("ground_motion")
            if not (ground is None or isinstance(ground, dict)):
                raise refused(
                    f"ground_motion: a {type(ground).__name__} stands beside a motion in memory",
                    "leave it out, or give a dict with `scale`",
                    CaseTypeError,
                )
            ground = {key: value for key, value in (ground or {}).items() if value is not None}
            known = {"scale"}
            beyond = sorted(map(str, set(ground) - known - {"file"}))
            if beyond:
                raise refused(
                    f"ground_motion.{beyond[0]}: a motion in memory takes `scale` alone",
                    "leave it out: the other keys say how a file is read",
                )
            ground["file"] = motion.name
            given["ground_motion"] = ground
        if motion is None:
            native = _NativeCase.from_dict(given, base)
        else:
            native = _NativeCase.from_dict(given, base, motion._native, motion.name)
        kind = "dict" if motion is None else "dict with motion"
        return cls._of(native, (kind, given, os.path.abspath(base)), motion)

    def with_motion(self, motion: Motion) -> Case:
        """The same case under another motion, processed and scaled as the case says.

        ``source``, and with it result files and pages, say which motion that is: its name, and
        a hash of its samples.
        """
        native = self._native.with_motion(_as_motion(motion)._native, motion.name)
        return Case._of(native, self._made, motion)

    @property
    def title(self) -> str:
        """Title, may be empty."""
        return self._native.title

    @property
    def source(self) -> str:
        """The text of the case file; under a motion in memory a comment at its end says so."""
        return self._native.source

    @property
    def buildings(self) -> list[str]:
        """Names of the buildings, from the left."""
        return self._native.buildings

    @property
    def gaps(self) -> list[str]:
        """Names of the gaps."""
        return self._native.gaps

    def check(self) -> dict[str, Any]:
        """What was understood: periods, modes, damping ratios, contact levels, the record, in SI
        units; what ``pounding check --json`` prints.

        Raises
        ------
        CaseError
            What cannot be, with its place.
        """
        answer: dict[str, Any] = json.loads(self._native.check_json())
        return answer

    def __repr__(self) -> str:
        title = f" {self.title!r}" if self.title else ""
        return f"<pounding.Case{title}: {', '.join(self.buildings)}>"


def as_case(case: Case | str | os.PathLike[str]) -> Case:
    """A case, or that of a file."""
    if isinstance(case, Case):
        return case
    if isinstance(case, _PATHS):
        return Case.from_file(case)
    what = f"a {type(case).__name__} is given as a case"
    raise refused(what, "give a Case, such as Case.from_dict makes, or a path", CaseTypeError)


def _as_motion(motion: Any) -> Motion:
    if isinstance(motion, Motion):
        return motion
    what = f"a {type(motion).__name__} is given as a motion"
    remedy = "give a Motion: Motion(array, time_step), or read_motion(path)"
    raise refused(what, remedy, CaseTypeError)


def _tables(
    given: Iterable[Mapping[str, Any]] | Mapping[str, Any], name: str
) -> list[Mapping[str, Any]]:
    """Tables of one kind, also a single one."""
    return [given] if isinstance(given, Mapping) else listed(given, name, "dicts")


def _kept(value: Any) -> Any:
    """The same, where it can be read once only as a list."""
    return [_kept(entry) for entry in value] if isinstance(value, Iterator) else value


#: What is no list although it has entries: texts, and what is refused with its keys.
_NO_LISTS = (str, bytes, bytearray, memoryview, set, frozenset)

#: Kinds of paths.
_PATHS = (str, bytes, os.PathLike)

#: Tables in one another at most: more than any case has.
_DEEPEST = 32


def _plain(value: Any, place: str = "", around: tuple[int, ...] = ()) -> Any:
    """A copy with plain dicts and lists in the place of other mappings and of all that has entries:
    what can be read once only is read here, and the same whenever the case is made again."""
    if isinstance(value, _NO_LISTS):
        return value
    if hasattr(value, "columns") and not isinstance(value, Mapping):
        what = f"{place or 'the case'}: a {type(value).__name__} is a table with names of columns"
        remedy = "give its values: one column of it, or `.to_numpy()`"
        raise refused(what, remedy, CaseTypeError)
    entries: Iterator[Any] | None = None
    # Arrays have one themselves, and without a dimension no entries.
    if not isinstance(value, Mapping) and not hasattr(value, "tolist"):
        with contextlib.suppress(TypeError):
            entries = iter(value)
    if entries is None and not isinstance(value, Mapping):
        # What cannot be copied is refused with its keys.
        with contextlib.suppress(Exception):
            return copy.deepcopy(value)
        return value
    if id(value) in around or len(around) > _DEEPEST:
        what = f"{place or 'the case'}: tables in tables without end"
        raise refused(what, "give a dict or list that does not contain itself")
    around = (*around, id(value))
    if entries is not None:
        return [_plain(entry, f"{place}[{i}]", around) for i, entry in enumerate(entries)]
    dot = "." if place else ""
    return {key: _plain(entry, f"{place}{dot}{key}", around) for key, entry in value.items()}


def _restored(kind: str, content: Any, place: str, motion: Motion | None) -> Case:
    """A case in another process."""
    if kind == "dict with motion" and motion is not None:
        # Its text names the motion that it was made with.
        native = _NativeCase.from_dict(content, place, motion._native, motion.name)
        return Case._of(native, (kind, content, place), motion)
    if kind == "text":
        case = Case.from_text(content, place)
    else:
        case = Case.from_dict(content, folder=place)
    return case if motion is None else case.with_motion(motion)
