//! Foundations that sway and rock on the soil.

use std::ops::Range;

use pounding_shear_building::{Soil, SpringDashpot};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{
    Dashpot, Density, Dimensioned, Entry, Field, Length, Mass, NotNegative, Optional, Poisson,
    Positive, Reader, RotationalDashpot, RotationalInertia, RotationalStiffness, Stiffness,
    Velocity,
};
use crate::located::Located;
use crate::types::{Foundation, Support};

/// Foundation of the building, which sways and rocks on the soil
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "[building.foundation]",
    expecting = "a table\nfor example { mass = \"150 t\", rotational_inertia = \"5400 t m2\", soil = { ... } }"
)]
#[schemars(extend("oneOf" = [
    {"required": ["soil"]},
    {"anyOf": [{"required": ["sway"]}, {"required": ["rocking"]}]}
]))]
pub(super) struct FoundationTable {
    /// Mass of the foundation (kg), needed where it sways
    mass: Optional<Positive<Mass>>,
    /// Rotational inertia of foundation and floors about their own axes (kg m2), needed where
    /// it rocks
    rotational_inertia: Optional<Positive<RotationalInertia>>,
    /// The soil, from which springs and dashpots follow
    soil: Optional<SoilTable>,
    /// Spring and dashpot of the displacement; left out: rigid
    sway: Optional<SwayTable>,
    /// Spring and dashpot of the rotation; left out: rigid
    rocking: Optional<RockingTable>,
    /// Length of the foundation along the motion (m), beside springs, for the check against
    /// overturning
    length: Optional<Positive<Length>>,
}

/// Soil below a rectangular foundation
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "soil",
    expecting = "a table\nfor example { shear_wave_speed = \"180 m/s\", density = \"1.8 t/m3\", poisson = 0.33, length = \"12 m\", width = \"12 m\" }"
)]
struct SoilTable {
    /// Shear wave speed (m/s) at the strain that is expected
    shear_wave_speed: Field<Positive<Velocity>>,
    /// Density (kg/m3)
    density: Field<Positive<Density>>,
    /// Poisson's ratio (-)
    poisson: Field<Poisson>,
    /// Length of the foundation along the motion (m)
    length: Field<Positive<Length>>,
    /// Width of the foundation across the motion (m)
    width: Field<Positive<Length>>,
}

/// Spring and dashpot below a foundation
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "sway",
    expecting = "a table\nfor example { stiffness = \"1.9 GN/m\", dashpot = \"47 MN s/m\" }"
)]
struct SwayTable {
    /// Stiffness (N/m)
    stiffness: Field<Positive<Stiffness>>,
    /// Dashpot coefficient (N s/m); by default none
    dashpot: Optional<NotNegative<Dashpot>>,
}

/// Spring and dashpot of the rotation of a foundation
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "rocking",
    expecting = "a table\nfor example { stiffness = \"75 GN m/rad\", dashpot = \"1.1 GN m s/rad\" }"
)]
struct RockingTable {
    /// Stiffness (N m/rad)
    stiffness: Field<Positive<RotationalStiffness>>,
    /// Dashpot coefficient (N m s/rad); by default none
    dashpot: Optional<NotNegative<RotationalDashpot>>,
}

impl FoundationTable {
    /// A foundation in the place of one that is wrong, of which nothing else is said.
    pub(super) fn stand_in(span: Range<usize>) -> Located<Foundation> {
        let stiff = Some(SpringDashpot {
            stiffness: 1.0e12,
            dashpot: 0.0,
        });
        let value = Foundation {
            mass: 1.0,
            rotational_inertia: 1.0,
            support: Support::Springs {
                sway: stiff,
                rocking: stiff,
            },
            length: None,
        };
        Located { value, span }
    }

    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        place: Range<usize>,
    ) -> Option<Located<Foundation>> {
        let all = [
            self.mass.is_wrong(),
            self.rotational_inertia.is_wrong(),
            self.soil.is_wrong(),
            self.sway.is_wrong(),
            self.rocking.is_wrong(),
            self.length.is_wrong(),
        ];
        let lost = all.contains(&true);
        let springs = [
            self.sway.as_ref().map(|_| "sway"),
            self.rocking.as_ref().map(|_| "rocking"),
        ];
        let spring = springs.into_iter().flatten().next();
        let support = match (self.soil, spring) {
            (Some(soil), Some(spring)) => {
                let span = soil.span().unwrap_or(place);
                return reader.refuse(
                    span,
                    format!("a foundation has either `soil` or `{spring}`, not both"),
                    "leave one of them out: springs and dashpots follow from the soil",
                );
            }
            (Some(soil), None) => {
                if let (Some(span), true) = (self.length.span(), soil.span().is_some()) {
                    return reader.refuse(
                        span,
                        "`length` stands in `soil`, where there is one",
                        "remove it here",
                    );
                }
                soil.value().map(SoilTable::read)
            }
            (None, None) => {
                return reader.refuse(
                    place,
                    "the foundation has neither `soil` nor `sway` nor `rocking`: it is a fixed base",
                    "add `soil = { ... }`, or a spring and dashpot of sway, rocking or both",
                );
            }
            (None, Some(_)) => {
                let sway = self
                    .sway
                    .map(|table| table.value().and_then(SwayTable::read));
                let rocking = self
                    .rocking
                    .map(|table| table.value().and_then(RockingTable::read));
                Some(springs_of(sway, rocking))
            }
        };
        let support = support??;
        for (missing, moves, key, example) in [
            (
                self.mass.is_none(),
                support.sways(),
                "mass",
                "mass = \"150 t\"",
            ),
            (
                self.rotational_inertia.is_none(),
                support.rocks(),
                "rotational_inertia",
                "rotational_inertia = \"5400 t m2\"",
            ),
        ] {
            if missing && moves {
                let does = if key == "mass" { "sways" } else { "rocks" };
                return reader.refuse(
                    place,
                    format!("a foundation that {does} needs `{key}`"),
                    format!("add `{example}`{}", match does {
                        "rocks" => ", that of foundation and floors about their own axes: of a slab m (length^2 + thickness^2) / 12",
                        _ => "",
                    }),
                );
            }
        }
        if lost {
            return None;
        }
        let unused = [
            (
                self.rotational_inertia.span().filter(|_| !support.rocks()),
                "`rotational_inertia` has no meaning beside `sway` alone: the foundation does not rock",
                "remove it, or add `rocking = { ... }`",
            ),
            // With a length, the mass is part of the weight that holds the foundation down.
            (
                self.mass
                    .span()
                    .filter(|_| !support.sways() && self.length.is_none()),
                "`mass` has no meaning beside `rocking` alone without `length`: the foundation does not move",
                "remove it, or add `sway = { ... }`, or `length`",
            ),
        ];
        for (span, message, help) in unused {
            if let Some(span) = span {
                return reader.refuse(span, message, help);
            }
        }
        let length = match &support {
            Support::Soil(soil) => Some(soil.length),
            Support::Springs { .. } => self.length.number(),
        };
        let value = Foundation {
            mass: self.mass.number().unwrap_or_default(),
            rotational_inertia: self.rotational_inertia.number().unwrap_or_default(),
            support,
            length,
        };
        Some(Located { value, span: place })
    }
}

/// Springs that are given, unless one of them is wrong.
fn springs_of(
    sway: Option<Option<SpringDashpot>>,
    rocking: Option<Option<SpringDashpot>>,
) -> Option<Support> {
    let given = |spring: Option<Option<SpringDashpot>>| match spring {
        Some(None) => None,
        Some(spring) => Some(spring),
        None => Some(None),
    };
    Some(Support::Springs {
        sway: given(sway)?,
        rocking: given(rocking)?,
    })
}

impl SoilTable {
    fn read(self) -> Option<Support> {
        Some(Support::Soil(Soil {
            shear_wave_speed: self.shear_wave_speed.number()?,
            density: self.density.number()?,
            poisson: self.poisson.number()?,
            length: self.length.number()?,
            width: self.width.number()?,
        }))
    }
}

fn spring<S: Dimensioned, C: Dimensioned>(
    stiffness: Field<Positive<S>>,
    dashpot: Optional<NotNegative<C>>,
) -> Option<SpringDashpot> {
    Some(SpringDashpot {
        stiffness: stiffness.number()?,
        dashpot: dashpot.number_or(0.0)?,
    })
}

impl SwayTable {
    fn read(self) -> Option<SpringDashpot> {
        spring(self.stiffness, self.dashpot)
    }
}

impl RockingTable {
    fn read(self) -> Option<SpringDashpot> {
        spring(self.stiffness, self.dashpot)
    }
}
