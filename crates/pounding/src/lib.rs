//! Seismic pounding of adjacent buildings.
//!
//! Two buildings that stand too close collide in an earthquake. This library integrates their
//! time history, locates every impact, closes an energy ledger, and answers how hard they hit
//! and what that does to the storeys. It is what the program `pounding` is made of.
//!
//! # A pair, a gap, a run
//!
//! ```
//! use pounding::prelude::*;
//!
//! fn main() -> Result<(), Error> {
//!     let storey = |mass, stiffness| Storey {
//!         mass: Mass::tonnes(mass),
//!         stiffness: Stiffness::meganewtons_per_metre(stiffness),
//!         height: Length::metres(3.0),
//!     };
//!     let damping = Damping::StiffnessProportional { ratio: 0.05 };
//!     let light = Building::shear("light").storeys(3, storey(25.0, 3.46)).damping(damping.clone());
//!     let heavy = Building::shear("heavy").storeys(3, storey(1000.0, 2215.0)).damping(damping);
//!     let gap = Gap::between("light", "heavy")
//!         .width(Length::millimetres(20.0))
//!         .model("jankowski_2005", [("stiffness", 2.75e9), ("restitution", 0.65)]);
//! #   let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! #   std::env::set_current_dir(root).expect("the repository");
//!     let motion = GroundMotion::read("ground_motions/el_centro_1940_ns.csv")?;
//!     let motion = motion.scaled_to(Acceleration::gravities(0.3))?;
//!     let model = Simulation::of([light, heavy]).gap(gap).ground_motion(motion).build()?;
//! #   let folder = tempfile::tempdir().expect("a folder");
//! #   std::env::set_current_dir(&folder).expect("the folder");
//!     let outcome = model.run_to_file("pair.h5")?;
//!     for warning in model.warnings(&outcome) {
//!         println!("{warning}");
//!     }
//!     let roof = &outcome.gaps[0].levels[2];
//!     println!("{} impacts, {:.0} kN", roof.impacts, roof.peak_force.value / 1e3);
//!     assert_eq!(roof.impacts, 22);
//!     assert_eq!(format!("{:.0}", roof.peak_force.value / 1e3), "1163");
//!     Ok(())
//! }
//! ```
//!
//! All numbers of an [`Outcome`](prelude::Outcome) are SI; it implements `serde::Serialize`.
//! The result file opens in h5py, xarray and MATLAB.
//!
//! # What a second call does
//!
//! A call that sets something replaces what stood there: of two `.damping(...)` the last counts, as of
//! [`Gap::width`] and [`Gap::widths`], of [`Gap::model`] and [`Gap::impact_model`], of the levels of a gap or link, and of all
//! that a [`Simulation`] has once, such as [`Simulation::ground_motion`] and [`Simulation::method`]. So a description can be
//! kept, and varied in one thing. Storeys, floors, gaps, links and forces are added; so are laws, of which each
//! storey takes one: a second one is an error.
//!
//! # With and without the neighbour
//!
//! [`Model::isolated`] takes gaps and links away, [`Model::without_gaps`] the gaps alone; modes and exact
//! steps are computed once for all of them.
//!
//! ```
//! # use pounding::prelude::*;
//! # fn main() -> Result<(), Error> {
//! # let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(root).expect("the repository");
//! let model = Model::read("examples/three_storey_pair/case.toml")?;
//! let (pounding, isolated) = (model.run()?, model.isolated().run()?);
//! let roof = |outcome: &Outcome| outcome.buildings[0].storeys[2].displacement.value;
//! assert!(roof(&pounding) < roof(&isolated));
//! # Ok(())
//! # }
//! ```
//!
//! # A case file, changed by code
//!
//! A [`Case`](case::Case) is a case file as types, in SI units. [`Model::of_case`] makes a model of one, whatever
//! code has changed in it:
//!
//! ```
//! # use pounding::prelude::*;
//! use std::path::Path;
//!
//! use pounding::case::Case;
//!
//! # fn main() -> Result<(), Error> {
//! # let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(root).expect("the repository");
//! let file = Path::new("examples/three_storey_pair/case.toml");
//! # let text = std::fs::read_to_string(file).expect("the case");
//! // The text, and the file that paths in it are relative to.
//! let mut case = Case::parse(&text, file)?;
//! let force = |case: &Case| -> Result<f64, Error> {
//!     let outcome = Model::of_case(case)?.run()?;
//!     Ok(outcome.gaps[0].levels[2].peak_force.value)
//! };
//! let before = force(&case)?;
//! for level in &mut case.gaps[0].levels {
//!     level.width = 0.030;
//! }
//! println!("{:.0} kN across 20 mm, {:.0} kN across 30 mm", before / 1e3, force(&case)? / 1e3);
//! # assert_eq!(format!("{:.0} {:.0}", before / 1e3, force(&case)? / 1e3), "1271 1178");
//! # Ok(())
//! # }
//! ```
//!
//! # Responses over time
//!
//! Recorders are served from the steps as they are taken, and change no bit of a run.
//!
//! ```
//! # use pounding::prelude::*;
//! # fn main() -> Result<(), Error> {
//! # let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(root).expect("the repository");
//! # let model = Model::read("examples/three_storey_pair/case.toml")?;
//! let mut recorder = GridRecorder::new(0.005)?;
//! let outcome = model.run_with(&mut [&mut recorder])?;
//! assert_eq!(outcome, model.run()?);
//! let history = recorder.responses;
//! let roof = history.column(&history.displacement, 2);
//! let sampled = roof.iter().fold(0.0_f64, |m, u| m.max(u.abs()));
//! // Peaks come from inside the steps.
//! assert!(sampled <= outcome.buildings[0].storeys[2].displacement.value);
//! # Ok(())
//! # }
//! ```
//!
//! # How far it is, and by which method
//!
//! [`Model::run_while`] says how far a run is, and asks whether to go on; [`Model::with_options`]
//! integrates a case otherwise than its file says.
//!
//! ```
//! # use pounding::prelude::*;
//! use std::ops::ControlFlow;
//!
//! # fn main() -> Result<(), Error> {
//! # let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(root).expect("the repository");
//! let model = Model::read("examples/three_storey_pair/case.toml")?;
//! let options = RunOptions {
//!     method: MethodChoice::Newmark { step: 1e-3, beta: 0.25, gamma: 0.5 },
//!     energy_tolerance: Some(0.2),
//!     ..*model.options()
//! };
//! let model = model.with_options(options)?;
//! let mut recorder = GridRecorder::new(0.01)?;
//! let ended = model.run_while(&mut [&mut recorder], |done| {
//!     eprint!("\r{:3.0} %", 100.0 * done);
//!     if done < 0.5 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
//! });
//! assert!(matches!(ended, Err(Error::Stopped { .. })));
//! assert!(recorder.responses.len() > 100);
//! # Ok(())
//! # }
//! ```
//!
//! # Yielding storeys, links, widths
//!
//! Laws of storeys and links go by the names that [`hysteresis::find`] knows. What a building,
//! a gap or a link cannot be is an [`Error`] with its name and a [help](Error::help).
//!
//! ```
//! # use pounding::prelude::*;
//! # fn main() -> Result<(), Error> {
//! # let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(root).expect("the repository");
//! let storey = Storey {
//!     mass: Mass::tonnes(25.0),
//!     stiffness: Stiffness::meganewtons_per_metre(3.46),
//!     height: Length::metres(3.0),
//! };
//! let building = |name| {
//!     let building = Building::shear(name).storeys(2, storey);
//!     building.damping(Damping::StiffnessProportional { ratio: 0.05 })
//! };
//! let left = building("left").law_of_storeys([1], "bilinear", [
//!     ("yield_force", 60e3),
//!     ("hardening_ratio", 0.05),
//! ]);
//! let gap = Gap::between("left", "right")
//!     .widths([Length::millimetres(15.0), Length::millimetres(25.0)])
//!     .model("anagnostopoulos_2004", [("stiffness", 9.35e7), ("restitution", 0.65)]);
//! let damper = Link::between("left", "right")
//!     .levels([(2, 2)])
//!     .law("viscous_damper", [("damping", 5e4)]);
//! let motion = GroundMotion::read("ground_motions/el_centro_1940_ns.csv")?;
//! let simulation = Simulation::of([left, building("right")]).gap(gap).link(damper);
//! let simulation = simulation.ground_motion(motion).duration(Time::seconds(5.0));
//! // The default method: exact from event to event, also where storeys yield.
//! let outcome = simulation.run()?;
//! assert_eq!(outcome.links[0].levels.len(), 1);
//! # Ok(())
//! # }
//! ```
//!
//! # An impact model of one's own
//!
//! A law between floors is an [`ImpactModel`](gap_element::ImpactModel). This one is a bumper whose loss grows with the
//! penetration and its rate, `F = k delta (1 + b v)`: a stiffness and a factor in s/m, one branch, nothing to remember.
//! What it gives back does not depend on masses or stiffness: `m v dv / (1 + b v) = -k delta d(delta)`, integrated
//! over a free collision, leaves `(1 + b v) / (1 - b w) = exp(b (v + w))` for the speeds `v` before and `w` after.
//!
//! ```
//! use std::sync::Arc;
//!
//! use pounding::gap_element::{
//!     AchievedRestitution, Bodies, ClosedForm, Collision, Force, GapElementError, ImpactModel, Memory,
//!     ModelDescriptor, ModelParameters, Phase, SeparationRule, Transition, Verification, collide,
//! };
//! use pounding::prelude::*;
//!
//! /// Stiffness (N/m) and loss (s/m).
//! #[derive(Debug)]
//! struct Bumper {
//!     stiffness: f64,
//!     loss: f64,
//! }
//!
//! /// What messages and results say of it. Parameters are for models that go by name.
//! static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
//!     name: "bumper",
//!     aliases: &[],
//!     title: "Bumper with a loss by rate",
//!     formula: "F = k delta (1 + b v)",
//!     citation: "after Hunt and Crossley, J. Applied Mechanics 42 (1975) 440",
//!     class: "own",
//!     parameters: &[],
//!     constants: &[],
//!     separation_rules: &[SeparationRule::ZeroPenetration],
//!     needs_approach_velocity: false,
//!     needs_effective_mass: false,
//!     achieved_restitution: AchievedRestitution::Varies,
//!     recommended: false,
//!     verification: Verification::Verified("the closed form of a free collision"),
//!     example: &[],
//!     traps: &[],
//!     build: bumper,
//! };
//!
//! fn bumper(_: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
//!     Ok(Box::new(Bumper { stiffness: 9.35e7, loss: 1.5 }))
//! }
//!
//! impl ImpactModel for Bumper {
//!     fn descriptor(&self) -> &'static ModelDescriptor {
//!         &DESCRIPTOR
//!     }
//!
//!     /// It never pulls: no collision ends faster than `1 / b`.
//!     fn separation(&self) -> SeparationRule {
//!         SeparationRule::ZeroPenetration
//!     }
//!
//!     fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
//!         Collision { approach_velocity, effective_mass, ..Collision::default() }
//!     }
//!
//!     /// With both derivatives, which implicit steps need.
//!     fn force(&self, _: &Collision, _: &Memory, _: Phase, delta: f64, velocity: f64) -> Force {
//!         let factor = 1.0 + self.loss * velocity;
//!         Force {
//!             value: self.stiffness * delta * factor,
//!             by_penetration: self.stiffness * factor,
//!             by_velocity: self.stiffness * delta * self.loss,
//!         }
//!     }
//!
//!     /// The force vanishes at closure; its sign is that of this factor.
//!     fn raw_force(&self, _: &Collision, _: &Memory, _: Phase, _: f64, velocity: f64) -> f64 {
//!         1.0 + self.loss * velocity
//!     }
//!
//!     /// What the ledger counts as stored: the rest of the work is lost.
//!     fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
//!         0.5 * self.stiffness * delta * delta
//!     }
//!
//!     fn transitions(&self, _: Phase) -> &'static [Transition] {
//!         &[]
//!     }
//!
//!     fn closed_form(&self, _: f64, _: f64) -> Option<ClosedForm> {
//!         None
//!     }
//!
//!     fn smooth_at_closure(&self) -> bool {
//!         true
//!     }
//! }
//!
//! # fn main() -> Result<(), Error> {
//! // By itself first: two bodies, and the closed form.
//! let model = bumper(&ModelParameters::default()).expect("a bumper");
//! let bodies = Bodies {
//!     mass_left: 25e3,
//!     mass_right: Some(40e3),
//!     velocity_left: 0.8,
//!     velocity_right: 0.3,
//! };
//! let free = collide(&*model, &bodies).expect("a collision");
//! let (v, w, b) = (0.5, 0.5 * free.restitution, 1.5_f64);
//! assert!(((1.0 + b * v) / (1.0 - b * w) - (b * (v + w)).exp()).abs() < 1e-9);
//! println!("restitution {:.3}", free.restitution);
//! # assert_eq!(format!("{:.3}", free.restitution), "0.663");
//!
//! // Then between buildings.
//! let storey = |mass, stiffness| Storey {
//!     mass: Mass::tonnes(mass),
//!     stiffness: Stiffness::meganewtons_per_metre(stiffness),
//!     height: Length::metres(3.0),
//! };
//! let damping = Damping::StiffnessProportional { ratio: 0.05 };
//! let light = Building::shear("light").storeys(3, storey(25.0, 3.46)).damping(damping.clone());
//! let heavy = Building::shear("heavy").storeys(3, storey(1000.0, 2215.0)).damping(damping);
//! let gap = Gap::between("light", "heavy")
//!     .width(Length::millimetres(20.0))
//!     .impact_model(Arc::from(model));
//! # let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(root).expect("the repository");
//! let motion = GroundMotion::read("ground_motions/el_centro_1940_ns.csv")?;
//! let outcome = Simulation::of([light, heavy]).gap(gap).ground_motion(motion).run()?;
//! let roof = &outcome.gaps[0].levels[2];
//! println!("{} impacts, {:.0} kN", roof.impacts, roof.peak_force.value / 1e3);
//! # assert_eq!(format!("{} {:.0}", roof.impacts, roof.peak_force.value / 1e3), "27 1140");
//! // No impact gives energy, and the ledger of the run closes.
//! assert!(outcome.impacts.iter().all(|impact| impact.energy_dissipated > 0.0));
//! assert!(outcome.energy.residual_ratio < 1e-9);
//! # Ok(())
//! # }
//! ```
//!
//! Laws with branches name the sign changes that end them ([`ImpactModel::transitions`](gap_element::ImpactModel::transitions));
//! rigid ones give a [restitution](gap_element::ImpactModel::rigid_restitution) alone.
//!
//! # Walls, frames, matrices of other programs
//!
//! A building whose floors all act on one another has one [`LateralStiffness`](prelude::LateralStiffness)
//! in the place of storey stiffnesses: of a wall, of a frame with flexible beams, or typed in.
//! Its overturning moment at the base is among the results.
//!
//! ```
//! # use pounding::prelude::*;
//! # fn main() -> Result<(), Error> {
//! # let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
//! # std::env::set_current_dir(root).expect("the repository");
//! let heights = [3.0; 4];
//! let flexural_rigidity = [6.0e9; 4];
//! let wall = LateralStiffness::cantilever(&heights, &flexural_rigidity, None)?;
//! let floor = Floor { mass: Mass::tonnes(40.0), height: Length::metres(3.0) };
//! let wall = Building::stiffness_matrix("core", wall)
//!     .floors(4, floor)
//!     .damping(Damping::Modal { ratios: vec![0.05] });
//! let motion = GroundMotion::read("ground_motions/el_centro_1940_ns.csv")?;
//! let outcome = Simulation::of([wall]).ground_motion(motion).run()?;
//! let moment = outcome.buildings[0].base_moment.expect("that of a matrix");
//! println!("{:.0} kN m at {:.2} s", moment.value / 1e3, moment.time);
//! # assert!(moment.value > 1.0e6);
//! # Ok(())
//! # }
//! ```
//!
//! # What is where
//!
//! | crate | what |
//! |---|---|
//! | [`gap_element`] | impact models: [`registry::find`](gap_element::registry::find) names them, the trait [`ImpactModel`](gap_element::ImpactModel) is for one's own |
//! | [`hysteresis`] | laws of storeys and links |
//! | [`ground_motion`] | records in many formats, processing, spectra, synthetic motions |
//! | [`shear_building`] | storeys, damping, modes |
//! | [`separation`] | provisions of codes for the gap |
//! | [`time_history`] | the solver: systems, methods, outcomes, recorders |
//! | [`catalogue`] | parameters of models and laws, for descriptors of one's own |
//! | `pounding-study`, a crate beside this one | many runs: gap checks, model comparison, floor spectra, IDA and fragility |
//!
//! [`Model::of_system`] makes a model of what [`time_history`] can and the builders cannot: several
//! ground motions, foundations on soil, buildings that turn.
//!
//! Features: `hdf5` (results; needs libhdf5) and `toml` (case files), both on by default.
//! Without them the library needs no C library and has no [`Model::read`].

mod building;
mod error;
mod facing;
mod gap;
mod help;
mod law;
mod link;
mod model;
mod progress;
mod record;
mod simulation;
pub mod units;

pub use building::{Building, Floor, Storey};
pub use error::Error;
pub use gap::Gap;
pub use link::Link;
pub use model::Model;
pub use record::GroundMotion;
pub use simulation::Simulation;

#[cfg(feature = "toml")]
pub use pounding_assembly as assembly;
#[cfg(feature = "toml")]
pub use pounding_case as case;
pub use pounding_catalogue as catalogue;
#[cfg(feature = "hdf5")]
pub use pounding_files::FileUseError;
#[cfg(feature = "hdf5")]
pub use pounding_files::checksum::{Checksum, ChecksumError, WithoutChecksum};
pub use pounding_gap_element as gap_element;
pub use pounding_ground_motion as ground_motion;
pub use pounding_hysteresis as hysteresis;
#[cfg(feature = "hdf5")]
pub use pounding_results as results;
pub use pounding_separation as separation;
pub use pounding_shear_building as shear_building;
/// The crate whose matrices and vectors stand in [`shear_building`] and in [`Damping::Matrix`](prelude::Damping::Matrix),
/// of the version that they are of.
pub use pounding_shear_building::nalgebra;
pub use pounding_time_history as time_history;

/// What most programs need.
pub mod prelude {
    pub use pounding_gap_element::SeparationRule;
    pub use pounding_shear_building::{
        Damping, Isolator, IsolatorKind, LateralStiffness, PostYield, Strength,
    };
    pub use pounding_time_history::{
        ForceHistory, GridRecorder, History, HistorySink, MethodChoice, Outcome, Recorder,
        RunOptions, Summary, Warning,
    };

    pub use crate::units::{Acceleration, Length, Mass, Stiffness, Time, Velocity};
    pub use crate::{Building, Error, Floor, Gap, GroundMotion, Link, Model, Simulation, Storey};
}
