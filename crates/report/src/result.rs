//! The result of a run, read back.

use std::path::{Path, PathBuf};

use hdf5::types::VarLenUnicode;
use hdf5::{Group, H5Type, Location};

use crate::error::ReportError;

type Outcome<T> = Result<T, ReportError>;

/// Rows of a quantity over time: one column a storey or level.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Row after row.
    pub values: Vec<f64>,
    /// Columns.
    pub columns: usize,
}

impl Table {
    /// One column.
    pub fn column(&self, index: usize) -> impl Iterator<Item = f64> + '_ {
        self.values
            .iter()
            .skip(index)
            .step_by(self.columns.max(1))
            .copied()
    }
}

/// Peaks of one quantity of all storeys, with and without pounding, with their times (s).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StoreyPeaks {
    /// With pounding.
    pub value: Vec<f64>,
    /// Times of these (s).
    pub time: Vec<f64>,
    /// Of the building without any gap.
    pub isolated: Vec<f64>,
    /// Times of these (s).
    pub isolated_time: Vec<f64>,
}

/// One building.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingResult {
    /// Name.
    pub name: String,
    /// Elevation of every floor (m), bottom first.
    pub elevation: Vec<f64>,
    /// Floor displacement relative to the ground (m).
    pub displacement: Table,
    /// Peak displacement (m).
    pub displacement_peaks: StoreyPeaks,
    /// Peak drift ratio (-).
    pub drift_peaks: StoreyPeaks,
    /// Peak storey shear (N).
    pub shear_peaks: StoreyPeaks,
    /// Peak absolute acceleration (m/s2).
    pub acceleration_peaks: StoreyPeaks,
    /// Ductility of every storey (-), where any has a law; NaN where there is no yield force.
    pub ductility: Option<Vec<f64>>,
    /// Natural periods (s).
    pub period: Vec<f64>,
    /// Modal damping ratios (-).
    pub damping_ratio: Vec<f64>,
}

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq, H5Type)]
#[repr(C)]
pub struct ImpactResult {
    /// Level from 1, bottom first.
    pub level: u64,
    /// Time of closure (s).
    pub t_close: f64,
    /// Time of separation (s).
    pub t_open: f64,
    /// Approach velocity (m/s).
    pub approach_velocity: f64,
    /// Separation velocity (m/s).
    pub separation_velocity: f64,
    /// Achieved restitution (-).
    pub achieved_restitution: f64,
    /// Peak force (N); NaN for velocity jumps.
    pub peak_force: f64,
    /// Its time (s).
    pub peak_force_time: f64,
    /// Peak penetration (m).
    pub peak_penetration: f64,
    /// Impulse (N s).
    pub impulse: f64,
    /// Dissipated energy (J).
    pub energy_dissipated: f64,
    /// Constants of the model.
    pub constants: [f64; 4],
}

/// One gap.
#[derive(Debug, Clone, PartialEq)]
pub struct GapResult {
    /// Name.
    pub name: String,
    /// What stands on both sides, `left | right`.
    pub between: String,
    /// Impact model; empty without levels.
    pub model: String,
    /// Rule of separation.
    pub separation: String,
    /// Elevation of every level (m), bottom first.
    pub elevation: Vec<f64>,
    /// Width at rest (m).
    pub width: Vec<f64>,
    /// Penetration (m), negative while the gap is open.
    pub penetration: Table,
    /// Contact force (N).
    pub force: Table,
    /// Impacts in order of closure.
    pub impacts: Vec<ImpactResult>,
}

/// One link.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkResult {
    /// Name.
    pub name: String,
    /// Law.
    pub law: String,
    /// Elevation of every level (m).
    pub elevation: Vec<f64>,
    /// Peak deformation (m).
    pub deformation: Vec<f64>,
    /// Peak force (N).
    pub force: Vec<f64>,
    /// Energy dissipated by the end (J).
    pub energy_dissipated: Vec<f64>,
}

/// Energies over time (J).
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyHistory {
    /// Work of the ground motion.
    pub input: Vec<f64>,
    /// Kinetic energy.
    pub kinetic: Vec<f64>,
    /// Recoverable energy.
    pub strain: Vec<f64>,
    /// Dissipated by damping.
    pub viscous: Vec<f64>,
    /// Dissipated by storeys with laws and by links.
    pub hysteretic: Vec<f64>,
    /// Dissipated in contacts.
    pub impact: Vec<f64>,
}

/// All that a page shows of a result file.
#[derive(Debug, Clone, PartialEq)]
pub struct RunResult {
    /// Title of the case.
    pub title: String,
    /// Program version that ran it.
    pub version: String,
    /// Text of the case.
    pub case: String,
    /// Hash of the text.
    pub case_sha256: String,
    /// Hash of the record.
    pub record_sha256: String,
    /// What was read and done to the record, line by line.
    pub record: String,
    /// Method of integration.
    pub method: String,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Steps taken.
    pub steps: u64,
    /// Time that the run took (s).
    pub wall_time: f64,
    /// Largest residual of the energy over the largest input energy (-).
    pub residual_ratio: f64,
    /// Output times (s).
    pub time: Vec<f64>,
    /// Ground acceleration (m/s2).
    pub ground_acceleration: Vec<f64>,
    /// Buildings by name.
    pub buildings: Vec<BuildingResult>,
    /// Gaps by name.
    pub gaps: Vec<GapResult>,
    /// Links by name.
    pub links: Vec<LinkResult>,
    /// Energies.
    pub energy: EnergyHistory,
}

impl RunResult {
    /// Reads a result file.
    ///
    /// # Errors
    /// A file that is no HDF5 or no result of a run, and parts of it that are missing or
    /// have another shape.
    pub fn read(path: &Path) -> Outcome<Self> {
        let unreadable = |reason: String| ReportError::Unreadable {
            path: path.to_owned(),
            reason,
        };
        // HDF5 says at length what the operating system says in a word.
        std::fs::File::open(path).map_err(|e| unreadable(e.to_string()))?;
        let file = hdf5::File::open(path).map_err(|_| unreadable("it is not HDF5".to_owned()))?;
        let reader = Reader {
            path: path.to_owned(),
        };
        reader.is_a_result(&file)?;
        let [energy, run, ground] = ["energy", "run", "ground"].map(|g| reader.group(&file, g));
        let (energy, run, ground) = (energy?, run?, ground?);
        let warnings = reader.text(&run, "warnings")?;
        let time = reader.column(&file, "time")?;
        Ok(Self {
            title: reader.text(&file, "title")?,
            version: reader.text(&file, "version")?,
            case: reader.text(&file, "case")?,
            case_sha256: reader.text(&file, "case_sha256")?,
            record_sha256: reader.text(&file, "record_sha256")?,
            record: reader.text(&ground, "record")?,
            method: reader.text(&run, "method")?,
            warnings: warnings.lines().map(str::to_owned).collect(),
            steps: reader.scalar(&run, "steps")?,
            wall_time: reader.scalar(&run, "wall_time")?,
            residual_ratio: reader.scalar(&energy, "residual_ratio")?,
            ground_acceleration: reader.column(&ground, "acceleration")?,
            buildings: reader.members(&file, "building", |g, name| reader.building(g, name))?,
            gaps: reader.members(&file, "gap", |g, name| reader.gap(g, name))?,
            links: reader.members(&file, "link", |g, name| reader.link(g, name))?,
            energy: EnergyHistory {
                input: reader.column(&energy, "input")?,
                kinetic: reader.column(&energy, "kinetic")?,
                strain: reader.column(&energy, "strain")?,
                viscous: reader.column(&energy, "viscous")?,
                hysteretic: reader.column(&energy, "hysteretic")?,
                impact: reader.column(&energy, "impact")?,
            },
            time,
        })
    }
}

/// Reads, and says what could not be read.
struct Reader {
    path: PathBuf,
}

impl Reader {
    /// Whether the file is the finished result of a run.
    fn is_a_result(&self, file: &hdf5::File) -> Outcome<()> {
        let not = |found: &str| ReportError::NotAResult {
            path: self.path.clone(),
            found: found.to_owned(),
        };
        if !matches!(self.text(file, "program"), Ok(program) if program == "pounding") {
            return Err(not("its attribute `program` does not say pounding"));
        }
        if !file.link_exists("building") || !file.link_exists("energy") {
            return Err(not("it has no buildings and energies over time"));
        }
        match self.text(file, "status") {
            Ok(status) if status == "complete" => Ok(()),
            _ => Err(not("its attribute `status` does not say complete")),
        }
    }

    fn failed(&self, object: &str) -> impl FnOnce(hdf5::Error) -> ReportError {
        let (path, object) = (self.path.clone(), object.to_owned());
        move |e| ReportError::Damaged {
            path,
            object,
            reason: e.to_string(),
        }
    }

    fn text(&self, place: &Location, name: &str) -> Outcome<String> {
        let read = || place.attr(name)?.read_scalar::<VarLenUnicode>();
        let object = format!("attribute {name} of {}", place.name());
        read().map(|t| t.to_string()).map_err(self.failed(&object))
    }

    fn scalar<T: H5Type>(&self, place: &Location, name: &str) -> Outcome<T> {
        let object = format!("attribute {name} of {}", place.name());
        let read = || place.attr(name)?.read_scalar::<T>();
        read().map_err(self.failed(&object))
    }

    fn group(&self, parent: &Group, name: &str) -> Outcome<Group> {
        parent
            .group(name)
            .map_err(self.failed(&format!("{}/{name}", parent.name())))
    }

    fn column(&self, parent: &Group, name: &str) -> Outcome<Vec<f64>> {
        let read = || parent.dataset(name)?.read_raw::<f64>();
        read().map_err(self.failed(&format!("{}/{name}", parent.name())))
    }

    fn table(&self, parent: &Group, name: &str) -> Outcome<Table> {
        let read = || {
            let data = parent.dataset(name)?;
            let shape = data.shape();
            let [_, columns] = shape[..] else {
                return Err(hdf5::Error::from(format!("{} dimensions", shape.len())));
            };
            Ok(Table {
                values: data.read_raw::<f64>()?,
                columns,
            })
        };
        read().map_err(self.failed(&format!("{}/{name}", parent.name())))
    }

    /// All groups in one of them; none where it is absent.
    fn members<T>(
        &self,
        file: &hdf5::File,
        name: &str,
        read: impl Fn(&Group, String) -> Outcome<T>,
    ) -> Outcome<Vec<T>> {
        if !file.link_exists(name) {
            return Ok(Vec::new());
        }
        let all = self.group(file, name)?;
        let names = all.member_names().map_err(self.failed(name))?;
        let one = |name: String| read(&self.group(&all, &name)?, name);
        names.into_iter().map(one).collect()
    }

    fn building(&self, group: &Group, name: String) -> Outcome<BuildingResult> {
        let peaks = self.group(group, "peak")?;
        let of = |quantity: &str| -> Outcome<StoreyPeaks> {
            let part = |name: String| self.column(&peaks, &name);
            Ok(StoreyPeaks {
                value: part(quantity.to_owned())?,
                time: part(format!("{quantity}_time"))?,
                isolated: part(format!("isolated_{quantity}"))?,
                isolated_time: part(format!("isolated_{quantity}_time"))?,
            })
        };
        let ductility = peaks
            .link_exists("ductility")
            .then(|| self.column(&peaks, "ductility"));
        Ok(BuildingResult {
            name,
            elevation: self.column(group, "storey")?,
            displacement: self.table(group, "displacement")?,
            displacement_peaks: of("displacement")?,
            drift_peaks: of("drift_ratio")?,
            shear_peaks: of("storey_shear")?,
            acceleration_peaks: of("acceleration_absolute")?,
            ductility: ductility.transpose()?,
            period: self.column(group, "period")?,
            damping_ratio: self.column(group, "damping_ratio")?,
        })
    }

    fn gap(&self, group: &Group, name: String) -> Outcome<GapResult> {
        let elevation = self.column(group, "level")?;
        // A gap without levels has no model.
        let word = |name: &str| match elevation.is_empty() {
            true => Ok(String::new()),
            false => self.text(group, name),
        };
        let impacts = || group.dataset("impacts")?.read_raw::<ImpactResult>();
        let object = format!("{}/impacts", group.name());
        Ok(GapResult {
            name,
            between: self.text(group, "between")?,
            model: word("model")?,
            separation: word("separation")?,
            width: self.column(group, "width")?,
            penetration: self.table(group, "penetration")?,
            force: self.table(group, "force")?,
            impacts: impacts().map_err(self.failed(&object))?,
            elevation,
        })
    }

    fn link(&self, group: &Group, name: String) -> Outcome<LinkResult> {
        let dissipated = self.table(group, "energy_dissipated")?;
        let columns = 0..dissipated.columns;
        let last = |i: usize| dissipated.column(i).last().unwrap_or(f64::NAN);
        Ok(LinkResult {
            name,
            law: self.text(group, "law")?,
            elevation: self.column(group, "level")?,
            deformation: self.column(group, "peak/deformation")?,
            force: self.column(group, "peak/force")?,
            energy_dissipated: columns.map(last).collect(),
        })
    }
}
