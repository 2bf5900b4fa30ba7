"""Impact models and the collision of two bodies."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._errors import needs, optional_text, refused, text

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt
    import pandas

    Array = npt.NDArray[np.float64]

__all__ = ["Collision", "collide", "model", "models"]


def models() -> pandas.DataFrame:
    """All impact models, indexed by name: title, formula, citation, class, status and traps.

    The status is ``"verified"``, ``"from secondary sources"`` or ``"unverified"``; the column
    ``verification`` says against what.
    """
    needs("models", "pandas")
    import pandas as pd

    frame = pd.DataFrame(json.loads(_native.models_json())).set_index("name")
    frame["status"] = frame["verification"].str.split(":").str[0].str.removesuffix(" against")
    return frame


def model(name: str) -> dict[str, Any]:
    """The descriptor of one impact model: formula, citation, parameters with units and ranges."""
    described: list[dict[str, Any]] = json.loads(_native.models_json(text(name, "name")))
    return described[0]


@dataclass(frozen=True, eq=False, repr=False)
class Collision:
    """A collision of two bodies (SI units), with its history from closure on."""

    restitution: float
    velocity_left: float
    velocity_right: float
    peak_force: float
    peak_force_time: float
    peak_penetration: float
    peak_penetration_time: float
    duration: float
    impulse: float
    energy_dissipated: float
    time: Array
    penetration: Array
    velocity: Array
    force: Array

    def _numbers(self) -> tuple[bytes, ...]:
        return tuple(np.asarray(getattr(self, field.name)).tobytes() for field in fields(self))

    def __eq__(self, other: object) -> bool:
        return self._numbers() == other._numbers() if isinstance(other, Collision) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._numbers())

    def __repr__(self) -> str:
        return (
            f"<pounding.Collision: restitution {self.restitution:.4g}, "
            f"peak force {self.peak_force / 1e3:.4g} kN, duration {1e3 * self.duration:.4g} ms>"
        )


def collide(
    model: str,
    *,
    mass_left: float | str,
    mass_right: float | str | None = None,
    velocity_left: float | str,
    velocity_right: float | str = 0.0,
    separation: str | None = None,
    spring: Iterable[Sequence[float | str]] | None = None,
    **parameters: float | str,
) -> Collision:
    """Two bodies collide under an impact model, without anything else that acts on them.

    Parameters
    ----------
    model : str
        Its name: see :func:`models`.
    mass_left, mass_right : float
        Masses (kg); without the right one it is a wall.
    velocity_left, velocity_right : float
        Velocities before (m/s), positive to the right. A wall has none.
    separation : str, optional
        Separation rule, where the model has several.
    spring : array of shape (points, 2), optional
        Penetrations (m) and forces (N), both increasing: a spring of your own in the place of
        ``stiffness`` and ``exponent``, for ``borovin_2014``.
    **parameters
        Parameters of the model, such as ``stiffness`` and ``restitution``.

    All are SI; texts carry a unit, such as ``"2.75e9 N/m^1.5"``.
    """
    given = text(model, "model")
    try:
        table = None if spring is None else [(d, f) for d, f in spring]
    except (TypeError, ValueError):
        what = "spring is no list of pairs"
        raise refused(what, "give a penetration (m) and a force (N) for each point") from None
    rule = optional_text(separation, "separation")
    answer = _native.collide(
        given, list(parameters.items()), mass_left, mass_right, velocity_left, velocity_right, rule, table
    )
    return Collision(**answer)
