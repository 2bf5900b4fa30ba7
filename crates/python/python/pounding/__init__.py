"""Seismic pounding of adjacent buildings.

Two buildings that stand too close collide in an earthquake. This package integrates their time
history, locates every impact, closes an energy ledger, and answers how hard they hit, whether the
gap is wide enough, and how sensitive the answer is to the impact model.

>>> import pounding
>>> result = pounding.run("case.toml")            # doctest: +SKIP
>>> result.impacts                                # doctest: +SKIP
>>> result.to_xarray()                            # doctest: +SKIP

Numbers are SI; texts may carry units. Errors say what is wrong, where, and what to do.
"""

from typing import TYPE_CHECKING

from . import _native
from ._case import Analysis, Building, Case, Gap, GroundMotion, Link, Separation
from ._errors import (
    CaseError,
    ComputationError,
    MissingPackageError,
    OutputError,
    PoundingError,
    RecordError,
)
from ._floors import floor_spectra
from ._models import Collision, collide, model, models
from ._motion import Motion, formats, measures, read_motion, spectrum
from ._result import BuildingHistories, GapHistories, Result, run, run_many
from ._study import Comparison, GapCheck, Ida, compare, gap_check, ida, sweep

__version__: str = _native.__version__

__all__ = [
    "Analysis",
    "Building",
    "BuildingHistories",
    "Case",
    "CaseError",
    "Collision",
    "Comparison",
    "ComputationError",
    "Gap",
    "GapCheck",
    "GapHistories",
    "GroundMotion",
    "Ida",
    "Link",
    "MissingPackageError",
    "Motion",
    "OutputError",
    "PoundingError",
    "RecordError",
    "Result",
    "Separation",
    "collide",
    "compare",
    "floor_spectra",
    "formats",
    "gap_check",
    "ida",
    "measures",
    "model",
    "models",
    "read_motion",
    "run",
    "run_many",
    "spectrum",
    "sweep",
]


if TYPE_CHECKING:
    # Not as a function, which would give a type to names that are misspelt.
    from . import plot as plot
else:

    def __getattr__(name):
        # Matplotlib is needed for `plot` alone.
        if name == "plot":
            import importlib

            return importlib.import_module(".plot", __name__)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
