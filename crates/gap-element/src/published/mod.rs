//! What publications print, the collisions they print it of, and independent
//! reference values where nothing or only a figure is printed.

pub mod borovin_2014;
pub mod papi_toopchi_2022;
pub mod restitution;
pub mod zhou_2012;
