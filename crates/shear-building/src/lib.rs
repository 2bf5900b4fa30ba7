//! Shear buildings: storeys, mass, stiffness, damping and modes
