//! The case file: units, validation with source positions, JSON Schema
