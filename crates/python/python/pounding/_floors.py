"""Response spectra of floors: what equipment on them feels."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from . import _native
from ._case import Case, as_case
from ._errors import CaseTypeError, listed, needs, refused, text, whole
from ._motion import _periods
from ._result import Progress, _progress, _threads
from ._study import Records, _records

if TYPE_CHECKING:
    import numpy.typing as npt
    import xarray

__all__ = ["floor_spectra"]


def _place(floor: object) -> tuple[str, int]:
    """A building and a storey."""
    if not (isinstance(floor, tuple) and len(floor) == 2):
        what = f"{floor!r} is no floor"
        raise refused(what, 'give a building and a storey from 1, such as ("light", 3)', CaseTypeError)
    building, storey = floor
    return text(building, "building"), whole(storey, "storey", 1)


def floor_spectra(
    case: Case | str | os.PathLike[str],
    floors: Iterable[tuple[str, int]] | None = None,
    periods: npt.ArrayLike | None = None,
    damping: float | str = 0.05,
    *,
    records: Records = None,
    threads: int | None = None,
    progress: Progress | bool | None = None,
) -> xarray.Dataset:
    """Response spectra of floors, with pounding and of the buildings alone.

    They come from the displacements and velocities of the floors at fine rows, which hold what impacts do;
    accelerations at the rows of a result miss the milliseconds that these last.

    Parameters
    ----------
    case : Case or path
    floors : iterable of (str, int), optional
        Buildings and storeys, from 1 at the bottom; the roofs of all buildings by default.
    periods : array_like, optional
        Periods of the equipment (s), from 1 ms on; 100 from 0.05 to 4 s by default, evenly spaced in their
        logarithm. The command ``floor-spectrum`` has 30 of that range by default.
    damping : float or str
        Damping ratio of the equipment (-).
    records : motions, files or folders of records, optional
        A list, or a dict by name; the motion of the case by default. Of records of the same name the second
        is called ``x (2)``, as by the command; files of folders that are no records are left out with a
        warning.
    threads : int, optional
        For several records.
    progress : callable or bool, optional

    Returns
    -------
    xarray.Dataset
        ``ground``, ``alone`` and ``pounding``, peak absolute accelerations (m/s2) over ``floor`` and
        ``period`` (s), and ``peak_acceleration_alone`` and ``peak_acceleration_pounding`` of the floors
        themselves, with ``building`` and ``storey`` of each. ``alone`` is NaN where buildings do not stand without
        one another; what should be known stands in the attribute ``warnings``. With ``records`` all have the
        dimension ``record`` before the others, and ``.mean("record")`` is what codes ask for; records under which
        a building collapses are left out.
    """
    needs("floor_spectra", "xarray")
    import numpy as np
    import xarray as xr

    given = as_case(case)
    places = None if floors is None else [_place(floor) for floor in listed(floors, "floors", "floors")]
    if places is not None and not places:
        raise refused("no floors are given", "leave `floors` out for the roofs of all buildings")
    at = _periods(periods, 0.05, 4.0, 100)
    several, count = records is not None, _threads(threads)
    told, bar = _progress(progress, "floor spectra")
    try:
        if several:
            made = _native.floor_spectra_over_records_json(
                given._native, _records(records), places, at, damping, count, told
            )
        else:
            made = _native.floor_spectra_json(given._native, places, at, damping, told)
    finally:
        if bar is not None:
            bar.close()
    told_all = json.loads(made)
    answers = [record["spectra"] for record in told_all["records"]] if several else [told_all]
    found = answers[0]["floors"]
    missing = np.full(len(at), np.nan)

    def shaped(values: list[list[Any]], dimensions: tuple[str, ...]) -> tuple[tuple[str, ...], Any]:
        every = np.array(values).reshape(len(answers), len(found), *[len(at)] * (len(dimensions) - 1))
        return (("record", *dimensions), every) if several else (dimensions, every[0])

    def accelerations(name: str) -> tuple[tuple[str, ...], Any]:
        def of(floor: dict[str, Any]) -> npt.NDArray[np.float64]:
            one = floor["spectra"][0][name]
            return missing if one is None else np.array(one["acceleration"])

        return shaped([[of(floor) for floor in answer["floors"]] for answer in answers], ("floor", "period"))

    def peaks(name: str) -> tuple[tuple[str, ...], Any]:
        def of(floor: dict[str, Any]) -> float:
            value = floor["peak_acceleration"][name]
            return np.nan if value is None else value

        return shaped([[of(floor) for floor in answer["floors"]] for answer in answers], ("floor",))

    def attributes(long_name: str) -> dict[str, str]:
        return {"units": "m s-2", "long_name": long_name}

    named = {
        "ground": "absolute acceleration on the ground",
        "alone": "absolute acceleration on a floor of the building alone",
        "pounding": "absolute acceleration on a floor with pounding",
    }
    variables: dict[str, tuple[object, ...]] = {
        name: (*accelerations(name), attributes(long_name)) for name, long_name in named.items()
    }
    for name in ("alone", "pounding"):
        long_name = f"peak absolute acceleration of a floor, {name}"
        variables[f"peak_acceleration_{name}"] = (*peaks(name), attributes(long_name))
    coordinates: dict[str, Any] = {
        "floor": ("floor", [f"{floor['building']} {floor['storey']}" for floor in found]),
        "building": ("floor", [floor["building"] for floor in found]),
        "storey": ("floor", [floor["storey"] for floor in found]),
        "elevation": ("floor", [floor["elevation"] for floor in found], {"units": "m"}),
        "period": ("period", at, {"units": "s", "long_name": "period"}),
    }
    attrs: dict[str, Any] = {"warnings": "\n".join(told_all["warnings"])}
    impacts = [answer["impacts"] for answer in answers]
    if several:
        coordinates["record"] = ("record", [record["name"] for record in told_all["records"]])
        coordinates["impacts"] = ("record", impacts)
    else:
        attrs["impacts"] = impacts[0]
    if found:
        attrs["damping_ratio"] = found[0]["spectra"][0]["ground"]["damping"]
    return xr.Dataset(variables, coordinates, attrs)
