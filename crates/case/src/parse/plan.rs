//! Buildings that turn in plan.

use std::ops::Range;

use schemars::JsonSchema;
use serde::Deserialize;

use super::law::{LawTable, storey_laws};
use super::spread;
use crate::document::{
    Entry, Field, Length, OneOrEach, Optional, Positive, Reader, RotationalInertia, Signed,
    Stiffness,
};
use crate::located::Located;
use crate::types::{Frame, Plan};

/// Plan of a building with rigid floors that move along and across the row and turn
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "[building.plan]",
    expecting = "a table\nfor example { length = \"12 m\", width = \"10 m\", frames_along = [...], frames_across = [...] }"
)]
pub(super) struct PlanTable {
    /// Length of the floors along the row (m)
    length: Field<Positive<Length>>,
    /// Width of the floors across the row (m)
    width: Field<Positive<Length>>,
    /// Position of the mass centre across the row (m), from a line that all buildings share; by
    /// default 0
    mass_centre: Optional<Signed<Length>>,
    /// Rotational inertia of every floor about its mass centre (kg m2), one for all or a list;
    /// by default that of a rectangle
    rotational_inertia: Optional<OneOrEach<Positive<RotationalInertia>>>,
    /// Frames that resist motion along the row, `at` positions across it
    frames_along: Field<Vec<Field<FrameTable>>>,
    /// Frames that resist motion across the row, `at` positions along it
    frames_across: Field<Vec<Field<FrameTable>>>,
}

/// A frame or wall line
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "frame",
    expecting = "a table\nfor example { at = \"-5 m\", stiffness = [\"30 MN/m\", \"26 MN/m\"] }"
)]
struct FrameTable {
    /// Distance from the mass centre (m), across the row for frames along it, along the row for
    /// frames across it
    at: Field<Signed<Length>>,
    /// Stiffness of every storey (N/m), one for all or a list, bottom first
    stiffness: Field<OneOrEach<Positive<Stiffness>>>,
    /// Force-deformation law with memory in the place of that stiffness, one for all storeys
    /// or a list of laws that name theirs; `pounding hysteresis` lists them
    law: Optional<OneOrEach<Field<LawTable>, 0>>,
}

impl PlanTable {
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        place: Range<usize>,
        storeys: usize,
    ) -> Option<Located<Plan>> {
        let frames = |given: Field<Vec<Field<FrameTable>>>| -> Option<Vec<Frame>> {
            let given = given.located()?;
            if given.value.is_empty() {
                return reader.refuse(
                    given.span,
                    "there is no frame",
                    "give at least one frame in each direction, such as { at = 0, stiffness = \"30 MN/m\" }",
                );
            }
            let read = given.value.into_iter().map(|frame| {
                let frame = frame.value()?;
                let laws = frame.law.value();
                let laws =
                    laws.map_or_else(Vec::new, |laws| storey_laws(reader, laws, (storeys, false)));
                Some(Frame {
                    at: frame.at.number()?,
                    stiffness: spread(reader, frame.stiffness.located()?, storeys, "storey")?,
                    laws,
                })
            });
            read.collect()
        };
        let (along, across) = (frames(self.frames_along), frames(self.frames_across));
        let rotational_inertia = match self.rotational_inertia.stated()? {
            None => None,
            Some(given) => Some(spread(reader, given, storeys, "storey")?),
        };
        Some(Located {
            value: Plan {
                length: self.length.number()?,
                width: self.width.number()?,
                mass_centre: self.mass_centre.number_or(0.0)?,
                rotational_inertia,
                along: along?,
                across: across?,
            },
            span: place,
        })
    }
}
