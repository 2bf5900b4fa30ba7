//! Explicit Runge-Kutta steps of order 8(5,3) with dense output, on flat state vectors.
