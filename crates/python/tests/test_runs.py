"""Many runs, threads, interruption, arrays."""

from __future__ import annotations

import _thread
import gc
import json
import os
import shutil
import subprocess
import sys
import threading
import time
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from conftest import EXAMPLES, PAIR, RECORD, ROOT

import pounding

ROW = EXAMPLES / "row_of_five" / "case.toml"


def test_threads_and_histories_change_no_bit() -> None:
    cases = [PAIR, ROW] * 3
    one = pounding.run_many(cases, threads=1)
    two = pounding.run_many(cases, threads=2, histories=True)
    alone = [pounding.run(case, isolated=False) for case in cases[:2]] * 3
    for a, b, c in zip(one, two, alone, strict=True):
        assert a.summary == b.summary == c.summary
        assert a.impacts.equals(c.impacts)


def test_a_result_says_of_which_case_file_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As that of the command line does, which so replaces none of another case unasked."""
    monkeypatch.chdir(tmp_path)
    for name in ("p", "q"):
        shutil.copytree(ROOT / "examples" / "three_storey_pair", tmp_path / name / "x")
    shutil.copytree(ROOT / "ground_motions", tmp_path / "ground_motions")
    pounding.run("p/x/case.toml").to_hdf5("x.h5")
    before = Path("x.h5").read_bytes()
    assert b'"file":"p/x/case.toml"' in before
    arguments = [sys.executable, "-m", "pounding", "run", "q/x/case.toml"]
    done = subprocess.run(arguments, capture_output=True, text=True)
    assert done.returncode == 4, done.stderr
    assert "not take its place unasked" in done.stderr
    assert Path("x.h5").read_bytes() == before


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not limit the memory of a process")
def test_histories_that_memory_does_not_hold_are_refused() -> None:
    tables = tomllib.loads(PAIR.read_text())
    # 14 GB, of which the process may have 4.
    tables["analysis"] = {"duration": "40 s", "output_step": 1e-6}
    tables["ground_motion"] = {"file": str(RECORD)}
    program = (
        "import json, resource, sys, pounding\n"
        "resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))\n"
        "case = pounding.Case.from_dict(json.load(sys.stdin))\n"
        "try:\n"
        "    pounding.run(case)\n"
        "except pounding.ComputationError as error:\n"
        "    print(error)\n"
    )
    arguments = [sys.executable, "-c", program]
    done = subprocess.run(arguments, input=json.dumps(tables), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "memory does not hold" in done.stdout


def test_a_python_thread_keeps_running() -> None:
    counted, stop = [0], threading.Event()

    def count() -> None:
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before, started = counted[0], time.perf_counter()
    pounding.run_many([ROW] * 20, threads=2)
    elapsed, counted_meanwhile = time.perf_counter() - started, counted[0] - before
    stop.set()
    thread.join()
    # Held up, it would count once or twice; free, some hundred times a second.
    assert counted_meanwhile > 10 * elapsed, (counted_meanwhile, elapsed)


def test_an_interruption_ends_a_run() -> None:
    timer = threading.Timer(0.3, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        pounding.run_many([ROW] * 100_000, threads=2)
    timer.join()
    # The interpreter goes on.
    assert pounding.run(PAIR).summary["status"] == "complete"


@pytest.mark.parametrize("work", ["gap_check", "compare"])
def test_an_interruption_ends_a_single_long_run(work: str) -> None:
    tables = tomllib.loads(PAIR.read_text())
    tables["analysis"] = {"method": "newmark", "step": 2e-6}
    case = pounding.Case.from_dict(tables, folder=PAIR.parent)
    began = time.monotonic()
    timer = threading.Timer(0.5, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        if work == "gap_check":
            pounding.gap_check(case, threads=1)
        else:
            pounding.compare(case, ["jankowski_2005"], threads=1)
    timer.join()
    # To its end it takes minutes.
    assert time.monotonic() - began < 5.0


def test_progress_is_told_and_may_end_the_work() -> None:
    told: list[tuple[int, int]] = []
    pounding.run_many([PAIR] * 50, threads=1, progress=lambda *now: told.append(now))
    assert told[-1] == (50, 50)

    def refuse(done: int, total: int) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        pounding.run_many([ROW] * 10_000, threads=1, progress=refuse)


@pytest.mark.parametrize("work", ["gap_check", "compare"])
def test_progress_ends_checks_and_comparisons(work: str) -> None:
    told: list[tuple[int, int]] = []

    def refuse(done: int, total: int) -> None:
        told.append((done, total))
        raise ZeroDivisionError

    motion = pounding.read_motion(ROOT / "ground_motions" / "el_centro_1940_ns.csv")
    records = {f"scaled by 1.{i:02}": motion.scaled_by(1.0 + 0.01 * i) for i in range(40)}
    with pytest.raises(ZeroDivisionError):
        if work == "gap_check":
            pounding.gap_check(ROW, points=100_000, threads=1, progress=refuse)
        else:
            pounding.compare(ROW, records=records, threads=1, progress=refuse)
    # Minutes are left of either.
    assert told[-1][0] < 0.5 * told[-1][1], told


def test_a_run_that_fails_stands_in_its_place(pair_dict: dict) -> None:
    pair_dict["analysis"] = {"method": "newmark", "step": "0.02 s", "energy_tolerance": 1e-15}
    bad = pounding.Case.from_dict(pair_dict)
    with pytest.raises(pounding.PoundingError) as caught:
        pounding.run_many([PAIR, bad])
    assert "help:" in str(caught.value)
    made = pounding.run_many(["/nowhere.toml", PAIR, bad], errors="return")
    assert isinstance(made[0], pounding.CaseError)
    assert isinstance(made[1], pounding.Result)
    assert isinstance(made[2], pounding.PoundingError)


def test_arrays_outlive_their_run_and_cannot_be_changed() -> None:
    displacement = pounding.run(PAIR).buildings["light"].displacement
    gc.collect()
    copied = displacement.copy()
    pounding.run(ROW)
    assert np.array_equal(displacement, copied)
    with pytest.raises(ValueError, match="read-only"):
        displacement[0, 0] = 1.0
    # Peaks come from inside the steps.
    peaks = pounding.run(PAIR).peaks.loc["light", "displacement"]
    assert np.all(np.abs(displacement).max(axis=0) <= peaks.to_numpy())


def test_a_run_without_histories_says_so() -> None:
    result = pounding.run(PAIR, histories=False, isolated=False)
    assert "isolated_displacement" not in result.peaks
    with pytest.raises(pounding.CaseError, match="histories=True"):
        result.to_xarray()


def test_a_notebook_shows_text_as_text(pair_dict: dict) -> None:
    pair_dict["title"] = "<script>alert(1)</script>"
    shown = pounding.run(pounding.Case.from_dict(pair_dict))._repr_html_()
    assert "<script>" not in shown and "&lt;script&gt;" in shown
    assert "impacts" in shown


def test_levels_and_peaks_are_tables() -> None:
    result = pounding.run(PAIR)
    levels = result.levels
    counts = result.impacts.groupby(["gap", "level"]).size()
    for place, count in counts.items():
        assert levels.loc[place, "impacts"] == count
    worst = result.impacts["peak_force"].max()
    assert levels["peak_force"].max() == pytest.approx(worst, rel=1e-15)
    assert levels["energy_dissipated"].sum() == pytest.approx(
        result.summary["energy"]["impact"], rel=1e-9
    )


def test_columns_are_of_one_type_with_and_without_impacts(pair_dict: dict) -> None:
    with_impacts = pounding.run(PAIR)
    pair_dict["gap"][0]["width"] = "10 m"
    without_impacts = pounding.run(pounding.Case.from_dict(pair_dict))
    del pair_dict["gap"]
    without_gaps = pounding.run(pounding.Case.from_dict(pair_dict))
    assert len(with_impacts.impacts) and not len(without_impacts.impacts)
    for other in (without_impacts, without_gaps):
        assert other.impacts.dtypes.equals(with_impacts.impacts.dtypes)
        assert other.levels.dtypes.equals(with_impacts.levels.dtypes)
        assert other.levels.index.dtypes.equals(with_impacts.levels.index.dtypes)


def test_a_tree_is_saved_with_all_it_has(tmp_path: Path, pair_dict: dict) -> None:
    result = pounding.run(PAIR)
    tree = result.to_xarray()
    impacts = tree["gap/light-heavy/impacts"]
    rows = result.impacts
    for name in rows.columns.drop(["gap", "level"]):
        assert np.array_equal(impacts[name], rows[name], equal_nan=True), name
        assert impacts[name].dims == ("impact",) and impacts[name].attrs["units"], name
    assert np.array_equal(impacts["level_number"], rows["level"])
    assert list(impacts["constant"].values) == ["stiffness", "class_damping_ratio"]
    pair_dict["gap"][0]["width"] = "10 m"
    quiet = pounding.run(pounding.Case.from_dict(pair_dict)).to_xarray()
    assert quiet["gap/light-heavy/impacts"].sizes["impact"] == 0
    del pair_dict["gap"]
    alone = pounding.run(pounding.Case.from_dict(pair_dict)).to_xarray()
    for number, saved in enumerate((tree, quiet, alone)):
        path = tmp_path / f"{number}.nc"
        saved.to_netcdf(path, engine="h5netcdf")
        with xr.open_datatree(path, engine="h5netcdf", decode_timedelta=False) as read:
            xr.testing.assert_identical(read.load(), saved)


def test_a_summary_is_a_copy() -> None:
    result = pounding.run(PAIR)
    before = result.summary
    result.summary["buildings"].clear()
    result.warnings.append("nothing")
    assert result.summary == before and result.peaks.shape[0] == 6


@pytest.mark.parametrize("threads", [True, 2.7, "2", 0, -1, 10**30, np.array(2.0), np.array([2])])
def test_threads_are_a_count(threads: object) -> None:
    with pytest.raises(pounding.CaseError, match="^threads is"):
        pounding.run_many([PAIR], threads=threads)
    for two in (np.int64(2), np.array(2)):
        assert len(pounding.run_many([PAIR], threads=two)) == 1


@pytest.mark.parametrize("errors", [np.array(["a", "b"]), pd.NA, None, 1, "ignore"])
def test_errors_are_one_of_two_words(errors: object) -> None:
    with pytest.raises(pounding.CaseError, match="^errors is") as told:
        pounding.run_many([], errors=errors)
    assert told.value.help == 'it is "raise" or "return"'


def test_one_case_may_stand_for_a_list(pair_dict: dict) -> None:
    case = pounding.Case.from_file(PAIR)
    expected = pounding.run(case, isolated=False).summary
    for one in (PAIR, str(PAIR), case):
        (made,) = pounding.run_many(one)
        assert made.summary == expected
    light = pounding.Building(**pair_dict["building"][0])
    assert pounding.Case(light, ground_motion=RECORD).buildings == ["light"]
    for wrong in (light, 5, None):
        with pytest.raises(pounding.CaseError, match="is given as a case"):
            pounding.run(wrong)
        with pytest.raises(pounding.CaseError, match="is given as a case"):
            pounding.run_many([wrong])


@pytest.mark.parametrize("name", ["histories", "isolated"])
@pytest.mark.parametrize("wrong", [0, 1, "no", None])
def test_what_is_kept_is_true_or_false(name: str, wrong: object) -> None:
    for call in (pounding.run, pounding.run_many):
        with pytest.raises(TypeError, match=f"^{name} is .* neither True nor False") as told:
            call(PAIR, **{name: wrong})
        assert isinstance(told.value, pounding.CaseError)


def test_cases_progress_and_paths_are_such(tmp_path: Path) -> None:
    result = pounding.run(PAIR)
    for call in (
        lambda: pounding.run_many(None),
        lambda: pounding.run_many(5),
        lambda: pounding.run(PAIR, progress=1),
        lambda: pounding.run_many([PAIR], progress="bar"),
        lambda: result.to_hdf5(None),
        lambda: result.report(5),
    ):
        with pytest.raises(TypeError) as told:
            call()
        assert isinstance(told.value, pounding.CaseError) and told.value.help
    result.report(bytes(tmp_path / "page.html"))
    assert (tmp_path / "page.html").exists()


def test_packages_that_are_missing_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    result = pounding.run(PAIR)
    for package, call in {
        "h5netcdf": result.to_xarray,
        "xarray": lambda: pounding.read_motion(RECORD).spectrum(),
        "pandas": lambda: result.impacts,
    }.items():
        monkeypatch.setitem(sys.modules, package, None)
        with pytest.raises(pounding.MissingPackageError, match=f"needs the package {package}") as told:
            call()
        assert told.value.help == 'pip install "pounding[xarray]"'
        assert isinstance(told.value, ModuleNotFoundError)
        monkeypatch.undo()


@pytest.mark.skipif(sys.platform != "linux", reason="names of files are texts there")
def test_names_that_are_no_text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = os.fsencode(tmp_path) + b"/w\xe9"
    os.mkdir(folder)
    record = folder + b"/\xe9.csv"
    shutil.copy(RECORD, record)
    # Records are read whatever their name.
    motion = pounding.read_motion(record)
    assert motion.name == "\N{REPLACEMENT CHARACTER}" and len(motion) > 1000
    assert pounding.measures(record) == pounding.measures(RECORD)
    assert pounding.gap_check(PAIR, [record]).answer["records"][0]["name"] == motion.name
    # HDF5 takes names in UTF-8 alone.
    result = pounding.run(PAIR)
    monkeypatch.chdir(folder)
    for name in (os.fsencode(tmp_path) + b"/\xe9.h5", b"\xe9.dat", folder + b"/o.h5", "o.h5", "o.dat"):
        with pytest.raises(pounding.CaseError, match="not UTF-8") as told:
            result.to_hdf5(name)
        assert "HDF5 opens no other" in (told.value.help or "")
        assert not os.path.exists(name)
    result.report(b"\xe9.html")
    result.to_hdf5(tmp_path / "o.h5")
