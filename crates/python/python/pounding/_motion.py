"""Ground motions: records of files and arrays, response spectra, intensity measures."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._errors import CaseError, CaseTypeError, flag, needs, optional_text, refused, text, whole
from ._errors import path as as_path

if TYPE_CHECKING:
    import numpy.typing as npt
    import obspy
    import xarray

__all__ = ["Motion", "formats", "measures", "read_motion", "spectrum"]


def _real(values: npt.ArrayLike, name: str, of: str) -> npt.NDArray[np.float64]:
    """Real numbers along one dimension."""
    # Whose codes of characters would be read as numbers; a view of them that was cast to numbers is of such.
    of_bytes = isinstance(values, memoryview) and values.format in ("B", "b", "c")
    if of_bytes or isinstance(values, (bytes, bytearray)):
        what = f"{name} is a {type(values).__name__}, which is no list of numbers"
        raise refused(what, "give real numbers", CaseTypeError)
    try:
        if np.ma.is_masked(values) or np.iscomplexobj(values):
            raise refused(f"{name} has masked or complex values", "give real numbers, all of them")
        kind = np.asarray(values).dtype
        if kind.kind not in "iufO":
            raise refused(f"{name} has values of type {kind}", "give real numbers")
        if kind.kind == "O":
            # Whose texts would be read as numbers, and nothing as none of them.
            wrong = [v for v in np.ravel(values) if v is None or isinstance(v, (str, bytes, bytearray, bool, np.bool_))]
            if wrong:
                raise refused(f"{name} has the value {wrong[0]!r}", "give real numbers")
        array = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        if isinstance(error, CaseError):
            raise
        raise refused(f"{name} is no list of numbers: {error}", "give real numbers") from None
    if np.ndim(values) > 1:
        raise refused(f"{name} has {array.ndim} dimensions", f"give one of {of}")
    return array


def _periods(
    given: npt.ArrayLike | None, first: float, last: float, count: int
) -> npt.NDArray[np.float64]:
    """Periods (s), at least one; left out, so many between two."""
    if given is None:
        return _native.periods(first, last, count)
    at = _real(given, "periods", "periods (s)")
    if at.size == 0:
        raise refused("no periods are given", f"leave `periods` out for {count} from {first:g} to {last:g} s")
    return at


class Motion:
    """A ground acceleration at even steps, linear in between.

    Parameters
    ----------
    acceleration : array_like, shape (samples,)
        Accelerations in ``unit``.
    time_step : float or str
        Time between them (s), or a text with its unit.
    unit : str, optional
        ``"m/s2"`` (default), ``"g"``, ``"cm/s2"``, ``"gal"``, ``"mm/s2"``, ``"in/s2"`` or
        ``"ft/s2"``.
    name : str, optional
        What tables and datasets call it.
    """

    def __init__(
        self,
        acceleration: npt.ArrayLike,
        time_step: float | str,
        unit: str = "m/s2",
        name: str = "motion",
    ) -> None:
        samples = _real(acceleration, "acceleration", "samples")
        self._native = _native.Motion(samples, time_step, text(unit, "unit"))
        self.name = name

    @property
    def name(self) -> str:
        """What tables and datasets call it."""
        return self._name

    @name.setter
    def name(self, name: str) -> None:
        self._name = text(name, "name")

    @classmethod
    def _of(cls, native: _native.Motion, name: str) -> Motion:
        motion = cls.__new__(cls)
        motion._native = native
        motion.name = name
        return motion

    @property
    def acceleration(self) -> npt.NDArray[np.float64]:
        """Accelerations (m/s2), shape (samples,): a copy."""
        return self._native.acceleration

    @property
    def time_step(self) -> float:
        """Time between samples (s)."""
        return self._native.time_step

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Times of the samples (s), shape (samples,)."""
        return np.arange(len(self.acceleration), dtype=np.float64) * np.float64(self.time_step)

    @property
    def duration(self) -> float:
        """Time of the last sample (s)."""
        return self._native.duration

    @property
    def peak(self) -> float:
        """Peak ground acceleration (m/s2)."""
        return self._native.peak

    @property
    def origin(self) -> dict[str, Any] | None:
        """File, format, component, unit, hash and warnings of a record; ``None`` of an array."""
        origin: dict[str, Any] | None = json.loads(self._native.origin_json())
        return origin

    def scaled_by(self, factor: float | str) -> Motion:
        """The same multiplied by a factor."""
        return Motion._of(self._native.scaled_by(factor), self.name)

    def scaled_to_peak(self, peak: float | str) -> Motion:
        """The same scaled to a peak ground acceleration (m/s2), or a text such as ``"0.3 g"``."""
        return Motion._of(self._native.scaled_to_peak(peak), self.name)

    def spectrum(
        self, periods: npt.ArrayLike | None = None, damping: float | str = 0.05
    ) -> xarray.Dataset:
        """The response spectrum: see :func:`spectrum`."""
        return spectrum(self, periods=periods, damping=damping)

    def measures(self, damping: float | str = 0.05) -> dict[str, Any]:
        """Intensity measures: see :func:`measures`."""
        return measures(self, damping=damping)

    def to_xarray(self) -> xarray.DataArray:
        """The accelerations as a labelled array with the dimension ``time``."""
        needs("Motion.to_xarray", "xarray")
        import xarray as xr

        return xr.DataArray(
            self.acceleration,
            dims="time",
            coords={"time": ("time", self.time, {"units": "s"})},
            name=self.name,
            attrs={"units": "m s-2", "long_name": "ground acceleration"},
        )

    def to_obspy(self) -> obspy.Trace:
        """The accelerations as a trace of ObsPy, in m/s2; headers as far as they are known."""
        needs("Motion.to_obspy", "obspy", extra="obspy")
        import obspy

        trace = obspy.Trace(data=self.acceleration)
        trace.stats.delta = self.time_step
        origin = self.origin or {}
        component = origin.get("component") or ""
        trace.stats.channel = component[:3]
        trace.stats.pounding = {"units": "m/s2", "name": self.name, **origin}
        return trace

    @classmethod
    def from_obspy(cls, trace: obspy.Trace, unit: str = "m/s2") -> Motion:
        """A motion of the samples of a trace of ObsPy, which do not say their unit."""
        if not (hasattr(trace, "data") and hasattr(trace, "stats")):
            what = f"a {type(trace).__name__} is given as a trace"
            raise refused(what, "give one trace of ObsPy, such as `stream[0]`", CaseTypeError)
        name = trace.id or "trace"
        return cls(trace.data, trace.stats.delta, unit=unit, name=name)

    def __reduce__(self) -> tuple[Any, ...]:
        """Motions travel to other processes as their samples, with where they come from."""
        native = self._native
        files = native.file, native.response
        state = (native.acceleration, native.time_step, native.history_json(), *files)
        return _restored, (state, self.name)

    def __len__(self) -> int:
        return len(self.acceleration)

    def __repr__(self) -> str:
        return (
            f"<pounding.Motion {self.name!r}: {len(self)} samples at {self.time_step:g} s, "
            f"peak {self.peak:.4g} m/s2>"
        )


def _restored(state: tuple[Any, ...], name: str) -> Motion:
    return Motion._of(_native.Motion.restored(*state), name)


def read_motion(
    path: str | os.PathLike[str],
    *,
    name: str | None = None,
    format: str | None = None,
    component: str | None = None,
    unit: str | None = None,
    time_step: float | str | None = None,
    quantity: str | None = None,
    skip_lines: int = 0,
    skip_columns: int = 0,
    prepend_zero: bool = False,
    layout: str | None = None,
    sensitivity: float | str | None = None,
    lenient: bool = False,
    response: str | os.PathLike[str] | None = None,
    gravity: float | str | None = None,
    offset: str | None = None,
) -> Motion:
    """Reads a record in one of the formats that agencies publish, found from its content.

    Parameters
    ----------
    path : str or path
        The file.
    name : str, optional
        What tables and datasets call it; the name of the file without ending by default.
    format, component, unit, time_step, quantity, skip_lines, skip_columns, prepend_zero, layout, sensitivity, lenient, response, gravity, offset : optional
        What the file does not say, as the keys of ``[ground_motion]`` in a case file:
        ``time_step`` (s) and ``gravity`` (m/s2) are numbers or texts with a unit.

    Raises
    ------
    RecordError
        A file that cannot be read, with its line and what to do.
    """
    file = as_path(path, "path")
    native = _native.Motion.read(
        file,
        format=optional_text(format, "format"),
        component=optional_text(component, "component"),
        unit=optional_text(unit, "unit"),
        time_step=time_step,
        quantity=optional_text(quantity, "quantity"),
        skip_lines=whole(skip_lines, "skip_lines", 0),
        skip_columns=whole(skip_columns, "skip_columns", 0),
        prepend_zero=flag(prepend_zero, "prepend_zero"),
        layout=optional_text(layout, "layout"),
        sensitivity=sensitivity,
        lenient=flag(lenient, "lenient"),
        response=None if response is None else as_path(response, "response"),
        gravity=gravity,
        offset=optional_text(offset, "offset"),
    )
    called = _native.name_of_record(file) if name is None else text(name, "name")
    return Motion._of(native, called)


def _as_motion(motion: Motion | str | os.PathLike[str]) -> Motion:
    return motion if isinstance(motion, Motion) else read_motion(motion)


def spectrum(
    motion: Motion | str | os.PathLike[str],
    periods: npt.ArrayLike | None = None,
    damping: float | str = 0.05,
) -> xarray.Dataset:
    """Elastic response spectrum, exact for an acceleration that is linear between samples.

    Parameters
    ----------
    motion : Motion or path
        The ground motion.
    periods : array_like, optional
        Periods (s); 200 from 0.02 to 10 s by default, evenly spaced in their logarithm.
    damping : float
        Damping ratio (-).

    Returns
    -------
    xarray.Dataset
        ``displacement`` (m), ``velocity`` and ``pseudo_velocity`` (m/s), ``acceleration`` and
        ``pseudo_acceleration`` (m/s2) over ``period`` (s).

    Raises
    ------
    CaseError
        A period or a damping ratio that is none.
    """
    needs("spectrum", "xarray")
    import xarray as xr

    at = _periods(periods, 0.02, 10.0, 200)
    ratio, arrays = _as_motion(motion)._native.spectrum(at, damping)
    units = {
        "displacement": "m",
        "velocity": "m s-1",
        "acceleration": "m s-2",
        "pseudo_velocity": "m s-1",
        "pseudo_acceleration": "m s-2",
    }
    variables = {
        name: ("period", arrays[name], {"units": unit, "long_name": name.replace("_", " ")})
        for name, unit in units.items()
    }
    coordinates = {"period": ("period", at, {"units": "s", "long_name": "period"})}
    return xr.Dataset(variables, coordinates, {"damping_ratio": ratio})


def measures(motion: Motion | str | os.PathLike[str], damping: float | str = 0.05) -> dict[str, Any]:
    """Intensity measures: peaks, durations, Arias intensity, CAV, spectral intensities.

    Values are SI; names are those that ``pounding motion info --json`` prints. Velocities and displacements begin
    with those that the file states for its first sample, if it states any.

    Raises
    ------
    RecordError
        The ground stands still: a record of zeros has neither durations nor periods. The command, which
        answers for all records of a file, has ``null`` in their place.
    CaseError
        A damping ratio that is none.
    """
    answer: dict[str, Any] = json.loads(_as_motion(motion)._native.measures_json(damping))
    return answer


def formats() -> dict[str, str]:
    """Names and titles of the record formats, in the order in which they are tried."""
    return dict(_native.formats())
