//! Does the answer hang on the impact model?
