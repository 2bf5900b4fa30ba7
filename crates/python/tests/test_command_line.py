"""What Python returns is what the command line writes, bit for bit."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import h5py
import numpy as np
import pytest
from conftest import EXAMPLES, PAIR, RECORD, ROOT

import pounding


def command(*arguments: object, expect: int = 0) -> str:
    ended = subprocess.run(
        [sys.executable, "-m", "pounding", *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == expect, ended.stderr
    return ended.stdout


def examples() -> list[Path]:
    return sorted(EXAMPLES.glob("*/case.toml"))


def datasets(file: h5py.File) -> dict[str, np.ndarray]:
    found: dict[str, np.ndarray] = {}

    def visit(name: str, place: object) -> None:
        if isinstance(place, h5py.Dataset):
            found[name] = place[()]

    file.visititems(visit)
    return found


def same(name: str, a: np.ndarray, b: np.ndarray) -> None:
    a, b = np.asarray(a), np.asarray(b)
    assert a.dtype == b.dtype and a.shape == b.shape, name
    if a.dtype.kind == "f":
        assert np.array_equal(a, b, equal_nan=True), name
    elif a.dtype.kind == "V":
        for field in a.dtype.names or ():
            same(f"{name}/{field}", a[field], b[field])
    else:
        assert np.array_equal(a, b), name


@pytest.mark.parametrize("path", examples(), ids=lambda p: p.parent.name)
def test_every_example_is_the_same_file(path: Path, tmp_path: Path) -> None:
    by_command, by_python = tmp_path / "command.h5", tmp_path / "python.h5"
    summary = json.loads(command("run", path, "-o", by_command, "--json"))
    result = pounding.run(path)
    result.to_hdf5(by_python)
    assert result.summary == summary
    with h5py.File(by_command) as a, h5py.File(by_python) as b:
        first, second = datasets(a), datasets(b)
        assert first.keys() == second.keys()
        for name in first.keys() - {"run/wall_time"}:
            same(name, first[name], second[name])
        for name in ("case", "case_sha256", "record_sha256", "status", "title", "version"):
            assert a.attrs[name] == b.attrs[name], name
        arrays = result.to_xarray()
        for name, values in first.items():
            if values.dtype.kind != "f" or name == "run/wall_time":
                continue
            group, _, leaf = name.rpartition("/")
            node = arrays[group] if group else arrays
            assert np.array_equal(node[leaf].values, values, equal_nan=True), name
        for name, building in result.buildings.items():
            for quantity in ("displacement", "velocity", "acceleration_absolute", "storey_shear"):
                expected = first[f"building/{name}/{quantity}"]
                assert np.array_equal(getattr(building, quantity), expected), quantity
        for name, gap in result.gaps.items():
            assert np.array_equal(gap.penetration, first[f"gap/{name}/penetration"])
            assert np.array_equal(gap.force, first[f"gap/{name}/force"])
            table = first[f"gap/{name}/impacts"]
            rows = result.impacts[result.impacts["gap"] == name]
            for column in rows.columns.drop("gap"):
                assert np.array_equal(rows[column], table[column], equal_nan=True), column
        for column in result.energy.columns:
            assert np.array_equal(result.energy[column], first[f"energy/{column}"]), column


def test_records_are_called_as_the_command_calls_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("blast_beside_a_tower", "three_storey_pair"):
        path = EXAMPLES / name / "case.toml"
        monkeypatch.chdir(path.parent.parent)
        relative = path.relative_to(path.parent.parent)
        by_command, by_python = tmp_path / "command.h5", tmp_path / "python.h5"
        summary = json.loads(command("run", relative, "-o", by_command, "--json"))
        result = pounding.run(relative)
        assert result.summary == summary
        result.to_hdf5(by_python)
        with h5py.File(by_command) as a, h5py.File(by_python) as b:
            assert a["ground"].attrs["record"] == b["ground"].attrs["record"]
        understood = json.loads(command("check", relative, "--json"))
        assert pounding.Case.from_file(relative).check() == understood


def test_the_file_is_one_that_the_command_line_reads(tmp_path: Path) -> None:
    path = tmp_path / "pair.h5"
    result = pounding.run(PAIR)
    result.to_hdf5(path)
    command("report", path, "-o", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text()
    own = result.report()
    assert own.startswith("<!DOCTYPE html>") and len(own) == pytest.approx(len(page), rel=0.01)


def test_exit_codes_are_those_of_the_program(tmp_path: Path) -> None:
    assert "pounding" in command("--version")
    command("run", tmp_path / "missing.toml", expect=2)
    command("nonsense", expect=2)


def test_gap_and_compare_say_what_the_commands_say() -> None:
    path = EXAMPLES / "three_storey_pair" / "case.toml"
    # Exit code 1: the gap is too small.
    said = json.loads(command("gap", path, "--points", 0, "--json", expect=1))
    check = pounding.gap_check(path)
    assert check.answer == said
    assert not check
    assert check.demand.shape == (1, 1)
    assert len(check.provisions) > 20
    models = ["anagnostopoulos_2004", "jankowski_2005"]
    said = json.loads(command("compare", path, "--models", *models, "--json"))
    comparison = pounding.compare(path, models)
    assert comparison.answer == said
    assert list(comparison.models.index) == models


def test_records_of_one_name_are_numbered_as_the_commands_do(tmp_path: Path) -> None:
    path = EXAMPLES / "gap_check" / "case.toml"
    motions, records = ROOT / "ground_motions", []
    for folder, record in (("a", "el_centro_1940_ns.csv"), ("b", "kobe_1995_jma_ns.csv")):
        (tmp_path / folder).mkdir()
        records.append(Path(shutil.copy(motions / record, tmp_path / folder / "x.csv")))
    named = ["x", "x (2)"]
    # Exit code 1: the gap is too small.
    said = json.loads(command("gap", path, "--records", *records, "--points", 0, "--json", expect=1))
    assert [record["name"] for record in said["records"]] == named
    for given in (records, [record.parent for record in records]):
        check = pounding.gap_check(path, given)
        assert check.answer == said
        assert list(check.demand.index) == named
    assert pounding.compare(path, "jankowski_2005", records).answer["records"] == named
    assert list(pounding.floor_spectra(path, periods=[1.0], records=records).record.values) == named
    # Motions of arrays are called alike.
    time = 0.02 * np.arange(500)
    made = [pounding.Motion(3.0 * np.sin(5.0 * k * time), 0.02) for k in (1, 2)]
    check = pounding.gap_check(path, [*made, records[0]])
    assert list(check.demand.index) == ["motion", "motion (2)", "x"]
    with pytest.raises(pounding.CaseError, match="x.csv is given twice"):
        pounding.gap_check(path, [records[0], tmp_path / "a" / ".." / "a" / "x.csv"])
    with pytest.raises(pounding.CaseError, match="record motion is given twice"):
        pounding.gap_check(path, [*made, made[0]])


def test_files_that_are_no_records_are_said_to_be_left_out(tmp_path: Path) -> None:
    path = EXAMPLES / "gap_check" / "case.toml"
    shutil.copy(RECORD, tmp_path)
    (tmp_path / "README.md").write_text("Whose they are.")
    note = f"{tmp_path / 'README.md'} is a text, not a record: it is left out"
    for call in (
        lambda: pounding.gap_check(path, tmp_path),
        lambda: pounding.compare(path, "jankowski_2005", [tmp_path]),
        lambda: pounding.floor_spectra(path, periods=[1.0], records={"all": tmp_path}),
    ):
        with pytest.warns(UserWarning) as told:
            call()
        assert [(str(w.message), w.filename) for w in told] == [(note, __file__)]
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with pytest.raises(UserWarning, match="it is left out"):
                call()
