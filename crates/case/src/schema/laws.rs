//! Keys of laws with memory: of storeys, and of links.

use super::{Key, Kind, key, needed};

pub(crate) const STOREY_LAW: &[Key] = &[
    needed("model", Kind::Text, "Law of the storey"),
    key(
        "storeys",
        Kind::Storeys,
        "Storeys of this law, from 1 at the bottom; by default all",
    ),
    key(
        "*",
        Kind::Quantities,
        "Parameters of the law: yield_force (N), hardening_ratio, ..., one for all its storeys or a list; its stiffness is that of the storey",
    ),
];

pub(crate) const LINK: &[Key] = &[
    key(
        "name",
        Kind::Text,
        "Name of the link, by default left-right",
    ),
    needed(
        "between",
        Kind::Names,
        "Left and right neighbour; \"wall\" is a rigid wall that moves with the ground",
    ),
    needed("model", Kind::Text, "Law of the link"),
    key(
        "levels",
        Kind::Levels,
        "Pairs of storey numbers that are joined, or \"matching\" for the floors at equal elevation only",
    ),
    key(
        "elevation_tolerance",
        Kind::Quantity,
        "Floors this close in elevation are level (m), by default 0.01",
    ),
    key(
        "*",
        Kind::Quantities,
        "Parameters of the law, one for all levels or a list, bottom first",
    ),
];
