//! Structures given by their matrices: coordinates that are no floors, rows over several
//! coordinates, damping that couples modes, several ground motions. Each case is a converged
//! reference of two independent codes; its file in `data/structures` says which.

use std::sync::Arc;

use nalgebra::DMatrix;
use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_ground_motion::ReadOptions;
use pounding_shear_building::{
    Coordinate, Damping, Excitation, GeneralBuilding, ResponseKind, ResponseRow, ShearBuilding,
};
use pounding_time_history::{
    BuildingPoint, GroundAcceleration, GroundMotion, MethodChoice, Outcome, RunOptions, Support,
    System, run,
};
use serde::Deserialize;

use super::reference::Reference;
use crate::yielding::setup::el_centro;

#[derive(Deserialize)]
struct File {
    system: Matrices,
    duration: f64,
    reference: Reference,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Matrices {
    m: Vec<Vec<f64>>,
    c: Vec<Vec<f64>>,
    k: Vec<Vec<f64>>,
    #[serde(rename = "contacts")]
    contacts: Vec<ContactRow>,
    #[serde(rename = "outputs")]
    outputs: Vec<OutputRow>,
}

#[derive(Deserialize)]
struct ContactRow {
    w: Vec<f64>,
    k: f64,
    e: Option<f64>,
    gap: f64,
    meff: f64,
}

#[derive(Deserialize)]
struct OutputRow {
    name: String,
    kind: usize,
    s: Vec<f64>,
}

/// A building by the numbers of its coordinates in the matrices.
struct Parts {
    name: &'static str,
    floors: Vec<usize>,
    further: Vec<(usize, Excitation)>,
}

struct Case {
    file: File,
    parts: Vec<Parts>,
    motions: Vec<GroundMotion>,
    supports: Vec<Support>,
}

fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j])
}

impl Case {
    fn new(text: &str, parts: Vec<Parts>) -> Self {
        let motion = GroundMotion {
            acceleration: el_centro(),
            delay: 0.0,
            origin: Vec::new(),
        };
        let support = Support {
            along: 0,
            across: None,
        };
        Self {
            file: serde_json::from_str(text).unwrap(),
            supports: vec![support; parts.len()],
            parts,
            motions: vec![motion],
        }
    }

    /// The matrices and rows in other coordinates: the old ones are `change` times the new ones.
    fn in_other_coordinates(mut self, change: &DMatrix<f64>) -> Self {
        let system = &mut self.file.system;
        for m in [&mut system.m, &mut system.c, &mut system.k] {
            let new = change.transpose() * matrix(m) * change;
            let largest = new.amax();
            let clean = |x: f64| if x.abs() < 1e-13 * largest { 0.0 } else { x };
            *m = (new.row_iter())
                .map(|row| row.iter().map(|x| clean(*x)).collect())
                .collect();
        }
        let row = |w: &Vec<f64>| -> Vec<f64> {
            let old = nalgebra::RowDVector::from_row_slice(w);
            let new = old * change;
            new.iter()
                .map(|x| if x.abs() < 1e-13 { 0.0 } else { *x })
                .collect()
        };
        for contact in &mut system.contacts {
            contact.w = row(&contact.w);
        }
        for output in &mut system.outputs {
            output.s = row(&output.s);
        }
        self
    }

    fn system(&self) -> System {
        let s = &self.file.system;
        let buildings = self.parts.iter().map(|part| {
            let all: Vec<usize> = part.coordinates().collect();
            let of =
                |m: &[Vec<f64>]| DMatrix::from_fn(all.len(), all.len(), |i, j| m[all[i]][all[j]]);
            let floors = part.floors.len();
            let own = |row: &OutputRow| all.iter().any(|i| row.s[*i] != 0.0);
            let rows = s
                .outputs
                .iter()
                .filter(|row| own(row))
                .map(|row| ResponseRow {
                    name: row.name.clone(),
                    unit: "m",
                    kind: match row.kind {
                        0 => ResponseKind::Displacement,
                        _ => ResponseKind::Acceleration,
                    },
                    weights: all.iter().map(|i| row.s[*i]).collect(),
                });
            let general = GeneralBuilding {
                name: part.name.to_owned(),
                mass: part.floors.iter().map(|i| s.m[*i][*i]).collect(),
                height: vec![3.0; floors],
                further: (part.further.iter())
                    .map(|(i, excitation)| Coordinate {
                        name: format!("coordinate {i}"),
                        inertia: s.m[*i][*i],
                        excitation: *excitation,
                    })
                    .collect(),
                stiffness: of(&s.k),
                geometric: None,
                damping: Damping::Matrix { matrix: of(&s.c) },
                drifts: None,
                sections: vec![vec![0.0; all.len()]; floors + 1],
                responses: rows.collect(),
            };
            Arc::new(ShearBuilding::with_coordinates(general).unwrap())
        });
        let buildings = buildings.collect();
        let (motions, supports) = (self.motions.clone(), self.supports.clone());
        let mut system = System::with_motions(buildings, motions, supports).unwrap();
        let point = |system: &mut System, building: usize, sign: f64, w: &[f64]| {
            let weights = self.parts[building].coordinates().enumerate();
            system.add_point(BuildingPoint {
                building,
                storey: 0,
                elevation: 3.0,
                weights: weights
                    .map(|(k, i)| (k, sign * w[i]))
                    .filter(|(_, w)| *w != 0.0)
                    .collect(),
            })
        };
        let levels = s.contacts.iter().map(|c| {
            let model: Arc<dyn ImpactModel> = match c.e {
                Some(e) => {
                    let given = [("stiffness", c.k), ("restitution", e)];
                    let given = ModelParameters::from_pairs(&given);
                    registry::build("anagnostopoulos_2004", &given)
                }
                None => {
                    let given = ModelParameters::from_pairs(&[("stiffness", c.k)]);
                    registry::build("linear_elastic", &given)
                }
            }
            .unwrap()
            .into();
            let left = point(&mut system, 0, 1.0, &c.w);
            (left, point(&mut system, 1, -1.0, &c.w), c.gap, model)
        });
        let levels = levels.collect();
        let names = ["A".to_owned(), "B".to_owned()];
        system.add_gap("A-B", names, levels).unwrap();
        for (level, contact) in system.levels().iter().zip(&s.contacts) {
            let off = level.effective_mass / contact.meff - 1.0;
            assert!(off.abs() < 1e-12, "effective mass {off:e}");
        }
        system
    }

    fn run(&self, method: MethodChoice) -> Outcome {
        let options = RunOptions {
            method,
            duration: Some(self.file.duration),
            ..RunOptions::default()
        };
        run(&self.system(), &options, &mut [], &mut |_| {}).unwrap()
    }

    fn agrees_by_two_methods(&self, allowed: f64) {
        for method in [
            MethodChoice::EventDriven {
                relative_tolerance: 1e-11,
            },
            MethodChoice::Adaptive {
                relative_tolerance: 1e-11,
            },
        ] {
            self.file.reference.agrees(&self.run(method), allowed);
        }
    }
}

impl Parts {
    fn coordinates(&self) -> impl Iterator<Item = usize> {
        let further = self.further.iter().map(|(i, _)| *i);
        self.floors.iter().copied().chain(further)
    }

    fn floors(name: &'static str, floors: std::ops::Range<usize>) -> Self {
        Self {
            name,
            floors: floors.collect(),
            further: Vec::new(),
        }
    }
}

#[test]
fn a_column_with_contact_mass_is_hit_as_two_independent_codes_say() {
    let text = include_str!("../../data/structures/floor_to_column_mass.json");
    let mut hit = Parts::floors("B", 2..5);
    hit.further = vec![(5, Excitation::Along), (6, Excitation::Along)];
    let case = Case::new(text, vec![Parts::floors("A", 0..2), hit]);
    case.agrees_by_two_methods(1e-8);
}

#[test]
fn a_column_without_mass_is_hit_as_two_independent_codes_say() {
    let text = include_str!("../../data/structures/floor_to_column_massless.json");
    let parts = vec![Parts::floors("A", 0..2), Parts::floors("B", 2..5)];
    Case::new(text, parts).agrees_by_two_methods(1e-8);
}

#[test]
fn buildings_on_soil_collide_as_two_independent_codes_say() {
    let text = include_str!("../../data/structures/ssi_sway_rocking_pair.json");
    // From sway, rotation and floors relative to the rigid line to floors, sway, rotation.
    let mut change = DMatrix::zeros(10, 10);
    for first in [0, 5] {
        change[(first, first + 3)] = 1.0;
        change[(first + 1, first + 4)] = 1.0;
        for floor in 0..3 {
            let row = first + 2 + floor;
            change[(row, first + floor)] = 1.0;
            change[(row, first + 3)] = -1.0;
            change[(row, first + 4)] = -3.2 * (floor as f64 + 1.0);
        }
    }
    let part = |name, first: usize| Parts {
        further: vec![
            (first + 3, Excitation::Along),
            (first + 4, Excitation::None),
        ],
        ..Parts::floors(name, first..first + 3)
    };
    let case = Case::new(text, vec![part("A", 0), part("B", 5)]).in_other_coordinates(&change);
    case.agrees_by_two_methods(1e-8);
    // Dashpots of 311 1/s do not set the steps: 1,250 samples and 17 impacts, where steps of a
    // third of their time would be 22,000.
    let exact = case.run(MethodChoice::EventDriven {
        relative_tolerance: 1e-10,
    });
    let steps = exact.statistics.steps;
    assert!(steps < 1_900, "{steps} steps");
}

#[test]
fn a_wave_that_passes_under_two_buildings_is_as_two_independent_codes_say() {
    let text = include_str!("../../data/structures/wave_passage_pair.json");
    let parts = vec![Parts::floors("A", 0..3), Parts::floors("B", 3..6)];
    let mut case = Case::new(text, parts);
    let mut later = case.motions[0].clone();
    later.delay = 0.13;
    case.motions.push(later);
    case.supports[1].along = 1;
    case.agrees_by_two_methods(1e-8);
}

#[test]
fn buildings_that_turn_in_plan_collide_as_two_independent_codes_say() {
    let text = include_str!("../../data/structures/torsion_pair.json");
    let part = |name, first: usize| Parts {
        name,
        floors: vec![first, first + 3],
        further: vec![
            (first + 1, Excitation::Across),
            (first + 4, Excitation::Across),
            (first + 2, Excitation::None),
            (first + 5, Excitation::None),
        ],
    };
    let mut case = Case::new(text, vec![part("A", 0), part("B", 6)]);
    let file =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("data/structures/synthetic.csv");
    let record = pounding_ground_motion::read(&file, &ReadOptions::default()).unwrap();
    case.motions.push(GroundMotion {
        acceleration: GroundAcceleration {
            samples: Arc::new(record.samples().iter().map(|a| 0.7 * a).collect()),
            time_step: record.time_step(),
        },
        delay: 0.0,
        origin: Vec::new(),
    });
    for support in &mut case.supports {
        support.across = Some(1);
    }
    case.agrees_by_two_methods(1e-8);
}
