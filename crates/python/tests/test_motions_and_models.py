"""Ground motions and impact models, against closed forms."""

from __future__ import annotations

import _thread
import array
import json
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from conftest import RECORD

import pounding


def test_the_spectrum_of_a_step_is_twice_its_static_answer() -> None:
    # A step of the ground acceleration a: u = a/omega^2 (1 - cos), so that PSA = 2 a.
    motion = pounding.Motion(np.full(4001, 1.5), 0.005)
    spectrum = motion.spectrum([0.5, 1.0, 2.0], damping=0.0)
    assert np.allclose(spectrum["pseudo_acceleration"], 3.0, rtol=1e-12)
    assert spectrum["period"].attrs["units"] == "s"


def test_measures_of_a_constant_acceleration() -> None:
    motion = pounding.Motion(np.full(1001, 2.0), 0.01)
    measures = motion.measures()
    # Arias: pi/(2 g) a^2 t; CAV: a t.
    assert measures["arias_intensity"] == pytest.approx(np.pi / (2 * 9.80665) * 4 * 10, rel=1e-12)
    assert measures["cumulative_absolute_velocity"] == pytest.approx(20.0, rel=1e-12)
    assert motion.peak == 2.0 and motion.duration == pytest.approx(10.0)


def test_units_and_scales() -> None:
    in_g = pounding.Motion([0.0, 1.0, 0.0], 0.1, unit="g")
    assert in_g.peak == 9.80665
    assert in_g.scaled_to_peak(3.0).peak == pytest.approx(3.0, rel=1e-15)
    with pytest.raises(pounding.RecordError, match="unit"):
        pounding.Motion([0.0, 1.0], 0.1, unit="bananas")
    with pytest.raises(pounding.RecordError):
        pounding.Motion([0.0, np.nan], 0.1)
    with pytest.raises(ValueError, match="2 dimensions"):
        pounding.Motion([[0.0, 1.0]], 0.1)


def test_a_motion_keeps_where_it_comes_from_in_another_process() -> None:
    motion = pounding.read_motion(RECORD, name="el centro").scaled_by(1.5)
    copied = pickle.loads(pickle.dumps(motion))
    assert copied.origin == motion.origin and motion.origin["sha256"]
    assert copied.name == "el centro" and copied._native.file == motion._native.file
    assert copied._native.description == motion._native.description
    assert np.array_equal(copied.acceleration, motion.acceleration)
    with pytest.raises(pounding.RecordError, match="has a peak of inf"):
        motion.scaled_by(1e308)


@pytest.mark.parametrize("values", [["1", "2"], [True, False], np.array([1, 2], "datetime64[s]")])
def test_accelerations_are_numbers(values: object) -> None:
    with pytest.raises(ValueError, match="give real numbers"):
        pounding.Motion(values, 0.01)


def test_records_are_refused_with_a_reason(tmp_path: Path) -> None:
    with pytest.raises(pounding.RecordError, match="check the path"):
        pounding.read_motion(tmp_path / "none.csv")
    assert "pounding_csv" in pounding.formats()


def test_obspy_takes_a_motion_and_gives_it_back() -> None:
    obspy = pytest.importorskip("obspy")
    motion = pounding.read_motion(RECORD)
    trace = motion.to_obspy()
    assert isinstance(trace, obspy.Trace)
    assert np.array_equal(trace.data, motion.acceleration)
    back = pounding.Motion.from_obspy(trace)
    assert np.array_equal(back.acceleration, motion.acceleration)
    assert back.time_step == motion.time_step


def test_an_elastic_collision_of_equal_masses_exchanges_velocities() -> None:
    made = pounding.collide(
        "linear_elastic",
        mass_left=1e4,
        mass_right=1e4,
        velocity_left=1.0,
        velocity_right=-0.5,
        stiffness=1e8,
    )
    assert made.velocity_left == pytest.approx(-0.5, rel=1e-9)
    assert made.velocity_right == pytest.approx(1.0, rel=1e-9)
    # v sqrt(k m) with the effective mass m.
    assert made.peak_force == pytest.approx(1.5 * np.sqrt(1e8 * 5e3), rel=1e-9)
    assert made.duration == pytest.approx(np.pi * np.sqrt(5e3 / 1e8), rel=1e-9)
    assert made.force.max() <= made.peak_force


def test_a_table_is_the_spring_of_a_collision() -> None:
    table = np.array([[5e-3, 100e3], [10e-3, 500e3], [20e-3, 3000e3]])
    bodies = {"mass_left": 25e3, "velocity_left": 0.5}
    made = pounding.collide("borovin_2014", friction=0.3, spring=table, **bodies)
    # The closed form of the law about any spring.
    assert made.restitution == pytest.approx(np.sqrt(0.7 / 1.3), rel=1e-8)
    with pytest.raises(pounding.CaseError, match="hertz_1882 takes none"):
        pounding.collide("hertz_1882", spring=table, **bodies)


def test_models_are_described() -> None:
    models = pounding.models()
    assert "jankowski_2005" in models.index and len(models) >= 35
    described = pounding.model("jankowski_2005")
    assert described["parameters"]
    with pytest.raises(pounding.CaseError, match="jankowski_2005"):
        pounding.model("jankovski_2005")


def test_texts_carry_units() -> None:
    plain = pounding.collide(
        "jankowski_2005", mass_left=25e3, velocity_left=0.5, stiffness=2.75e9, restitution=0.65
    )
    texts = pounding.collide(
        "jankowski_2005",
        mass_left="25 t",
        velocity_left="50 cm/s",
        stiffness="2.75e9 N/m^1.5",
        restitution="65 %",
    )
    assert texts == plain and hash(texts) == hash(plain) and len({texts, plain}) == 1
    assert plain != pounding.collide("linear_elastic", mass_left=1.0, velocity_left=1.0, stiffness=1.0)
    assert plain != "a collision" and len(repr(plain)) < 200
    with pytest.raises(pounding.CaseError, match="stiffness must be .* but .* is a force") as told:
        pounding.collide("jankowski_2005", mass_left=1.0, velocity_left=1.0, stiffness="1 N")
    assert told.value.help
    for wrong in (None, b"1", [1.0], True):
        with pytest.raises(pounding.CaseError, match="^stiffness must be"):
            pounding.collide("jankowski_2005", mass_left=1.0, velocity_left=1.0, stiffness=wrong)
    with pytest.raises(pounding.CaseError, match="list of pairs"):
        pounding.collide("borovin_2014", mass_left=1.0, velocity_left=1.0, spring=[1.0, 2.0])
    motion = pounding.Motion([0.0, 1.0, 0.0], "20 ms", unit="g")
    assert motion.time_step == 0.02
    assert motion.scaled_to_peak("0.3 g").peak == pytest.approx(0.3 * 9.80665, rel=1e-15)
    assert motion.scaled_by("50 %").peak == pytest.approx(0.5 * 9.80665, rel=1e-15)
    assert motion.measures("5 %") == motion.measures(0.05)


@pytest.mark.parametrize(
    "periods",
    [
        np.ma.array([0.1, 0.2], mask=[1, 0]),
        [0.1 + 1j],
        [[0.1, 0.2]],
        ["0.1 s"],
        [True],
        [None, pd.NA],
        b"a",
        bytearray(b"a"),
        memoryview(b"a"),
        np.array([bytearray(b"1"), 2.0], dtype=object),
    ],
)
def test_periods_are_real_numbers(periods: object) -> None:
    motion = pounding.Motion([0.0, 1.0, 0.0], 0.02)
    with pytest.raises(pounding.CaseError, match="periods") as told:
        motion.spectrum(periods)
    assert told.value.help
    with pytest.raises(pounding.CaseError, match="acceleration"):
        pounding.Motion(periods, 0.02)
    # Numbers that lie in memory are such.
    held = array.array("d", [0.1, 0.2])
    in_bytes = memoryview(held.tobytes()).cast("d")
    for numbers in (held, memoryview(held), in_bytes):
        assert list(motion.spectrum(numbers)["period"].values) == [0.1, 0.2]


@pytest.mark.parametrize("name", [None, 5, ""])
def test_a_name_is_a_text(name: object) -> None:
    with pytest.raises(pounding.CaseError, match="^name is"):
        pounding.Motion([0.0, 1.0], 0.02, name=name)
    if name is not None:
        with pytest.raises(pounding.CaseError, match="^name is"):
            pounding.read_motion(RECORD, name=name)


def test_records_are_read_as_a_case_reads_them(tmp_path: Path) -> None:
    path = tmp_path / "record.txt"
    path.write_text("0.1\n0.2\n-0.1\n")
    keys = {"unit": "g", "time_step": "20 ms", "layout": "a", "gravity": "9.81 m/s2"}
    motion = pounding.read_motion(path, format="plain_columns", prepend_zero=True, offset="keep", **keys)
    assert motion.time_step == 0.02
    assert np.allclose(motion.acceleration, 9.81 * np.array([0.0, 0.1, 0.2, -0.1]), rtol=1e-15)
    with pytest.raises(pounding.CaseError, match="skip_lines is -1"):
        pounding.read_motion(path, skip_lines=-1)
    with pytest.raises(pounding.CaseError, match="time_step must be"):
        pounding.read_motion(path, time_step="20 m")
    with pytest.raises(pounding.RecordError, match="automatic, keep or remove"):
        pounding.read_motion(path, offset="half")
    with pytest.raises(TypeError, match=r"^read_motion\(\)"):
        pounding.read_motion(path, tiem_step=0.02)
    # A remedy says what is to be written here.
    with pytest.raises(pounding.RecordError, match=r'`unit="g"` with `read_motion`'):
        pounding.read_motion(path)


@pytest.mark.parametrize("name", ["gravity", "time_step", "sensitivity"])
def test_what_is_said_of_a_record_is_above_zero(name: str) -> None:
    for wrong in (0, -1.0, np.float64(-0.5)):
        with pytest.raises(pounding.CaseError, match=f"^{name} = .* must be greater than zero"):
            pounding.read_motion(RECORD, **{name: wrong})
    for wrong in (np.nan, np.inf):
        with pytest.raises(pounding.CaseError, match=f"^{name} = .* is not a finite number") as told:
            pounding.read_motion(RECORD, **{name: wrong})
        assert told.value.help
    with pytest.raises(pounding.CaseError, match=f'^{name} must be .* "9.81" has no unit'):
        pounding.read_motion(RECORD, **{name: "9.81"})


@pytest.mark.parametrize("name", ["lenient", "prepend_zero"])
@pytest.mark.parametrize("wrong", ["no", "false", 1, 0, None, [True]])
def test_flags_are_true_or_false(name: str, wrong: object) -> None:
    with pytest.raises(TypeError, match=f"^{name} is .* neither True nor False") as told:
        pounding.read_motion(RECORD, **{name: wrong})
    assert isinstance(told.value, pounding.CaseError)
    assert len(pounding.read_motion(RECORD, **{name: np.False_})) > 1000


def test_texts_without_a_unit_are_no_quantities() -> None:
    motion = pounding.Motion([0.0, 1.0, 0.0], 0.01)
    bodies = {"mass_left": 25e3, "velocity_left": 0.8, "stiffness": 1e8}
    calls = {
        "time_step": lambda: pounding.Motion([0.0, 1.0], "0.01"),
        "peak": lambda: motion.scaled_to_peak("0.3"),
        **{
            name: lambda name=name: pounding.collide("linear_elastic", **{**bodies, name: str(bodies[name])})
            for name in bodies
        },
    }
    for name, call in calls.items():
        with pytest.raises(pounding.CaseError, match=f'^{name} must be .* has no unit') as told:
            call()
        assert "add a unit, or write" in told.value.help
    # Pure numbers have none.
    assert motion.scaled_by("0.5").peak == 0.5


@pytest.mark.parametrize("name", [None, 1, b"hertz_1882", ["hertz_1882"]])
def test_the_name_of_a_model_is_a_text(name: object) -> None:
    for call in (pounding.model, lambda model: pounding.collide(model, mass_left=1.0, velocity_left=1.0)):
        with pytest.raises(TypeError, match="which is no text") as told:
            call(name)
        assert isinstance(told.value, pounding.CaseError)


def test_models_have_their_status() -> None:
    models = pounding.models()
    assert set(models["status"]) <= {"verified", "from secondary sources", "unverified"}
    for status, verification in zip(models["status"], models["verification"], strict=True):
        assert verification.startswith(status)


@pytest.mark.parametrize("work", ["measures", "spectrum"])
def test_an_interruption_ends_spectra_and_measures(work: str) -> None:
    motion = pounding.Motion(np.sin(0.1 * np.arange(2_000_000)), 0.001)
    # A process in the background of a shell ignores the signal until it is told not to.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    began = time.monotonic()
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            if work == "measures":
                motion.measures()
            else:
                motion.spectrum(np.linspace(0.1, 3.0, 20_000))
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)
    # To its end either takes minutes, and would raise only then.
    assert time.monotonic() - began < 30.0


def test_a_record_too_strong_to_be_squared() -> None:
    with pytest.raises(pounding.RecordError, match="1e308 m/s2 is too large to be squared"):
        pounding.Motion([1e308, -1e308, 1e308], 0.01).measures()
    with pytest.raises(pounding.RecordError, match="1e-200 m/s2 is too small to be squared"):
        pounding.Motion([1e-200, -1e-200], 0.01).measures()


@pytest.mark.parametrize(
    "values",
    [[10**400, 1], np.array([1, "2"], dtype=object), np.array([1.0, True], dtype=object), np.array([np.True_, 1.0], dtype=object), [1.0, None]],
)
def test_entries_that_are_no_numbers(values: object) -> None:
    with pytest.raises(pounding.CaseError, match="^acceleration ") as told:
        pounding.Motion(values, 0.01)
    assert told.value.help
    assert pounding.Motion(np.array([1, 2.5], dtype=object), 0.01).peak == 2.5


def test_what_is_no_trace_is_told() -> None:
    for wrong in (None, 5, [1.0, 2.0]):
        with pytest.raises(TypeError, match="is given as a trace") as told:
            pounding.Motion.from_obspy(wrong)
        assert isinstance(told.value, pounding.CaseError)
    obspy = pytest.importorskip("obspy")
    trace = pounding.read_motion(RECORD).to_obspy()
    with pytest.raises(TypeError, match=r"a Stream is given as a trace\n.*stream\[0\]"):
        pounding.Motion.from_obspy(obspy.Stream([trace]))


def test_masses_are_above_zero() -> None:
    for name in ("mass_left", "mass_right"):
        bodies = {"mass_left": 1e3, "mass_right": 1e3, name: -1}
        with pytest.raises(pounding.CaseError, match=f"^{name} = -1 must be greater than zero") as told:
            pounding.collide("linear_elastic", velocity_left=1.0, stiffness=1e8, **bodies)
        assert told.value.help == "write a value above zero"


@pytest.mark.parametrize("name", ["format", "component", "unit", "quantity", "layout", "offset"])
def test_words_are_texts(name: str) -> None:
    with pytest.raises(TypeError, match=f"^{name} is 5, which is no text") as told:
        pounding.read_motion(RECORD, **{name: 5})
    assert isinstance(told.value, pounding.CaseError)
    for path in (None, 5, ["a"]):
        with pytest.raises(TypeError, match="^path is .* no path"):
            pounding.read_motion(path)
        with pytest.raises(TypeError, match="^response is .* no path"):
            pounding.read_motion(RECORD, response=path or 5)


def test_remedies_of_records_are_keywords(tmp_path: Path) -> None:
    path = tmp_path / "record.txt"
    path.write_text("a title of words\n0.1 0.2\n0.3 x 0.4\n")
    with pytest.raises(pounding.RecordError) as told:
        pounding.read_motion(path, format="plain_columns", unit="g", time_step=0.01)
    assert "`skip_lines=2` with `read_motion`" in told.value.help, told.value.help


def test_a_wall_has_no_velocity() -> None:
    keys = dict(mass_left=25e3, velocity_left=0.8, stiffness=93.5e6)
    assert pounding.collide("linear_elastic", velocity_right="0 m/s", **keys).velocity_right == 0.0
    with pytest.raises(pounding.CaseError, match="the right body is a rigid wall"):
        pounding.collide("linear_elastic", velocity_right=0.5, **keys)


def test_spectra_say_their_damping_as_a_number() -> None:
    motion = pounding.Motion([0.0, 1.0, 0.0], 0.1)
    for damping in ("5 %", 0.05, np.float64(0.05)):
        assert motion.spectrum([1.0], damping=damping).attrs["damping_ratio"] == 0.05


def test_names_of_motions_are_texts() -> None:
    motion = pounding.Motion([0.0, 1.0, 0.0], 0.1)
    with pytest.raises(pounding.CaseError, match="name is 5"):
        motion.name = 5
    motion.name = "other"
    assert pickle.loads(pickle.dumps(motion)).name == "other"


def test_measures_begin_with_the_motion_that_a_file_states(tmp_path: Path) -> None:
    record = tmp_path / "moving.csv"
    lines = ["# Initial velocity: 50 cm/s", "# dt: 0.1 s", "time_s,acceleration_m_s2", "0,-3", "0.1,-3", "0.2,-3"]
    record.write_text("\n".join(lines) + "\n")
    told = subprocess.run(
        [sys.executable, "-m", "pounding", "motion", "info", str(record), "--json"],
        capture_output=True,
        text=True,
        check=True,
    )
    said = json.loads(told.stdout)["files"][0]["series"][0]["measures"]
    motion = pounding.read_motion(record)
    assert motion.measures() == said
    assert said["peak_velocity"] == pytest.approx({"value": 0.5, "time": 0.0})
    assert pickle.loads(pickle.dumps(motion)).measures() == said
    assert motion.scaled_by(2).measures()["end_velocity"] == pytest.approx(-0.2)


def test_ground_that_stands_still_has_no_measures() -> None:
    still = pounding.Motion(np.zeros(100), 0.02)
    for ask in (still.measures, lambda: pounding.measures(still)):
        with pytest.raises(pounding.RecordError, match="the ground stands still") as told:
            ask()
        assert "another record" in (told.value.help or "")
    assert not still.spectrum([1.0])["pseudo_acceleration"].any()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.spectrum([1.0], damping=5), "damping ratio = 5 is outside"),
        (lambda m: m.measures(damping=5), "damping ratio = 5 is outside"),
        (lambda m: m.spectrum([-1.0]), "period = -1 is outside"),
        (lambda m: m.spectrum([]), "no periods are given"),
        (lambda m: m.scaled_by(0), "factor = 0 is not finite, or zero"),
        (lambda m: m.scaled_by(np.nan), "factor = NaN is not finite, or zero"),
        (lambda m: m.scaled_to_peak(-1.0), "peak"),
        (lambda m: m.scaled_to_peak(np.inf), "peak = inf is not a finite number"),
    ],
)
def test_arguments_at_fault_are_no_fault_of_the_record(call: Callable[[Any], object], message: str) -> None:
    with pytest.raises(pounding.CaseError, match=message) as told:
        call(pounding.read_motion(RECORD))
    assert type(told.value) is pounding.CaseError and told.value.help
