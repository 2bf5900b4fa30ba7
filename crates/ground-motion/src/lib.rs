//! Accelerogram readers, one format a file, and scaling
