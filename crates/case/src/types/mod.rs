//! A case in SI units, with the place of what the layers above may refuse.

mod files;
mod laws;
mod rule;
mod usual;

use std::collections::BTreeMap;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

use pounding_ground_motion::Offset;
use pounding_ground_motion::processing::{ProcessingStep, Scale};
use pounding_ground_motion::spectra::design::CodeSpectrum;

use crate::error::{CaseError, MORE_FILES, UnreadParameter, is_short_of_files};
use crate::located::Located;

pub use files::GivenFiles;
pub use laws::{FoundationMotion, Link, Parameter, StoreyLaw};
pub use pounding_shear_building::{
    ColumnEnds, Damping, Isolator, IsolatorKind, PostYield, Soil, SpringDashpot, Strength,
};
pub use rule::{RuleText, TableText};

/// A whole case.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Title, may be empty.
    pub title: String,
    /// Buildings from the left.
    pub buildings: Vec<Building>,
    /// Gaps in the order of the file.
    pub gaps: Vec<Gap>,
    /// Links in the order of the file.
    pub links: Vec<Link>,
    /// Ground motion.
    pub ground_motion: GroundMotion,
    /// Analysis.
    pub analysis: Analysis,
    /// What provisions for the gap need to know.
    pub separation: Separation,
    /// Scales of ground motions that were probably meant in another unit, in words: a warning for
    /// each.
    pub asked: Vec<String>,
    /// The TOML text.
    pub source: String,
    /// Name of the file in messages, and the base of relative paths.
    pub file: PathBuf,
    /// The files that it names, where they do not lie on a disk.
    pub given_files: Option<GivenFiles>,
}

/// A case in which something is wrong, as far as it could be read, for whoever wants to say
/// what else is wrong in it. No run can be made of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    /// The case; stand-ins are in place of values that are wrong. Gaps and links whose
    /// neighbours or levels are not known lie between walls.
    pub case: Case,
    /// Places of models, laws and dampings of which not all is known: what is found wrong
    /// there may follow from an error that is reported already.
    pub incomplete: Vec<Range<usize>>,
    /// Parameters whose values could not be read: it may have none of that name.
    pub unread: Vec<UnreadParameter>,
    /// Whether all was read that says how the record is to be read.
    pub motion_is_known: bool,
}

/// Why a text is no case.
#[derive(Debug, Clone, PartialEq)]
pub struct Refusal {
    /// All that is wrong in it.
    pub error: CaseError,
    /// What could be read all the same; nothing of a text that is no case file at all.
    pub draft: Option<Draft>,
}

/// A building: one value per storey, bottom first.
#[derive(Debug, Clone, PartialEq)]
pub struct Building {
    /// Name, unique in the case.
    pub name: Located<String>,
    /// Floor masses (kg).
    pub mass: Vec<f64>,
    /// Storey stiffnesses (N/m); none where `lateral` says what resists; with an isolator,
    /// which is the first storey, those of the storeys above.
    pub stiffness: Vec<f64>,
    /// Isolators under the building, at their table.
    pub isolator: Option<Located<Isolator>>,
    /// What resists the lateral motion of a building that is no chain of storeys, at its
    /// key.
    pub lateral: Option<Located<Lateral>>,
    /// Storey heights (m).
    pub height: Vec<f64>,
    /// Floor displacements relative to the ground at time zero (m).
    pub initial_displacement: Located<Vec<f64>>,
    /// Floor velocities relative to the ground at time zero (m/s).
    pub initial_velocity: Vec<f64>,
    /// Laws in the place of storey stiffnesses; no storey stands in two of them.
    pub laws: Vec<StoreyLaw>,
    /// Whether gravity acts through the drift (P-Delta).
    pub p_delta: bool,
    /// Damping; with an isolator that of the storeys above it, where there is a foundation that
    /// of the building on a fixed base.
    pub damping: Located<Damping>,
    /// The foundation, if it sways or rocks.
    pub foundation: Option<Located<Foundation>>,
    /// The ground under it, where that does not move as `[ground_motion]` says.
    pub ground: Option<Located<BuildingGround>>,
    /// Its plan, if its floors turn.
    pub plan: Option<Located<Plan>>,
    /// Forces on its floors, at their tables.
    pub forces: Vec<Located<FloorForce>>,
    /// Where the values of `mass`, `stiffness` and `height` (or `elevations`) stand.
    pub places: BuildingPlaces,
}

impl Building {
    /// Where the value of `mass`, `stiffness` or `height` stands; the name, if the key is not given.
    #[must_use]
    pub fn span_of(&self, key: &str) -> Range<usize> {
        let BuildingPlaces {
            mass,
            stiffness,
            height,
        } = &self.places;
        let place = match key {
            "mass" => mass,
            "stiffness" => stiffness,
            "height" => height,
            _ => &None,
        };
        place.as_ref().unwrap_or(&self.name.span).clone()
    }
}

/// Where the values of storeys stand in a file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct BuildingPlaces {
    /// Of `mass`.
    pub mass: Option<Range<usize>>,
    /// Of `stiffness`.
    pub stiffness: Option<Range<usize>>,
    /// Of `height`, or of `elevations` in its place.
    pub height: Option<Range<usize>>,
}

/// A force on a floor over time, positive to the right.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorForce {
    /// Storey below the floor, from zero.
    pub storey: usize,
    /// Where it comes from.
    pub source: ForceSource,
    /// Whether the last force stays.
    pub stays: bool,
    /// Factor.
    pub scale: f64,
    /// Time (s) by which it comes later.
    pub delay: f64,
}

/// What a force on a floor is.
#[derive(Debug, Clone, PartialEq)]
pub enum ForceSource {
    /// The same (N) from time zero on.
    Constant(f64),
    /// Times (s) and forces (N).
    Points(Located<Vec<(f64, f64)>>),
    /// `amplitude sin(2 pi frequency t + phase)` in straight lines.
    Harmonic {
        /// Amplitude (N).
        amplitude: f64,
        /// Frequency (Hz).
        frequency: f64,
        /// Phase (rad).
        phase: f64,
        /// How long it lasts (s).
        duration: f64,
        /// Length of the straight lines (s).
        step: f64,
    },
    /// A CSV file with times and forces, or forces at equal steps.
    File {
        /// The file, relative to the folder of the case file.
        file: Located<PathBuf>,
        /// Column of the force, from zero, where one is named; otherwise that after the times, or
        /// the only one.
        column: Option<usize>,
        /// Time between lines (s); `None` where the first column holds times.
        time_step: Option<f64>,
        /// Unit of the force in SI units, where one is named.
        unit: Option<f64>,
    },
}

impl ForceSource {
    /// The file that it is read from.
    #[must_use]
    pub fn file(&self) -> Option<&Located<PathBuf>> {
        match self {
            Self::File { file, .. } => Some(file),
            _ => None,
        }
    }
}

/// The plan of a building with rigid floors that turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Length of the floors along the row (m).
    pub length: f64,
    /// Width of the floors across the row (m).
    pub width: f64,
    /// Position of the mass centre across the row (m).
    pub mass_centre: f64,
    /// Rotational inertia of every floor about its mass centre (kg m2); `None` is that of a
    /// rectangle.
    pub rotational_inertia: Option<Vec<f64>>,
    /// Frames along the row, at positions across it.
    pub along: Vec<Frame>,
    /// Frames across the row, at positions along it.
    pub across: Vec<Frame>,
}

impl Plan {
    /// Frames along the row, then those across it.
    pub fn frames(&self) -> impl Iterator<Item = &Frame> {
        self.along.iter().chain(&self.across)
    }

    /// The same to be changed.
    pub fn frames_mut(&mut self) -> impl Iterator<Item = &mut Frame> {
        self.along.iter_mut().chain(&mut self.across)
    }
}

/// A frame or wall line of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Distance from the mass centre (m).
    pub at: f64,
    /// Stiffness of every storey (N/m), bottom first.
    pub stiffness: Vec<f64>,
    /// Laws in the place of the stiffness of its storeys.
    pub laws: Vec<StoreyLaw>,
}

/// The motion of the ground under one building.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingGround {
    /// Time (s) by which it is later.
    pub delay: f64,
    /// Whether the delay is that of waves over a distance.
    pub by_wave_speed: bool,
    /// A record of its own; `None` is that of the case.
    pub motion: Option<GroundMotion>,
}

/// A foundation that sways or rocks on the soil.
#[derive(Debug, Clone, PartialEq)]
pub struct Foundation {
    /// Mass (kg); zero where it is not given, which a foundation that sways does not allow.
    pub mass: f64,
    /// Rotational inertia of foundation and floors about their own axes (kg m2); zero where it
    /// is not given, which a foundation that rocks does not allow.
    pub rotational_inertia: f64,
    /// What holds it.
    pub support: Support,
    /// Length along the motion (m), if it is known.
    pub length: Option<f64>,
}

/// What holds a foundation.
#[derive(Debug, Clone, PartialEq)]
pub enum Support {
    /// The soil, from which springs and dashpots follow.
    Soil(Soil),
    /// Springs and dashpots; one left out is rigid.
    Springs {
        /// Of the displacement (N/m, N s/m).
        sway: Option<SpringDashpot>,
        /// Of the rotation (N m/rad, N m s/rad).
        rocking: Option<SpringDashpot>,
    },
}

impl Support {
    /// Whether the foundation sways.
    #[must_use]
    pub fn sways(&self) -> bool {
        !matches!(self, Self::Springs { sway: None, .. })
    }

    /// Whether the foundation rocks.
    #[must_use]
    pub fn rocks(&self) -> bool {
        !matches!(self, Self::Springs { rocking: None, .. })
    }
}

/// What resists the lateral motion of a frame or a wall.
#[derive(Debug, Clone, PartialEq)]
pub enum Lateral {
    /// Stiffness matrix of the floors (N/m).
    Stiffness(MatrixSource),
    /// Flexibility matrix of the floors (m/N).
    Flexibility(MatrixSource),
    /// A cantilever wall.
    Cantilever {
        /// E I of every storey (N m2).
        flexural_rigidity: Vec<f64>,
        /// kappa G A of every storey (N), if it deforms in shear.
        shear_rigidity: Option<Vec<f64>>,
    },
    /// A frame, its columns and beams lumped.
    Fishbone {
        /// E I of the columns of every storey (N m2).
        columns: Vec<f64>,
        /// Rotational stiffness of the beams at every floor (N m).
        beam_stiffness: Vec<f64>,
    },
}

/// A matrix of the floors, bottom first.
#[derive(Debug, Clone, PartialEq)]
pub enum MatrixSource {
    /// Its rows, in SI units.
    Rows(Vec<Vec<f64>>),
    /// A CSV file without header, one row a line.
    File {
        /// The file, relative to the folder of the case file.
        file: Located<PathBuf>,
        /// Its unit in SI units.
        unit: f64,
    },
}

impl Lateral {
    /// The file that it is read from.
    #[must_use]
    pub fn file(&self) -> Option<&Located<PathBuf>> {
        match self {
            Self::Stiffness(MatrixSource::File { file, .. })
            | Self::Flexibility(MatrixSource::File { file, .. }) => Some(file),
            _ => None,
        }
    }
}

/// One end of a gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Index of the building in the row.
    Building(usize),
    /// A rigid wall that moves with the ground.
    Wall,
}

impl Building {
    /// Laws of its storeys, then those of the frames of its plan.
    pub fn all_laws(&self) -> impl Iterator<Item = &StoreyLaw> {
        let frames = self.plan.iter().flat_map(|plan| plan.value.frames());
        self.laws.iter().chain(frames.flat_map(|f| &f.laws))
    }

    /// Elevations of the floors (m), bottom first, as
    /// [`pounding_shear_building::elevations`] has them.
    #[must_use]
    pub fn elevations(&self) -> Vec<f64> {
        pounding_shear_building::elevations(&self.height)
    }
}

/// One side of a contact level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Facing {
    /// A floor, by its storey from zero.
    Floor(usize),
    /// Columns between floors.
    Column {
        /// Their storey, from zero.
        storey: usize,
        /// Height of the hit above the floor below, or the base (m).
        above_floor: f64,
    },
    /// A rigid wall.
    Wall,
}

impl Facing {
    /// The storey of a floor, from zero.
    #[must_use]
    pub fn floor(self) -> Option<usize> {
        match self {
            Self::Floor(storey) => Some(storey),
            Self::Column { .. } | Self::Wall => None,
        }
    }

    /// Whether columns are hit here.
    #[must_use]
    pub fn is_column(self) -> bool {
        matches!(self, Self::Column { .. })
    }
}

/// Columns that floors of the neighbour hit between floors, all together as one line.
#[derive(Debug, Clone, PartialEq)]
pub struct HitColumns {
    /// E I of all of them (N m2).
    pub flexural_rigidity: f64,
    /// kappa G A of all of them (N), if they deform in shear.
    pub shear_rigidity: Option<f64>,
    /// How floors hold their ends.
    pub ends: ColumnEnds,
    /// Mass that a hit sets in motion (kg), if any.
    pub contact_mass: Option<f64>,
    /// Shear capacity (N) to compare the demand with.
    pub shear_capacity: Option<f64>,
}

/// What may touch: two floors, a floor and columns, or a floor and a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactLevel {
    /// On the left.
    pub left: Facing,
    /// On the right.
    pub right: Facing,
    /// Width (m).
    pub width: f64,
    /// Where it is named in `levels`, else the `between` of its gap.
    pub place: Range<usize>,
}

/// A gap between neighbours, or to a wall.
#[derive(Debug, Clone, PartialEq)]
pub struct Gap {
    /// Name, by default `left-right`.
    pub name: String,
    /// Left and right.
    pub between: [Side; 2],
    /// Contact levels, from the bottom.
    pub levels: Vec<ContactLevel>,
    /// Floors whose elevations differ by no more than this are level (m).
    pub elevation_tolerance: f64,
    /// Whether floors that are not level act on each other as if they were.
    pub floor_to_floor: bool,
    /// Columns of the left and of the right building that floors of the other may hit, at
    /// their table.
    pub columns: [Option<Located<HitColumns>>; 2],
    /// Whether its wall stands still in space while the ground moves.
    pub fixed_wall: bool,
    /// Positions across the row (m) at which floors that turn may touch; `None` for both ends of
    /// the edge that they share.
    pub points: Option<Located<Vec<f64>>>,
    /// Seat width (m) of what spans the joint, which an opening must not exceed.
    pub seat: Option<Located<f64>>,
    /// Impact model.
    pub model: Located<String>,
    /// Separation rule.
    pub separation: Option<Located<String>>,
    /// Penetrations (m) and forces (N) of a spring that is given as a table.
    pub spring: Option<Located<Vec<(f64, f64)>>>,
    /// All other keys, for the model to judge; one value per contact level.
    pub parameters: Vec<Parameter>,
}

/// The ground motion.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundMotion {
    /// Record file as written.
    pub file: Located<PathBuf>,
    /// Format.
    pub format: Option<Located<String>>,
    /// Time step (s).
    pub time_step: Option<f64>,
    /// Unit of the values.
    pub unit: Option<Located<String>>,
    /// Layout of plain columns.
    pub layout: Option<String>,
    /// Component to use: name, azimuth or channel number.
    pub component: Option<String>,
    /// The other component and the angle (degrees) by which both are turned, first
    /// towards second.
    pub rotation: Option<Rotation>,
    /// The record across the row, for buildings that turn in plan.
    pub across: Option<Located<Box<GroundMotion>>>,
    /// Quantity to use: only an acceleration excites buildings.
    pub quantity: Option<Located<String>>,
    /// Lines to skip.
    pub skip_lines: usize,
    /// Characters to skip at the start of each line.
    pub skip_columns: usize,
    /// Puts a zero before the first value.
    pub prepend_zero: bool,
    /// Accepts a truncated record.
    pub lenient: bool,
    /// Counts per m/s2 of a record in counts.
    pub sensitivity: Option<f64>,
    /// StationXML with the sensitivities of a record in counts.
    pub response: Option<Located<PathBuf>>,
    /// The g (m/s2) that units of gravity stand for.
    pub gravity: Option<f64>,
    /// What becomes of the mean.
    pub offset: Offset,
    /// What is done to the record, in this order.
    pub process: Vec<Located<ProcessingStep<BandSource>>>,
    /// Scale, after that; `None`: as recorded.
    pub scale: Option<Located<Scale<BandSource>>>,
    /// Where the values of the keys that say how to read it stand.
    pub places: BTreeMap<&'static str, Range<usize>>,
}

impl GroundMotion {
    /// Where the value of a key stands; that of `file`, if the key is not given.
    #[must_use]
    pub fn span_of(&self, key: &str) -> Range<usize> {
        self.places.get(key).unwrap_or(&self.file.span).clone()
    }
}

/// A turn of two components at right angles.
#[derive(Debug, Clone, PartialEq)]
pub struct Rotation {
    /// The other component, in the same file.
    pub second_component: Located<String>,
    /// Angle (degrees).
    pub angle: f64,
}

/// A spectrum to which a record is scaled, over a band of periods.
#[derive(Debug, Clone, PartialEq)]
pub struct BandSource {
    /// The spectrum.
    pub spectrum: SpectrumSource,
    /// First period (s); `None` for that which the code asks for.
    pub from: Option<f64>,
    /// Last period (s), likewise.
    pub to: Option<f64>,
    /// A further factor (-).
    pub times: f64,
}

/// A spectrum to which a record is scaled.
#[derive(Debug, Clone, PartialEq)]
pub enum SpectrumSource {
    /// Of a file.
    File(SpectrumFile),
    /// Of a code.
    Code(Located<CodeSpectrum>),
}

impl SpectrumSource {
    /// Its file, if it is of one.
    #[must_use]
    pub fn file(&self) -> Option<&SpectrumFile> {
        match self {
            Self::File(file) => Some(file),
            Self::Code(_) => None,
        }
    }
}

/// The file of a spectrum to which a record is scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumFile {
    /// File of periods and pseudo-accelerations, as written.
    pub file: Located<PathBuf>,
    /// Damping ratio.
    pub damping: f64,
}

/// The analysis. Times in s.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// Method.
    pub method: Located<String>,
    /// Duration; the record's by default.
    pub duration: Option<f64>,
    /// Step of the output; 0.01 s by default.
    pub output_step: f64,
    /// Step of fixed-step methods.
    pub step: Option<f64>,
    /// Newmark's beta.
    pub beta: Option<f64>,
    /// Newmark's gamma.
    pub gamma: Option<f64>,
    /// Alpha of HHT.
    pub alpha: Option<f64>,
    /// Theta of Moreau and Jean.
    pub theta: Option<f64>,
    /// Relative tolerance of adaptive methods.
    pub relative_tolerance: Option<f64>,
    /// Allowed energy residual.
    pub energy_tolerance: Option<f64>,
    /// Where the values of the keys that are given stand, by key.
    pub places: BTreeMap<String, Range<usize>>,
}

impl Analysis {
    /// Where the value of a key of `[analysis]` stands; that of the method, if the key is not
    /// given.
    #[must_use]
    pub fn span_of(&self, option: &str) -> Range<usize> {
        self.places.get(option).unwrap_or(&self.method.span).clone()
    }
}

/// What provisions for the gap need to know beside the buildings themselves; lists
/// hold one value per building. What is not given is `None`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Separation {
    /// `R`, `q`, `Rd Ro`, `R*`, `Ra`.
    pub response_modification: Option<Vec<f64>>,
    /// `Cd`.
    pub displacement_amplification: Option<Vec<f64>>,
    /// Importance factors.
    pub importance: Option<Vec<f64>>,
    /// `alpha_y` of the code of Taiwan.
    pub yield_amplification: Option<Vec<f64>>,
    /// Ductilities, for effective periods and damping.
    pub ductility: Option<Vec<f64>>,
    /// Kinds of structure.
    pub structural_system: Option<Vec<Located<String>>>,
    /// Whether all floors face floors; by default found from the elevations.
    pub floors_aligned: Option<bool>,
    /// Whether no property line lies in the gaps.
    pub same_owner: Option<bool>,
    /// Fortification intensity of the Chinese code.
    pub fortification_intensity: Option<usize>,
    /// Soil zone of Mexico City.
    pub soil_zone: Option<Located<String>>,
    /// `a_g S` (m/s2).
    pub design_ground_acceleration: Option<f64>,
    /// `alpha_h` of the Indian code.
    pub seismic_coefficient: Option<f64>,
    /// `S_M1` of ASCE 7 (m/s2).
    pub spectral_acceleration_1s: Option<f64>,
    /// `T_M` of ASCE 7 (s).
    pub isolation_period: Option<Vec<f64>>,
    /// `B_M` of ASCE 7.
    pub isolation_damping_coefficient: Option<Vec<f64>>,
    /// Longest dimensions in plan (m).
    pub plan_length: Option<Vec<f64>>,
    /// Shortest dimensions in plan (m).
    pub plan_width: Option<Vec<f64>>,
    /// Eccentricities in plan (m).
    pub plan_eccentricity: Option<Vec<f64>>,
    /// Whether the neighbour has left its own distance from the property line.
    pub neighbour_has_gap: Option<bool>,
    /// The code whose answer is asked for, with its edition or without, or a rule of the user.
    pub code: Option<Located<String>>,
    /// The country whose code in force is asked for.
    pub country: Option<Located<String>>,
    /// The day on which editions are to be in force.
    pub date: Option<Located<String>>,
    /// Names of the provisions to apply; all by default.
    pub provisions: Option<Vec<Located<String>>>,
    /// Rules of the user.
    pub rules: Vec<RuleText>,
}

/// What lies outside the values that codes have of the parameters of their spectra, in words: a
/// warning for each, with what was probably meant.
#[must_use]
pub fn unusual_parameters(spectrum: &CodeSpectrum) -> Vec<String> {
    usual::of_spectrum(spectrum)
}

/// What is said of an acceleration (m/s2) to which records are scaled and that was written without a
/// unit, where it is as small as no such record and the same number of g is a usual one. `least` is
/// the least usual value (g), and `what` the words for the value and where it stands.
#[must_use]
pub fn bare_acceleration(what: &str, value: f64, least: f64) -> Option<String> {
    usual::bare_acceleration(what, value, least)
}

/// What is said of a velocity of the ground (m/s) that was written without a unit, where no ground reaches
/// it. `what` has the words for the value and where it stands.
#[must_use]
pub fn bare_ground_velocity(what: &str, value: f64) -> Option<String> {
    usual::bare_ground_velocity(what, value)
}

/// What is said of the width of a gap (m) that was written without a unit, where hardly a joint is as wide. `what`
/// has the words for the value and where it stands, with their verb.
#[must_use]
pub fn bare_gap_width(what: &str, value: f64) -> Option<String> {
    usual::bare_gap_width(what, value)
}

impl GroundMotion {
    /// The same of the spectra to which the motion, and that across the row, is scaled.
    #[must_use]
    pub fn unusual_parameters(&self) -> Vec<String> {
        let steps = self.process.iter().filter_map(|step| step.value.target());
        let scale = self.scale.iter().filter_map(|scale| scale.value.target());
        let spectra = steps.chain(scale).filter_map(|band| match &band.spectrum {
            SpectrumSource::Code(code) => Some(&code.value),
            SpectrumSource::File(_) => None,
        });
        let across = self.across.iter();
        let across = across.flat_map(|motion| motion.value.unusual_parameters());
        spectra.flat_map(unusual_parameters).chain(across).collect()
    }
}

impl Separation {
    /// What lies outside the values that codes have, in words: a warning for each key, with what was
    /// probably meant.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        usual::warnings(self)
    }

    /// What is wrong with plans that are wider than long, and what to do.
    #[must_use]
    pub fn wide_plan(&self) -> Option<(String, &'static str)> {
        let (lengths, widths) = (self.plan_length.as_ref()?, self.plan_width.as_ref()?);
        let mut both = widths.iter().zip(lengths).enumerate();
        let (place, (width, length)) = both.find(|(_, (width, length))| width > length)?;
        let building = place + 1;
        let message = format!(
            "`plan_width`, {width} m for building {building}, is greater than `plan_length`, {length} m"
        );
        let help = "`plan_length` is the longer side of the plan and `plan_width` the shorter one: exchange them, or correct the values and their units";
        Some((message, help))
    }

    /// The same with what `other` gives in the place of what this one has; a code in the place of
    /// a country, and a country in that of a code. Rules are those of both.
    #[must_use]
    pub fn overridden_by(self, other: Self) -> Self {
        let (code, country) = match (&other.code, &other.country) {
            (None, None) => (self.code, self.country),
            _ => (other.code, other.country),
        };
        Self {
            response_modification: other.response_modification.or(self.response_modification),
            displacement_amplification: other
                .displacement_amplification
                .or(self.displacement_amplification),
            importance: other.importance.or(self.importance),
            yield_amplification: other.yield_amplification.or(self.yield_amplification),
            ductility: other.ductility.or(self.ductility),
            structural_system: other.structural_system.or(self.structural_system),
            floors_aligned: other.floors_aligned.or(self.floors_aligned),
            same_owner: other.same_owner.or(self.same_owner),
            fortification_intensity: other
                .fortification_intensity
                .or(self.fortification_intensity),
            soil_zone: other.soil_zone.or(self.soil_zone),
            design_ground_acceleration: other
                .design_ground_acceleration
                .or(self.design_ground_acceleration),
            seismic_coefficient: other.seismic_coefficient.or(self.seismic_coefficient),
            spectral_acceleration_1s: other
                .spectral_acceleration_1s
                .or(self.spectral_acceleration_1s),
            isolation_period: other.isolation_period.or(self.isolation_period),
            isolation_damping_coefficient: other
                .isolation_damping_coefficient
                .or(self.isolation_damping_coefficient),
            plan_length: other.plan_length.or(self.plan_length),
            plan_width: other.plan_width.or(self.plan_width),
            plan_eccentricity: other.plan_eccentricity.or(self.plan_eccentricity),
            neighbour_has_gap: other.neighbour_has_gap.or(self.neighbour_has_gap),
            code,
            country,
            date: other.date.or(self.date),
            provisions: other.provisions.or(self.provisions),
            rules: self.rules.into_iter().chain(other.rules).collect(),
        }
    }
}

/// Largest case file (bytes): far more than anyone writes, and little enough to read what
/// has no end.
const LARGEST_FILE: u64 = 16_000_000;

/// As [`read_text`], of a file that another file names, or that lies beside one: no pipe, which may never
/// begin, and no device, which may never end.
///
/// # Errors
/// As [`read_text`], and what is no regular file.
pub fn read_regular_text(path: &Path, what: &str) -> Result<String, CaseError> {
    if let Ok(found) = std::fs::metadata(path)
        && !found.is_file()
    {
        let kind = match found.is_dir() {
            true => "this is a folder, not a file",
            false => "this is no regular file",
        };
        let message = format!("cannot read the {what} file: {kind}");
        let help = Some("give the path of a file".to_owned());
        return Err(CaseError::unread(
            &path.display().to_string(),
            message,
            help,
        ));
    }
    read_text(path, what)
}

/// Text of a file that people write, which may be a pipe: it is read once. `what` names it
/// in messages, such as "case".
///
/// # Errors
/// A file that cannot be read, is no text, is not in UTF-8 (with the place of the first byte
/// that is not), or is larger than 16 MB.
pub fn read_text(path: &Path, what: &str) -> Result<String, CaseError> {
    let name = path.display().to_string();
    let reason = |why: &str| format!("cannot read the {what} file: {why}");
    let unread =
        |why: String| CaseError::unread(&name, reason(&why), Some("check the path".to_owned()));
    let mut bytes = Vec::new();
    let failed = |e: std::io::Error| match is_short_of_files(&e) {
        true => CaseError::unread(&name, reason(&e.to_string()), Some(MORE_FILES.to_owned())),
        false => unread(e.to_string()),
    };
    let file = std::fs::File::open(path).map_err(failed)?;
    let read = file.take(LARGEST_FILE + 1).read_to_end(&mut bytes);
    if read.map_err(failed)? as u64 > LARGEST_FILE {
        return Err(unread(format!(
            "it is larger than 16 MB, which no {what} is"
        )));
    }
    decoded(&name, bytes)
}

/// Bytes as text; `name` is that of their file in messages.
///
/// # Errors
/// What is no text, or not in UTF-8, with the place of the first byte that is not.
pub fn decoded(name: &str, bytes: Vec<u8>) -> Result<String, CaseError> {
    let at = |end: usize, message: String, help: &str| {
        let before = String::from_utf8_lossy(&bytes[..end]);
        CaseError::new(
            name,
            &before,
            before.len()..before.len(),
            message,
            Some(help.to_owned()),
        )
    };
    const SAVE: &str = "save the file as UTF-8";
    if bytes.starts_with(b"\x89HDF\r\n\x1a\n") {
        let message = "the file is in HDF5, as results are, and no text";
        let help =
            "give the file in TOML of which the result was made; `pounding report` shows a result";
        return Err(at(0, message.to_owned(), help));
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(at(
            0,
            "the file is in UTF-16, not in UTF-8".to_owned(),
            SAVE,
        ));
    }
    let valid = match std::str::from_utf8(&bytes) {
        Ok(_) => bytes.len(),
        Err(e) => e.valid_up_to(),
    };
    if let Some(nul) = bytes.iter().take(valid + 1).position(|b| *b == 0) {
        // Two bytes a letter of which one is zero: UTF-16 without a mark.
        let zeros = bytes.iter().filter(|b| **b == 0).count();
        return Err(if zeros > 1 && nul < 2 && 3 * zeros >= bytes.len() {
            at(0, "the file is in UTF-16, not in UTF-8".to_owned(), SAVE)
        } else {
            let message = "a byte 0x00 stands here: the file is no text, or damaged";
            at(
                nul,
                message.to_owned(),
                "give a text file, or remove the byte",
            )
        });
    }
    let Some(wrong) = bytes.get(valid).copied() else {
        return String::from_utf8(bytes)
            .map_err(|e| CaseError::new(name, "", 0..0, e.to_string(), Some(SAVE.to_owned())));
    };
    // Letters of Latin-1 begin at 0xa0; Windows-1252 has signs below.
    let letter = match wrong {
        0xa0..=0xff => format!(" (in Latin-1 \"{}\")", char::from(wrong)),
        _ => String::new(),
    };
    Err(at(
        valid,
        format!(
            "byte 0x{wrong:02x}{letter} is not UTF-8: the file is in another encoding, such as Latin-1 or Windows-1252, or no text"
        ),
        SAVE,
    ))
}

impl Case {
    /// A path of the case, relative to the folder of its file.
    #[must_use]
    pub fn resolve(&self, path: &Path) -> PathBuf {
        self.file.parent().unwrap_or(Path::new("")).join(path)
    }

    /// An error at a place of this case.
    #[must_use]
    pub fn error(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        help: Option<String>,
    ) -> CaseError {
        CaseError::new(
            &self.file.display().to_string(),
            &self.source,
            span,
            message,
            help,
        )
    }
}
