"""The package beside others in one process, its types, its notebooks."""

from __future__ import annotations

import importlib.util
import itertools
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import EXAMPLES, PAIR, ROOT

OTHERS = ["h5py", "netCDF4", "xarray", "obspy"]
#: What is done with each: opened and closed where it has a file format of its own.
USE = """
import importlib, io, sys, tempfile, os
order, case = sys.argv[1].split(","), sys.argv[2]
for name in order:
    importlib.import_module(name)
import pounding, h5py, netCDF4
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "r.h5")
    result = pounding.run(case)
    result.to_hdf5(path)
    with h5py.File(path) as file:
        assert file["building/light/displacement"].shape == result.buildings["light"].displacement.shape
    with netCDF4.Dataset(path) as file:
        assert file["building"]["light"]["displacement"].units == "m"
    tree = result.to_xarray()
    assert float(abs(tree["building/light/displacement"]).max()) > 0
    again = pounding.run(case)
    assert again.summary == result.summary
print("fine")
"""


@pytest.mark.parametrize(
    "order",
    [["pounding", *OTHERS], [*OTHERS, "pounding"], *[[o, "pounding"] for o in OTHERS], *[["pounding", o] for o in OTHERS]],
    ids=lambda order: "-".join(order),
)
def test_other_libraries_live_in_the_same_process(order: list[str]) -> None:
    pytest.importorskip("netCDF4")
    pytest.importorskip("obspy")
    call = [sys.executable, "-c", USE, ",".join(order), str(PAIR)]
    ended = subprocess.run(call, capture_output=True, text=True, check=False)
    assert ended.returncode == 0 and ended.stdout == "fine\n", ended.stderr


def test_types_are_right() -> None:
    pytest.importorskip("mypy")
    folder = Path(__file__).parents[1]
    call = [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "python/pounding"]
    ended = subprocess.run(call, cwd=folder, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_the_stub_of_the_native_part_is_that_of_the_module(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    (tmp_path / "mypy.ini").write_text("[mypy]\nignore_missing_imports = True\n")
    call = [sys.executable, "-m", "mypy.stubtest", "pounding._native", "--mypy-config-file", "mypy.ini"]
    ended = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr


#: What users write, with what a checker says of it.
TYPED = """
import pounding
for result in pounding.run_many(["a.toml"]):
    result.peaks
for either in pounding.run_many("a.toml", errors="return"):
    either.peaks  # type: ignore[union-attr]
pounding.run_mny  # type: ignore[attr-defined]
pounding.plot.enrgy  # type: ignore[attr-defined]
pounding.plot.energy(pounding.run("a.toml"))
pounding.read_motion("a.csv", tiem_step=1.0)  # type: ignore[call-arg]
pounding.collide("hertz_1882", mass_left="25 t", velocity_left=1.0, stiffness="1 N/m^1.5")
"""


def test_types_are_those_of_what_users_write(tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    import pounding

    (tmp_path / "used.py").write_text(TYPED)
    (tmp_path / "pounding").symlink_to(Path(pounding.__file__).parent)
    call = [sys.executable, "-m", "mypy", "--strict", "--follow-imports", "silent", "used.py"]
    ended = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_everything_public_is_documented() -> None:
    import pounding

    undocumented = []
    for name in pounding.__all__:
        value = getattr(pounding, name)
        if not (value.__doc__ or "").strip():
            undocumented.append(name)
        for member, inside in vars(value).items() if isinstance(value, type) else ():
            public = not member.startswith("_") and (callable(inside) or isinstance(inside, property))
            if public and not (getattr(inside, "__doc__", None) or "").strip():
                undocumented.append(f"{name}.{member}")
    assert not undocumented


def notebooks() -> list[Path]:
    return sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))


def said_in(notebook: Any) -> str:
    """The texts of all outputs of a notebook."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return "\n".join(output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs)


@pytest.mark.parametrize("path", notebooks(), ids=lambda p: p.stem)
def test_notebooks_run(path: Path, tmp_path: Path) -> None:
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(path, as_version=4)
    stored = said_in(notebook)
    client = nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}
    )
    client.execute()
    said = itertools.chain.from_iterable(cell.get("outputs", []) for cell in notebook.cells)
    assert any(True for _ in said)
    if path.stem == "beside_opensees" and importlib.util.find_spec("openseespy") is None:
        return
    # What is stored is what is said now; numbers but for digits that machines may not share.
    number = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
    now = said_in(notebook)
    assert number.sub("#", now) == number.sub("#", stored)
    for a, b in zip(number.findall(now), number.findall(stored), strict=True):
        assert float(a) == pytest.approx(float(b), rel=1e-6), (a, b)


def test_pictures_are_drawn() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import pounding
    from pounding import plot

    result = pounding.run(PAIR)
    for draw in (plot.displacements, plot.opening, plot.forces, plot.energy):
        axes = draw(result)
        assert axes.get_xlabel() and axes.get_ylabel()
    motion = pounding.read_motion(ROOT / "ground_motions" / "el_centro_1940_ns.csv")
    # Storeys are counted from 1, as everywhere.
    light = result.buildings["light"].displacement
    drawn = plot.displacements(result, storey=1).lines[0].get_ydata()
    assert np.array_equal(drawn, 1e3 * light[:, 0])
    roofs = plot.displacements(result).lines[0].get_ydata()
    assert np.array_equal(roofs, 1e3 * light[:, -1])
    for storey in (0, 4):
        with pytest.raises(ValueError, match="none of 1 to 3"):
            plot.displacements(result, storey=storey)
    rigid = pounding.run(EXAMPLES / "rigid_impacts" / "case.toml")
    with pytest.raises(ValueError, match="have no force"):
        pounding.plot.forces(rigid)
    assert plot.spectra([motion, motion.scaled_by(0.5)]).get_legend() is not None
    assert plot.spectra(motion).lines[0].get_label() == motion.name
    with pytest.raises(pounding.CaseError, match="no motions are given"):
        plot.spectra([])
    with pytest.raises(ValueError, match="no gap"):
        plot.opening(result, "nowhere")
    record = ROOT / "ground_motions" / "el_centro_1940_ns.csv"
    for one in (record, str(record), [str(record)]):
        assert [line.get_label() for line in plot.spectra(one).lines] == [record.stem]
    for storey in ("1", 1.5, True):
        with pytest.raises(TypeError, match="^storey is .* no whole number") as told:
            plot.displacements(result, storey=storey)
        assert isinstance(told.value, pounding.CaseError)
    for call in (
        lambda: plot.displacements(result, storey=9),
        lambda: plot.forces(result, "nowhere"),
        lambda: plot.forces(rigid),
        *(lambda draw=draw: draw(None) for draw in (plot.displacements, plot.opening, plot.forces, plot.energy)),
        lambda: plot.spectra(5),
        lambda: plot.spectra([5]),
    ):
        before = matplotlib.pyplot.get_fignums()
        with pytest.raises(pounding.CaseError) as told:
            call()
        assert told.value.help and matplotlib.pyplot.get_fignums() == before


def test_the_page_of_the_reference_is_that_of_the_docstrings() -> None:
    sys.path.insert(0, str(ROOT / "crates" / "python"))
    try:
        import documentation
    finally:
        sys.path.pop(0)
    assert documentation.PAGE.read_text(encoding="utf-8") == documentation.page()
    for name in ("collide", "plot.spectra", "run_many", "Result.to_xarray", "CaseError"):
        assert f" {name}\n" in documentation.page(), name
