//! Which floors, and how they move.

use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::spectra::{FloorMotion, ResponseSpectrum, floor_spectrum};
use pounding_time_history::{History, HistorySink, System, TimeHistoryError};

use crate::failure::Failure;

/// A floor: building and storey, both from zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    pub building: usize,
    pub storey: usize,
}

/// The floors of these names, `BUILDING:STOREY`; without any the roof of every building.
pub fn places(system: &System, named: &[String]) -> Result<Vec<Place>, Failure> {
    let buildings = system.buildings();
    if named.is_empty() {
        let roofs = buildings.iter().enumerate().map(|(building, b)| Place {
            building,
            storey: b.storeys() - 1,
        });
        return Ok(roofs.collect());
    }
    let mut places = Vec::new();
    for name in named {
        let place = place(system, name)?;
        if places.contains(&place) {
            let message = format!("--floor: {name} stands twice");
            return Err(Failure::input(message, Some("give it once".to_owned())));
        }
        places.push(place);
    }
    Ok(places)
}

fn place(system: &System, name: &str) -> Result<Place, Failure> {
    let refused = |message: String, help: String| {
        Err(Failure::input(format!("--floor: {message}"), Some(help)))
    };
    let buildings = system.buildings();
    let Some((building, storey)) = name.rsplit_once(':') else {
        let help = format!("write it as {name}:1");
        return refused(format!("\"{name}\" names no storey"), help);
    };
    let Some(index) = buildings.iter().position(|b| b.name() == building) else {
        let names: Vec<&str> = buildings.iter().map(|b| b.name()).collect();
        let help = format!("its buildings are {}", names.join(", "));
        return refused(format!("the case has no building \"{building}\""), help);
    };
    let storeys = buildings[index].storeys();
    match storey.parse::<usize>() {
        Ok(number) if (1..=storeys).contains(&number) => Ok(Place {
            building: index,
            storey: number - 1,
        }),
        _ => refused(
            format!("{building} has no storey \"{storey}\""),
            format!("its storeys are 1, at the bottom, to {storeys}"),
        ),
    }
}

/// Motions of floors on the grid of a recorder, which keeps nothing else of a run.
#[derive(Debug)]
pub struct Motions<'s> {
    system: &'s System,
    places: &'s [Place],
    /// Of each floor.
    ground: Vec<Vec<f64>>,
    displacement: Vec<Vec<f64>>,
    velocity: Vec<Vec<f64>>,
}

impl<'s> Motions<'s> {
    /// None as yet.
    pub fn of(system: &'s System, places: &'s [Place]) -> Self {
        let none = || vec![Vec::new(); places.len()];
        Self {
            system,
            places,
            ground: none(),
            displacement: none(),
            velocity: none(),
        }
    }

    /// The spectrum of floor number so many, for rows of this time step (s).
    pub fn spectrum(
        &self,
        floor: usize,
        time_step: f64,
        (periods, damping): (&[f64], f64),
    ) -> Result<ResponseSpectrum, GroundMotionError> {
        let motion = FloorMotion {
            time_step,
            ground: &self.ground[floor],
            displacement: &self.displacement[floor],
            velocity: &self.velocity[floor],
        };
        floor_spectrum(&motion, periods, damping)
    }

    /// That of the ground under it.
    pub fn of_ground(
        &self,
        floor: usize,
        time_step: f64,
        (periods, damping): (&[f64], f64),
    ) -> Result<ResponseSpectrum, GroundMotionError> {
        let still = vec![0.0; self.ground[floor].len()];
        let motion = FloorMotion {
            time_step,
            ground: &self.ground[floor],
            displacement: &still,
            velocity: &still,
        };
        floor_spectrum(&motion, periods, damping)
    }
}

impl HistorySink for Motions<'_> {
    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError> {
        for (i, place) in self.places.iter().enumerate() {
            let column = self.system.offsets()[place.building] + place.storey;
            self.displacement[i].extend(rows.column(&rows.displacement, column));
            self.velocity[i].extend(rows.column(&rows.velocity, column));
            match self.system.motions_under(place.building)[0] {
                None => self.ground[i].extend(&rows.ground_acceleration),
                Some(own) => self.ground[i].extend(rows.time.iter().map(|t| own.at(*t))),
            }
        }
        Ok(())
    }
}
