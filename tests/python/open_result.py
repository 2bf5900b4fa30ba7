"""Opens a result file as a user would: h5py, then xarray with named dimensions."""

import shutil
import subprocess
import sys

import h5py
import netCDF4
import numpy as np
import xarray as xr

path = sys.argv[1]

with h5py.File(path) as f:
    assert f.attrs["program"] == "pounding" and f.attrs["status"] == "complete"
    assert "[[building]]" in f.attrs["case"] and len(f.attrs["record_sha256"]) == 64
    time = f["time"]
    assert time.attrs["units"] == "s"
    light = f["building/light"]
    u = light["displacement"]
    assert u.attrs["units"] == "m" and u.attrs["long_name"]
    assert u.shape == (len(time), 3)
    u_values = u[:]
    assert u.dims[0][0] == time and u.dims[1][0] == light["storey"]
    for group in ("ground", "building/heavy", "gap/light-heavy", "energy"):
        assert f[group]["time"] == time, group
    # Peaks come from inside the steps: never below the output grid's.
    grid = np.abs(u[:]).max(axis=0)
    peak = light["peak/displacement"][:]
    assert np.all(peak >= grid * (1 - 1e-12)) and np.all(peak <= grid * 1.01)
    assert abs(peak[2] - 0.10528) < 2e-5
    impacts = f["gap/light-heavy/impacts"][:]
    assert len(impacts) == 45
    assert np.all(impacts["t_open"] > impacts["t_close"])
    assert abs(impacts["peak_force"].max() - 1.2711e6) < 1e3
    energy = f["energy"]
    total = sum(energy[k][-1] for k in ("kinetic", "strain", "viscous", "impact"))
    assert abs(total - energy["input"][-1]) < 1e-8 * energy["input"][:].max()
    assert abs(impacts["energy_dissipated"].sum() - energy["impact"][-1]) < 1e-6 * energy["impact"][-1]

for engine in ("h5netcdf", "netcdf4"):
    # Every group by itself has the coordinates of its dimensions.
    with xr.open_dataset(path, engine=engine, group="/building/light") as ds:
        assert ds.displacement.dims == ("time", "storey"), ds.displacement.dims
        assert {"time", "storey"} <= set(ds.coords), ds.coords
        # The decimal elevations, not the plain sums of the heights.
        assert list(ds.storey.values) == [3.3, 6.6, 9.9]
        roof = ds.displacement.sel(storey=9.9)
        assert roof.dims == ("time",) and roof.attrs["units"] == "m"
        assert ds.storey.attrs["units"] == "m" and ds.time.attrs["units"] == "s"
        at = roof.sel(time=2.5, method="nearest")
        assert float(at) == float(ds.displacement[250, 2])
    with xr.open_dataset(path, engine=engine, group="/building/light/peak") as ds:
        assert ds.displacement.sel(storey=9.9) > 0
    with xr.open_dataset(path, engine=engine, group="/gap/light-heavy") as ds:
        assert ds.force.dims == ("time", "level") and "time" in ds.coords
        for name in ("left_storey", "right_storey", "left_elevation", "right_elevation", "width"):
            assert name in ds.coords and ds[name].attrs["long_name"], name
        top = ds.force.sel(level="3-3")
        assert (int(top.left_storey), float(top.right_elevation)) == (3, 9.9)
        assert ds.left_elevation.attrs["units"] == "m" and float(top.width) == 0.02
    for group in ("/ground", "/energy"):
        with xr.open_dataset(path, engine=engine, group=group) as ds:
            assert "time" in ds.coords, group
    with xr.open_dataset(path, engine=engine) as root:
        assert root.time.dims == ("time",) and root.time.attrs["units"] == "s"
        assert abs(float(root.time[1]) - 0.01) < 1e-12
    with xr.open_datatree(path, engine=engine) as tree:
        for name in ("building/light", "gap/light-heavy", "energy", "ground"):
            assert tree[name].time.equals(tree["/"].time), name
        assert tree["building/light/displacement"].sel(storey=9.9).sizes == {"time": 3101}

# What follows the content is in nobody's way: the engines, the choice of one, ncdump.
for engine in ("h5netcdf", "netcdf4", None):
    tree = xr.open_datatree(path, engine=engine)
    assert "time" in tree["building/light"].coords or "time" in tree["/"].coords
    np.testing.assert_array_equal(tree["building/light"].displacement.values, u_values)
with netCDF4.Dataset(path) as data:
    np.testing.assert_array_equal(data["building/light/displacement"][:], u_values)
    # Every dataset that has chunks carries Fletcher-32 checksums.
    assert data["building/light/displacement"].filters()["fletcher32"]
with h5py.File(path) as f:
    def checked(name, item):
        # HDF5 has no checksums for texts of variable length.
        if isinstance(item, h5py.Dataset) and item.size > 0 and item.dtype.kind != "O":
            assert item.fletcher32, name
    f.visititems(checked)
    assert f.attrs["checksum"].startswith("pounding-sha256:1") and f.attrs["build"]
for program in ("ncdump", "h5dump"):
    if shutil.which(program):
        header = {"ncdump": "-h", "h5dump": "-H"}[program]
        told = subprocess.run([program, header, path], capture_output=True, text=True, check=True).stdout
        assert "displacement" in told
print("opened in h5py", h5py.__version__, "and xarray", xr.__version__)
