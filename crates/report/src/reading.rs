//! The result of a run, read back.

use std::path::{Path, PathBuf};

use hdf5::{Group, H5Type, Location};
use pounding_files::checksum::{ABSENT, Checksum, WithoutChecksum};
use pounding_results::watch::Reading;
use pounding_results::{ResultFile, number, read_all, text, texts, value, values};

use crate::error::ReportError;
use crate::result::{
    BaseMoment, BuildingResult, EnergyHistory, FrameResult, GapResult, ImpactResult,
    IsolatorResult, LevelResponses, LevelResult, LinkResult, NamedResponse, RunResult, StoreyPeaks,
    Table,
};

type Outcome<T> = Result<T, ReportError>;

/// Names of responses with their units.
type NamesAndUnits = Vec<(String, String)>;

impl RunResult {
    /// Reads a result file whose checksum matches; one without a checksum only if that is
    /// accepted, and then with a warning among those of the run.
    ///
    /// # Errors
    /// A file that is not as it was written, that is no HDF5 or no result of a run, and
    /// parts of it that are missing or have another shape.
    pub fn read(path: &Path, without: WithoutChecksum) -> Outcome<Self> {
        let _reading = Reading::of(path);
        let opened = ResultFile::open(path, without).map_err(|source| ReportError::Unreadable {
            path: path.to_owned(),
            source,
        })?;
        let file = opened.file();
        if opened.checksum() == Checksum::Absent {
            read_all(file).map_err(|e| ReportError::Damaged {
                path: path.to_owned(),
                object: "a part of it".to_owned(),
                reason: e.to_string(),
            })?;
        }
        Self::of_file(file, path, opened.checksum())
    }

    /// The same of a file that is open, or lives in memory; `path` names it in messages.
    ///
    /// # Errors
    /// A file that is no result of a run, and parts of it that are missing or have another
    /// shape.
    pub fn of_file(file: &hdf5::File, path: &Path, checksum: Checksum) -> Outcome<Self> {
        let reader = Reader {
            path: path.to_owned(),
        };
        reader.is_a_result(file)?;
        let [energy, run, ground] = ["energy", "run", "ground"].map(|g| reader.group(file, g));
        let (energy, run, ground) = (energy?, run?, ground?);
        let warnings = reader.text(&run, "warnings")?;
        let mut warnings: Vec<String> = warnings.lines().map(str::to_owned).collect();
        if checksum == Checksum::Absent {
            warnings.push(format!("the result file {ABSENT}"));
        }
        let time = reader.column(file, "time")?;
        let ground_acceleration = reader.column(&ground, "acceleration")?;
        Ok(Self {
            title: reader.text(file, "title")?,
            version: reader.text(file, "version")?,
            case: reader.text(file, "case")?,
            case_sha256: reader.text(file, "case_sha256")?,
            record_sha256: reader.text(file, "record_sha256")?,
            record: reader.text(&ground, "record")?,
            method: reader.text(&run, "method")?,
            warnings,
            checksum,
            steps: reader.scalar(&run, "steps")?,
            wall_time: reader.scalar(&run, "wall_time")?,
            residual_ratio: reader.scalar(&energy, "residual_ratio")?,
            buildings: reader.members(file, "building", |g, name| {
                reader.building(g, name, &ground_acceleration)
            })?,
            ground_acceleration,
            gaps: reader.members(file, "gap", |g, name| reader.gap(g, name))?,
            links: reader.members(file, "link", |g, name| reader.link(g, name))?,
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

/// Names of buildings, gaps or links in the order of a case: those of gaps and links without one
/// are made of the names between which they are.
fn names_in(case: &str, list: &str) -> Vec<String> {
    let case = case.parse::<toml::Table>().unwrap_or_default();
    let items = case.get(list).and_then(toml::Value::as_array);
    let name = |item: &toml::Value| {
        if let Some(name) = item.get("name") {
            return name.as_str().map(str::to_owned);
        }
        let between = item.get("between")?.as_array()?.iter();
        let between: Vec<&str> = between.filter_map(toml::Value::as_str).collect();
        Some(between.join("-"))
    };
    items.into_iter().flatten().filter_map(name).collect()
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
        let object = format!("attribute {name} of {}", place.name());
        text(place, name).map_err(self.failed(&object))
    }

    fn scalar<T: H5Type + Copy>(&self, place: &Location, name: &str) -> Outcome<T> {
        let object = format!("attribute {name} of {}", place.name());
        number(place, name).map_err(self.failed(&object))
    }

    fn group(&self, parent: &Group, name: &str) -> Outcome<Group> {
        parent
            .group(name)
            .map_err(self.failed(&format!("{}/{name}", parent.name())))
    }

    fn column<T: H5Type>(&self, parent: &Group, name: &str) -> Outcome<Vec<T>> {
        values(parent, name).map_err(self.failed(&format!("{}/{name}", parent.name())))
    }

    fn table(&self, parent: &Group, name: &str) -> Outcome<Table> {
        let read = || {
            let shape = parent.dataset(name)?.shape();
            let [_, columns] = shape[..] else {
                return Err(hdf5::Error::from(format!("{} dimensions", shape.len())));
            };
            Ok(Table {
                values: values(parent, name)?,
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
        let mut names = all.member_names().map_err(self.failed(name))?;
        // HDF5 has them by name; the case has them from left to right.
        let case = self.text(file, "case")?;
        let known = names_in(&case, name);
        names.sort_by_key(|n| {
            let place = known.iter().position(|known| known == n);
            let found = case.find(&format!("\"{n}\""));
            (place.unwrap_or(usize::MAX), found.unwrap_or(usize::MAX))
        });
        let one = |name: String| read(&self.group(&all, &name)?, name);
        names.into_iter().map(one).collect()
    }

    /// A building; `ground` is the acceleration of the ground under those without a motion of
    /// their own.
    fn building(&self, group: &Group, name: String, ground: &[f64]) -> Outcome<BuildingResult> {
        let peaks = self.group(group, "peak")?;
        let of = |quantity: &str| -> Outcome<StoreyPeaks> {
            let part = |name: String| self.column(&peaks, &name);
            Ok(StoreyPeaks {
                value: part(quantity.to_owned())?,
                isolated: part(format!("isolated_{quantity}"))?,
            })
        };
        let ductility = peaks
            .link_exists("ductility")
            .then(|| self.column(&peaks, "ductility"));
        let building = BuildingResult {
            name,
            elevation: self.column(group, "storey")?,
            on_moving_ground: self.moves(group, ground)?,
            pushed: group.link_exists("applied_force"),
            displacement: self.table(group, "displacement")?,
            displacement_peaks: of("displacement")?,
            drift_peaks: of("drift_ratio")?,
            shear_peaks: of("storey_shear")?,
            acceleration_peaks: of("acceleration_absolute")?,
            base_moment: self.base_moment(&peaks)?,
            responses: self.responses(&peaks)?,
            isolator: self.isolator(group)?,
            ductility: ductility.transpose()?,
            frames: self.frames(group)?,
            period: self.column(group, "period")?,
            damping_ratio: self.column(group, "damping_ratio")?,
        };
        let storeys = building.elevation.len();
        let peaks = [
            &building.displacement_peaks,
            &building.drift_peaks,
            &building.shear_peaks,
            &building.acceleration_peaks,
        ];
        let whole = |p: &&StoreyPeaks| p.value.len() == storeys && p.isolated.len() == storeys;
        let fits =
            storeys > 0 && building.displacement.columns == storeys && peaks.iter().all(whole);
        self.fits(group, fits)?;
        Ok(building)
    }

    /// Whether the ground under a building moves, along the row or across it.
    fn moves(&self, building: &Group, common: &[f64]) -> Outcome<bool> {
        let own = |name: &str| {
            let known = building.link_exists(name);
            known.then(|| self.column(building, name)).transpose()
        };
        let along = own("ground_acceleration")?;
        let across = own("ground_acceleration_across")?.unwrap_or_default();
        let mut both = along.as_deref().unwrap_or(common).iter().chain(&across);
        Ok(both.any(|a| *a != 0.0))
    }

    /// The isolators, of a building that has some.
    fn frames(&self, building: &Group) -> Outcome<Vec<FrameResult>> {
        if !building.link_exists("frames") {
            return Ok(Vec::new());
        }
        let group = self.group(building, "frames")?;
        let (directions, laws) = (self.text(&group, "directions")?, self.text(&group, "laws")?);
        let (at, storeys) = (
            self.column::<f64>(&group, "at")?,
            self.column::<i32>(&group, "storey")?,
        );
        let peaks = self.group(&group, "peak")?;
        let peak = |name: &str| self.column::<f64>(&peaks, name);
        let (force, force_time) = (peak("force")?, peak("force_time")?);
        let (deformation, ductility) = (peak("deformation")?, peak("ductility")?);
        let residual = peak("residual_deformation")?;
        let words = directions.split(' ').zip(laws.split(' '));
        let made = words.enumerate().map(|(i, (direction, law))| {
            Some(FrameResult {
                direction: direction.to_owned(),
                at: *at.get(i)?,
                storey: usize::try_from(*storeys.get(i)?).ok()?,
                law: law.to_owned(),
                force: *force.get(i)?,
                force_time: *force_time.get(i)?,
                deformation: *deformation.get(i)?,
                ductility: *ductility.get(i)?,
                residual_deformation: *residual.get(i)?,
            })
        });
        let made: Option<Vec<_>> = made.collect();
        made.filter(|frames| frames.len() == at.len())
            .ok_or_else(|| self.failed(&group.name())("lists of different lengths".into()))
    }

    fn isolator(&self, building: &Group) -> Outcome<Option<IsolatorResult>> {
        if !building.link_exists("isolator") {
            return Ok(None);
        }
        let group = self.group(building, "isolator")?;
        let one = |name: &str| -> Outcome<f64> {
            value(&group, name).map_err(self.failed(&format!("{}/{name}", group.name())))
        };
        Ok(Some(IsolatorResult {
            model: self.text(&group, "model")?,
            displacement: one("displacement")?,
            isolated_displacement: one("isolated_displacement")?,
            force: one("force")?,
            isolated_force: one("isolated_force")?,
            effective_period: one("effective_period")?,
            effective_damping_ratio: one("effective_damping_ratio")?,
        }))
    }

    /// The peak of the base moment, of a building that has one.
    fn base_moment(&self, peaks: &Group) -> Outcome<Option<BaseMoment>> {
        if !peaks.link_exists("base_moment") {
            return Ok(None);
        }
        let one = |name: &str| -> Outcome<f64> {
            value(peaks, name).map_err(self.failed(&format!("{}/{name}", peaks.name())))
        };
        Ok(Some(BaseMoment {
            value: one("base_moment")?,
            time: one("base_moment_time")?,
            isolated: one("isolated_base_moment")?,
        }))
    }

    /// Peaks of the responses with names of a building.
    fn responses(&self, peaks: &Group) -> Outcome<Vec<NamedResponse>> {
        let Some((group, names)) = self.names_of_responses(peaks, "response")? else {
            return Ok(Vec::new());
        };
        let one = |name: &str| -> Outcome<f64> {
            value(&group, name).map_err(self.failed(&format!("{}/{name}", group.name())))
        };
        let made = names.into_iter().map(|(name, unit)| {
            Ok(NamedResponse {
                unit,
                value: one(&name)?,
                time: one(&format!("{name}_time"))?,
                isolated: one(&format!("isolated_{name}"))?,
                name,
            })
        });
        made.collect()
    }

    /// Peaks of the responses of levels, by name.
    fn level_responses(&self, gap: &Group) -> Outcome<Vec<LevelResponses>> {
        let Some((group, names)) = self.names_of_responses(gap, "response/peak")? else {
            return Ok(Vec::new());
        };
        let made = names.into_iter().map(|(name, unit)| {
            Ok(LevelResponses {
                unit,
                value: self.column(&group, &name)?,
                time: self.column(&group, &format!("{name}_time"))?,
                capacity: match format!("{name}_capacity") {
                    known if group.link_exists(&known) => self.column(&group, &known)?,
                    _ => Vec::new(),
                },
                name,
            })
        });
        made.collect()
    }

    /// The group of that path, with names and units of what has a peak there; `None` if there is
    /// no such group.
    fn names_of_responses(
        &self,
        parent: &Group,
        path: &str,
    ) -> Outcome<Option<(Group, NamesAndUnits)>> {
        if !parent.link_exists("response") {
            return Ok(None);
        }
        let group = self.group(parent, path)?;
        let members = group.member_names().map_err(self.failed(&group.name()))?;
        let timed = members.iter().filter_map(|name| name.strip_suffix("_time"));
        let names = timed.filter(|name| !name.starts_with("isolated_"));
        let mut found = Vec::new();
        for name in names {
            let object = format!("{}/{name}", group.name());
            let data = group.dataset(name).map_err(self.failed(&object))?;
            found.push((name.to_owned(), self.text(&data, "units")?));
        }
        Ok(Some((group, found)))
    }

    /// Levels of a gap or a link.
    fn levels(&self, group: &Group) -> Outcome<Vec<LevelResult>> {
        let object = format!("{}/level", group.name());
        if !group.link_exists("left_elevation") {
            // Versions before knew the elevation of the left floor alone, and levels by
            // their number.
            let elevations = self.column(group, "level")?.into_iter().enumerate();
            return Ok(elevations
                .map(|(l, elevation)| LevelResult {
                    label: (l + 1).to_string(),
                    elevations: [elevation, f64::NAN],
                })
                .collect());
        }
        let labels = texts(group, "level").map_err(self.failed(&object))?;
        let left = self.column(group, "left_elevation")?;
        let right = self.column(group, "right_elevation")?;
        self.fits(
            group,
            left.len() == labels.len() && right.len() == labels.len(),
        )?;
        let sides = left.into_iter().zip(right);
        let level = |(label, (left, right))| LevelResult {
            label,
            elevations: [left, right],
        };
        Ok(labels.into_iter().zip(sides).map(level).collect())
    }

    fn gap(&self, group: &Group, name: String) -> Outcome<GapResult> {
        let levels = self.levels(group)?;
        // A gap without levels has no model.
        let word = |name: &str| match levels.is_empty() {
            true => Ok(String::new()),
            false => self.text(group, name),
        };
        let impacts = || values::<ImpactResult>(group, "impacts");
        let object = format!("{}/impacts", group.name());
        let clearance = group
            .link_exists("clearance")
            .then(|| self.column(group, "clearance"));
        let gap = GapResult {
            name,
            between: self.text(group, "between")?,
            model: word("model")?,
            separation: word("separation")?,
            width: self.column(group, "width")?,
            clearance: clearance.transpose()?,
            penetration: self.table(group, "penetration")?,
            force: self.table(group, "force")?,
            impacts: impacts().map_err(self.failed(&object))?,
            responses: self.level_responses(group)?,
            levels,
        };
        let levels = gap.levels.len();
        let known = |i: &ImpactResult| (1..=levels as u64).contains(&i.level);
        let fits = gap.width.len() == levels
            && gap.penetration.columns == levels
            && gap.force.columns == levels
            && gap.clearance.as_ref().is_none_or(|c| c.len() == levels)
            && gap.impacts.iter().all(known)
            && (gap.responses.iter()).all(|r| {
                let known = [0, levels].contains(&r.capacity.len());
                known && r.value.len() == levels && r.time.len() == levels
            });
        self.fits(group, fits)?;
        Ok(gap)
    }

    /// Refuses a group whose parts do not fit one another.
    fn fits(&self, group: &Group, fits: bool) -> Outcome<()> {
        match fits {
            true => Ok(()),
            false => Err(self.failed(&group.name())(hdf5::Error::from(
                "its parts do not have the same storeys or levels",
            ))),
        }
    }

    fn link(&self, group: &Group, name: String) -> Outcome<LinkResult> {
        let dissipated = self.table(group, "energy_dissipated")?;
        let columns = 0..dissipated.columns;
        let last = |i: usize| dissipated.column(i).last().unwrap_or(f64::NAN);
        let unit = |name: &str| {
            let object = format!("{}/{name}", group.name());
            let data = group.dataset(name).map_err(self.failed(&object))?;
            self.text(&data, "units")
        };
        Ok(LinkResult {
            units: [unit("deformation")?, unit("force")?],
            name,
            law: self.text(group, "law")?,
            levels: self.levels(group)?,
            deformation: self.column(group, "peak/deformation")?,
            deformation_time: self.column(group, "peak/deformation_time")?,
            force: self.column(group, "peak/force")?,
            force_time: self.column(group, "peak/force_time")?,
            deformations: self.table(group, "deformation")?,
            forces: self.table(group, "force")?,
            energy_dissipated: columns.map(last).collect(),
        })
    }
}
