//! Records: formats, processing, measures, spectra, generators.

mod agency_files;
mod agency_measures;
mod agency_more;
mod column_headers;
mod common;
mod contradictory_headers;
mod contradictory_words;
mod design_spectra;
mod ensemble;
mod excitation;
mod formats;
mod generators;
mod hostile;
mod long_steps;
mod matching;
mod measures;
mod point_source;
mod processing;
mod pulses;
mod raw_records;
mod readers;
mod spectra;
mod stated_durations;
mod station_xml;
mod time_steps_and_scales;
mod writers;
