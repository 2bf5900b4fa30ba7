//! `pounding check`: what was understood.

use std::path::Path;

use pounding_assembly::{
    Assembly, UsedParameters, parameters_of_frames, parameters_of_gap, parameters_of_link,
    parameters_of_storeys,
};
use pounding_case::{Case, CaseError};
use pounding_catalogue::wording::counted;
use pounding_shear_building::{OnFoundation, ShearBuilding, SpringDashpot, YieldingFrame};
use pounding_time_history::LevelPlace;
use serde::Serialize;

use crate::failure::Failure;
use crate::faults::{assembled, read_case, responses_fit};
use crate::output::{pretty, print};
use crate::progress::Progress;
use crate::tables;

/// Validates a case, reads its record, and prints both in SI units.
pub fn check(path: &Path, as_json: bool) -> Result<(), Failure> {
    let case = read_case(path, true)?;
    let storeys: usize = case.buildings.iter().map(|b| b.mass.len()).sum();
    let progress = Progress::working(format!(
        "computing the modes of {}",
        counted(storeys, "storey")
    ))?;
    let assembly = assembled(&case)?;
    responses_fit(&assembly, &case)?;
    if !as_json {
        let text = tables::understood(&case, &assembly);
        drop(progress);
        return print(&text.map_err(|e| Failure::of_case(e, &case))?);
    }
    let understood = Understood::of(&case, &assembly);
    drop(progress);
    print(&pretty(
        &understood.map_err(|e| Failure::of_case(e, &case))?,
    )?)
}

/// What `check --json` prints.
#[derive(Serialize)]
pub struct Understood<'a> {
    buildings: Vec<Building<'a>>,
    gaps: Vec<Gap<'a>>,
    links: Vec<Link<'a>>,
    ground_motion: Motion,
    warnings: Vec<String>,
    analysis: Analysis,
}

/// A building with its modes.
#[derive(Serialize)]
struct Building<'a> {
    name: &'a str,
    mass: &'a [f64],
    stiffness: &'a [f64],
    /// The foundation, if it sways or rocks.
    #[serde(skip_serializing_if = "Option::is_none")]
    foundation: Option<Foundation>,
    /// Rows, without what gravity takes off; of a building that is no chain of storeys.
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness_matrix: Option<Vec<Vec<f64>>>,
    height: &'a [f64],
    elevation: &'a [f64],
    period: &'a [f64],
    geometric_stiffness: &'a [f64],
    laws: Vec<Option<&'static str>>,
    /// Parameters of the laws.
    law_parameters: Vec<Option<UsedParameters>>,
    /// Frames with laws, of a building that turns in plan.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    frames: Vec<Frame>,
    #[serde(skip_serializing_if = "Option::is_none")]
    isolator: Option<Isolator>,
    damping_ratio: &'a [f64],
    effective_mass: &'a [f64],
}

/// A frame with a law in a storey.
#[derive(Serialize)]
struct Frame {
    direction: &'static str,
    /// Distance from the mass centre (m).
    at: f64,
    /// From 1.
    storey: usize,
    law: &'static str,
    /// Deformation at first yield (m).
    yield_deformation: Option<f64>,
    parameters: UsedParameters,
}

impl Frame {
    fn of((frame, (_, parameters)): (&YieldingFrame, (usize, UsedParameters))) -> Self {
        Self {
            direction: frame.direction.name(),
            at: frame.at,
            storey: frame.storey + 1,
            law: frame.law.law.descriptor().name,
            yield_deformation: frame.law.yield_drift,
            parameters,
        }
    }
}

/// The isolators under a building.
#[derive(Serialize)]
struct Isolator {
    model: &'static str,
    weight: f64,
    initial_stiffness: f64,
    post_yield_stiffness: f64,
    post_yield_period: f64,
    strength: f64,
    yield_displacement: f64,
    damping: f64,
}

impl Isolator {
    fn of(building: &ShearBuilding) -> Option<Self> {
        let (isolator, properties) = building.isolator()?;
        Some(Self {
            model: isolator.name(),
            weight: properties.weight,
            initial_stiffness: properties.initial_stiffness,
            post_yield_stiffness: properties.post_yield_stiffness,
            post_yield_period: properties.post_yield_period(),
            strength: properties.strength,
            yield_displacement: properties.yield_displacement,
            damping: isolator.dashpot,
        })
    }
}

/// A foundation with the first mode of building and soil.
#[derive(Serialize)]
struct Foundation {
    mass: f64,
    rotational_inertia: f64,
    sway: Option<Spring>,
    rocking: Option<Spring>,
    length: Option<f64>,
    moment_of_uplift: Option<f64>,
    overturning_moment: Option<f64>,
    period: Option<f64>,
    damping_ratio: Option<f64>,
    period_lengthening: Option<f64>,
    fixed_base_period: f64,
    fixed_base_damping_ratio: f64,
}

/// Spring and dashpot of a motion.
#[derive(Serialize)]
struct Spring {
    stiffness: f64,
    dashpot: f64,
}

impl Foundation {
    fn of(on: &OnFoundation) -> Self {
        let spring = |held: SpringDashpot| Spring {
            stiffness: held.stiffness,
            dashpot: held.dashpot,
        };
        let (foundation, fixed) = (on.foundation(), on.fixed_base().modes());
        let mode = on.first_mode();
        Self {
            mass: foundation.mass(),
            rotational_inertia: foundation.rotational_inertia(),
            sway: foundation.sway().map(spring),
            rocking: foundation.rocking().map(spring),
            length: on.length(),
            moment_of_uplift: on.moment_of_uplift(),
            overturning_moment: on.overturning_moment(),
            period: mode.map(|m| m.period),
            damping_ratio: mode.map(|m| m.damping_ratio),
            period_lengthening: on.period_lengthening(),
            fixed_base_period: fixed.period[0],
            fixed_base_damping_ratio: fixed.damping_ratio[0],
        }
    }
}

/// A gap with its contact levels.
#[derive(Serialize)]
struct Gap<'a> {
    name: &'a str,
    between: &'a [String; 2],
    levels: Vec<ContactLevel<'a>>,
}

/// A contact level.
#[derive(Serialize)]
struct ContactLevel<'a> {
    width: f64,
    effective_mass: f64,
    model: &'static str,
    parameters: UsedParameters,
    #[serde(flatten)]
    place: &'a LevelPlace,
}

/// A link with its levels and laws.
#[derive(Serialize)]
struct Link<'a> {
    name: &'a str,
    between: &'a [String; 2],
    levels: Vec<LevelPlace>,
    laws: Vec<&'static str>,
    /// Parameters of the law of each level.
    parameters: Vec<UsedParameters>,
}

/// The record as it is used.
#[derive(Serialize)]
struct Motion {
    samples: usize,
    time_step: f64,
    peak: f64,
    scale: f64,
    echo: Vec<String>,
}

/// Times of the analysis.
#[derive(Serialize)]
struct Analysis {
    output_step: f64,
    duration: f64,
}

impl<'a> Understood<'a> {
    /// What was understood of a case.
    ///
    /// # Errors
    /// As of a case that cannot be assembled.
    pub fn of(case: &Case, assembly: &'a Assembly) -> Result<Self, CaseError> {
        let system = &assembly.system;
        let of_floors = |b: &'a ShearBuilding| b.foundation().map_or(b, OnFoundation::fixed_base);
        let buildings = system.buildings().iter().zip(&case.buildings);
        let buildings = buildings.map(|(b, given)| -> Result<_, CaseError> {
            Ok(Building {
                name: b.name(),
                mass: b.mass(),
                stiffness: of_floors(b).stiffness(),
                foundation: b.foundation().map(Foundation::of),
                stiffness_matrix: of_floors(b).elastic_stiffness_matrix(),
                height: b.height(),
                elevation: b.elevations(),
                period: &b.modes().period,
                geometric_stiffness: b.geometric_stiffness(),
                laws: b
                    .laws()
                    .iter()
                    .map(|l| l.as_ref().map(|l| l.law.descriptor().name))
                    .collect(),
                law_parameters: {
                    let mut of_storeys = vec![None; b.laws().len()];
                    for (storey, parameters) in parameters_of_storeys(case, given)? {
                        of_storeys[storey] = Some(parameters);
                    }
                    of_storeys
                },
                frames: {
                    let parameters = parameters_of_frames(case, given)?;
                    b.yielding_frames()
                        .iter()
                        .zip(parameters)
                        .map(Frame::of)
                        .collect()
                },
                isolator: Isolator::of(b),
                damping_ratio: &b.modes().damping_ratio,
                effective_mass: &b.modes().effective_mass,
            })
        });
        let gaps = system.gaps().iter().zip(&case.gaps);
        let gaps = gaps.map(|(g, given)| -> Result<_, CaseError> {
            let levels = system.levels_of(g).iter().enumerate();
            let levels = levels.map(|(place, l)| -> Result<_, CaseError> {
                Ok(ContactLevel {
                    width: l.width,
                    effective_mass: l.effective_mass,
                    model: l.model.descriptor().name,
                    parameters: parameters_of_gap(case, given, place)?,
                    place: &l.place,
                })
            });
            Ok(Gap {
                name: &g.name,
                between: &g.between,
                levels: levels.collect::<Result<_, _>>()?,
            })
        });
        let links = system.links().iter().zip(&case.links).enumerate();
        let links = links.map(|(index, (l, given))| -> Result<_, CaseError> {
            let elements = &system.elements()[l.first_element..l.first_element + l.levels];
            Ok(Link {
                name: &l.name,
                between: &l.between,
                levels: system.link_levels(index),
                laws: elements.iter().map(|e| e.law.descriptor().name).collect(),
                parameters: parameters_of_link(case, given)?,
            })
        });
        let record = &assembly.accelerogram;
        let duration = assembly.options.duration;
        Ok(Self {
            buildings: buildings.collect::<Result<_, _>>()?,
            gaps: gaps.collect::<Result<_, _>>()?,
            links: links.collect::<Result<_, _>>()?,
            ground_motion: Motion {
                samples: record.samples().len(),
                time_step: record.time_step(),
                peak: record.peak().value,
                scale: record.scale(),
                echo: assembly.excitation(),
            },
            warnings: (assembly.warnings().into_iter())
                .chain(case.separation.warnings())
                .collect(),
            analysis: Analysis {
                output_step: assembly.output_step,
                duration: duration.unwrap_or(assembly.system.record_duration()),
            },
        })
    }
}
