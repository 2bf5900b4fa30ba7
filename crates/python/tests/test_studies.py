"""Sweeps and incremental dynamic analysis: the files of the command line, opened lazily."""

from __future__ import annotations

import json
import math
import re
import shutil
import sys
import tomllib
import warnings
from pathlib import Path

import h5py
import numpy as np
import pytest
from conftest import EXAMPLES, PAIR, RECORD, ROOT
from test_command_line import command, datasets, same

import pounding


@pytest.fixture()
def folder(tmp_path: Path) -> Path:
    """Examples and records beside one another, as in the repository."""
    for name in ("ground_motions", "examples/sweep_three_storey_pair", "examples/three_storey_pair"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("*.h5"))
    return tmp_path


def small_study(folder: Path) -> Path:
    path = folder / "examples" / "sweep_three_storey_pair" / "small.toml"
    path.write_text(
        'case = "../three_storey_pair/case.toml"\n\n'
        "[[variable]]\n"
        'path = "gap.0.width"\n'
        'name = "width"\n'
        'values = ["5 mm", "10 mm", "20 mm", "40 mm", "80 mm"]\n'
    )
    return path


def test_a_sweep_is_the_file_of_the_command(folder: Path) -> None:
    study = small_study(folder)
    told: list[tuple[int, int]] = []
    runs = pounding.sweep(study, threads=2, progress=lambda *now: told.append(now))
    assert told and told[-1][0] == told[-1][1]
    report = json.loads(runs.attrs["sweep"])
    assert report["failed"] == 0
    other = folder / "command.h5"
    command("sweep", study, "-o", other)
    with h5py.File(study.with_suffix(".h5")) as a, h5py.File(other) as b:
        first, second = datasets(a), datasets(b)
        assert first.keys() == second.keys()
        for name, values in first.items():
            same(name, values, second[name])
    assert runs.sizes["run"] == 5
    runs.close()


def test_a_study_that_is_wrong_is_told(folder: Path) -> None:
    study = small_study(folder)
    study.write_text(study.read_text().replace("gap.0.width", "gap.0.widht"))
    with pytest.raises(pounding.CaseError) as caught:
        pounding.sweep(study)
    assert "small.toml" in str(caught.value)
    with pytest.raises(pounding.CaseError, match=r"no \[ida\]"):
        pounding.ida(small_study(folder))


def test_fractiles_of_an_analysis_are_those_of_its_runs(folder: Path) -> None:
    name = "examples/fragility_three_storey_pair"
    shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("*.h5"))
    study = folder / name / "study.toml"
    text = study.read_text()
    for old, new in (
        ("count = 40", "count = 6"),
        ("count = 12", "count = 4"),
        ("target_frequency", "# target_frequency"),
    ):
        assert old in text
        text = text.replace(old, new)
    study.write_text(text)
    analysis = pounding.ida(study, threads=2)
    runs = analysis.runs()
    assert runs.sizes["run"] == 24
    intensity = runs["intensity"].to_numpy()
    light = runs["storey_building"].to_numpy() == "light"
    demands = {
        "peak_drift_ratio: light": runs["peak_drift_ratio"].to_numpy()[:, light].max(axis=1),
        "peak_force: light-heavy": runs["peak_force"].to_numpy().max(axis=1),
    }
    levels = analysis.levels
    assert sorted(set(intensity)) == sorted(set(levels.index.get_level_values("intensity")))
    for demand, values in demands.items():
        for level in sorted(set(intensity)):
            ours = levels.loc[(demand, level), ["p16", "p50", "p84"]].to_numpy(dtype=float)
            theirs = np.percentile(values[intensity == level], [16, 50, 84])
            np.testing.assert_allclose(ours, theirs, rtol=1e-12)
    assert list(analysis.limits["name"])[1] == "light roof above 2 g"
    runs.close()
    other = folder / "command.h5"
    said = json.loads(command("ida", study, "-o", other, "--json"))
    said.pop("sweep")
    assert {k: v for k, v in analysis.answer.items() if k != "sweep"} == said


def test_the_output_is_no_input(folder: Path) -> None:
    study = small_study(folder)
    before = study.read_bytes()
    with pytest.raises(pounding.CaseError):
        pounding.sweep(study, output=study)
    assert study.read_bytes() == before


def test_a_result_takes_the_place_of_none_of_another_kind(folder: Path) -> None:
    study = small_study(folder)
    run = pounding.run(pounding.Case.from_file(EXAMPLES / "three_storey_pair" / "case.toml"))
    of_run, of_study = folder / "run.h5", study.with_suffix(".h5")
    run.to_hdf5(of_run)
    pounding.sweep(study).close()
    before = of_run.read_bytes(), of_study.read_bytes()
    with pytest.raises(pounding.OutputError, match="is the result of a run"):
        pounding.sweep(study, output=of_run)
    with pytest.raises(pounding.OutputError, match="is the result of a study"):
        run.to_hdf5(of_study)
    assert (of_run.read_bytes(), of_study.read_bytes()) == before
    # One of its own kind does, with a word where it is of another study.
    other = study.with_name("other.toml")
    other.write_text(study.read_text() + "# another\n")
    with pytest.warns(UserWarning, match="will be replaced, the result of another study"):
        pounding.sweep(other, output=of_study).close()


def test_results_of_other_cases_are_replaced_after_a_warning(folder: Path) -> None:
    def made(title: str, mass: str) -> pounding.Result:
        shed = pounding.Building("shed", mass=[mass], stiffness=["4 MN/m"], height="3 m", damping={"stiffness_proportional": 0.05})
        motion = pounding.Motion([0.0, 1.0, -1.0, 0.0], 0.01)
        return pounding.run(pounding.Case([shed], ground_motion=motion, title=title), isolated=False)

    of_file = pounding.run(EXAMPLES / "three_storey_pair" / "case.toml")
    shed, tower = made("shed", "25 t"), made("tower", "25 t")
    output = folder / "result.h5"
    for before, after, said in (
        (of_file, shed, "the result of a run (.*case.toml)"),
        (shed, of_file, "the result of a run that does not say of which case file it is"),
        (shed, tower, "the result of a run of another case without a file"),
        (shed, made("shed", "26 t"), "the result of a run of another case without a file"),
    ):
        output.unlink(missing_ok=True)
        before.to_hdf5(output)
        bytes_before = output.read_bytes()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with pytest.raises(UserWarning, match=f"result.h5 will be replaced, {said}"):
                after.to_hdf5(output)
            assert output.read_bytes() == bytes_before
            # The same again.
            before.to_hdf5(output)
        with pytest.warns(UserWarning, match=said):
            after.to_hdf5(output)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        made("shed", "26 t").to_hdf5(output)


def test_a_gap_check_says_what_it_was_warned_of(folder: Path) -> None:
    el_centro = ROOT / "ground_motions" / "el_centro_1940_ns.csv"
    copy = folder / "copy.csv"
    copy.write_bytes(el_centro.read_bytes())
    check = pounding.gap_check(EXAMPLES / "three_storey_pair" / "case.toml", [el_centro, copy])
    assert any("the same motion" in warning for warning in check.warnings)
    assert "the same motion" in check._repr_html_()


def test_files_of_others_are_replaced_after_a_warning(folder: Path) -> None:
    study = small_study(folder)
    run = pounding.run(EXAMPLES / "three_storey_pair" / "case.toml")
    for name, what, write in (
        ("run.h5", "result", run.to_hdf5),
        ("page.html", "page", run.report),
        ("study.h5", "result", lambda output: pounding.sweep(study, output=output).close()),
    ):
        output = folder / name
        output.write_text("precious")
        said = f"{name} will be replaced, which is no {what} of this program"
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            # As an error it is a refusal.
            with pytest.raises(UserWarning, match=said):
                write(output)
        assert output.read_text() == "precious"
        with pytest.warns(UserWarning, match=said) as told:
            write(output)
        assert [w.filename for w in told] == [__file__]
        assert output.read_bytes()[:4] != b"prec"
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            write(output)


def test_a_result_under_its_default_name_says_of_which_study_it_is(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    study = small_study(folder).relative_to(folder)
    pounding.sweep(study).close()
    kept = study.with_suffix(".h5")
    before = kept.read_bytes()
    # Its default result has the same name.
    other = study.with_name("small.v2")
    other.write_text(study.read_text() + "# another\n")
    with pytest.raises(pounding.OutputError, match="does not take its place unasked"):
        pounding.sweep(other)
    assert kept.read_bytes() == before
    pounding.sweep(study).close()


def test_an_output_without_a_name_is_told_before_the_work(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    study = small_study(folder)
    with pytest.raises(pounding.CaseError, match="output is empty"):
        pounding.sweep(study, output="")
    assert not (folder / ".parts").exists()


def test_a_result_that_comes_while_a_study_runs_stays(folder: Path) -> None:
    study = small_study(folder)
    widths = ", ".join(f'"{width} mm"' for width in range(1, 2001))
    study.write_text(study.read_text().split("values")[0] + f"values = [{widths}]\n")
    run = pounding.run(pounding.Case.from_file(EXAMPLES / "three_storey_pair" / "case.toml"))
    came, output = folder / "run.h5", study.with_suffix(".h5")
    run.to_hdf5(came)
    left: list[int] = []

    def another_process(done: int, total: int) -> None:
        if not left:
            shutil.copyfile(came, output)
            left.append(total - done)

    with pytest.raises(pounding.OutputError, match="is the result of a run"):
        pounding.sweep(study, threads=2, progress=another_process)
    assert left[0] > 0
    assert output.read_bytes() == came.read_bytes()
    with h5py.File(study.with_name("small-2.h5")) as aside:
        assert aside["peak_force"].shape[0] == 2000
    # Another study asks nothing of the first one's place.
    output.unlink()
    pounding.sweep(study, threads=2).close()


@pytest.mark.skipif(sys.platform == "win32", reason="the interpreter is a shell script here")
def test_a_result_that_stands_is_read_by_another_process(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = small_study(folder)
    first = pounding.sweep(study)
    report = json.loads(first.attrs["sweep"])
    first.close()
    assert report["made"] == 5
    calls, interpreter = folder / "calls", folder / "interpreter"

    def executable(script: str) -> None:
        interpreter.write_text(f'#!/bin/sh\necho "$*" >> {calls}\n{script}\n')
        interpreter.chmod(0o755)
        monkeypatch.setattr(sys, "executable", str(interpreter))

    executable(f'exec {sys.executable} "$@"')
    again = pounding.sweep(study, resume=True, threads=1)
    assert json.loads(again.attrs["sweep"]) == {**report, "made": 0}
    again.close()
    (call,) = calls.read_text().splitlines()
    assert call.startswith("-m pounding sweep ") and call.endswith("--read-in-this-process")
    # What ends that process ends nothing here.
    executable("kill -SEGV $$")
    with pytest.raises(pounding.CaseError, match="cannot be read: it is damaged"):
        pounding.sweep(study, resume=True)
    # And what it says is what there is to say.
    executable("echo '  \u00d7 no result: it is cut off' >&2; exit 2")
    with pytest.raises(pounding.CaseError, match="^no result: it is cut off"):
        pounding.sweep(study, resume=True)


def test_an_analysis_that_stands_is_evaluated_again(folder: Path) -> None:
    name = "examples/fragility_three_storey_pair"
    shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("*.h5"))
    study = folder / name / "study.toml"
    text = study.read_text().replace("count = 40", "count = 3").replace("count = 12", "count = 2")
    study.write_text(text.replace("target_frequency", "# target_frequency"))
    first = pounding.ida(study, threads=2)
    again = pounding.ida(study, threads=2, resume=True)
    assert again.answer.pop("sweep")["made"] == 0
    first.answer.pop("sweep")
    assert again.answer == first.answer


def test_a_record_that_overturns_a_building_has_no_end_of_demand(folder: Path) -> None:
    text = (folder / "examples/three_storey_pair/case.toml").read_text()
    law = 'law = { model = "elastic_perfectly_plastic", yield_force = "110 kN" }'
    text = text.replace('height = "3 m"', f'height = "3 m"\np_delta = true\n{law}', 1)
    path = folder / "examples/three_storey_pair/overturned.toml"
    path.write_text(text)
    motions = folder / "ground_motions"
    records = [motions / f"{name}.csv" for name in ("kobe_1995_jma_ns", "el_centro_1940_ns")]
    answer = pounding.gap_check(path, records)
    assert not answer
    (collapsed,) = answer.answer["collapsed"]
    assert collapsed["name"] == "kobe_1995_jma_ns" and collapsed["building"] == "light"
    demand = answer.demand
    assert list(demand.index) == ["el_centro_1940_ns", "kobe_1995_jma_ns"]
    assert demand.iloc[1, 0] == math.inf and math.isfinite(demand.iloc[0, 0])
    said = "not adequate; gap light-heavy: 20 mm, no width is enough under 2 records"
    assert repr(answer) == f"<pounding.GapCheck: {said}>"
    assert "<li>gap light-heavy: 20 mm, no width is enough under 2 records</li>" in answer._repr_html_()


def test_a_gap_check_takes_motions_of_memory() -> None:
    case = EXAMPLES / "three_storey_pair" / "case.toml"
    motion = pounding.read_motion(ROOT / "ground_motions" / "el_centro_1940_ns.csv")
    of_file = pounding.gap_check(case, [ROOT / "ground_motions" / "el_centro_1940_ns.csv"])
    of_memory = pounding.gap_check(case, {"el_centro": motion, "half": motion.scaled_by(0.5)})
    assert of_memory.demand.iloc[0, 0] == of_file.demand.iloc[0, 0]
    assert list(of_memory.demand.index) == ["el_centro", "half"]
    # Isolated buildings are linear.
    assert np.isclose(of_memory.demand.iloc[1, 0], 0.5 * of_memory.demand.iloc[0, 0], rtol=1e-9)


def test_a_gap_check_by_one_code_is_that_of_the_command() -> None:
    case = EXAMPLES / "three_storey_pair" / "case.toml"
    said = json.loads(
        command("gap", case, "--code", "eurocode_8_2004", "--points", 0, "--json", expect=1)
    )
    check = pounding.gap_check(case, code="eurocode_8_2004")
    assert check.answer == said
    options = {"country": "Italy", "date": "2019-01-01", "rules": EXAMPLES / "gap_check" / "rules.toml"}
    words = [word for name, value in options.items() for word in (f"--{name}", value)]
    said = json.loads(command("gap", case, *words, "--points", 0, "--json", expect=1))
    check = pounding.gap_check(case, **options)
    assert check.answer == said
    assert "ntc_2018" in json.dumps(check.answer) and '"yours"' in json.dumps(check.answer)
    with pytest.raises(pounding.CaseError, match="eurocode_8_2004"):
        pounding.gap_check(case, code="eurocode_8_204")
    with pytest.raises(ValueError, match="no records"):
        pounding.gap_check(case, [])


def test_options_of_the_commands_are_keywords() -> None:
    case = EXAMPLES / "three_storey_pair" / "case.toml"
    models = ["jankowski_2005", "anagnostopoulos_2004"]
    words = ["--approach-velocity", "0.5 m/s", "--restitution", "0.6"]
    said = json.loads(command("compare", case, "--models", *models, *words, "--json"))
    for velocity, restitution in (("50 cm/s", "60 %"), (0.5, 0.6)):
        options = {"approach_velocity": velocity, "restitution": restitution}
        assert pounding.compare(case, models, **options).answer == said
    assert list(pounding.compare(case, models[0]).models.index) == models[:1]
    with pytest.raises(pounding.CaseError, match="unknown impact model \"jankovski_2005\""):
        pounding.compare(case, "jankovski_2005")
    for velocity in (0, "-1 m/s", math.nan):
        with pytest.raises(pounding.CaseError, match="approach_velocity must be greater than zero"):
            pounding.compare(case, models, approach_velocity=velocity)
    provision = "en_1998_1_2004_between"
    words = ["--provisions", provision, "--set", "importance=1.4", "--points", 4, "--from", "5 mm"]
    words += ["--to", "80 mm", "--gap", "light-heavy", "--probability", "10 %", "--confidence", "0.8"]
    said = json.loads(command("gap", case, *words, "--json", expect=1))
    check = pounding.gap_check(
        case,
        provisions=provision,
        set={"importance": 1.4},
        points=4,
        from_="5 mm",
        to=0.08,
        gap="light-heavy",
        probability="10 %",
        confidence=0.8,
    )
    assert check.answer == said
    assert len(check.answer["gaps"][0]["provisions"]) == 1
    with pytest.raises(pounding.CaseError, match="points is -1"):
        pounding.gap_check(case, points=-1)
    with pytest.raises(pounding.CaseError, match="without a sweep"):
        pounding.gap_check(case, to="80 mm")
    with pytest.raises(pounding.CaseError, match="^importence: unknown key"):
        pounding.gap_check(case, set={"importence": 1.4})


def test_remedies_name_what_is_written_here(tmp_path: Path) -> None:
    path = tmp_path / "wide.toml"
    case = EXAMPLES / "three_storey_pair" / "case.toml"
    text = case.read_text().replace("../../ground_motions", str(ROOT / "ground_motions"))
    path.write_text(text.replace('width = "20 mm"', 'width = "20 m"'))
    with pytest.raises(pounding.CaseError, match="help: give `approach_velocity`, or a narrower gap"):
        pounding.compare(path, ["jankowski_2005"])
    with pytest.raises(pounding.CaseError, match="give `to` a value"):
        pounding.gap_check(case, points=3, from_="5 mm", to="1 mm")
    with pytest.raises(pounding.OutputError, match="or name another file$"):
        pounding.run(case).to_hdf5(tmp_path / "no" / "folder.h5")


def test_answers_are_shown_in_short() -> None:
    case = EXAMPLES / "three_storey_pair" / "case.toml"
    check, comparison = pounding.gap_check(case), pounding.compare(case)
    for answer in (check, comparison):
        assert len(repr(answer)) < 1000 and repr(answer).startswith("<pounding.")
        assert answer._repr_html_().startswith("<p><strong>")
    assert "not adequate; gap light-heavy: 20 mm" in repr(check)
    # By a code, whose answer need not be that of the records.
    by_code = pounding.gap_check(case, code="eurocode_8_2004")
    assert "GapCheck: not adequate by eurocode_8_2004; gap" in repr(by_code)
    assert f"{len(comparison.models)} models under 1 record" in repr(comparison)


def test_required_widths_suffice_as_they_are_shown() -> None:
    tables = tomllib.loads((EXAMPLES / "three_storey_pair" / "case.toml").read_text())
    tables["ground_motion"]["file"] = str(RECORD)

    def shown(width: float) -> tuple[bool, float, float]:
        tables["gap"][0]["width"] = width
        check = pounding.gap_check(pounding.Case.from_dict(tables))
        numbers = re.search(r": ([\d.]+) mm, of which ([\d.]+) mm are required", repr(check))
        assert numbers is not None
        return check.adequate, float(numbers[1]), float(numbers[2])

    demand = pounding.gap_check(PAIR).demand.iloc[0, 0]
    for width in (demand - 1e-6, demand - 1e-9, demand, demand + 1e-6, 0.12, 0.02):
        adequate, provided, required = shown(width)
        assert required >= 1e3 * demand - 1e-6
        assert adequate == (required <= provided), (width, provided, required)


def test_provisions_have_the_width_that_they_ask_for() -> None:
    records = [RECORD, ROOT / "ground_motions" / "kobe_1995_jma_ns.csv"]
    check = pounding.gap_check(PAIR, records)
    rows = check.provisions.set_index("name")
    for provision in check.answer["gaps"][0]["provisions"]:
        required = rows.loc[provision["name"], "required"]
        widths = [record["width"] for record in provision["records"]]
        if None in widths:
            assert math.isnan(required), provision["name"]
        else:
            assert required == max(widths) >= 0, provision["name"]
    assert 0 < rows["required"].count() < len(rows)


def test_widths_and_velocities_have_a_unit_in_texts() -> None:
    case = EXAMPLES / "three_storey_pair" / "case.toml"
    for name, call in {
        "from_": lambda: pounding.gap_check(case, points=3, from_="0.01", to=0.05),
        "to": lambda: pounding.gap_check(case, points=3, from_=0.01, to="0.05"),
        "approach_velocity": lambda: pounding.compare(case, approach_velocity="0.4"),
    }.items():
        with pytest.raises(pounding.CaseError, match=f"^{name} must be .* has no unit") as told:
            call()
        assert told.value.help


def test_arguments_of_studies_are_such(folder: Path) -> None:
    case = EXAMPLES / "three_storey_pair" / "case.toml"
    study = small_study(folder)
    for call in (
        lambda: pounding.gap_check(case, set="x"),
        lambda: pounding.gap_check(case, 1),
        lambda: pounding.gap_check(case, {1: case}),
        lambda: pounding.gap_check(case, code=1),
        lambda: pounding.gap_check(case, country=1),
        lambda: pounding.gap_check(case, date=2020),
        lambda: pounding.gap_check(case, rules=1),
        lambda: pounding.gap_check(case, gap=1, points=3),
        lambda: pounding.gap_check(case, provisions=None),
        lambda: pounding.gap_check(case, provisions=[1]),
        lambda: pounding.gap_check(case, progress=1),
        lambda: pounding.gap_check(case, points=np.array(2.0)),
        lambda: pounding.gap_check(case, points=np.array([2])),
        lambda: pounding.compare(case, threads=np.array(2.0)),
        lambda: pounding.sweep(study, threads=np.array(2.0)),
        lambda: pounding.read_motion(RECORD, skip_lines=np.array(2.0)),
        lambda: pounding.read_motion(RECORD, skip_columns=np.array([1, 2])),
        lambda: pounding.compare(case, None),
        lambda: pounding.compare(case, exact="no"),
        lambda: pounding.compare(case, same_duration=1),
        lambda: pounding.sweep(None),
        lambda: pounding.sweep(study, output=5),
        lambda: pounding.sweep(study, shard=(1, 2)),
        lambda: pounding.sweep(study, resume="yes"),
        lambda: pounding.ida(study, keep_going=1),
    ):
        with pytest.raises(TypeError) as told:
            call()
        assert isinstance(told.value, pounding.CaseError) and told.value.help, told.value
    assert not study.with_suffix(".h5").exists()


def test_a_sweep_that_cannot_be_opened_is_not_begun(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = small_study(folder)
    monkeypatch.setitem(sys.modules, "h5netcdf", None)
    with pytest.raises(pounding.MissingPackageError, match="sweep needs the package h5netcdf"):
        pounding.sweep(study)
    assert not study.with_suffix(".h5").exists()


def test_shards_that_meet_a_result_are_told_in_keywords(folder: Path) -> None:
    study = small_study(folder)
    pounding.sweep(study).close()
    with pytest.raises(pounding.PoundingError) as told:
        pounding.sweep(study, shard="1/2")
    assert "--" not in str(told.value) and " -o" not in str(told.value), told.value


def test_what_stands_in_the_place_of_a_result_is_told_in_keywords(folder: Path) -> None:
    study = small_study(folder)
    foreign = folder / "foreign.h5"
    with h5py.File(foreign, "w") as file:
        file["values"] = [1.0, 2.0]
    before = foreign.read_bytes()
    with pytest.raises(pounding.CaseError, match="is not the result that `resume=True` goes on with") as told:
        pounding.sweep(study, output=foreign, resume=True)
    assert "--" not in str(told.value) and foreign.read_bytes() == before
    # No run was made, of which there would be anything to go on with.
    study.with_suffix(".h5").mkdir()
    for output in (None, folder / "missing" / "out.h5"):
        with pytest.raises(pounding.OutputError, match="cannot write the result") as failed:
            pounding.sweep(study, output=output)
        assert failed.value.help and "resume" not in failed.value.help
