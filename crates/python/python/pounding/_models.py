"""Impact models and the collision of two bodies."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _native

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy as np
    import numpy.typing as npt
    import pandas

    Array = npt.NDArray[np.float64]

__all__ = ["Collision", "collide", "model", "models"]


def models() -> pandas.DataFrame:
    """All impact models, indexed by name: title, formula, citation, class, status and traps."""
    import pandas as pd

    return pd.DataFrame(json.loads(_native.models_json())).set_index("name")


def model(name: str) -> dict[str, Any]:
    """The descriptor of one impact model: formula, citation, parameters with units and ranges."""
    described: list[dict[str, Any]] = json.loads(_native.models_json(name))
    return described[0]


@dataclass(frozen=True)
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


def collide(
    model: str,
    *,
    mass_left: float,
    mass_right: float | None = None,
    velocity_left: float,
    velocity_right: float = 0.0,
    separation: str | None = None,
    spring: Iterable[Sequence[float]] | None = None,
    **parameters: float,
) -> Collision:
    """Two bodies collide under an impact model, without anything else that acts on them.

    Parameters
    ----------
    model : str
        Its name: see :func:`models`.
    mass_left, mass_right : float
        Masses (kg); without the right one it is a wall.
    velocity_left, velocity_right : float
        Velocities before (m/s), positive to the right.
    separation : str, optional
        Separation rule, where the model has several.
    spring : array of shape (points, 2), optional
        Penetrations (m) and forces (N), both increasing: a spring of your own in the place of
        ``stiffness`` and ``exponent``, for ``borovin_2014``.
    **parameters
        Parameters of the model (SI), such as ``stiffness`` and ``restitution``.
    """
    table = None if spring is None else [(float(d), float(f)) for d, f in spring]
    pairs = [(name, float(value)) for name, value in parameters.items()]
    answer = _native.collide(
        model, pairs, mass_left, mass_right, velocity_left, velocity_right, separation, table
    )
    return Collision(**answer)
