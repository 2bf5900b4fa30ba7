//! Time integration of buildings in a row: event location, energy ledger, recorders, HDF5 result
