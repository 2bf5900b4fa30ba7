"""The native part: see the modules that wrap it."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Progress = Callable[[int, int], object]
#: A number (SI), or a text with a unit.
Quantity = float | str

__version__: str
BUILD: str

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

class Motion:
    def __init__(self, acceleration: Array, time_step: Quantity, unit: str) -> None: ...
    @staticmethod
    def read(
        path: str,
        *,
        format: str | None,
        component: str | None,
        unit: str | None,
        time_step: Quantity | None,
        quantity: str | None,
        skip_lines: int,
        skip_columns: int,
        prepend_zero: bool,
        layout: str | None,
        sensitivity: Quantity | None,
        lenient: bool,
        response: str | None,
        gravity: Quantity | None,
        offset: str | None,
    ) -> Motion: ...
    @staticmethod
    def restored(
        acceleration: Array, time_step: float, history: str, file: str | None
    ) -> Motion: ...
    def history_json(self) -> str: ...
    @property
    def acceleration(self) -> Array: ...
    @property
    def time_step(self) -> float: ...
    @property
    def duration(self) -> float: ...
    @property
    def peak(self) -> float: ...
    @property
    def file(self) -> str | None: ...
    @property
    def description(self) -> list[str]: ...
    def origin_json(self) -> str: ...
    def scaled_by(self, factor: Quantity) -> Motion: ...
    def scaled_to_peak(self, peak: Quantity) -> Motion: ...
    def spectrum(self, periods: Array, damping: Quantity) -> dict[str, Array]: ...
    def measures_json(self, damping: Quantity) -> str: ...

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
    def time(self) -> Array: ...
    def array(self, name: str) -> Array: ...
    def energy(self) -> dict[str, Array]: ...
    def impacts(self) -> dict[str, Any]: ...
    def to_hdf5(self, path: str) -> None: ...
    def image(self) -> bytes: ...
    def page(self, name: str) -> str: ...
    def write_page(self, path: str, page: str) -> None: ...

def command_line(arguments: list[str]) -> int: ...
def periods(first: float, last: float, count: int) -> Array: ...
def formats() -> list[tuple[str, str]]: ...
def run(
    case: Case, histories: bool = True, isolated: bool = True, progress: Progress | None = None
) -> Run: ...
def run_many(
    cases: list[Case],
    threads: int,
    histories: bool = False,
    isolated: bool = False,
    progress: Progress | None = None,
) -> list[Run | BaseException]: ...
def models_json(name: str | None = None) -> str: ...
def collide(
    model: str,
    parameters: list[tuple[str, Quantity]],
    mass_left: Quantity,
    mass_right: Quantity | None,
    velocity_left: Quantity,
    velocity_right: Quantity,
    separation: str | None = None,
    spring: list[tuple[Quantity, Quantity]] | None = None,
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
    progress: Progress | None = None,
) -> tuple[str, str | None]: ...
def gap_check_json(
    case: Case,
    motions: list[tuple[str, Any]],
    code: str | None,
    country: str | None,
    date: str | None,
    rules: str | None,
    provisions: list[str],
    entries: dict[str, Any] | None,
    probability: Quantity,
    confidence: Quantity,
    points: int,
    widths: tuple[Quantity | None, Quantity | None],
    gap: str | None,
    threads: int,
    progress: Progress | None = None,
) -> str: ...
def compare_json(
    case: Case,
    models: list[str],
    motions: list[tuple[str, Any]],
    restitution: Quantity | None,
    approach_velocity: Quantity | None,
    same_duration: bool,
    exact: bool,
    threads: int,
    progress: Progress | None = None,
) -> str: ...
