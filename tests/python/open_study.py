"""Opens the result of a study as a user would: one dataset with its coordinates."""

import csv
import shutil
import subprocess
import sys

import h5py
import numpy as np
import xarray as xr

path, table = sys.argv[1:]

with xr.open_dataset(path, engine="h5netcdf") as ds:
    assert dict(ds.sizes) == {"run": 60, "storey": 6, "level": 3}, ds.sizes
    for name in ("gap", "model", "record", "mass"):
        assert name in ds.coords and ds[name].dims == ("run",), name
    assert ds.gap.attrs["units"] == "m" and ds.mass.attrs["units"] == "kg"
    assert set(ds.model.values) == {"jankowski_2005", "anagnostopoulos_2004"}
    assert set(ds.record.values) == {"el_centro_1940_ns", "kobe_1995_jma_ns"}
    assert sorted(set(ds.mass.values)) == [20e3, 25e3, 30e3]
    # A Latin hypercube: one gap in each sixtieth of the range.
    shares = np.floor((ds.gap.values - 0.005) / 0.055 * 60)
    assert sorted(shares) == list(range(60))
    roof = ds.peak_displacement.sel(storey="light 3")
    assert roof.dims == ("run",) and np.all(roof > 0) and roof.attrs["units"] == "m"
    assert list(ds.storey_building.values) == ["light"] * 3 + ["heavy"] * 3
    assert list(ds.level_left_storey.values) == [1, 2, 3]
    # Elevations and storeys come with what is selected; widths are a variable here.
    force = ds.peak_force.sel(level="light-heavy 3-3")
    assert float(force.level_left_elevation) == float(force.level_right_elevation) == 9.0
    assert int(force.level_right_storey) == 3 and np.isnan(force.level_width)
    assert list(ds.storey_elevation.values) == [3, 6, 9, 3, 6, 9]
    assert ds.storey_elevation.attrs["units"] == "m" and "storey_elevation" in roof.coords
    assert np.all(ds.status == 0)
    # The gap that just keeps the buildings apart decides whether they touch at all.
    touched = ds.impacts.sum("level") > 0
    assert np.array_equal(touched, (ds.isolated_demand.max("level") > ds.gap))
    # And the amplification by pounding is one where they do not.
    amplification = ds.peak_storey_shear / ds.isolated_peak_storey_shear
    assert amplification.dims == ("run", "storey") and ds.isolated_peak_storey_shear.attrs["units"] == "N"
    assert np.all(amplification.values[~touched.values] == 1) and float(amplification.max()) > 1
    assert len(set(ds.run_id.values)) == 60
    # Selection by coordinates, as in every xarray dataset.
    one = ds.where(ds.model == "jankowski_2005", drop=True)
    assert 25 <= one.sizes["run"] <= 35
    with open(table) as f:
        for row, run in zip(csv.DictReader(f), ds.run.values):
            assert int(row["run"]) == run
            assert float(row["peak_displacement: light 3 [m]"]) == float(roof[run])
            assert row["model"] == ds.model.values[run]

for engine in ("netcdf4", None):
    with xr.open_dataset(path, engine=engine) as other, xr.open_dataset(path, engine="h5netcdf") as ds:
        # Texts of fixed length are bytes to one engine and texts to the other.
        told = [np.char.decode(d.run_id.values) if d.run_id.dtype.kind == "S" else d.run_id.values for d in (other, ds)]
        assert np.array_equal(*told)
        xr.testing.assert_identical(other.drop_vars("run_id").load(), ds.drop_vars("run_id").load())
# Not all of it: ncdump 4.9 crashes on the texts of fixed length in run_id.
if shutil.which("ncdump"):
    told = subprocess.run(["ncdump", "-v", "model,peak_displacement", path], capture_output=True, text=True, check=True).stdout
    assert "jankowski_2005" in told and "peak_displacement" in told

with h5py.File(path) as f:
    assert f.attrs["program"] == "pounding" and len(f.attrs["study_sha256"]) == 64
    assert "[[variable]]" in f.attrs["study"] and "[[building]]" in f.attrs["case"]
    assert f["failures/run"].shape == (0,)

print("opened in h5py", h5py.__version__, "and xarray", xr.__version__)
