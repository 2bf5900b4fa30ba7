//! Gaps by code and by combination rules, beside the demand.

use std::sync::Arc;

use pounding_case::{Case, CaseError, Located, Separation};
use pounding_separation::{
    Code, CombinationRule, Date, EffectiveProperties, Oscillator, OwnRule, Ownership, Place,
    Provision, Requirement, SeparationError, Site, Situation, SoilZone, StructuralSystem,
    Structure, Verification, YieldingOscillator, choose_code, code_in_country, codes,
    correlation_coefficient, descriptors, find,
};
use pounding_shear_building::{EDGE_DISPLACEMENTS, ShearBuilding, are_level};
use pounding_time_history::{BuildingOutcome, Gap, System};

use super::SAME;
use super::demand::{GapLevel, RecordDemand};
use super::error::CheckError;

/// A gap by one provision.
#[derive(Debug, Clone)]
pub struct CodeGap {
    /// The provision.
    pub provision: Provision,
    /// What it requires for each record and level, or why it says nothing.
    pub records: Vec<Vec<Result<Requirement, SeparationError>>>,
}

impl CodeGap {
    /// Why the provision says nothing at any level under any record, or why it has no value at
    /// some level where it applies: what it says at others decides nothing then. `None` if it does.
    #[must_use]
    pub fn refusal(&self) -> Option<&SeparationError> {
        let mut results = self.records.iter().flatten();
        let errors = results.clone().filter_map(|r| r.as_ref().err());
        if let Some(error) = errors.clone().find(|e| e.is_without_value()) {
            return Some(error);
        }
        if results.clone().any(Result::is_ok) {
            return None;
        }
        results.find_map(|r| r.as_ref().err())
    }

    /// Why the widths of the provision decide nothing under some record: it is a rule for
    /// elastic displacements, and a building yields. `None` if they hold under all.
    #[must_use]
    pub fn caution(&self) -> Option<&str> {
        let mut required = self.records.iter().flatten().flatten();
        required.find_map(|r| r.caution.as_deref())
    }

    /// Whether the texts on the provision differ, so that its widths decide nothing.
    #[must_use]
    pub fn is_disputed(&self) -> bool {
        !self.provision.status().readings().is_empty()
    }

    /// Whether its widths are held against what is provided: not those with a caution, or of a
    /// disputed provision.
    #[must_use]
    pub fn judges(&self) -> bool {
        self.caution().is_none() && !self.is_disputed()
    }

    /// Whether its widths are those of a seat, which what closes a gap says nothing of.
    #[must_use]
    pub fn is_of_seat(&self) -> bool {
        self.provision.place() == Place::Seat
    }

    /// Whether what is provided is no less than what is required at any level under any record: of a
    /// provision of seats the seat, of any other the width of the gap. `None` if nothing is, and for a
    /// provision that does not judge.
    #[must_use]
    pub fn satisfied_by(&self, levels: &[GapLevel], seat: Option<f64>) -> Option<bool> {
        if !self.judges() || self.refusal().is_some() {
            return None;
        }
        let provided = |level: &GapLevel| match self.is_of_seat() {
            true => seat,
            false => Some(level.width),
        };
        let records = self.records.iter();
        let pairs = records.flat_map(|r| r.iter().zip(levels));
        let known = pairs.filter_map(|(r, l)| Some((r.as_ref().ok()?.width, provided(l)?)));
        satisfied(known)
    }

    /// Width by one reading of a disputed provision at a level for one record (m).
    #[must_use]
    pub fn width_by_reading(&self, record: usize, level: usize, reading: usize) -> Option<f64> {
        let requirement = self.requirement(record, level)?;
        Some(requirement.readings.get(reading)?.width)
    }

    /// Width at a level for one record (m).
    #[must_use]
    pub fn width_at(&self, record: usize, level: usize) -> Option<f64> {
        if self.refusal().is_some() {
            return None;
        }
        Some(self.requirement(record, level)?.width)
    }

    /// Width for one record (m): the maximum over the levels.
    #[must_use]
    pub fn width(&self, record: usize) -> Option<f64> {
        let levels = self.records.get(record)?.len();
        let widths = (0..levels).filter_map(|level| self.width_at(record, level));
        widths.reduce(f64::max)
    }

    fn requirement(&self, record: usize, level: usize) -> Option<&Requirement> {
        self.records.get(record)?.get(level)?.as_ref().ok()
    }
}

/// A gap by one combination rule.
#[derive(Debug, Clone, PartialEq)]
pub struct CombinationGap {
    /// The rule.
    pub rule: CombinationRule,
    /// How period and damping of yielding buildings came about; `None` for elastic ones.
    pub effective: Option<EffectiveProperties>,
    /// How far rule and effective properties have been checked, together.
    pub status: Verification,
    /// Correlation coefficient (-); `None` where the rule needs none.
    pub correlation: Option<f64>,
    /// Width for each record and level (m).
    pub records: Vec<Vec<LevelCombination>>,
}

impl CombinationGap {
    /// Whether these provided widths are no less than the rule's at any level under any
    /// record; `None` without records.
    #[must_use]
    pub fn satisfied_by(&self, levels: &[GapLevel]) -> Option<bool> {
        let records = self.records.iter();
        let pairs = records.flat_map(|r| r.iter().zip(levels));
        satisfied(pairs.map(|(c, l)| (c.width, l.width)))
    }
}

/// Whether every provided width (second) reaches the required one.
fn satisfied(pairs: impl Iterator<Item = (f64, f64)>) -> Option<bool> {
    let reaches = |(required, provided): (f64, f64)| provided >= required * (1.0 - SAME);
    pairs.map(reaches).reduce(|a, b| a && b)
}

/// A combination at one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelCombination {
    /// Peak displacement of the isolated left building (m).
    pub left: f64,
    /// Peak displacement of the isolated right building (m).
    pub right: f64,
    /// Width (m): that of the rule, and the relative displacement of the ground.
    pub width: f64,
}

/// One gap of a system.
pub(crate) struct GapPlace<'a> {
    pub system: &'a System,
    pub gap: usize,
}

impl GapPlace<'_> {
    pub(super) fn gap(&self) -> &Gap {
        &self.system.gaps()[self.gap]
    }

    /// Building and storey (from zero) on both sides of each level; `None` is a wall.
    pub(super) fn levels(&self) -> Vec<[Option<(usize, usize)>; 2]> {
        let gap = self.gap();
        let levels = self.system.levels_of(gap).iter();
        levels
            .map(|l| l.between.map(|floor| self.system.storey_of(floor)))
            .collect()
    }

    /// Peak displacement (m) of an isolated building where it meets a level, on the left (0) or the
    /// right (1), at this building and storey: of floors that turn, that at the contact point.
    /// Exact at the edges of such a floor; between them no less than it, as the sum of the parts that
    /// both edges have in it.
    pub(super) fn displacement(
        &self,
        (level, side): (usize, usize),
        (building, storey): (usize, usize),
        isolated: &BuildingOutcome,
    ) -> f64 {
        let of_floor = isolated.storeys[storey].displacement.value;
        let between = self.system.levels_of(self.gap())[level].between;
        let Some(point) = self.system.point(between[side]) else {
            return of_floor;
        };
        let edge = |name: &str| {
            let name = format!("{name}_{}", storey + 1);
            let rows = self.system.buildings()[building].responses().iter();
            let row = rows.clone().find(|r| r.name == name)?;
            let peak = isolated.responses.iter().find(|r| r.name == name)?;
            Some((&row.weights, peak.peak.value))
        };
        let [Some((low, lower)), Some((high, upper))] = EDGE_DISPLACEMENTS.map(edge) else {
            return of_floor;
        };
        let turns = low.iter().zip(high).position(|(a, b)| a != b);
        let share = turns.map_or(0.0, |i| {
            let weights = point.weights.iter();
            let own: f64 = weights.filter(|w| w.0 == i).map(|w| w.1).sum();
            (own - low[i]) / (high[i] - low[i])
        });
        (1.0 - share).abs() * lower + share.abs() * upper
    }

    /// Provided width of a level (m).
    pub(super) fn width(&self, level: usize) -> f64 {
        self.system.levels_of(self.gap())[level].width
    }

    /// Whether all floors face floors: every floor of either building, up to the lower of the two
    /// roofs, one of the other.
    fn floors_aligned(&self) -> bool {
        let levels = self.levels();
        let Some([Some((left, _)), Some((right, _))]) = levels.first() else {
            return false;
        };
        let buildings = self.system.buildings();
        let [a, b] = [left, right].map(|i| buildings[*i].elevations());
        let tolerance = self.gap().elevation_tolerance;
        let roof = [a, b].map(|floors| floors.last().copied().unwrap_or(0.0));
        let lower_roof = roof[0].min(roof[1]);
        let faced = |own: &[f64], other: &[f64]| {
            let mut facing = own
                .iter()
                .filter(|z| **z <= lower_roof || are_level(**z, lower_roof, tolerance));
            facing.all(|z| other.iter().any(|o| are_level(*z, *o, tolerance)))
        };
        faced(a, b) && faced(b, a)
    }
}

/// What the case says, in the terms of provisions.
pub(crate) struct Inputs<'a> {
    separation: &'a Separation,
    systems: Option<Vec<StructuralSystem>>,
    soil_zone: Option<SoilZone>,
    /// Whether the case says which buildings stand on isolators: those alone have their
    /// properties then, whatever is given for all.
    isolators: bool,
}

impl<'a> Inputs<'a> {
    pub(crate) fn of(case: &Case, separation: &'a Separation) -> Result<Self, CheckError> {
        let systems = separation.structural_system.as_ref();
        let systems = systems.map(|all| all.iter().map(|name| system_of(case, name)).collect());
        let zone = separation.soil_zone.as_ref();
        Ok(Self {
            systems: systems.transpose()?,
            soil_zone: zone.map(|name| zone_of(case, name)).transpose()?,
            isolators: case.buildings.iter().any(|b| b.isolator.is_some()),
            separation,
        })
    }

    /// Who owns the ground, if the case says it.
    pub(super) fn ownership(&self) -> Option<Ownership> {
        self.separation.same_owner.map(|same| match same {
            true => Ownership::SameProperty,
            false => Ownership::DifferentProperties,
        })
    }

    /// With the relative displacement of the ground (m) on both sides of a level.
    pub(super) fn site(&self, place: &GapPlace<'_>, relative_ground_displacement: f64) -> Site {
        let s = self.separation;
        let intensity = s.fortification_intensity;
        Site {
            floors_aligned: s.floors_aligned.or_else(|| Some(place.floors_aligned())),
            same_owner: s.same_owner,
            // One that no byte holds is as wrong as zero, which provisions refuse.
            fortification_intensity: intensity.map(|i| u8::try_from(i).unwrap_or(0)),
            soil_zone: self.soil_zone,
            design_ground_acceleration: s.design_ground_acceleration,
            seismic_coefficient: s.seismic_coefficient,
            spectral_acceleration_1s: s.spectral_acceleration_1s,
            neighbour_has_gap: s.neighbour_has_gap,
            relative_ground_displacement,
        }
    }

    /// A building where it meets a level, on the left (0) or the right (1), with its displacement
    /// there (m), and whether it yields.
    pub(super) fn structure(
        &self,
        place: &GapPlace<'_>,
        (level, side): (usize, usize),
        index: usize,
        (displacement, inelastic): (f64, bool),
    ) -> Structure {
        let building = &place.system.buildings()[index];
        let levels = place.system.levels_of(place.gap());
        let of = |list: &Option<Vec<f64>>| list.as_ref().and_then(|l| l.get(index)).copied();
        let systems = self.systems.as_ref();
        let may_be_isolated = building.isolator().is_some() || !self.isolators;
        let isolation_period = of(&self.separation.isolation_period).filter(|_| may_be_isolated);
        Structure {
            name: building.name().to_owned(),
            height: building.elevations().last().copied().unwrap_or(0.0),
            elevation: levels[level].place.elevations[side].unwrap_or(0.0),
            storeys: building.storeys(),
            displacement: Some(displacement),
            // Of the run that the displacement is taken from. Links that yield leave the
            // storeys elastic, and no code reduces forces for them.
            inelastic,
            elastic_displacement: None,
            base_moves: building.foundation().is_some(),
            // In a case without isolators the period of some says it.
            on_isolators: building.isolator().is_some() || isolation_period.is_some(),
            response_modification: of(&self.separation.response_modification),
            displacement_amplification: of(&self.separation.displacement_amplification),
            importance: of(&self.separation.importance),
            yield_amplification: of(&self.separation.yield_amplification),
            system: systems.and_then(|l| l.get(index)).copied(),
            isolation_period,
            isolation_damping_coefficient: of(&self.separation.isolation_damping_coefficient),
            plan_length: of(&self.separation.plan_length),
            plan_width: of(&self.separation.plan_width),
            plan_eccentricity: of(&self.separation.plan_eccentricity),
        }
    }
}

fn system_of(case: &Case, name: &Located<String>) -> Result<StructuralSystem, CheckError> {
    let found = known_system(&name.value);
    found.map_err(|(message, help)| unknown(case, name, message, Some(help)))
}

fn zone_of(case: &Case, name: &Located<String>) -> Result<SoilZone, CheckError> {
    let found = known_zone(&name.value);
    found.map_err(|(message, help)| unknown(case, name, message, Some(help)))
}

/// A structural system by its name, else what is wrong and what the names are.
fn known_system(name: &str) -> Result<StructuralSystem, (String, String)> {
    StructuralSystem::from_name(name).ok_or_else(|| {
        let known: Vec<_> = StructuralSystem::ALL.iter().map(|s| s.name()).collect();
        let message = format!("unknown structural system \"{name}\"");
        (message, format!("known ones are {}", known.join(", ")))
    })
}

/// The same of a zone.
fn known_zone(name: &str) -> Result<SoilZone, (String, String)> {
    SoilZone::from_name(name).ok_or_else(|| {
        let message = format!("unknown soil zone \"{name}\"");
        (message, "zones are I, II and III".to_owned())
    })
}

/// The first unknown structural system or soil zone of words that stand in a text of their own, under a name, as those of
/// an argument do.
#[must_use]
pub fn unknown_names(separation: &Separation, (file, text): (&str, &str)) -> Option<CaseError> {
    let systems = separation.structural_system.iter().flatten();
    let systems = systems.map(|name| (name, known_system(&name.value).err()));
    let zones = separation.soil_zone.iter();
    let zones = zones.map(|name| (name, known_zone(&name.value).err()));
    let wrong = systems
        .chain(zones)
        .find_map(|(name, wrong)| Some((name, wrong?)));
    let (name, (message, help)) = wrong?;
    Some(CaseError::new(
        file,
        text,
        name.span.clone(),
        message,
        Some(help),
    ))
}

/// What the user asks for, found: rules of their own, provisions, and what gives the verdict.
pub(crate) struct Chosen {
    /// Provisions to apply.
    pub provisions: Vec<Provision>,
    /// The code or rule whose answer is asked for.
    pub code: Option<Code>,
    /// The day by which its edition was chosen, if it was.
    pub date: Option<Date>,
}

impl Chosen {
    pub(crate) fn of(case: &Case, separation: &Separation) -> Result<Self, CheckError> {
        let own = own_rules(separation).map_err(|mut errors| errors.remove(0))?;
        let (code, date) = chosen_code(case, separation, &own)?;
        Ok(Self {
            provisions: chosen(case, separation, &own)?,
            code,
            date,
        })
    }
}

/// Rules of the user, compiled; else all that is wrong with them.
fn own_rules(separation: &Separation) -> Result<Vec<Provision>, Vec<CaseError>> {
    let (mut rules, mut errors) = (Vec::<Provision>::new(), Vec::new());
    for text in &separation.rules {
        let name = &text.name.value;
        let of_rule = |rule: &CombinationRule| {
            let beginning = name.split([' ', '(']).next();
            beginning == Some(rule.name()) || rule.abbreviation() == Some(name)
        };
        // In small letters, as all names of ours are: one that differs by its letters alone would be
        // taken for ours.
        let small = name.to_lowercase();
        let known = codes().iter().any(|c| c.name == small || c.family == small)
            || CombinationRule::ALL.iter().any(of_rule);
        let refuse = |message: String| {
            let help = Some("give the rule another name".to_owned());
            text.error(text.name.span.clone(), message, help)
        };
        if known || find(&small).is_ok() {
            errors.push(refuse(format!(
                "\"{name}\" is a provision, a code or a combination rule already"
            )));
        } else if rules.iter().any(|rule| rule.name() == name) {
            errors.push(refuse(format!("two rules are called \"{name}\"")));
        } else {
            match OwnRule::compile(text) {
                Ok(rule) => rules.push(Provision::Own(Arc::new(rule))),
                Err(e) => errors.push(e),
            }
        }
    }
    match errors.is_empty() {
        true => Ok(rules),
        false => Err(errors),
    }
}

/// What is wrong with rules of the user, with the text of the file that has them: the first such
/// file, with all that is wrong in it. `None` if nothing is.
#[must_use]
pub fn wrong_rules(separation: &Separation) -> Option<(CaseError, Arc<str>)> {
    let errors = own_rules(separation).err()?;
    let file = errors.first()?.file.clone();
    let rule = separation.rules.iter().find(|rule| *rule.file == *file)?;
    let of_file = errors.into_iter().filter(|e| e.file == file);
    Some((CaseError::of_all(of_file.collect())?, rule.source.clone()))
}

fn provision_of(
    case: &Case,
    name: &Located<String>,
    own: &[Provision],
) -> Result<Provision, CheckError> {
    if let Some(rule) = own.iter().find(|rule| rule.name() == name.value) {
        return Ok(rule.clone());
    }
    let found = find(&name.value).map(Provision::BuiltIn);
    found.map_err(|e| unknown(case, name, e.to_string(), e.help()))
}

/// The day that is given, or today.
fn date_of(case: &Case, separation: &Separation) -> Result<Date, CheckError> {
    let Some(text) = &separation.date else {
        return Ok(Date::today());
    };
    let date = text.value.parse::<Date>();
    date.map_err(|e| unknown(case, text, e.to_string(), e.help()))
}

/// The code or rule whose answer is asked for, if there is one, with the day that decided between
/// its editions.
fn chosen_code(
    case: &Case,
    separation: &Separation,
    own: &[Provision],
) -> Result<(Option<Code>, Option<Date>), CheckError> {
    if separation.country.is_none() && separation.code.is_none() && separation.date.is_none() {
        return Ok((None, None));
    }
    let date = date_of(case, separation)?;
    let wrong = |name, e: SeparationError| unknown(case, name, e.to_string(), e.help());
    if let Some(country) = &separation.country {
        let code = code_in_country(&country.value, date).map_err(|e| wrong(country, e))?;
        return Ok((Some(code.code()), Some(date)));
    }
    let Some(name) = &separation.code else {
        idle_date(case, separation, "no code is asked for", "name one with it")?;
        return Ok((None, None));
    };
    if let Some(rule) = own.iter().find(|rule| rule.name() == name.value) {
        let why = format!("the rule \"{}\" has no editions", name.value);
        idle_date(case, separation, &why, "leave it out")?;
        return Ok((Some(Code::of_rule(rule.clone())), None));
    }
    let (code, by_date) = choose_code(&name.value, date).map_err(|e| wrong(name, e))?;
    if by_date {
        return Ok((Some(code.code()), Some(date)));
    }
    let why = format!("\"{}\" is one edition", name.value);
    let mut editions = codes().iter().filter(|c| c.family == code.family);
    let help = if !editions.any(|c| c.is_chosen_by_dates()) {
        "leave it out".to_owned()
    } else {
        let family = code.family;
        format!("leave it out, or name \"{family}\", between whose editions a date chooses")
    };
    idle_date(case, separation, &why, &help)?;
    Ok((Some(code.code()), None))
}

/// The error of a code or country that is known on no day, beside a date that is none.
fn unknown_code(case: &Case, separation: &Separation) -> Option<CheckError> {
    date_of(case, separation).err()?;
    let today = Date::today();
    let (name, error) = match (&separation.country, &separation.code) {
        (Some(country), _) => (country, code_in_country(&country.value, today).err()?),
        (None, Some(code)) => (code, choose_code(&code.value, today).err()?),
        (None, None) => return None,
    };
    // What is in force depends on the day, which is not known.
    let of_day = matches!(
        error,
        SeparationError::NotInForce { .. }
            | SeparationError::DayNotKnown { .. }
            | SeparationError::SeveralCodes { .. }
    );
    (!of_day).then(|| unknown(case, name, error.to_string(), error.help()))
}

/// The error of a date that chooses between nothing. One in a case may wait for a code that an
/// argument names, and is not meant for an edition that an argument names.
fn idle_date(
    case: &Case,
    separation: &Separation,
    why: &str,
    help: &str,
) -> Result<(), CheckError> {
    let Some(date) = &separation.date else {
        return Ok(());
    };
    let of_case = |word: &Located<String>| stands_in(case, word);
    if of_case(date) && !separation.code.as_ref().is_some_and(of_case) {
        return Ok(());
    }
    let message = format!("the date {} decides nothing: {why}", date.value);
    Err(unknown(case, date, message, Some(help.to_owned())))
}

/// Every word of `[separation]` in a case that is not known or cannot be used: structural systems,
/// the soil zone, provisions, the code, the date, and what is wrong in rules of the user.
#[must_use]
pub fn unknown_words(case: &Case) -> Vec<CaseError> {
    let given = &case.separation;
    let systems = given.structural_system.iter().flatten();
    let systems = systems.filter_map(|name| system_of(case, name).err());
    let zone = given.soil_zone.iter();
    let zone = zone.filter_map(|name| zone_of(case, name).err());
    let own = own_rules(given);
    let rules = own.as_ref().err().into_iter().flatten().cloned();
    // What is chosen among rules that are wrong is not judged.
    let known = own.as_deref().unwrap_or_default();
    let of_own = |name: &Located<String>| given.rules.iter().any(|r| r.name.value == name.value);
    let provisions = given.provisions.iter().flatten().filter(|n| !of_own(n));
    let provisions = provisions.filter_map(|name| provision_of(case, name, known).err());
    let placed = |error| match error {
        CheckError::Case(error) => Some(error),
        _ => None,
    };
    let is_own = given.code.as_ref().is_some_and(of_own);
    let code = (!is_own).then(|| chosen_code(case, given, known).err());
    let undated = (!is_own).then(|| unknown_code(case, given)).flatten();
    let code = code.flatten().into_iter().chain(undated);
    let all = systems.chain(zone).chain(provisions).chain(code);
    all.filter_map(placed).chain(rules).collect()
}

/// Whether a word stands in the case, and not in an argument.
fn stands_in(case: &Case, word: &Located<String>) -> bool {
    let there = case.source.get(word.span.clone());
    there.is_some_and(|text| text.contains(&word.value))
}

/// A word that is not known: with its place if it stands in the case, and not in an
/// argument.
fn unknown(
    case: &Case,
    name: &Located<String>,
    message: String,
    help: Option<String>,
) -> CheckError {
    if stands_in(case, name) {
        case.error(name.span.clone(), message, help).into()
    } else {
        CheckError::Word { message, help }
    }
}

/// Provisions that the case names; without a list all and the user's own, but those for isolated
/// structures where there is none, and seats, which are no gaps.
fn chosen(
    case: &Case,
    separation: &Separation,
    own: &[Provision],
) -> Result<Vec<Provision>, CheckError> {
    let Some(names) = &separation.provisions else {
        // Without isolators in the case the period of some says it.
        let isolated = case.buildings.iter().any(|b| b.isolator.is_some())
            || separation.isolation_period.is_some();
        let all = descriptors().iter().copied();
        let speak = all
            .filter(|d| (isolated || !d.is_of_isolated_structures()) && d.place() != Place::Seat);
        let speak = speak.map(Provision::BuiltIn);
        return Ok(speak.chain(own.iter().cloned()).collect());
    };
    let names = names.iter();
    names.map(|name| provision_of(case, name, own)).collect()
}

/// What the provisions require for every record and level.
pub(crate) fn by_code(
    place: &GapPlace<'_>,
    chosen: &[Provision],
    inputs: &Inputs<'_>,
    records: &[RecordDemand],
) -> Vec<CodeGap> {
    let structure = |at: Option<(usize, usize)>, place_of, record: &RecordDemand| {
        at.map(|(index, storey)| {
            let isolated = &record.isolated[index];
            let displacement = place.displacement(place_of, (index, storey), isolated);
            let inelastic = !isolated.inelastic_storeys().is_empty();
            inputs.structure(place, place_of, index, (displacement, inelastic))
        })
    };
    let apply = |descriptor: &Provision, record: &RecordDemand, level: usize, sides: &[_; 2]| {
        let site = inputs.site(place, record.ground_moves(place.gap, level));
        let [left, right] = [0, 1].map(|side| structure(sides[side], (level, side), record));
        match (left, right) {
            (Some(left), Some(right)) => descriptor.between(&Situation { left, right, site }),
            (Some(one), None) | (None, Some(one)) => descriptor.boundary(&one, &site),
            (None, None) => Err(SeparationError::NotApplicable {
                provision: descriptor.name().to_owned(),
                reason: "the level lies between two walls".to_owned(),
                remedy: "no width is asked for there".to_owned(),
            }),
        }
    };
    let levels = place.levels();
    let for_record = |descriptor: &Provision, record: &RecordDemand| {
        let levels = levels.iter().enumerate();
        levels
            .map(|(level, sides)| apply(descriptor, record, level, sides))
            .collect()
    };
    chosen
        .iter()
        .map(|descriptor| CodeGap {
            provision: descriptor.clone(),
            records: records.iter().map(|r| for_record(descriptor, r)).collect(),
        })
        .collect()
}

/// Combination rules at every level; none beside a wall.
pub(crate) fn combinations(
    place: &GapPlace<'_>,
    inputs: &Inputs<'_>,
    records: &[RecordDemand],
) -> Result<Vec<CombinationGap>, CheckError> {
    let levels = place.levels();
    let sides = levels.iter().filter_map(|l| Some((l[0]?, l[1]?)));
    let sides: Vec<_> = sides.collect();
    let Some(&((left, _), (right, _))) = sides.first() else {
        return Ok(Vec::new());
    };
    let mut gaps = Vec::new();
    for (rule, effective) in rules(inputs) {
        let correlation = if rule == CombinationRule::DoubleDifference {
            Some(correlation(
                place,
                inputs,
                [left, right],
                effective,
                records,
            )?)
        } else {
            None
        };
        let peak = |r: &RecordDemand, of, at: (usize, usize)| {
            place.displacement(of, at, &r.isolated[at.0])
        };
        let at_levels = |r: &RecordDemand| {
            let both = sides.iter().enumerate();
            let level = both.map(|(level, (a, b))| {
                let (left, right) = (peak(r, (level, 0), *a), peak(r, (level, 1), *b));
                let by_rule = rule.gap(left, right, correlation.unwrap_or(0.0));
                LevelCombination {
                    left,
                    right,
                    width: by_rule + r.ground_moves(place.gap, level),
                }
            });
            level.collect()
        };
        let by_effective = effective.map(EffectiveProperties::status);
        gaps.push(CombinationGap {
            rule,
            effective,
            status: by_effective
                .filter(|s| !s.is_verified())
                .unwrap_or(rule.status()),
            correlation,
            records: records.iter().map(at_levels).collect(),
        });
    }
    Ok(gaps)
}

/// The rules, and for yielding buildings every way to effective properties.
fn rules(inputs: &Inputs<'_>) -> Vec<(CombinationRule, Option<EffectiveProperties>)> {
    let mut rules: Vec<_> = CombinationRule::ALL.map(|r| (r, None)).into();
    if inputs.separation.ductility.is_some() {
        rules.pop();
        let effective = EffectiveProperties::ALL.map(Some);
        rules.extend(effective.map(|e| (CombinationRule::DoubleDifference, e)));
    }
    rules
}

/// The correlation of the motion of two buildings: the least over the records, where isolators give
/// every record a period and a damping of its own.
fn correlation(
    place: &GapPlace<'_>,
    inputs: &Inputs<'_>,
    buildings: [usize; 2],
    effective: Option<EffectiveProperties>,
    records: &[RecordDemand],
) -> Result<f64, CheckError> {
    // Once for all records: on soil it is sought.
    let first = buildings.map(|b| first_mode(&place.system.buildings()[b]));
    let mut least = f64::INFINITY;
    for record in records {
        let of = |k: usize| {
            let b = buildings[k];
            oscillator(first[k], inputs, b, effective, &record.isolated[b])
        };
        least = least.min(correlation_coefficient(of(0)?, of(1)?)?);
    }
    Ok(least)
}

/// Period and damping of a building's fundamental mode along the row; on soil of the mode that `check` names, with the damping
/// of both.
fn first_mode(building: &ShearBuilding) -> Oscillator {
    let on_soil = building.foundation().and_then(|soil| soil.first_mode());
    let (modes, mode) = (building.modes(), building.fundamental_mode());
    on_soil.map_or(
        Oscillator {
            period: modes.period[mode],
            damping_ratio: modes.damping_ratio[mode],
        },
        |damped| Oscillator {
            period: damped.period,
            damping_ratio: damped.damping_ratio,
        },
    )
}

/// The oscillator that stands for a building: its fundamental mode, or an effective one if it yields or stands on isolators.
fn oscillator(
    first: Oscillator,
    inputs: &Inputs<'_>,
    building: usize,
    effective: Option<EffectiveProperties>,
    isolated: &BuildingOutcome,
) -> Result<Oscillator, CheckError> {
    let isolator = isolated.isolator.as_ref();
    if let Some(isolator) = isolator.filter(|i| i.effective_period > first.period) {
        return Ok(Oscillator {
            period: isolator.effective_period,
            damping_ratio: isolator.effective_damping_ratio,
        });
    }
    let list = inputs.separation.ductility.as_ref();
    let ductility = list.and_then(|l| l.get(building));
    match (effective, ductility) {
        (Some(effective), Some(ductility)) => Ok(effective.apply(&YieldingOscillator {
            period: first.period,
            damping_ratio: first.damping_ratio,
            ductility: *ductility,
            hardening: 0.0,
        })?),
        _ => Ok(first),
    }
}
