"""Runs and what they return."""

from __future__ import annotations

import copy
import html
import io
import json
import os
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np

from . import _native
from ._case import Case, as_case
from ._errors import CaseTypeError, PoundingError, flag, listed, needs, one_of, refused, whole
from ._errors import path as as_path

if TYPE_CHECKING:
    import numpy.typing as npt
    import pandas
    import xarray

    Array = npt.NDArray[np.float64]

__all__ = ["BuildingHistories", "GapHistories", "Result", "run", "run_many"]

Progress = Callable[[int, int], object]


class BuildingHistories:
    """Responses of a building over time: arrays of shape (time, storey), read only, in the memory
    of the run."""

    def __init__(self, native: _native.Run, first: int, end: int) -> None:
        self._native, self._columns = native, slice(first, end)

    def _array(self, name: str) -> Array:
        return self._native.array(name)[:, self._columns]

    @property
    def displacement(self) -> Array:
        """Floor displacements relative to the ground (m)."""
        return self._array("displacement")

    @property
    def velocity(self) -> Array:
        """Floor velocities relative to the ground (m/s)."""
        return self._array("velocity")

    @property
    def acceleration_absolute(self) -> Array:
        """Absolute floor accelerations (m/s2)."""
        return self._array("acceleration_absolute")

    @property
    def storey_shear(self) -> Array:
        """Storey shears (N), elastic or by the law of the storey."""
        return self._array("storey_shear")


class GapHistories:
    """Responses of a gap over time: arrays of shape (time, level), read only, in the memory of the
    run."""

    def __init__(self, native: _native.Run, first: int, end: int) -> None:
        self._native, self._columns = native, slice(first, end)

    @property
    def penetration(self) -> Array:
        """Penetration (m), negative while the gap is open."""
        return self._native.array("penetration")[:, self._columns]

    @property
    def force(self) -> Array:
        """Contact force (N), positive pushes apart."""
        return self._native.array("force")[:, self._columns]


class Result:
    """A run that has ended, with peaks from inside the steps, located impacts and a closed energy
    ledger. All values are SI."""

    def __init__(self, native: _native.Run, case: Case) -> None:
        self._native, self._case = native, case
        self._summary: dict[str, Any] | None = None

    @property
    def case(self) -> Case:
        """The case that was run."""
        return self._case

    @property
    def summary(self) -> dict[str, Any]:
        """Peaks, impacts, energies and statistics: what ``pounding run --json`` prints. A copy,
        which may be changed."""
        return copy.deepcopy(self._said)

    @property
    def _said(self) -> dict[str, Any]:
        if self._summary is None:
            self._summary = json.loads(self._native.summary_json())
        return self._summary

    @property
    def warnings(self) -> list[str]:
        """What the user should know of the record and of the run."""
        return list(self._said["warnings"])

    @property
    def time(self) -> Array:
        """Output times (s), shape (time,)."""
        return self._native.time

    @property
    def ground_acceleration(self) -> Array:
        """Ground acceleration at the output times (m/s2), shape (time,)."""
        return self._native.array("ground_acceleration")[:, 0]

    @property
    def buildings(self) -> dict[str, BuildingHistories]:
        """Responses of the buildings over time, by name."""
        columns = self._native.building_columns
        return {name: BuildingHistories(self._native, a, b) for name, a, b in columns}

    @property
    def gaps(self) -> dict[str, GapHistories]:
        """Responses of the gaps over time, by name."""
        columns = self._native.gap_columns
        return {name: GapHistories(self._native, a, b) for name, a, b in columns}

    @property
    def impacts(self) -> pandas.DataFrame:
        """Impacts in order of closure, a row each, with the columns of the result file: ``gap``,
        ``level`` (from 1), ``t_close``, ``t_open`` (s), ``approach_velocity``,
        ``separation_velocity`` (m/s), ``achieved_restitution``, ``peak_force`` (N),
        ``peak_force_time`` (s), ``peak_penetration`` (m), ``impulse`` (N s) and
        ``energy_dissipated`` (J)."""
        needs("Result.impacts", "pandas")
        import pandas as pd

        columns = self._native.impacts()
        return pd.DataFrame({**columns, "gap": pd.Series(columns["gap"], dtype=_of_texts())})

    @property
    def peaks(self) -> pandas.DataFrame:
        """Peak absolute responses of all storeys, a row each, indexed by building and storey (from
        1): ``displacement`` (m), ``drift_ratio``, ``storey_shear`` (N) and
        ``acceleration_absolute`` (m/s2), each with its time (s) and, as ``isolated_...``,
        without gaps, where that run was made."""
        needs("Result.peaks", "pandas")
        import pandas as pd

        rows = []
        for building in self._said["buildings"]:
            pairs = zip(building["storeys"], building["isolated"], strict=True)
            for number, (storey, isolated) in enumerate(pairs, start=1):
                row: dict[str, Any] = {"building": building["name"], "storey": number}
                for name, peak in storey.items():
                    row[name], row[f"{name}_time"] = peak["peak"], peak["time"]
                if self._native.has_isolated:
                    for name, peak in isolated.items():
                        row[f"isolated_{name}"] = peak["peak"]
                rows.append(row)
        frame = pd.DataFrame(rows).set_index(["building", "storey"])
        return frame.astype(float)

    @property
    def levels(self) -> pandas.DataFrame:
        """What happened at each contact level, indexed by gap and level (from 1): ``impacts``,
        ``first_contact`` (s), ``peak_force`` (N), ``peak_penetration`` (m),
        ``approach_velocity_max`` (m/s), ``impulse`` (N s), ``energy_dissipated`` (J)."""
        needs("Result.levels", "pandas")
        import pandas as pd

        names = ["impacts", "first_contact", "approach_velocity_max", "impulse", "energy_dissipated"]
        rows = []
        for gap in self._said["gaps"]:
            for number, level in enumerate(gap["levels"], start=1):
                row: dict[str, Any] = {"gap": gap["name"], "level": number}
                row.update({name: level[name] for name in names})
                for name in ("peak_force", "peak_penetration"):
                    row[name] = level[name]["peak"]
                rows.append(row)
        columns = ["gap", "level", *names, "peak_force", "peak_penetration"]
        kinds: dict[str, Any] = dict.fromkeys(columns, float)
        kinds.update(gap=_of_texts(), level=int, impacts=int)
        frame = pd.DataFrame(rows, columns=columns).astype(kinds)
        return frame.set_index(["gap", "level"])

    @property
    def energy(self) -> pandas.DataFrame:
        """The energy ledger (J) over the output times: ``input``, ``kinetic``, ``strain``,
        ``viscous``, ``hysteretic``, ``impact``, ``residual``."""
        needs("Result.energy", "pandas")
        import pandas as pd

        index = pd.Index(np.array(self.time), name="time")
        return pd.DataFrame(self._native.energy(), index=index)

    def to_xarray(self) -> xarray.DataTree:
        """The whole result as a tree of labelled arrays with units: the groups of the result file
        (``docs/reference/result-file.md``), from memory.

        The table ``impacts`` of a gap is a group of its own, with an array for each column, such
        as ``tree["gap/light-heavy/impacts/t_close"]``; the column ``level`` is ``level_number``
        there. ``to_netcdf`` writes the tree.
        """
        needs("Result.to_xarray", "xarray", "h5netcdf", "h5py")
        import xarray as xr

        # Decoded from a copy of the file in memory: no file is written.
        file = io.BytesIO(self._native.image())
        with xr.open_datatree(file, engine="h5netcdf", phony_dims="sort", decode_timedelta=False) as tree:
            loaded = tree.load()
        for gap in loaded["gap"].children.values() if "gap" in loaded.children else ():
            columns = _columns(gap.dataset["impacts"])
            gap.dataset = gap.to_dataset(inherit=False).drop_vars("impacts")
            gap["impacts"] = xr.DataTree(columns)
        return loaded

    def to_hdf5(self, path: str | os.PathLike[str]) -> None:
        """Writes the result file, the same that ``pounding run`` writes. A ``UserWarning`` says before which
        file it takes the place of, unless that is an earlier result of the same case file, or of the same case
        that was made in code.

        Raises
        ------
        OutputError
            It cannot be written, or would replace the result of a study; what stood under the
            name is untouched.
        CaseError
            It would replace what the case reads.
        """
        self._native.to_hdf5(as_path(path, "path"))

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """The page of the run, one HTML file that needs no other; written to ``path`` if that is
        given. A ``UserWarning`` says before that it takes the place of a file that is no page."""
        file = None if path is None else as_path(path, "path")
        page = self._native.page(self.case.title or "result")
        if file is not None:
            self._native.write_page(file, page)
        return page

    def _lines(self) -> list[str]:
        lines = []
        for gap in self._said["gaps"]:
            count = sum(level["impacts"] for level in gap["levels"])
            forces = [level["peak_force"]["peak"] for level in gap["levels"]]
            force = max((f for f in forces if f is not None), default=None)
            what = f"{count} impact{'' if count == 1 else 's'}"
            if count and force is not None:
                what += f", at most {force / 1e3:.4g} kN"
            lines.append(f"gap {gap['name']}: {what}")
        return lines

    def __repr__(self) -> str:
        title = self.case.title or ", ".join(self.case.buildings)
        return f"<pounding.Result {title!r}: {'; '.join(self._lines()) or 'no gaps'}>"

    def _repr_html_(self) -> str:
        title = html.escape(self.case.title or ", ".join(self.case.buildings))
        lines = "".join(f"<li>{html.escape(line)}</li>" for line in [*self._lines(), *self.warnings])
        shown = ["displacement", "drift_ratio", "storey_shear", "acceleration_absolute"]
        try:
            table: str = self.peaks[shown].to_html(float_format=lambda x: f"{x:.4g}")
        except ImportError:
            table = ""
        return f"<p><strong>{title}</strong></p><ul>{lines}</ul>{table}"


#: Units of the columns of impacts, which a table of them has not.
_UNITS = {
    "t_close": "s",
    "t_open": "s",
    "approach_velocity": "m s-1",
    "separation_velocity": "m s-1",
    "achieved_restitution": "1",
    "peak_force": "N",
    "peak_force_time": "s",
    "peak_penetration": "m",
    "impulse": "N s",
    "energy_dissipated": "J",
}


def _columns(table: xarray.DataArray) -> xarray.Dataset:
    """The columns of the table of impacts of a gap, as arrays."""
    import xarray as xr

    rows = table.values
    level = rows["level"].astype(np.int64)
    about = {"units": "1", "long_name": "place in the dimension level, from 1"}
    variables: dict[str, Any] = {"level_number": ("impact", level, about)}
    for name, units in _UNITS.items():
        about = {"units": units, "long_name": name.replace("_", " ")}
        variables[name] = ("impact", np.ascontiguousarray(rows[name]), about)
    coordinates: dict[str, Any] = {"impact": table["impact"].variable}
    names = [name for name in table.attrs.get("constants", "").split(", ") if name]
    if names:
        about = {"long_name": "constants that the model fixed at closure"}
        constants = np.ascontiguousarray(rows["constants"][:, : len(names)])
        variables["constants"] = (("impact", "constant"), constants, about)
        coordinates["constant"] = ("constant", names)
    return xr.Dataset(variables, coordinates, {"long_name": "impacts in order of closure"})


def _of_texts() -> Any:
    """The type of a column of texts, also of an empty one."""
    import pandas as pd

    return pd.Series([""]).dtype


def _threads(threads: int | None) -> int:
    """As many as the command line takes."""
    return (os.cpu_count() or 1) if threads is None else whole(threads, "threads", 1, 4096)


def _progress(progress: Progress | bool | None, what: str) -> tuple[Progress | None, Any]:
    """A callback, and what has to be closed at the end."""
    if progress is None or progress is False:
        return None, None
    if progress is not True:
        if not callable(progress):
            what = f"progress is {progress!r}, which cannot be called"
            raise refused(what, "give a function of two numbers, or True for a bar", CaseTypeError)
        return progress, None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None, None
    bar = tqdm(desc=what, leave=False)

    def show(done: int, total: int) -> None:
        bar.total = total
        bar.update(done - bar.n)

    return show, bar


def run(
    case: Case | str | os.PathLike[str],
    *,
    histories: bool = True,
    isolated: bool = True,
    progress: Progress | bool | None = None,
) -> Result:
    """Runs a case: with its gaps and, for comparison, without them.

    Parameters
    ----------
    case : Case or path
        A case, or its file.
    histories : bool
        Whether responses over time are kept; peaks and impacts are the same, to the last bit.
    isolated : bool
        Whether the buildings are run without gaps too.
    progress : callable or bool, optional
        Called with what is done and how much there is, several times a second; ``True`` shows
        a bar where tqdm is installed.

    Raises
    ------
    CaseError
        A case that cannot be run, with its place and a remedy.
    ComputationError
        A run without an end, located.
    """
    wanted = flag(histories, "histories"), flag(isolated, "isolated")
    given = as_case(case)
    told, bar = _progress(progress, "run")
    try:
        native = _native.run(given._native, *wanted, told)
    finally:
        if bar is not None:
            bar.close()
    return Result(native, given)


Cases = Iterable[Case | str | os.PathLike[str]] | Case | str | os.PathLike[str]


@overload
def run_many(
    cases: Cases,
    *,
    threads: int | None = None,
    histories: bool = False,
    isolated: bool = False,
    errors: Literal["raise"] = "raise",
    progress: Progress | bool | None = None,
) -> list[Result]: ...


@overload
def run_many(
    cases: Cases,
    *,
    threads: int | None = None,
    histories: bool = False,
    isolated: bool = False,
    errors: Literal["return"],
    progress: Progress | bool | None = None,
) -> list[Result | PoundingError]: ...


def run_many(
    cases: Cases,
    *,
    threads: int | None = None,
    histories: bool = False,
    isolated: bool = False,
    errors: Literal["raise", "return"] = "raise",
    progress: Progress | bool | None = None,
) -> list[Result] | list[Result | PoundingError]:
    """Runs many cases on all cores, without Python's lock.

    Parameters
    ----------
    cases : iterable of Case or path, or one of them
    threads : int, optional
        How many; all cores by default. Results do not depend on it, to the last bit.
    histories, isolated : bool
        As in :func:`run`.
    errors : {"raise", "return"}
        Whether the first run that fails raises its exception when all have ended, or every
        exception stands in the place of its result.
    progress : callable or bool, optional
        As in :func:`run`, in runs.

    Returns
    -------
    list of Result
        In the order of the cases, with exceptions among them where ``errors`` is ``"return"``.
    """
    one_of(errors, "errors", "raise", "return")
    wanted = flag(histories, "histories"), flag(isolated, "isolated")
    given: list[Case | PoundingError] = []
    one = isinstance(cases, (Case, str, bytes, os.PathLike))
    each: list[Any] = [cases] if one else listed(cases, "cases", "cases, each a Case or a path")
    for case in each:
        try:
            given.append(as_case(case))
        except PoundingError as error:
            if errors == "raise":
                raise
            given.append(error)
    sound = [case for case in given if isinstance(case, Case)]
    count = _threads(threads)
    told, bar = _progress(progress, "runs")
    try:
        made = _native.run_many([c._native for c in sound], count, *wanted, told)
    finally:
        if bar is not None:
            bar.close()
    results: list[Result | PoundingError] = []
    natives = iter(made)
    for entry in given:
        if not isinstance(entry, Case):
            results.append(entry)
            continue
        native = next(natives)
        if isinstance(native, BaseException):
            if errors == "raise" or not isinstance(native, PoundingError):
                raise native
            results.append(native)
        else:
            results.append(Result(native, entry))
    return results
