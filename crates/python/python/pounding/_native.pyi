"""The native part: see the modules that wrap it."""

from collections.abc import Callable
from typing import Any, TypeAlias, final

import numpy as np
import numpy.typing as npt

_Array: TypeAlias = npt.NDArray[np.float64]
_Progress: TypeAlias = Callable[[int, int], object]
#: A number (SI), or a text with a unit.
_Quantity: TypeAlias = float | str

__all__ = [
    "__version__",
    "BUILD",
    "command_line",
    "Case",
    "Motion",
    "name_of_record",
    "periods",
    "formats",
    "Run",
    "run",
    "run_many",
    "models_json",
    "collide",
    "run_study",
    "shown_width",
    "has_ida",
    "floor_spectra_json",
    "floor_spectra_over_records_json",
    "gap_check_json",
    "compare_json",
]

__version__: str
BUILD: str

@final
class Case:
    @staticmethod
    def from_text(source: str, file: str) -> Case: ...
    @staticmethod
    def from_file(path: str) -> Case: ...
    @staticmethod
    def from_dict(
        dict: dict[str, Any], folder: str, motion: Motion | None = None, name: str = ""
    ) -> Case: ...
    def with_motion(self, motion: Motion, name: str) -> Case: ...
    @property
    def source(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def file(self) -> str | None: ...
    @property
    def buildings(self) -> list[str]: ...
    @property
    def gaps(self) -> list[str]: ...
    def check_json(self) -> str: ...

@final
class Motion:
    def __new__(cls, acceleration: _Array, time_step: _Quantity, unit: str) -> Motion: ...
    @staticmethod
    def read(
        path: str,
        *,
        format: str | None,
        component: str | None,
        unit: str | None,
        time_step: _Quantity | None,
        quantity: str | None,
        skip_lines: int,
        skip_columns: int,
        prepend_zero: bool,
        layout: str | None,
        sensitivity: _Quantity | None,
        lenient: bool,
        response: str | None,
        gravity: _Quantity | None,
        offset: str | None,
    ) -> Motion: ...
    @staticmethod
    def restored(
        acceleration: _Array, time_step: float, history: str, file: str | None, response: str | None
    ) -> Motion: ...
    def history_json(self) -> str: ...
    @property
    def acceleration(self) -> _Array: ...
    @property
    def time_step(self) -> float: ...
    @property
    def duration(self) -> float: ...
    @property
    def peak(self) -> float: ...
    @property
    def file(self) -> str | None: ...
    @property
    def response(self) -> str | None: ...
    @property
    def description(self) -> list[str]: ...
    def origin_json(self) -> str: ...
    def scaled_by(self, factor: _Quantity) -> Motion: ...
    def scaled_to_peak(self, peak: _Quantity) -> Motion: ...
    def spectrum(self, periods: _Array, damping: _Quantity) -> tuple[float, dict[str, _Array]]: ...
    def measures_json(self, damping: _Quantity) -> str: ...

@final
class Run:
    def summary_json(self) -> str: ...
    @property
    def case(self) -> Case: ...
    @property
    def wall_time(self) -> float: ...
    @property
    def has_histories(self) -> bool: ...
    @property
    def has_isolated(self) -> bool: ...
    @property
    def building_columns(self) -> list[tuple[str, int, int]]: ...
    @property
    def gap_columns(self) -> list[tuple[str, int, int]]: ...
    @property
    def time(self) -> _Array: ...
    def array(self, name: str) -> _Array: ...
    def energy(self) -> dict[str, _Array]: ...
    def impacts(self) -> dict[str, Any]: ...
    def to_hdf5(self, path: str) -> None: ...
    def image(self) -> bytes: ...
    def page(self, name: str) -> str: ...
    def write_page(self, path: str, page: str) -> None: ...

def command_line(arguments: list[str]) -> int: ...
def name_of_record(file: str) -> str: ...
def periods(first: float, last: float, count: int) -> _Array: ...
def formats() -> list[tuple[str, str]]: ...
def run(
    case: Case, histories: bool = True, isolated: bool = True, progress: _Progress | None = None
) -> Run: ...
def run_many(
    cases: list[Case],
    threads: int,
    histories: bool = False,
    isolated: bool = False,
    progress: _Progress | None = None,
) -> list[Run | BaseException]: ...
def models_json(name: str | None = None) -> str: ...
def collide(
    model: str,
    parameters: list[tuple[str, _Quantity]],
    mass_left: _Quantity,
    mass_right: _Quantity | None,
    velocity_left: _Quantity,
    velocity_right: _Quantity,
    separation: str | None = None,
    spring: list[tuple[_Quantity, _Quantity]] | None = None,
) -> dict[str, Any]: ...
def has_ida(study: str) -> bool: ...
def run_study(
    study: str,
    output: str,
    threads: int,
    named: bool = True,
    shard: str | None = None,
    resume: bool = False,
    keep_going: bool = False,
    evaluated: bool = False,
    progress: _Progress | None = None,
) -> tuple[str, str | None]: ...
def floor_spectra_json(
    case: Case,
    floors: list[tuple[str, int]] | None,
    periods: _Array,
    damping: _Quantity,
    progress: _Progress | None = None,
) -> str: ...
def floor_spectra_over_records_json(
    case: Case,
    motions: list[tuple[str, Any]],
    floors: list[tuple[str, int]] | None,
    periods: _Array,
    damping: _Quantity,
    threads: int,
    progress: _Progress | None = None,
) -> str: ...
def shown_width(width: float, provided: float | None = None) -> str: ...
def gap_check_json(
    case: Case,
    motions: list[tuple[str, Any]],
    code: str | None,
    country: str | None,
    date: str | None,
    rules: str | None,
    provisions: list[str],
    entries: dict[str, Any] | None,
    probability: _Quantity,
    confidence: _Quantity,
    points: int,
    widths: tuple[_Quantity | None, _Quantity | None],
    gap: str | None,
    threads: int,
    progress: _Progress | None = None,
) -> str: ...
def compare_json(
    case: Case,
    models: list[str],
    motions: list[tuple[str, Any]],
    restitution: _Quantity | None,
    approach_velocity: _Quantity | None,
    same_duration: bool,
    exact: bool,
    threads: int,
    progress: _Progress | None = None,
) -> str: ...
