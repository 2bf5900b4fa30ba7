"""A large result is read in parts: by xarray what is asked for, by DuckDB the columns and rows of a query.

    read_in_parts.py RESULT.h5 RESULT.parquet
"""

import sys

import duckdb
import numpy as np
import xarray as xr

result, table = sys.argv[1:]

data = xr.open_dataset(result, engine="h5netcdf")
force = data["peak_force"]
assert force.dtype == np.float32, force.dtype
# Nothing has been read yet, and of what is asked for only the rows.
assert not force.variable._in_memory
part = force.isel(run=slice(4000, 4010)).load()
assert part.sizes["run"] == 10 and not force.variable._in_memory
assert int(part["run"][0]) == 4000

connection = duckdb.connect()
groups = connection.sql(f"select count(distinct row_group_id) from parquet_metadata('{table}')").fetchall()[0][0]
assert groups == 2, groups
names = [row[0] for row in connection.sql(f"describe select * from '{table}'").fetchall()]
column = next(name for name in names if name.startswith("peak_force"))
rows = connection.sql(f'select run, "{column}" from \'{table}\' where run between 4000 and 4009 order by run').fetchall()
assert [row[0] for row in rows] == list(range(4000, 4010))
level = force.level.values[0]
expected = part.sel(level=level).values
found = np.array([row[1] for row in rows], dtype=np.float32)
assert np.array_equal(found, expected, equal_nan=True), (found, expected)
# The same over all rows, by the engine of each.
largest = connection.sql(f'select max("{column}") from \'{table}\' where not isnan("{column}")').fetchall()[0][0]
assert largest == float(force.sel(level=level).max())
print("read in parts")
