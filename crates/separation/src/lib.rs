//! How wide a gap must be by code: provisions as a registry, and the rules
//! that combine the displacements of two buildings.
