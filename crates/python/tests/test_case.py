"""Cases of files, dicts and builders are one; what is wrong in them is told."""

from __future__ import annotations

import collections
import copy
import datetime
import decimal
import hashlib
import json
import pickle
import shutil
import tomllib
import types
from pathlib import Path

import h5py
import numpy as np
import pandas as pd
import pytest
from conftest import EXAMPLES, PAIR, RECORD, ROOT
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import pounding


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*/case.toml")), ids=lambda p: p.parent.name)
def test_a_dict_is_the_file(path: Path) -> None:
    tables = tomllib.loads(path.read_text())
    made = pounding.run(pounding.Case.from_dict(tables, folder=path.parent), isolated=False)
    read = pounding.run(path, isolated=False)
    assert made.summary == read.summary
    for name, building in read.buildings.items():
        assert np.array_equal(made.buildings[name].displacement, building.displacement)


def test_other_mappings_than_dicts_are_tables() -> None:
    path = EXAMPLES / "three_storey_pair" / "case.toml"
    tables = tomllib.loads(path.read_text())
    tables["building"] = tuple(types.MappingProxyType(table) for table in tables["building"])
    tables["gap"] = [collections.UserDict(table) for table in tables["gap"]]
    made = pounding.Case.from_dict(collections.UserDict(tables), folder=path.parent)
    assert made.check() == pounding.Case.from_file(path).check()
    assert pickle.loads(pickle.dumps(made)).source == made.source


def pair(motion: object, **analysis: object) -> pounding.Case:
    keys = dict(storeys=3, height=3.0, damping={"stiffness_proportional": 0.05})
    light = pounding.Building("light", mass="25 t", stiffness="3.46 MN/m", **keys)
    heavy = pounding.Building("heavy", mass="1000 t", stiffness="2215 MN/m", **keys)
    keys = {k: v for k, v in tomllib.loads(PAIR.read_text())["gap"][0].items() if k != "between"}
    gap = pounding.Gap(light, heavy, **keys)
    return pounding.Case([light, heavy], [gap], ground_motion=motion, analysis=analysis or None)


def test_builders_are_the_file() -> None:
    tables = tomllib.loads(PAIR.read_text())
    scale = tables["ground_motion"].get("scale")
    motion = pounding.GroundMotion(RECORD, scale=scale)
    built = pounding.run(pair(motion, **tables.get("analysis", {})))
    read = pounding.run(PAIR)
    built_peaks, read_peaks = built.peaks, read.peaks
    assert built_peaks.equals(read_peaks)
    assert built.impacts.equals(read.impacts)


def test_a_motion_in_memory_is_that_of_the_file() -> None:
    motion = pounding.read_motion(RECORD)
    again = pounding.Motion(motion.acceleration, motion.time_step)
    of_file = pounding.run(pair(RECORD))
    for given in (motion, again):
        of_memory = pounding.run(pair(given))
        assert of_memory.peaks.equals(of_file.peaks)
    twice = pair(RECORD).with_motion(motion.scaled_by(2.0))
    doubled = pounding.Motion(2.0 * motion.acceleration, motion.time_step)
    assert pounding.run(twice).peaks.equals(pounding.run(pair(doubled)).peaks)


def test_cases_travel_to_other_processes() -> None:
    for case in (
        pounding.Case.from_file(PAIR),
        pair(RECORD),
        pair(pounding.read_motion(RECORD)),
    ):
        other = pickle.loads(pickle.dumps(case))
        first, second = pounding.run(case), pounding.run(other)
        assert first.summary == second.summary


def test_check_tells_what_was_understood() -> None:
    understood = pounding.Case.from_file(PAIR).check()
    light = understood["buildings"][0]
    # A uniform chain of three storeys: omega_1 = 2 sqrt(k/m) sin(pi/14).
    omega = 2.0 * np.sqrt(3.46e6 / 25e3) * np.sin(np.pi / 14)
    assert light["period"][0] == pytest.approx(2 * np.pi / omega, rel=1e-12)


WRONG = {
    "unit of another dimension": (("building", 0, "mass"), "25 kN", "building[0].mass", "divide it by g"),
    "unknown key": (("building", 1, "stifness"), 1.0, "building[1].stifness", "`stiffness`"),
    "negative": (("building", 0, "stiffness"), -1.0, "building[0].stiffness", "greater than zero"),
    "unknown model": (("gap", 0, "model"), "jankovski_2005", "gap[0].model", "jankowski_2005"),
    "unknown building": (("gap", 0, "between"), ["light", "hevy"], "gap[0].between", "heavy"),
    "out of range": (("gap", 0, "restitution"), 1.5, "gap[0].restitution", "1.5"),
    "missing record": (("ground_motion", "file"), "none.csv", "ground_motion.file", "check the path"),
    "wrong count": (("building", 0, "mass"), [1.0, 2.0], "building[0].mass", "3"),
    "unknown method": (("analysis", "method"), "exact", "analysis.method", "event_driven"),
    "no number": (("building", 0, "height"), True, "building[0].height", "text with unit"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_has_place_and_remedy(name: str, pair_dict: dict) -> None:
    keys, value, place, remedy = WRONG[name]
    table = pair_dict
    for key in keys[:-1]:
        table = table[key]
    table[keys[-1]] = value
    with pytest.raises(pounding.CaseError) as caught:
        pounding.Case.from_dict(pair_dict).check()
    text = str(caught.value)
    assert place in text and remedy in text, text
    assert isinstance(caught.value, ValueError)
    assert caught.value.faults


def test_errors_of_a_file_have_its_lines(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    text = PAIR.read_text().replace('"25 t"', '"25 kN"')
    path.write_text(text)
    line = next(i for i, row in enumerate(text.splitlines(), 1) if "25 kN" in row)
    with pytest.raises(pounding.CaseError, match=rf"case\.toml:{line}:\d+"):
        pounding.Case.from_file(path)


def test_all_errors_come_together(pair_dict: dict) -> None:
    pair_dict["building"][0]["mass"] = "25 kN"
    pair_dict["gap"][0]["model"] = "nobody_1900"
    with pytest.raises(pounding.CaseError) as caught:
        pounding.Case.from_dict(pair_dict)
    assert len(caught.value.faults) >= 2


def test_values_that_no_case_has(pair_dict: dict) -> None:
    pair_dict["building"][0]["mass"] = object()
    with pytest.raises(TypeError, match=r"building\[0\].mass: a object cannot stand in a case"):
        pounding.Case.from_dict(pair_dict)
    pair_dict["building"][0]["mass"] = {1.0, 2.0, 3.0}
    with pytest.raises(TypeError, match=r"building\[0\].mass: a set"):
        pounding.Case.from_dict(pair_dict)
    endless: dict = {}
    endless["building"] = endless
    with pytest.raises((ValueError, RecursionError)):
        pounding.Case.from_dict(endless)
    with pytest.raises(TypeError, match="no string"):
        pounding.Case.from_dict({1: 2})


def test_no_output_replaces_an_input(tmp_path: Path) -> None:
    path = tmp_path / "case.toml"
    path.write_text(PAIR.read_text().replace("../../ground_motions", str(RECORD.parent)))
    before = path.read_bytes()
    result = pounding.run(path)
    with pytest.raises(pounding.CaseError):
        result.to_hdf5(path)
    with pytest.raises(pounding.CaseError):
        result.report(path)
    assert path.read_bytes() == before
    with pytest.raises(pounding.OutputError):
        result.to_hdf5(tmp_path / "no" / "folder.h5")


def test_no_output_replaces_the_metadata_of_a_motion(tmp_path: Path, pair_dict: dict) -> None:
    count, rate = 500, 50.0
    obspy = pytest.importorskip("obspy")
    inventory = pytest.importorskip("obspy.core.inventory")
    header = {"network": "XX", "station": "ABC", "location": "00", "channel": "HNE", "sampling_rate": rate}
    counts = (1e5 * np.sin(0.1 * np.arange(count))).astype(np.int32)
    record, metadata = tmp_path / "a.mseed", tmp_path / "resp.xml"
    obspy.Trace(counts, header).write(str(record), "MSEED")
    response = inventory.Response.from_paz(
        zeros=[], poles=[], stage_gain=2e5, input_units="M/S**2", output_units="COUNTS"
    )
    channel = inventory.Channel("HNE", "00", 35.0, -117.0, 0.0, 0.0, 0.0, 0.0, sample_rate=rate, response=response)
    station = inventory.Station("ABC", 35.0, -117.0, 0.0, channels=[channel])
    stations = inventory.Inventory([inventory.Network("XX", [station])], source="test")
    stations.write(str(metadata), "STATIONXML")
    before = metadata.read_bytes()
    named = pounding.read_motion(record, response=metadata)
    beside = pounding.read_motion(record)
    own = pounding.Case.from_file(PAIR)
    of_dict = pounding.Case.from_dict(pair_dict)
    cases = [
        own.with_motion(named),
        own.with_motion(beside),
        own.with_motion(named.scaled_by(0.5)),
        own.with_motion(named.scaled_to_peak("0.3 g")),
        own.with_motion(pickle.loads(pickle.dumps(named))),
        pickle.loads(pickle.dumps(own.with_motion(named))),
        of_dict.with_motion(named),
        pounding.Case(
            pair_dict["building"], pair_dict["gap"], ground_motion=named, analysis=pair_dict["analysis"]
        ),
    ]
    for result in pounding.run_many(cases, histories=True):
        for write in (result.to_hdf5, result.report):
            with pytest.raises(pounding.CaseError, match="would take the place of .*station's metadata"):
                write(metadata)
            with pytest.raises(pounding.CaseError, match="would take the place of .*record"):
                write(record)
    assert metadata.read_bytes() == before


values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=12)
    | st.sampled_from(["25 t", "3 m", "20 mm", "light", "heavy", "wall", "jankowski_2005", "-1 s"]),
    lambda inner: st.lists(inner, max_size=4)
    | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=8,
)
places = st.sampled_from(
    [
        ("building", 0, "mass"),
        ("building", 0, "damping"),
        ("building", 1, "storeys"),
        ("building", 1, "height"),
        ("building", 0),
        ("gap", 0, "between"),
        ("gap", 0, "width"),
        ("gap", 0, "model"),
        ("gap", 0, "restitution"),
        ("gap", 0),
        ("ground_motion", "scale"),
        ("ground_motion",),
        ("analysis", "duration"),
        ("analysis", "output_step"),
        ("analysis",),
        ("title",),
        ("nonsense",),
    ]
)


@settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
@given(changes=st.lists(st.tuples(places, values), min_size=1, max_size=3))
def test_no_dict_ends_the_interpreter(changes: list, pair_dict: dict) -> None:
    tables = copy.deepcopy(pair_dict)
    for keys, value in changes:
        table = tables
        try:
            for key in keys[:-1]:
                table = table[key]
            table[keys[-1]] = value
        except (KeyError, IndexError, TypeError):
            continue
    try:
        pounding.Case.from_dict(tables)
    except (ValueError, TypeError, pounding.PoundingError) as error:
        assert str(error)


def test_the_steps_of_a_case_act_on_motions_in_memory(pair_dict: dict) -> None:
    pair_dict["ground_motion"] = {"file": str(RECORD), "process": [{"scale": 5}]}
    case = pounding.Case.from_dict(pair_dict)
    motion = pounding.read_motion(RECORD)
    under = case.with_motion(motion)
    of_file = pounding.run(case).peaks
    assert pounding.run(under).peaks.equals(of_file)
    for copied in (pickle.loads(pickle.dumps(under)), pickle.loads(pickle.dumps(case))):
        assert pounding.run(copied).peaks.equals(of_file)
    demands = [
        pounding.gap_check(case, records).answer["gaps"][0]["demand"]
        for records in ([RECORD], [motion])
    ]
    assert demands[0] == demands[1]


def test_two_codes_are_not_asked_for_at_once() -> None:
    with pytest.raises(pounding.CaseError, match="`code` and `country` are both given"):
        pounding.gap_check(PAIR, code="ntc_2018", country="Greece")


def test_errors_say_all_that_is_wrong(pair_dict: dict) -> None:
    pair_dict["ground_motion"] = {"file": str(RECORD)}
    pair_dict["analysis"] = {"energy_tolerance": 1e-18}
    with pytest.raises(pounding.PoundingError, match="energy") as told:
        pounding.run(pounding.Case.from_dict(pair_dict))
    assert "energy" in told.value.faults[0][0]


def test_paths_are_those_of_the_folder_in_which_a_case_was_made(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, pair_dict: dict
) -> None:
    motions = ROOT / "ground_motions"
    for folder, record in (("A", "el_centro_1940_ns.csv"), ("B", "kobe_1995_jma_ns.csv")):
        (tmp_path / folder).mkdir()
        shutil.copy(motions / record, tmp_path / folder / "record.csv")
    pair_dict["ground_motion"] = {"file": "record.csv"}
    monkeypatch.chdir(tmp_path / "A")
    case = pounding.Case.from_dict(pair_dict)
    with open("case.toml", "w") as file:
        file.write(case.source)
    of_file = pounding.Case.from_file("case.toml")
    text = pounding.Case.from_text(case.source)
    motion = pounding.Case.from_dict(pair_dict).with_motion(pounding.read_motion("record.csv"))
    before = pounding.run(case).summary
    monkeypatch.chdir(tmp_path / "B")
    for made in (case, of_file, text, motion):
        after = pounding.run(made)
        assert after.peaks.equals(pounding.run(case).peaks)
        with pytest.raises(pounding.CaseError):
            after.to_hdf5(tmp_path / "A" / "record.csv")
    with pytest.raises(pounding.CaseError):
        pounding.run(of_file).to_hdf5(tmp_path / "A" / "case.toml")
    assert pounding.run(case).summary == before


def test_a_record_of_a_dict_has_its_name(pair_dict: dict) -> None:
    case = pounding.Case.from_dict(pair_dict, folder=ROOT / "examples" / "three_storey_pair")
    kobe = ROOT / "ground_motions" / "kobe_1995_jma_ns.csv"
    assert list(pounding.gap_check(case, {"my kobe": kobe}).demand.index) == ["my kobe"]
    assert list(pounding.gap_check(case, [kobe]).demand.index) == ["kobe_1995_jma_ns"]


def test_what_can_be_read_once_stays(pair_dict: dict) -> None:
    heights = {"first": 3.0, "second": 3.0, "third": 3.0}
    pair_dict["building"][0].update(
        mass=map(float, ["25e3"] * 3),
        height=heights.values(),
        stiffness=(3.46e6 for _ in range(3)),
    )
    once = {**pair_dict, "building": iter(pair_dict["building"]), "gap": iter(pair_dict["gap"])}
    case = pounding.Case.from_dict(once)
    expected = pounding.run(case).impacts
    assert len(expected)
    for copied in (copy.deepcopy(case), pickle.loads(pickle.dumps(case))):
        assert copied.source == case.source
        assert pounding.run(copied).impacts.equals(expected)
    # A building is in as many cases as one likes.
    keys = dict(stiffness=3.46e6, height=3.0, damping={"stiffness_proportional": 0.05})
    light = pounding.Building("light", mass=map(float, ["25e3"] * 3), **keys)
    made = [pounding.Case([light], ground_motion=RECORD).check()["buildings"] for _ in range(2)]
    assert made[0] == made[1]


@pytest.mark.parametrize("text", [b"25 t", bytearray(b"25 t"), memoryview(b"25 t"), np.bytes_(b"25 t")])
def test_bytes_are_no_list_of_numbers(text: object, pair_dict: dict) -> None:
    pair_dict["building"][0].update(storeys=4, mass=text)
    with pytest.raises(pounding.CaseError, match=r"building\[0\].mass: a \w+ cannot stand") as told:
        pounding.Case.from_dict(pair_dict)
    assert isinstance(told.value, TypeError) and told.value.help


@pytest.mark.parametrize("title", [0, False, 1.5, [], np.array([1, 2]), b"", b"pair", pd.NA, {}])
def test_a_title_is_a_text(title: object) -> None:
    light = pounding.Building("light", storeys=1, mass=25e3, stiffness=3.46e6, height=3.0)
    with pytest.raises(pounding.CaseError, match="title") as told:
        pounding.Case(light, ground_motion=RECORD, title=title)
    assert told.value.help


@pytest.mark.parametrize("title", ["", None])
def test_a_case_needs_no_title(title: str | None) -> None:
    damping = {"stiffness_proportional": 0.05}
    light = pounding.Building("light", storeys=1, mass=25e3, stiffness=3.46e6, height=3.0, damping=damping)
    assert pounding.Case(light, ground_motion=RECORD, title=title).title == ""


@pytest.mark.parametrize("value", [10**30, pd.NA, "\ud800", decimal.Decimal("sNaN"), 1j])
def test_values_beyond_any_case_have_their_place(value: object, pair_dict: dict) -> None:
    pair_dict["building"][0]["mass"] = value
    with pytest.raises(pounding.CaseError, match=r"^building\[0\].mass: ") as told:
        pounding.Case.from_dict(pair_dict)
    assert told.value.help


def test_long_doubles_are_numbers(pair_dict: dict) -> None:
    def written(mass: object) -> str:
        pair_dict["building"][0]["mass"] = mass
        return pounding.Case.from_dict(pair_dict).source

    assert written(np.longdouble(25e3)) == written(25e3)
    of_storeys = [25e3, 26e3, 27e3]
    assert written(np.array(of_storeys, np.longdouble)) == written(of_storeys)


def test_ragged_lists_are_refused_as_all_else() -> None:
    for call in (
        lambda: pounding.Motion([[1], [1, 2]], 0.01),
        lambda: pounding.spectrum(pounding.Motion([0, 1.0], 0.01), [[1], [1, 2]]),
    ):
        with pytest.raises(pounding.CaseError, match="no list of numbers"):
            call()


def test_a_day_is_the_text_of_one(pair_dict: dict) -> None:
    pair_dict["separation"] = {"date": datetime.date(2018, 3, 22)}
    assert 'date = "2018-03-22"' in pounding.Case.from_dict(pair_dict).source
    check = pounding.gap_check(PAIR, code="ntc", date=datetime.date(2019, 1, 1))
    assert "ntc_2018" in json.dumps(check.answer["gaps"][0]["code"])


def test_a_case_says_which_motion_it_is_under(tmp_path: Path, pair_dict: dict) -> None:
    samples = np.sin(0.3 * np.arange(500))
    of_file = pounding.Case.from_file(PAIR)
    in_dict = pounding.Case.from_dict(pair_dict)
    read = pounding.read_motion(RECORD)
    hashes = set()
    for case in (of_file, in_dict, pair(RECORD)):
        for motion in (
            pounding.Motion(samples, 0.02, name="sine"),
            pounding.Motion(2.0 * samples, 0.02, name="sine"),
            pounding.Motion(samples, 0.01, name="sine"),
            read.scaled_by(2.0),
        ):
            under = case.with_motion(motion)
            path = tmp_path / "under.h5"
            pounding.run(under, isolated=False).to_hdf5(path)
            with h5py.File(path) as file:
                told = dict(file.attrs)
                record = file["ground"].attrs["record"]
            assert told["case"] == under.source != case.source
            assert repr(motion.name).strip("'") in under.source.splitlines()[-3]
            hashed = hashlib.sha256(np.array(motion.time_step, "<f8").tobytes())
            hashed.update(motion.acceleration.astype("<f8").tobytes())
            assert told["record_sha256"] == hashed.hexdigest() and hashed.hexdigest() in told["case"]
            hashes.add((told["case_sha256"], told["record_sha256"]))
            # What stands there is a case still, and so are its copies.
            tomllib.loads(told["case"])
            assert pickle.loads(pickle.dumps(under)).source == under.source
            if motion.origin is None:
                assert record.startswith("sine (array in memory)")
    assert len(hashes) == 12
    # A file as it is has its own.
    pounding.run(of_file.with_motion(read), isolated=False).to_hdf5(path)
    with h5py.File(path) as file:
        assert file.attrs["record_sha256"] == hashlib.sha256(RECORD.read_bytes()).hexdigest()
    made = pair(pounding.Motion(samples, 0.02, name="sine"))
    page = pounding.run(made).report()
    assert "sine (array in memory)" in page
    demand = pounding.gap_check(of_file.with_motion(pounding.Motion(samples, 0.02, name="sine"))).demand
    assert list(demand.index) == ["sine"]


def test_what_is_missing_has_no_place_of_another(pair_dict: dict) -> None:
    del pair_dict["ground_motion"]
    for tables in (pair_dict, {"title": "a pair", **pair_dict}, {}):
        with pytest.raises(pounding.CaseError) as told:
            pounding.Case.from_dict(tables)
        assert told.value.faults[0][0] == "the case: the case has no `ground_motion`", str(told.value)
        assert "<dict>" not in str(told.value) and "title = " not in str(told.value)


def test_what_is_no_motion_is_told(pair_dict: dict) -> None:
    array = np.sin(np.arange(10.0))
    for call in (
        lambda: pounding.Case.from_dict(pair_dict, motion=array),
        lambda: pounding.Case.from_file(PAIR).with_motion(array),
        lambda: pair(array),
    ):
        with pytest.raises(pounding.CaseError, match=r"a ndarray is given as a motion\n.*Motion\(array"):
            call()
    with pytest.raises(pounding.CaseError, match="a ndarray is given as a record"):
        pounding.gap_check(PAIR, [array])


def test_a_scale_is_given_once() -> None:
    light = pounding.Building(
        "light", storeys=1, mass=1e3, stiffness=1e5, height=3.0, damping={"stiffness_proportional": 0.05}
    )
    motion = pounding.GroundMotion(RECORD, scale=3)
    with pytest.raises(pounding.CaseError, match=r"^ground_motion.scale is 3, and `scale` is 2") as told:
        pounding.Case(light, ground_motion=motion, scale=2)
    assert told.value.help
    peaks = [
        pounding.Case(light, ground_motion=given, scale=scale).check()["ground_motion"]
        for given, scale in ((motion, None), (pounding.GroundMotion(RECORD), 3))
    ]
    assert peaks[0] == peaks[1]


def test_a_motion_takes_the_place_of_the_record(pair_dict: dict) -> None:
    motion = pounding.read_motion(RECORD)
    made = []
    for ground in (None, {}, {"file": "none.csv"}, {"scale": 1}, {"scale": None}):
        pair_dict["ground_motion"] = ground
        made.append(pounding.run(pounding.Case.from_dict(pair_dict, motion=motion), isolated=False).peaks)
    del pair_dict["ground_motion"]
    made.append(pounding.run(pounding.Case.from_dict(pair_dict, motion=motion), isolated=False).peaks)
    assert all(peaks.equals(made[0]) for peaks in made)
    for wrong in (5, "x", motion, [1.0]):
        pair_dict["ground_motion"] = wrong
        with pytest.raises(TypeError, match=r"^ground_motion: a \w+ stands beside a motion") as told:
            pounding.Case.from_dict(pair_dict, motion=motion)
        assert isinstance(told.value, pounding.CaseError) and told.value.help
    pair_dict["ground_motion"] = {"unit": "g", 5: 6}
    with pytest.raises(pounding.CaseError, match=r"^ground_motion.5: a motion in memory takes"):
        pounding.Case.from_dict(pair_dict, motion=motion)


def test_tables_and_texts_are_such(tmp_path: Path) -> None:
    for call in (
        lambda: pounding.Case.from_dict(None),
        lambda: pounding.Case.from_dict([("title", "a")]),
        lambda: pounding.Case.from_text(None),
        lambda: pounding.Case.from_text(b"title = 1"),
        lambda: pounding.Case.from_file(None),
        lambda: pounding.Case.from_text("", 5),
        lambda: pounding.Case.from_dict({}, folder=5),
        lambda: pounding.Case(5, ground_motion=RECORD),
        lambda: pounding.Case("light", ground_motion=RECORD),
        lambda: pounding.Case([], 5, ground_motion=RECORD),
        lambda: pounding.GroundMotion(5),
    ):
        with pytest.raises(TypeError) as told:
            call()
        assert isinstance(told.value, pounding.CaseError) and told.value.help
    for call in (
        lambda: pounding.Case.from_text("\ud800"),
        lambda: pounding.Case.from_file("\ud800"),
    ):
        with pytest.raises(pounding.CaseError, match="has characters that no") as told:
            call()


@pytest.mark.parametrize("kind", ["dict", "list", "twice", "deep"])
def test_no_table_contains_itself(kind: str, pair_dict: dict) -> None:
    inside: dict = {}
    inside["law"] = {"dict": inside, "list": [inside], "twice": [inside, inside]}.get(kind, {})
    if kind == "deep":
        for _ in range(2000):
            inside = {"law": inside}
    pair_dict["building"][0]["law"] = inside
    with pytest.raises(pounding.CaseError, match=r"^building\[0\].law.*: tables in tables without end") as told:
        pounding.Case.from_dict(pair_dict)
    assert told.value.help


def test_paths_are_of_bytes_too(pair_dict: dict) -> None:
    expected = pounding.Case.from_file(PAIR).check()
    assert pounding.Case.from_file(bytes(PAIR)).check() == expected
    assert pounding.run(bytes(PAIR), histories=False, isolated=False).summary["buildings"]
    assert pounding.read_motion(bytes(RECORD)).name == RECORD.stem
    motion = pounding.GroundMotion(bytes(RECORD))
    assert motion == pounding.GroundMotion(RECORD)
    assert list(pounding.gap_check(bytes(PAIR), [bytes(RECORD)]).demand.index) == [RECORD.stem]


def test_paths_are_values_of_files_alone(pair_dict: dict) -> None:
    pair_dict["ground_motion"] = {"file": RECORD}
    assert pounding.Case.from_dict(pair_dict).check()
    pair_dict["building"][0]["mass"] = Path("25 t")
    with pytest.raises(TypeError, match=r"^building\[0\].mass: a PosixPath cannot stand in a case"):
        pounding.Case.from_dict(pair_dict)


def test_a_time_is_the_day_that_it_is_on(pair_dict: dict) -> None:
    times = (
        datetime.datetime(2019, 1, 1, 12, 30),
        pd.Timestamp("2019-01-01 23:59"),
        np.datetime64("2019-01-01T12"),
    )
    expected = pounding.gap_check(PAIR, code="ntc", date="2019-01-01").answer
    for time in times:
        if not isinstance(time, np.datetime64):
            assert pounding.gap_check(PAIR, code="ntc", date=time).answer == expected
        pair_dict["separation"] = {"date": time}
        assert 'date = "2019-01-01"' in pounding.Case.from_dict(pair_dict).source
    with pytest.raises(pounding.CaseError, match="^date is NaT"):
        pounding.gap_check(PAIR, date=pd.NaT)
    pair_dict["separation"] = {"date": pd.NaT}
    with pytest.raises(pounding.CaseError, match="^separation.date: "):
        pounding.Case.from_dict(pair_dict)


def test_remedies_are_written_as_python_takes_them(tmp_path: Path, pair_dict: dict) -> None:
    pair_dict["gap"][0]["model"] = "nothing_like_it_2050"
    with pytest.raises(pounding.CaseError, match=r"`pounding.models\(\)` lists all"):
        pounding.Case.from_dict(pair_dict).check()
    pair_dict["building"][0]["storeys"] = 10**20
    with pytest.raises(pounding.CaseError, match=r"^building\[0\].storeys: an integer") as told:
        pounding.Case.from_dict(pair_dict)
    assert "float" not in told.value.help


def test_tables_with_columns_are_no_lists(pair_dict: dict) -> None:
    frame = pd.DataFrame([[25e3, 26e3, 27e3]], columns=[1, 2, 3])
    pair_dict["building"][0]["mass"] = frame
    with pytest.raises(pounding.CaseError, match="names of columns"):
        pounding.Case.from_dict(pair_dict)
    # A column of it, and its values, are lists.
    for values in (frame.iloc[0], frame.to_numpy()[0]):
        pair_dict["building"][0]["mass"] = values
        assert "25000" in pounding.Case.from_dict(pair_dict).source


def test_a_case_keeps_the_name_of_its_motion(pair_dict: dict) -> None:
    motion = pounding.Motion(np.sin(0.1 * np.arange(200)), 0.02, name="first")
    cases = [
        pounding.Case.from_file(PAIR).with_motion(motion),
        pounding.Case.from_dict(pair_dict, motion=motion),
        pounding.Case(pair_dict["building"], pair_dict["gap"], ground_motion=motion),
    ]
    said = [case.source for case in cases]
    assert all('"first"' in text for text in said)
    motion.name = "second"
    for made in (cases, pickle.loads(pickle.dumps(cases)), [copy.deepcopy(case) for case in cases]):
        assert [case.source for case in made] == said


def test_a_case_under_two_motions_travels(pair_dict: dict) -> None:
    first, second = (pounding.Motion([0.0, 1.0, 0.0], 0.1, name=name) for name in ("first", "second"))
    pair_dict["ground_motion"] = {"process": None, "scale": None}
    case = pounding.Case.from_dict(pair_dict, motion=first)
    for made in (case, case.with_motion(second)):
        copied = pickle.loads(pickle.dumps(made))
        assert copied.source == made.source
        assert pickle.loads(pickle.dumps(copied)).source == made.source
