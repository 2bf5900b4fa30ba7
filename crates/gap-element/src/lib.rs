//! Impact models for the gaps between buildings: trait, models, registry, two-body collision
