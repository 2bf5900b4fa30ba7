"""Opens a result of a building with a stiffness matrix: base moments have no storeys."""

import sys

import numpy as np
import xarray as xr

path = sys.argv[1]
for engine in ("h5netcdf", "netcdf4"):
    with xr.open_dataset(path, engine=engine, group="/building/wall") as ds:
        assert ds.base_moment.dims == ("time",) and ds.base_moment.attrs["units"] == "N m"
        sampled = np.abs(ds.base_moment.values).max()
        assert "time" in ds.base_moment.coords and len(ds.time) == ds.base_moment.size
    with xr.open_dataset(path, engine=engine, group="/building/wall/peak") as ds:
        assert ds.base_moment.dims == () and ds.base_moment.attrs["units"] == "N m"
        peak = float(ds.base_moment)
        assert 0.98 * peak < sampled <= peak * (1 + 1e-12)
        assert float(ds.isolated_base_moment) == peak and float(ds.base_moment_time) > 0
        assert ds.storey_shear.dims == ("storey",)
    with xr.open_dataset(path, engine=engine, group="/building/chain") as ds:
        assert "base_moment" not in ds
    with xr.open_datatree(path, engine=engine) as tree:
        assert float(tree["building/wall/peak/base_moment"]) > 0
print("opened base moments with xarray", xr.__version__)
