"""Pictures of results by Matplotlib (the extra ``plot``). Every function draws into the axes that it
is given, or into new ones, and returns them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import CaseTypeError, listed, needs, refused
from ._motion import Motion, _as_motion, spectrum
from ._result import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["displacements", "energy", "forces", "opening", "spectra"]

Path = str | os.PathLike[str]

#: Line styles that differ in greyscale too.
_STYLES = ["-", "--", "-.", ":"]


def _axes(axes: Axes | None) -> Axes:
    if axes is not None:
        return axes
    needs("a picture", "matplotlib", extra="plot")
    import matplotlib.pyplot as plt

    made: Axes
    _, made = plt.subplots(figsize=(7.5, 3.0), layout="constrained")
    return made


def _of_run(result: object) -> Result:
    if isinstance(result, Result):
        return result
    what = f"a {type(result).__name__} is given as a result"
    raise refused(what, "give a Result, such as `run` returns", CaseTypeError)


def displacements(result: Result, *, storey: int | None = None, axes: Axes | None = None) -> Axes:
    """Displacements (mm) of one storey, from 1, of each building that has it over time; the roofs
    by default."""
    result = _of_run(result)
    highest = max((b.displacement.shape[1] for b in result.buildings.values()), default=0)
    if storey is not None:
        if isinstance(storey, bool) or not hasattr(storey, "__index__"):
            what = f"storey is {storey!r}, which is no whole number"
            raise refused(what, f"give one from 1 to {highest}", CaseTypeError)
        if not 1 <= storey <= highest:
            raise refused(f"storey {storey} is none of 1 to {highest}", "count from the ground, from 1")
    drawn = _axes(axes)
    number = 0
    for name, building in result.buildings.items():
        if storey is not None and storey > building.displacement.shape[1]:
            continue
        values = 1e3 * building.displacement[:, -1 if storey is None else storey - 1]
        drawn.plot(result.time, values, _STYLES[number % 4], lw=0.9, label=name)
        number += 1
    title = "roofs" if storey is None else f"storey {storey}"
    drawn.set(xlabel="time (s)", ylabel="displacement (mm)", title=title)
    drawn.legend(frameon=False)
    return drawn


def _gap(result: Result, gap: str | None) -> str:
    names = list(_of_run(result).gaps)
    if gap is None:
        if not names:
            raise refused("the case has no gap", "draw `displacements`, or add a gap to the case")
        return names[0]
    if gap not in names:
        has = ", ".join(names) or "none"
        raise refused(f"{gap!r} is no gap", f"name one of the gaps of the case: {has}")
    return gap


def opening(result: Result, gap: str | None = None, *, axes: Axes | None = None) -> Axes:
    """Opening (mm) of every level of a gap over time; negative is penetration."""
    name = _gap(result, gap)
    drawn = _axes(axes)
    penetration = result.gaps[name].penetration
    for level in range(penetration.shape[1]):
        values = -1e3 * penetration[:, level]
        drawn.plot(result.time, values, _STYLES[level % 4], lw=0.8, label=f"level {level + 1}")
    drawn.axhline(0.0, color="k", lw=0.6)
    drawn.set(xlabel="time (s)", ylabel="opening (mm)", title=name)
    drawn.legend(frameon=False)
    return drawn


def forces(result: Result, gap: str | None = None, *, axes: Axes | None = None) -> Axes:
    """Peak force (kN) of every impact of a gap over its time: peaks come from inside the steps,
    which the output grid misses."""
    name = _gap(result, gap)
    impacts = result.impacts
    impacts = impacts[impacts["gap"] == name]
    if len(impacts) and impacts["peak_force"].isna().all():
        raise refused(f"rigid impacts of {name!r} have no force", "draw `impulse` of `result.impacts`")
    drawn = _axes(axes)
    for number, (level, rows) in enumerate(impacts.groupby("level")):
        times, values = rows["peak_force_time"], rows["peak_force"] / 1e3
        drawn.vlines(times, 0.0, values, lw=0.6, color=f"C{number}")
        drawn.plot(times, values, "osD^v"[number % 5], ms=3, color=f"C{number}", label=f"level {level}")
    drawn.set(xlabel="time (s)", ylabel="peak force (kN)", title=name, xlim=(0, result.time[-1]))
    if len(impacts):
        drawn.legend(frameon=False)
    return drawn


def energy(result: Result, *, axes: Axes | None = None) -> Axes:
    """The energy ledger (kJ) over time, parts on top of one another."""
    ledger = _of_run(result).energy / 1e3
    drawn = _axes(axes)
    parts = ["kinetic", "strain", "viscous", "hysteretic", "impact"]
    parts = [part for part in parts if np.any(ledger[part] != 0.0)]
    drawn.stackplot(ledger.index, [ledger[part] for part in parts], labels=parts, alpha=0.8)
    drawn.plot(ledger.index, ledger["input"], "k", lw=0.8, label="input")
    drawn.set(xlabel="time (s)", ylabel="energy (kJ)")
    drawn.legend(frameon=False, loc="upper left")
    return drawn


def spectra(
    motions: Iterable[Motion | Path] | Motion | Path,
    *,
    damping: float | str = 0.05,
    axes: Axes | None = None,
) -> Axes:
    """Pseudo-acceleration spectra (m/s2) of motions or files, or of one, and their mean where there
    are several."""
    one = isinstance(motions, (Motion, str, bytes, os.PathLike))
    each: list[Any] = [motions] if one else listed(motions, "motions", "motions or paths")
    given = [_as_motion(motion) for motion in each]
    if not given:
        raise refused("no motions are given", "give one or more")
    drawn, all_values = _axes(axes), []
    for motion in given:
        values = spectrum(motion, damping=damping)
        all_values.append(values["pseudo_acceleration"].values)
        drawn.loglog(values["period"], all_values[-1], lw=0.7, label=motion.name)
    if len(all_values) > 1:
        drawn.loglog(values["period"], np.mean(all_values, axis=0), "k", lw=1.6, label="mean")
    drawn.set(xlabel="period (s)", ylabel="pseudo-acceleration (m/s²)")
    if len(all_values) <= 8:
        drawn.legend(frameon=False)
    return drawn
