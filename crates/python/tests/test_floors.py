"""Response spectra of floors, against those of their accelerations at fine rows."""

from __future__ import annotations

import numpy as np
import pytest
from conftest import PAIR, RECORD

import pounding


def test_roofs_have_the_spectra_of_their_accelerations() -> None:
    # From accelerations at rows of 0.05 ms by matrix exponentials (SciPy).
    found = pounding.floor_spectra(PAIR, periods=[0.05, 0.1, 0.3, 1.0])
    assert list(found["floor"].values) == ["light 3", "heavy 3"]
    assert found.attrs["impacts"] == 45 and found.attrs["damping_ratio"] == 0.05
    expected = [
        [81.90760296, 54.11656659, 17.16340002, 8.94671259],
        [9.33674363, 12.52369127, 32.01735168, 5.18668650],
    ]
    assert np.allclose(found["pounding"], expected, rtol=5e-5)
    assert found["pounding"].attrs["units"] == "m s-2"
    # The ground is that of the record.
    ground = pounding.read_motion(RECORD).spectrum([0.3, 1.0])["acceleration"]
    assert np.allclose(found["ground"].sel(floor="light 3", period=[0.3, 1.0]), ground, rtol=1e-9)


def test_floors_by_name_and_progress() -> None:
    told: list[tuple[int, int]] = []
    found = pounding.floor_spectra(
        PAIR,
        [("heavy", 1), ("light", 2)],
        damping="2 %",
        progress=lambda done, total: told.append((done, total)),
    )
    assert found["pounding"].shape == (2, 100)
    assert list(found["building"].values) == ["heavy", "light"]
    assert list(found["elevation"].values) == [3.0, 6.0]
    assert found.attrs["damping_ratio"] == 0.02
    peaks = found["peak_acceleration_pounding"]
    assert float(peaks.sel(floor="light 2")) > float(found["peak_acceleration_alone"].sel(floor="light 2"))


def test_over_records() -> None:
    motion = pounding.read_motion(RECORD)
    periods = [0.05, 0.3]
    found = pounding.floor_spectra(
        PAIR, [("light", 3)], periods, records={"as recorded": RECORD, "in memory": motion}, threads=2
    )
    assert found["pounding"].dims == ("record", "floor", "period")
    assert list(found["record"].values) == ["as recorded", "in memory"]
    assert found["peak_acceleration_alone"].dims == ("record", "floor")
    # The case stops at 31 s, where the record is as long.
    one = pounding.floor_spectra(PAIR, [("light", 3)], periods)
    for name in ("ground", "alone", "pounding"):
        assert np.allclose(found[name].mean("record"), one[name], rtol=1e-12)
    assert list(found["impacts"].values) == [45, 45]
    assert "are the same motion" in found.attrs["warnings"]
    with pytest.raises(pounding.PoundingError, match="no records are given"):
        pounding.floor_spectra(PAIR, records=[])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"floors": [("tall", 1)]}, "no building \"tall\""),
        ({"floors": [("light", 4)]}, "no storey \"4\""),
        ({"floors": ["light"]}, "is no floor"),
        ({"floors": [("light", 0)]}, "storey"),
        ({"periods": [0.0]}, "0.001 s at least"),
        ({"floors": []}, "no floors are given"),
        ({"periods": []}, "no periods are given"),
        ({"damping": 1.0}, "not between 0 and 1"),
        ({"threads": -1}, "threads is -1"),
        ({"threads": "abc"}, "threads is 'abc', which is no whole number"),
        ({"periods": bytearray(b"a")}, "periods is a bytearray, which is no list of numbers"),
    ],
)
def test_what_has_no_spectrum_is_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(pounding.PoundingError, match=message) as refused:
        pounding.floor_spectra(PAIR, **arguments)  # type: ignore[arg-type]
    assert refused.value.help


def test_spectra_tell_how_far_they_are_and_can_be_ended() -> None:
    periods = np.geomspace(0.05, 4.0, 200)
    told: list[tuple[int, int]] = []
    pounding.floor_spectra(
        PAIR, periods=periods, progress=lambda done, total: told.append((done, total))
    )
    assert told == sorted(told)
    assert told[-1][0] == told[-1][1]

    def end(done: int, total: int) -> None:
        if 2 * done > total:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pounding.floor_spectra(PAIR, periods=np.geomspace(0.05, 4.0, 2000), progress=end)
