//! The example that is worked for every provision.

use pounding_catalogue::STANDARD_GRAVITY;

use crate::descriptor::{Place, ProvisionDescriptor};
use crate::error::SeparationError;
use crate::inputs::{Site, Situation, SoilZone, StructuralSystem, Structure};
use crate::working::Requirement;

/// Two frames of 21 and 18 m with 7 and 6 storeys, at the roof of the lower one, whose peaks there
/// are 80 and 60 mm; every input of every provision is given.
#[must_use]
pub fn worked_example() -> Situation {
    let left = Structure {
        name: "left".to_owned(),
        height: 21.0,
        elevation: 18.0,
        storeys: 7,
        displacement: Some(0.08),
        response_modification: Some(8.0),
        displacement_amplification: Some(4.0),
        importance: Some(1.1),
        yield_amplification: Some(1.0),
        system: Some(StructuralSystem::Frame),
        isolation_period: Some(3.0),
        isolation_damping_coefficient: Some(1.5),
        plan_length: Some(40.0),
        plan_width: Some(20.0),
        plan_eccentricity: Some(2.0),
        ..Structure::default()
    };
    let right = Structure {
        name: "right".to_owned(),
        height: 18.0,
        storeys: 6,
        displacement: Some(0.06),
        response_modification: Some(5.0),
        displacement_amplification: Some(4.5),
        ..left.clone()
    };
    Situation {
        left,
        right,
        site: Site {
            floors_aligned: Some(false),
            same_owner: Some(true),
            fortification_intensity: Some(8),
            soil_zone: Some(SoilZone::Two),
            design_ground_acceleration: Some(0.25 * STANDARD_GRAVITY),
            seismic_coefficient: Some(0.12),
            spectral_acceleration_1s: Some(8.0),
            neighbour_has_gap: Some(false),
            relative_ground_displacement: 0.0,
        },
    }
}

impl ProvisionDescriptor {
    /// What it requires in the worked example: of a boundary rule the distance of the left
    /// building from the border.
    ///
    /// # Errors
    /// As [`Self::boundary`] and [`Self::between`]; none for a provision of the registry.
    pub fn of_worked_example(&self) -> Result<Requirement, SeparationError> {
        let Situation { left, site, .. } = &worked_example();
        match self.place() {
            Place::Boundary => self.boundary(left, site),
            Place::Between | Place::Seat => self.between(&worked_example()),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use crate::own::arithmetic;
    use crate::registry::descriptors;

    /// By hand, in mm: numbers alone, by the evaluator of users' expressions.
    #[test]
    fn every_provision_gives_what_its_worked_example_says() {
        for descriptor in descriptors() {
            let name = descriptor.name;
            let found = descriptor.of_worked_example().unwrap();
            let by_hand = |worked: &str| 1.0e-3 * arithmetic(worked).unwrap();
            let readings = descriptor.status.readings();
            if readings.is_empty() {
                let worked = by_hand(descriptor.worked);
                assert!(
                    (found.width - worked).abs() < 1.0e-12,
                    "{name}: {worked}, {}",
                    found.width
                );
            }
            for (reading, found) in readings.iter().zip(&found.readings) {
                let worked = by_hand(reading.worked);
                assert!(
                    (found.width - worked).abs() < 1.0e-12,
                    "{name}: {worked}, {}",
                    found.width
                );
            }
        }
    }
}
