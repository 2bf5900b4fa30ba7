"""Many runs of one case: sweeps, incremental dynamic analysis, gap checks, comparisons."""

from __future__ import annotations

import datetime
import html
import json
import math
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _native
from ._case import Case, as_case
from ._errors import CaseTypeError, flag, listed, needs, optional_text, refused, text, whole
from ._errors import path as as_path
from ._motion import Motion
from ._result import Progress, _progress, _threads

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["Comparison", "GapCheck", "Ida", "compare", "gap_check", "ida", "sweep"]

Path = str | os.PathLike[str]
Records = Iterable[Motion | Path] | Mapping[str, Motion | Path] | Motion | Path | None


def _records(records: Records) -> list[tuple[str, Any]]:
    if records is None:
        return []
    if isinstance(records, Mapping):
        named = [(text(name, "a name of records"), record) for name, record in records.items()]
    else:
        one = isinstance(records, (Motion, str, bytes, os.PathLike))
        each = [records] if one else listed(records, "records", "motions and paths")
        named = [(r.name if isinstance(r, Motion) else "", r) for r in each]
    if not named:
        raise refused("no records are given", "leave `records` out for that of the case")
    return [(name, _record(record)) for name, record in named]


def _record(record: Any) -> Any:
    if isinstance(record, Motion):
        return record._native
    if isinstance(record, (str, bytes, os.PathLike)):
        return as_path(record, "a record")
    what = f"a {type(record).__name__} is given as a record"
    raise refused(what, "give a Motion, or the path of a file or folder", CaseTypeError)


def _names(names: Iterable[str] | str, what: str) -> list[str]:
    """Names, also a single one. Left out, they are all; a list that is empty, as what a filter leaves, is not."""
    if isinstance(names, tuple) and not names:
        return []
    each = [names] if isinstance(names, str) else listed(names, what, "names")
    if len(each) == 0:
        raise refused(f"no {what} are given", f"leave `{what}` out for all of them")
    return [text(name, f"an entry of {what}") for name in each]


def _day(date: object) -> str | None:
    """A day as a text; of a time the day that it is on."""
    if isinstance(date, datetime.datetime):
        date = date.date()
        # The time of Pandas that is none is on no day.
        if isinstance(date, datetime.datetime):
            raise refused(f"date is {date!r}, which is no day", "give a day, or leave it out")
    if isinstance(date, datetime.date):
        return date.isoformat()
    if date is None or isinstance(date, str):
        return optional_text(date, "date")
    what = f"date is {date!r}, which is no day"
    raise refused(what, 'give a text, such as "2020-01-31", or a datetime.date', CaseTypeError)


def _output(study: str, output: Path | None) -> str:
    if output is not None:
        made = as_path(output, "output")
        if not made:
            raise refused("output is empty", "give the name of a file, or leave it out")
        return made
    return os.path.splitext(study)[0].removeprefix(f".{os.sep}") + ".h5"


def _run_study(
    study: str,
    output: Path | None,
    evaluated: bool,
    threads: int | None,
    progress: Progress | bool | None,
    **options: Any,
) -> tuple[str, dict[str, Any], dict[str, Any] | None]:
    target, count = _output(study, output), _threads(threads)
    told, bar = _progress(progress, "study")
    try:
        finished, analysis = _native.run_study(
            study,
            target,
            count,
            named=output is not None,
            evaluated=evaluated,
            progress=told,
            **options,
        )
    finally:
        if bar is not None:
            bar.close()
    return target, json.loads(finished), None if analysis is None else json.loads(analysis)


def sweep(
    study: Path,
    *,
    output: Path | None = None,
    threads: int | None = None,
    shard: str | None = None,
    resume: bool = False,
    keep_going: bool = False,
    progress: Progress | bool | None = None,
) -> xarray.Dataset:
    """Runs a study and opens its result.

    Parameters
    ----------
    study : path
        Study file (TOML).
    output : path, optional
        Result file (HDF5); beside the study file, with the ending ``.h5``, by default. Finished
        runs are stored beside it while the study goes on. It takes the place of no result of a
        run; a ``UserWarning`` says before the runs that it takes that of another file.
    threads : int, optional
        All cores by default; results do not depend on it.
    shard : str, optional
        A part of the study, such as ``"2/8"``.
    resume : bool
        Goes on with the finished runs of an interrupted call. A result that stands is read by
        another process of the interpreter.
    keep_going : bool
        Records runs whose motion cannot be read as failed.
    progress : callable or bool, optional
        As in :func:`pounding.run`.

    Returns
    -------
    xarray.Dataset
        Responses of all runs over the dimension ``run``, read when they are looked at; what the
        command says of the study is in the attribute ``sweep`` (JSON).
    """
    # Before the work, whose result it opens.
    needs("sweep", "xarray", "h5netcdf", "h5py")
    import xarray as xr

    options = {
        "shard": optional_text(shard, "shard"),
        "resume": flag(resume, "resume"),
        "keep_going": flag(keep_going, "keep_going"),
    }
    target, finished, _ = _run_study(as_path(study, "study"), output, False, threads, progress, **options)
    dataset = xr.open_dataset(target, engine="h5netcdf", decode_timedelta=False)
    dataset.attrs["sweep"] = json.dumps(finished)
    return dataset


class _Answered:
    """What is shown of an answer, whose numbers are many."""

    answer: dict[str, Any]

    def _lines(self) -> list[str]:
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"<pounding.{type(self).__name__}: {'; '.join(self._lines())}>"

    def _repr_html_(self) -> str:
        said = [*self._lines(), *self.answer.get("warnings", [])]
        lines = "".join(f"<li>{html.escape(line)}</li>" for line in said)
        return f"<p><strong>{type(self).__name__}</strong></p><ul>{lines}</ul>"


@dataclass(frozen=True, repr=False)
class Ida(_Answered):
    """What an incremental dynamic analysis says.

    Attributes
    ----------
    answer : dict
        All of it: what ``pounding ida --json`` prints.
    output : str
        The result file of the runs.
    """

    answer: dict[str, Any]
    output: str

    def _lines(self) -> list[str]:
        limits = [limit["name"] for limit in self.answer.get("limits", [])]
        intensities = len(self.answer.get("levels", []))
        return [f"{intensities} intensities, runs in {self.output}", f"limits: {', '.join(limits)}"]

    @property
    def levels(self) -> pandas.DataFrame:
        """Fractiles of every demand at every intensity."""
        needs("Ida.levels", "pandas")
        import pandas as pd

        rows = [
            {"intensity": level["intensity"], **demand}
            for level in self.answer["levels"]
            for demand in level["demands"]
        ]
        frame = pd.DataFrame(rows).rename(columns={"name": "demand"})
        return frame.set_index(["demand", "intensity"])

    @property
    def limits(self) -> pandas.DataFrame:
        """Fragilities of pounding and of the limits of the study, a row each."""
        needs("Ida.limits", "pandas")
        import pandas as pd

        return pd.json_normalize(self.answer["limits"])

    def runs(self) -> xarray.Dataset:
        """The runs, read when they are looked at."""
        needs("Ida.runs", "xarray", "h5netcdf", "h5py")
        import xarray as xr

        return xr.open_dataset(self.output, engine="h5netcdf", decode_timedelta=False)


def ida(
    study: Path,
    *,
    output: Path | None = None,
    threads: int | None = None,
    resume: bool = False,
    keep_going: bool = False,
    progress: Progress | bool | None = None,
) -> Ida:
    """Incremental dynamic analysis: fragilities, and the gap for a frequency.

    Parameters are those of :func:`sweep`; the study has a part ``[ida]``.
    """
    file = as_path(study, "study")
    options = {
        "shard": None,
        "resume": flag(resume, "resume"),
        "keep_going": flag(keep_going, "keep_going"),
    }
    if not _native.has_ida(file):
        what = f"{file} has no [ida]"
        raise refused(what, "add it, or run the study with sweep")
    target, finished, analysis = _run_study(file, output, True, threads, progress, **options)
    # The working folder may be another one when its runs are read.
    return Ida({**(analysis or {}), "sweep": finished}, os.path.abspath(target))


@dataclass(frozen=True, repr=False)
class GapCheck(_Answered):
    """Whether the gaps of a case are wide enough.

    Attributes
    ----------
    answer : dict
        All of it, in SI units: what ``pounding gap --json`` prints. ``sweep`` is ``None`` where no
        ``points`` were asked for; the command has 400 by default.
    """

    answer: dict[str, Any]

    def _lines(self) -> list[str]:
        code = self.answer["decided_by_code"]
        by = "" if code is None else f" by {code}"
        lines = [("adequate" if self.adequate else "not adequate") + by]
        count = len(self.answer["records"]) + len(self.answer["collapsed"])
        records = f"{count} record{'' if count == 1 else 's'}"
        for gap in self.answer["gaps"]:
            governing = gap["governing"]
            if governing is None:
                widths = [level["width"] for level in gap["levels"]]
                ends = [_native.shown_width(width) for width in (min(widths), max(widths))]
                provided = " to ".join(dict.fromkeys(ends))
                lines.append(f"gap {gap['name']}: {provided} mm, no width is enough under {records}")
                continue
            provided = _native.shown_width(governing["provided"])
            required = _native.shown_width(governing["required"], governing["provided"])
            lines.append(
                f"gap {gap['name']}: {provided} mm, of which {required} mm are required under {records}"
            )
        return lines

    @property
    def adequate(self) -> bool:
        """Whether every gap is wide enough: by the code, where one decides
        (``answer["decided_by_code"]``), else by the records. The answer of the records is
        ``answer["gaps"][i]["adequate"]``."""
        return bool(self.answer["adequate"])

    def __bool__(self) -> bool:
        return self.adequate

    @property
    def warnings(self) -> list[str]:
        """What the user should know of the records, the case and the answer: that two of the records are
        the same motion, for instance, which then weighs as several."""
        return list(self.answer["warnings"])

    @property
    def demand(self) -> pandas.DataFrame:
        """The width (m) that each record would just not close, a column for each gap.

        Infinite under records, the last ones, that bring a building to collapse without
        contact.
        """
        needs("GapCheck.demand", "pandas")
        import pandas as pd

        collapsed = self.answer["collapsed"]
        names = [record["name"] for record in [*self.answer["records"], *collapsed]]
        infinite = [math.inf] * len(collapsed)
        columns = {gap["name"]: gap["demand"] + infinite for gap in self.answer["gaps"]}
        return pd.DataFrame(columns, index=pd.Index(names, name="record"))

    @property
    def provisions(self) -> pandas.DataFrame:
        """The widths that provisions ask for, a row for each provision and gap.

        ``required`` (m) is the largest under any record and at any level, and NaN where a provision
        gives none under one of them, for the reason in ``refusal`` or as texts on it differ;
        ``records`` has those of each record and level.
        """
        needs("GapCheck.provisions", "pandas")
        import pandas as pd

        def required(provision: dict[str, Any]) -> float:
            widths = [record["width"] for record in provision["records"]]
            return math.nan if None in widths else max(widths, default=math.nan)

        rows = [
            {"gap": gap["name"], "required": required(provision), **provision}
            for gap in self.answer["gaps"]
            for provision in gap["provisions"]
        ]
        return pd.json_normalize(rows, max_level=0)


def gap_check(
    case: Case | Path,
    records: Records = None,
    *,
    code: str | None = None,
    country: str | None = None,
    date: str | datetime.date | None = None,
    rules: Path | None = None,
    provisions: Iterable[str] | str = (),
    set: Mapping[str, Any] | None = None,
    probability: float | str = 0.0,
    confidence: float | str = 0.9,
    points: int = 0,
    from_: float | str | None = None,
    to: float | str | None = None,
    gap: str | None = None,
    threads: int | None = None,
    progress: Progress | bool | None = None,
) -> GapCheck:
    """Is the gap wide enough, by simulation and by code?

    Parameters
    ----------
    case : Case or path
    records : motions, files or folders of records, optional
        A list, or a dict by name; the motion of the case by default. Of records of the same name the second
        is called ``x (2)``, as by the command; files of folders that are no records are left out with a
        warning.
    code : str, optional
        One code, such as ``"eurocode_8_2004"``, whose answer decides: with its statistic of the
        suite, for both cases of ownership; it stands in ``answer["gaps"][i]["code"]``. The name
        of a family, such as ``"eurocode_8"``, is its edition in force on ``date``.
    country : str, optional
        The code in force there decides.
    date : str or datetime.date, optional
        Day of the editions, ``"YYYY-MM-DD"``; today by default, and in ``answer`` in any case.
    rules : path, optional
        A file of rules of your own (TOML), which are applied beside the built-in ones.
    provisions : iterable of str, or one name, optional
        Provisions that alone are applied; those of the case, or all, by default.
    set : dict, optional
        Entries of the table ``separation`` in the place of those of the case, such as
        ``{"importance": 1.25}``.
    probability : float or str
        Part of the records that may bring the buildings into contact (-), such as ``"10 %"``.
    confidence : float or str
        Of two-sided bounds (-).
    points : int
        Widths in a sweep of the gap; none by default.
    from_, to : float or str, optional
        First and last width of the sweep (m).
    gap : str, optional
        Gap whose width varies in the sweep; all, with the same width, by default.
    threads : int, optional
    progress : callable or bool, optional
    """
    given = as_case(case)
    if not (set is None or isinstance(set, Mapping)):
        what = f"set is a {type(set).__name__}, which is no dict"
        raise refused(what, 'give entries of `separation`, such as {"importance": 1.25}', CaseTypeError)
    entries = None if set is None else dict(set)
    told, bar = _progress(progress, "gap check")
    try:
        answer = _native.gap_check_json(
            given._native,
            _records(records),
            optional_text(code, "code"),
            optional_text(country, "country"),
            _day(date),
            None if rules is None else as_path(rules, "rules"),
            _names(provisions, "provisions"),
            entries,
            probability,
            confidence,
            whole(points, "points", 0),
            (from_, to),
            optional_text(gap, "gap"),
            _threads(threads),
            told,
        )
    finally:
        if bar is not None:
            bar.close()
    return GapCheck(json.loads(answer))


@dataclass(frozen=True, repr=False)
class Comparison(_Answered):
    """Impact models beside one another on one case.

    Attributes
    ----------
    answer : dict
        All of it: what ``pounding compare --json`` prints.
    """

    answer: dict[str, Any]

    def _lines(self) -> list[str]:
        models, records = self.answer["models"], self.answer["records"]
        failed = sum(1 for model in models if model["failures"])
        lines = [f"{len(models)} models under {len(records)} record{'' if len(records) == 1 else 's'}"]
        if failed:
            lines.append(f"{failed} failed")
        for said in self.answer["conclusions"]:
            if said["holds"] == "depends on the model":
                lines.append(f"depends on the model: {said['statement']}")
        return lines

    @property
    def models(self) -> pandas.DataFrame:
        """A row for each model, indexed by its name."""
        needs("Comparison.models", "pandas")
        import pandas as pd

        frame = pd.json_normalize(self.answer["models"], max_level=0)
        name = "name" if "name" in frame else frame.columns[0]
        return frame.set_index(name)


def compare(
    case: Case | Path,
    models: Iterable[str] | str = (),
    records: Records = None,
    *,
    restitution: float | str | None = None,
    approach_velocity: float | str | None = None,
    same_duration: bool = False,
    exact: bool = False,
    threads: int | None = None,
    progress: Progress | bool | None = None,
) -> Comparison:
    """Is the answer sensitive to the impact model?

    Parameters
    ----------
    case : Case or path
    models : iterable of str, or one name
        Names of impact models; all by default.
    records : motions, files or folders of records, optional
        As in :func:`gap_check`.
    restitution : float, optional
        That of the gap's own law by default.
    approach_velocity : float or str, optional
        Of the collision in which models are calibrated (m/s); the maximum of the gap's own law
        by default.
    same_duration : bool
        Stiffnesses follow from the same contact time, not from the same penetration.
    exact : bool
        The restitution is what models return, not what their publications ask for.
    """
    given = as_case(case)
    told, bar = _progress(progress, "comparison")
    try:
        answer = _native.compare_json(
            given._native,
            _names(models, "models"),
            _records(records),
            restitution,
            approach_velocity,
            flag(same_duration, "same_duration"),
            flag(exact, "exact"),
            _threads(threads),
            told,
        )
    finally:
        if bar is not None:
            bar.close()
    return Comparison(json.loads(answer))
