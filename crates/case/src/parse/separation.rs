//! What provisions for the gap need to know beside the buildings themselves.

use schemars::JsonSchema;
use serde::Deserialize;

use super::rule::{RuleTable, read_all};
use super::spread;
use crate::document::{
    Acceleration, Count, Dimensioned, Entry, Length, Number, OneOrEach, Optional, Positive, Reader,
    Tables, Time,
};
use crate::error::{CaseError, Errors};
use crate::located::Located;
use crate::types::Separation;

/// What provisions for the gap need to know
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "[separation]")]
pub(super) struct SeparationTable {
    /// R, q, Rd Ro, R* or Ra (-), one for all buildings or a list
    response_modification: PerBuilding,
    /// Cd (-), one for all buildings or a list
    displacement_amplification: PerBuilding,
    /// Importance factor (-), one for all buildings or a list
    importance: PerBuilding,
    /// alpha_y of the code of Taiwan (-), one for all buildings or a list
    yield_amplification: PerBuilding,
    /// Ductility (-) for effective period and damping, one for all buildings or a list
    ductility: PerBuilding,
    /// frame, frame_wall, wall, steel_frame or box_wall, one for all buildings or a list
    structural_system: Optional<Texts>,
    /// Whether all floors face floors; by default found from the elevations
    floors_aligned: Optional<bool>,
    /// Whether no property line lies in the gaps
    same_owner: Optional<bool>,
    /// Fortification intensity of the Chinese code, 6 to 9
    fortification_intensity: Optional<Count<6, 9>>,
    /// Zone of Mexico City: I, II or III
    soil_zone: Optional<String>,
    /// a_g S of Eurocode 8 and NTC, Z S g of E.030 of 2026 (m/s2)
    design_ground_acceleration: Optional<Positive<Acceleration>>,
    /// alpha_h of the Indian code (-)
    seismic_coefficient: Optional<Positive<Number>>,
    /// S_M1 of ASCE 7, for isolated buildings: spectral acceleration of the maximum considered
    /// earthquake at one second (m/s2)
    spectral_acceleration_1s: Optional<Positive<Acceleration>>,
    /// T_M of ASCE 7: effective period of the isolators at the maximum displacement (s), one
    /// for all buildings or a list
    isolation_period: PerBuilding<Time>,
    /// B_M of ASCE 7: what the damping of the isolators divides that displacement by (-), one
    /// for all buildings or a list
    isolation_damping_coefficient: PerBuilding,
    /// Longest dimension in plan (m), one for all buildings or a list
    plan_length: PerBuilding<Length>,
    /// Shortest dimension in plan (m), one for all buildings or a list
    plan_width: PerBuilding<Length>,
    /// Eccentricity of mass and isolators with the accidental one (m), one for all buildings or
    /// a list
    plan_eccentricity: PerBuilding<Length>,
    /// Whether the neighbour has left its own distance from the property line
    neighbour_has_gap: Optional<bool>,
    /// Code whose answer is the verdict, such as eurocode_8_2004, a family of editions such as ntc,
    /// or a rule of your own; by default the demand is
    code: Optional<String>,
    /// Country or city whose one code in force is the verdict, in the place of `code`
    country: Optional<String>,
    /// Day on which editions are in force, such as "2018-03-22", for a family or a country; by
    /// default today, which the answer names
    date: Optional<String>,
    /// Provisions to apply, by default all that apply
    provisions: Optional<Texts>,
    /// Rules of your own
    rule: Optional<Tables<RuleTable>>,
}

type PerBuilding<D = Number> = Optional<OneOrEach<Positive<D>>>;
type Texts = OneOrEach<Located<String>, 0>;

impl SeparationTable {
    /// For so many buildings.
    pub(super) fn read(self, reader: &Reader<'_>, buildings: usize) -> Separation {
        fn each<D: Dimensioned>(
            reader: &Reader<'_>,
            list: PerBuilding<D>,
            buildings: usize,
        ) -> Option<Vec<f64>> {
            spread(reader, list.located()?, buildings, "building")
        }
        let numbers = |list: PerBuilding| each(reader, list, buildings);
        let lengths = |list: PerBuilding<Length>| each(reader, list, buildings);
        let systems = self.structural_system.located();
        let country = self.country.located();
        if let (Some(country), Some(_)) = (&country, self.code.span()) {
            let help = "give one of them: a country stands for its one code in force";
            let message = "`country` and `code` are both given";
            reader.refuse::<()>(country.span.clone(), message, help);
        }
        let ductility_at = self.ductility.span();
        let ductility = numbers(self.ductility);
        let outside = |list: &Vec<f64>| list.iter().any(|d| !(1.0..=1.0e3).contains(d));
        if let (Some(span), true) = (ductility_at, ductility.as_ref().is_some_and(outside)) {
            let message = "`ductility` lies between 1, which is elastic, and 1000";
            reader.refuse::<()>(span, message, "correct the value, such as ductility = 4");
        }
        let fortification_intensity = self.fortification_intensity.value().map(|c| c.0);
        let provisions = self.provisions.value().map(|names| names.into_list());
        for (place, name) in provisions.iter().flatten().enumerate() {
            let before = provisions.iter().flatten().take(place);
            if before.into_iter().any(|other| other.value == name.value) {
                let message = format!("`provisions` names \"{}\" twice", name.value);
                reader.refuse::<()>(name.span.clone(), message, "remove one of them");
            }
        }
        let width_at = self.plan_width.span();
        let separation = Separation {
            response_modification: numbers(self.response_modification),
            displacement_amplification: numbers(self.displacement_amplification),
            importance: numbers(self.importance),
            yield_amplification: numbers(self.yield_amplification),
            ductility,
            structural_system: systems.and_then(|s| spread(reader, s, buildings, "building")),
            floors_aligned: self.floors_aligned.value(),
            same_owner: self.same_owner.value(),
            fortification_intensity,
            soil_zone: self.soil_zone.located(),
            design_ground_acceleration: self.design_ground_acceleration.number(),
            seismic_coefficient: self.seismic_coefficient.number(),
            spectral_acceleration_1s: self.spectral_acceleration_1s.number(),
            isolation_period: each(reader, self.isolation_period, buildings),
            isolation_damping_coefficient: numbers(self.isolation_damping_coefficient),
            plan_length: lengths(self.plan_length),
            plan_width: lengths(self.plan_width),
            plan_eccentricity: lengths(self.plan_eccentricity),
            neighbour_has_gap: self.neighbour_has_gap.value(),
            code: self.code.located(),
            country,
            date: self.date.located(),
            provisions,
            rules: self
                .rule
                .value()
                .map_or_else(Vec::new, |rules| read_all(reader, rules)),
        };
        if let (Some(span), Some((message, help))) = (width_at, separation.wide_plan()) {
            reader.refuse::<()>(span, message, help);
        }
        separation
    }
}

impl Separation {
    /// Reads the keys of `[separation]` from a text of their own, for so many buildings.
    ///
    /// # Errors
    /// The first thing wrong in it, with its place in the text.
    pub fn parse(text: &str, buildings: usize) -> Result<Self, CaseError> {
        let errors = Errors::default();
        let reader = Reader {
            file: "--set",
            source: text,
            errors: &errors,
        };
        let table = reader.read::<SeparationTable>(
            "write key=value as in the case file, texts in quotes, such as --set 'soil_zone=\"II\"'",
        );
        let read = table.map(|table| table.read(&reader, buildings));
        errors.finish(Ok(read.unwrap_or_default()))
    }
}
