//! The gap check for machines: SI units, full precision.

use pounding_separation::Requirement;
use pounding_study::gap_check::{
    self, CodeGap, CombinationGap, GapCheck, GapReport, GapRun, GapSweep, MeanSpectrum,
    RecordDemand, SuiteSpectrum,
};
use pounding_time_history::{BuildingOutcome, LevelPlace, NamedPeak};
use serde::Serialize;

use super::provisions::Descriptor;
use super::text::rigid;

/// The object that `gap --json` prints.
#[derive(Serialize)]
pub struct Check<'c> {
    adequate: bool,
    /// The code that decides; `null` where the demand does.
    decided_by_code: Option<&'c str>,
    /// The day on which the edition of that code is in force, where it was chosen by that;
    /// `null` else.
    date: Option<String>,
    target_probability: f64,
    confidence: f64,
    /// Whether velocities jump at impacts: accelerations leave that out.
    rigid_impacts: bool,
    warnings: &'c [String],
    /// Records without those that are copies of others.
    distinct_records: usize,
    records: Vec<Record<'c>>,
    /// Records under which a building collapses without contact; `records` is without them.
    collapsed: &'c [gap_check::CollapsedRecord],
    spectra: Spectra<'c>,
    gaps: Vec<Gap<'c>>,
    sweep: Option<Sweep<'c>>,
}

impl<'c> Check<'c> {
    /// All of a check.
    pub fn of(check: &'c GapCheck) -> Self {
        Self {
            adequate: check.adequate(),
            decided_by_code: check
                .gaps
                .iter()
                .find_map(|g| g.code.as_ref().map(|c| c.code.name.as_str())),
            date: check
                .gaps
                .iter()
                .find_map(|g| g.code.as_ref()?.date.map(|date| date.to_string())),
            target_probability: check.options.target_probability,
            confidence: check.options.confidence,
            rigid_impacts: rigid(check),
            warnings: &check.warnings,
            distinct_records: check.repeated.distinct,
            records: check.records.iter().map(Record::of).collect(),
            collapsed: &check.collapsed,
            spectra: Spectra::of(&check.spectra),
            gaps: (0..check.gaps.len()).map(|i| Gap::of(check, i)).collect(),
            sweep: check.sweep.as_ref().map(Sweep::of),
        }
    }
}

/// Pseudo-accelerations of the records as they are used.
#[derive(Serialize)]
struct Spectra<'c> {
    damping: f64,
    /// Names, with those under which a building collapses.
    records: &'c [String],
    periods: &'c [f64],
    /// By record.
    pseudo_acceleration: &'c [Vec<f64>],
    mean: &'c [f64],
    target: Option<Target<'c>>,
}

/// The spectrum to which the records are scaled.
#[derive(Serialize)]
struct Target<'c> {
    name: &'c str,
    from: f64,
    to: f64,
    /// Why these periods; empty where the case gives them.
    band_reason: &'c str,
    pseudo_acceleration: &'c [Option<f64>],
    least_ratio_of_mean: f64,
    period_of_least_ratio: f64,
    greatest_ratio_of_mean: f64,
    period_of_greatest_ratio: f64,
}

impl<'c> Spectra<'c> {
    fn of(spectra: &'c gap_check::SuiteSpectra) -> Self {
        Self {
            damping: spectra.damping,
            records: &spectra.names,
            periods: &spectra.periods,
            pseudo_acceleration: &spectra.records,
            mean: &spectra.mean,
            target: spectra.target.as_ref().map(|t| Target {
                name: &t.name,
                from: t.band.0,
                to: t.band.1,
                band_reason: &t.band_reason,
                pseudo_acceleration: &t.values,
                least_ratio_of_mean: t.least.0,
                period_of_least_ratio: t.least.1,
                greatest_ratio_of_mean: t.greatest.0,
                period_of_greatest_ratio: t.greatest.1,
            }),
        }
    }
}

/// A maximum and when it occurs.
#[derive(Serialize)]
struct Peak {
    peak: f64,
    time: f64,
}

impl Peak {
    fn of(peak: &pounding_time_history::Peak) -> Self {
        Self {
            peak: peak.value,
            time: peak.time,
        }
    }
}

/// What pounding does to the maxima of a storey.
#[derive(Serialize)]
struct Amplification {
    displacement: f64,
    storey_shear: f64,
    acceleration_absolute: f64,
}

impl Amplification {
    fn of_all(buildings: &[Vec<gap_check::Amplification>]) -> Vec<Vec<Self>> {
        let storey = |a: &gap_check::Amplification| Self {
            displacement: a.displacement,
            storey_shear: a.storey_shear,
            acceleration_absolute: a.acceleration_absolute,
        };
        let buildings = buildings.iter();
        buildings
            .map(|storeys| storeys.iter().map(storey).collect())
            .collect()
    }
}

/// A building without its neighbours under one record.
#[derive(Serialize)]
struct Isolated<'c> {
    name: &'c str,
    displacement: Vec<Peak>,
    inelastic_storeys: Vec<Inelastic>,
}

/// A storey that left its elastic range.
#[derive(Serialize)]
struct Inelastic {
    storey: usize,
    ductility: Option<f64>,
}

impl<'c> Isolated<'c> {
    fn of(building: &'c BuildingOutcome) -> Self {
        let storeys = building.storeys.iter();
        let inelastic = building.inelastic_storeys().into_iter();
        let inelastic = inelastic.map(|(storey, ductility)| Inelastic {
            storey: storey + 1,
            ductility,
        });
        Self {
            name: &building.name,
            displacement: storeys.map(|s| Peak::of(&s.displacement)).collect(),
            inelastic_storeys: inelastic.collect(),
        }
    }
}

/// What one record does.
#[derive(Serialize)]
struct Record<'c> {
    name: &'c str,
    factor: f64,
    peak_ground_acceleration: f64,
    isolated: Vec<Isolated<'c>>,
    amplification: Option<Vec<Vec<Amplification>>>,
    /// By gap and level.
    impacts: Option<Vec<Vec<usize>>>,
    failure: Option<&'c str>,
    /// The building that collapsed, if that is why.
    #[serde(skip_serializing_if = "Option::is_none")]
    collapsed: Option<&'c str>,
}

impl<'c> Record<'c> {
    fn of(record: &'c RecordDemand) -> Self {
        let impacts = record.pounding.as_ref().ok().map(|(_, gaps)| {
            let levels = gaps.iter().map(|g| g.levels.iter().map(|l| l.impacts));
            levels.map(Iterator::collect).collect()
        });
        let failure = record.pounding.as_ref().err().map(String::as_str);
        Self {
            name: &record.name,
            factor: record.factor,
            peak_ground_acceleration: record.peak_ground_acceleration,
            isolated: record.isolated.iter().map(Isolated::of).collect(),
            amplification: record.amplification().map(|a| Amplification::of_all(&a)),
            impacts,
            failure,
            collapsed: failure.and_then(gap_check::collapsed_building),
        }
    }
}

/// A gap under all records.
#[derive(Serialize)]
struct Gap<'c> {
    name: &'c str,
    between: &'c [String; 2],
    adequate: bool,
    records_in_contact: usize,
    records_driven_by_neighbours: usize,
    records_at_demand: usize,
    contact_probability_bounds: (f64, f64),
    governing_level: usize,
    /// `null` where records that collapse decide.
    governing: Option<Governing<'c>>,
    demand: &'c [f64],
    suite: Suite,
    code: Option<Code<'c>>,
    levels: Vec<Level<'c>>,
    required: Required,
    combinations: Vec<Combination>,
    provisions: Vec<Provision<'c>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    columns: Vec<Column<'c>>,
    /// Seat of the deck, and how far its joint opens at the provided widths.
    #[serde(skip_serializing_if = "Option::is_none")]
    seat: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    openings: Option<Vec<Opening<'c>>>,
}

/// What decides the verdict: width and demand at the level of the least margin.
#[derive(Serialize)]
struct Governing<'c> {
    level: usize,
    record: &'c str,
    required: f64,
    provided: f64,
    margin: f64,
}

/// How far a joint with a seat opens at a level, at most.
#[derive(Serialize)]
struct Opening<'c> {
    level: usize,
    record: &'c str,
    #[serde(flatten)]
    opening: Peak,
}

/// Maximum shear of the columns that are hit at a level.
#[derive(Serialize)]
struct Column<'c> {
    level: usize,
    record: &'c str,
    demand_over_capacity: Option<f64>,
    #[serde(flatten)]
    shear: &'c NamedPeak,
}

/// A contact level with its demand under each record.
#[derive(Serialize)]
struct Level<'c> {
    width: f64,
    demand: Vec<Peak>,
    /// Of the ground on both sides, under each record: what widths by rules hold beside the
    /// rule. Absent where one motion is under both.
    #[serde(skip_serializing_if = "Option::is_none")]
    relative_ground_displacement: Option<Vec<Peak>>,
    /// Beside a building on isolators.
    #[serde(skip_serializing_if = "Option::is_none")]
    isolation: Option<Isolation<'c>>,
    #[serde(flatten)]
    place: &'c LevelPlace,
}

/// A building on isolators beside a level.
#[derive(Serialize)]
struct Isolation<'c> {
    building: &'c str,
    /// Width less demand under each record; negative where it falls short.
    clearance: Vec<f64>,
    /// Peak force on the wall or the neighbour under each record; `null` where the run failed
    /// or impacts are jumps of the velocity.
    force: Vec<Option<f64>>,
}

impl<'c> Isolation<'c> {
    fn of(check: &'c GapCheck, index: usize, l: usize) -> Option<Self> {
        let level = &check.gaps[index].levels[l];
        let building = level.on_isolators.as_deref()?;
        let records = check.records.iter();
        let demand = records.clone().map(|r| r.demand[index][l].value);
        Some(Self {
            building,
            clearance: demand.map(|demand| level.width - demand).collect(),
            force: records.map(|r| r.peak_force(index, l)).collect(),
        })
    }
}

/// Statistics of the demand over the records.
#[derive(Serialize)]
struct Suite {
    minimum: f64,
    p16: f64,
    median: f64,
    p84: f64,
    maximum: f64,
    mean: f64,
    standard_deviation: f64,
}

impl Suite {
    fn of(s: &gap_check::SuiteStatistics) -> Self {
        Self {
            minimum: s.minimum,
            p16: s.p16,
            median: s.median,
            p84: s.p84,
            maximum: s.maximum,
            mean: s.mean,
            standard_deviation: s.standard_deviation,
        }
    }
}

/// The answer of the code that decides.
#[derive(Serialize)]
struct Code<'c> {
    name: &'c str,
    edition: &'c str,
    in_force: Option<&'c str>,
    superseded_by: Option<&'static str>,
    statistic: &'static str,
    statistic_rule: String,
    statistic_clause: &'static str,
    statistic_status: &'static str,
    /// Whether displacements under the records count in any of its widths.
    /// `null` where no level has a width.
    takes_records: Option<bool>,
    enough_records: bool,
    /// `null` where nothing is known of what the code asks of the mean spectrum.
    spectrum: Option<CodeSpectrum>,
    /// Statistic of the demand.
    demand: f64,
    /// Ownership that the case states.
    ownership: Option<&'static str>,
    satisfied: Option<bool>,
    cases: Vec<CodeCase<'c>>,
}

/// What the code asks of the mean spectrum of the records, and how that compares.
#[derive(Serialize)]
struct CodeSpectrum {
    at_least: f64,
    clause: &'static str,
    /// `null` where the records are not scaled to the spectrum of the code.
    is_reached: Option<bool>,
    band: Option<(f64, f64)>,
    least_ratio: Option<f64>,
    period_of_least_ratio: Option<f64>,
    ratio_of_peaks: Option<f64>,
    /// The least factor on all records with which they are what the code asks for.
    factor: Option<f64>,
}

impl CodeSpectrum {
    fn of(found: &SuiteSpectrum) -> Option<Self> {
        let (condition, mean) = match found {
            SuiteSpectrum::NotKnown => return None,
            SuiteSpectrum::NotCompared { condition, .. } => (condition, None),
            SuiteSpectrum::Compared(mean) => (&mean.condition, Some(mean)),
        };
        Some(Self {
            at_least: condition.at_least,
            clause: condition.clause,
            is_reached: mean.map(MeanSpectrum::is_reached),
            band: mean.map(|m| m.band),
            least_ratio: mean.map(|m| m.least.0),
            period_of_least_ratio: mean.map(|m| m.least.1),
            ratio_of_peaks: mean.and_then(|m| m.zero_period),
            factor: mean.map(MeanSpectrum::factor),
        })
    }
}

/// A width of a provision, unless texts on it differ.
fn decided(requirement: &Requirement) -> Option<f64> {
    requirement.readings.is_empty().then_some(requirement.width)
}

/// The width by one reading of a disputed provision.
#[derive(Serialize)]
struct Reading<'c> {
    text: &'c str,
    width: f64,
}

impl<'c> Reading<'c> {
    fn of_all(requirement: &'c Requirement) -> Vec<Self> {
        let readings = requirement.readings.iter();
        let readings = readings.map(|r| Self {
            text: r.text,
            width: r.width,
        });
        readings.collect()
    }
}

/// The answer of a code for one kind of ownership.
#[derive(Serialize)]
struct CodeCase<'c> {
    ownership: Option<&'static str>,
    satisfied: Option<bool>,
    governing_level: Option<usize>,
    /// At the governing level.
    required: Option<f64>,
    provided: Option<f64>,
    refusal: Option<String>,
    /// What else is to be known of the provisions that govern.
    remarks: Vec<&'static str>,
    /// What makes the gap too small under any records, where the widths that take them are no answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    short_anyway: Option<ShortAnyway<'c>>,
    levels: Vec<CodeLevel<'c>>,
}

/// A width that takes no displacements, at its level.
#[derive(Serialize)]
struct ShortAnyway<'c> {
    level: usize,
    provision: &'c str,
    required: f64,
}

/// The width of a code at a level.
#[derive(Serialize)]
#[serde(untagged)]
enum CodeLevel<'c> {
    Required {
        provision: Box<Descriptor>,
        /// Across a property line that of the other building, where it goes by another one.
        #[serde(skip_serializing_if = "Option::is_none")]
        other_provision: Option<Box<Descriptor>>,
        displacement: [Option<f64>; 2],
        /// `null` for a disputed provision, whose readings stand beside it.
        required: Option<f64>,
        #[serde(skip_serializing_if = "Vec::is_empty")]
        readings: Vec<Reading<'c>>,
        provided: f64,
        satisfied: Option<bool>,
        explanation: &'c str,
        caution: Option<&'c str>,
    },
    Refused {
        refusal: String,
    },
}

impl<'c> Code<'c> {
    fn of(answer: &'c gap_check::CodeAnswer) -> Self {
        let suite = &answer.code.suite;
        Self {
            name: &answer.code.name,
            edition: &answer.code.edition,
            in_force: answer.code.in_force.as_deref(),
            superseded_by: answer.code.superseded_by,
            statistic: answer.statistic.name(),
            statistic_rule: suite.explanation(),
            statistic_clause: suite.clause,
            statistic_status: suite.status.name(),
            takes_records: answer.has_widths().then(|| answer.takes_records()),
            enough_records: answer.enough_records,
            spectrum: CodeSpectrum::of(&answer.spectrum),
            demand: answer.demand,
            ownership: answer.ownership.map(|o| o.name()),
            satisfied: answer.satisfied(),
            cases: answer.cases.iter().map(CodeCase::of).collect(),
        }
    }
}

impl<'c> CodeCase<'c> {
    fn of(case: &'c gap_check::OwnershipAnswer) -> Self {
        let governing = case.governing();
        let level = |level: &'c Result<gap_check::LevelAnswer, _>| match level {
            Ok(answer) => CodeLevel::Required {
                provision: Box::new(Descriptor::of(&answer.width.provision)),
                other_provision: answer
                    .width
                    .beside
                    .as_ref()
                    .map(|p| Box::new(Descriptor::of(p))),
                displacement: answer.displacement,
                required: decided(&answer.width.requirement),
                readings: Reading::of_all(&answer.width.requirement),
                provided: answer.provided,
                satisfied: answer.satisfied(),
                explanation: &answer.width.requirement.explanation,
                caution: answer.width.requirement.caution.as_deref(),
            },
            Err(e) => CodeLevel::Refused {
                refusal: ToString::to_string(e),
            },
        };
        Self {
            ownership: case.ownership.map(|o| o.name()),
            satisfied: case.satisfied(),
            governing_level: governing.map(|(l, _)| l + 1),
            required: governing.and_then(|(_, l)| decided(&l.width.requirement)),
            provided: governing.map(|(_, l)| l.provided),
            refusal: case.refusal().map(ToString::to_string),
            remarks: governing.map_or(Vec::new(), |(_, l)| {
                l.width
                    .provisions()
                    .flat_map(|p| p.remarks())
                    .copied()
                    .collect()
            }),
            short_anyway: case.falls_short_anyway().map(|(level, least)| ShortAnyway {
                level: level + 1,
                provision: least.provision.name(),
                required: least.width,
            }),
            levels: case.levels.iter().map(level).collect(),
        }
    }
}

/// The width that the target probability asks for.
#[derive(Serialize)]
struct Required {
    /// `null` where buildings collapse without contact under more records than may touch.
    by_count: Option<f64>,
    allowed_contacts: usize,
    lognormal: Option<Lognormal>,
    no_lognormal: Option<&'static str>,
}

/// A lognormal distribution of the demand.
#[derive(Serialize)]
struct Lognormal {
    median: f64,
    dispersion: f64,
    width: f64,
    bounds: (f64, f64),
}

impl<'c> Gap<'c> {
    fn of(check: &'c GapCheck, index: usize) -> Self {
        let gap = &check.gaps[index];
        let level = |(l, level): (usize, &'c gap_check::GapLevel)| Level {
            width: level.width,
            demand: check
                .records
                .iter()
                .map(|r| Peak::of(&r.demand[index][l]))
                .collect(),
            relative_ground_displacement: (check.records.iter())
                .map(|r| Some(Peak::of(r.relative_ground_displacement[index][l].as_ref()?)))
                .collect(),
            isolation: Isolation::of(check, index, l),
            place: &level.place,
        };
        let fit = gap.required.lognormal.as_ref();
        Self {
            name: &gap.name,
            between: &gap.between,
            adequate: gap.adequate,
            records_in_contact: gap.records_in_contact,
            records_driven_by_neighbours: gap.records_driven,
            records_at_demand: gap.records_at_demand,
            contact_probability_bounds: gap.contact_bounds,
            governing_level: gap.governing.level + 1,
            governing: gap.required.by_count.map(|_| Governing {
                level: gap.governing.level + 1,
                record: &check.records[gap.governing.record].name,
                required: gap.governing.required,
                provided: gap.governing.provided,
                margin: gap.governing.margin(),
            }),
            columns: (gap.columns.iter())
                .map(|c| Column {
                    level: c.level + 1,
                    record: &check.records[c.record].name,
                    demand_over_capacity: c.response.demand_ratio(),
                    shear: &c.response,
                })
                .collect(),
            seat: gap.seat,
            openings: gap.seat.map(|_| {
                let found = gap.openings.iter().map(|o| Opening {
                    level: o.level + 1,
                    record: &check.records[o.record].name,
                    opening: Peak::of(&o.response.peak),
                });
                found.collect()
            }),
            demand: &gap.demand,
            suite: Suite::of(&gap.suite),
            code: gap.code.as_ref().map(Code::of),
            levels: gap.levels.iter().enumerate().map(level).collect(),
            required: Required {
                by_count: gap.required.by_count,
                allowed_contacts: gap.required.allowed_contacts,
                lognormal: fit.ok().map(|f| Lognormal {
                    median: f.median,
                    dispersion: f.dispersion,
                    width: f.width,
                    bounds: f.bounds,
                }),
                no_lognormal: fit.err().copied(),
            },
            combinations: gap
                .combinations
                .iter()
                .map(|c| Combination::of(gap, c))
                .collect(),
            provisions: gap.codes.iter().map(|c| Provision::of(gap, c)).collect(),
        }
    }
}

/// A combination rule, with its widths by record and level.
#[derive(Serialize)]
struct Combination {
    rule: &'static str,
    /// Name with its abbreviation.
    title: String,
    effective_properties: Option<&'static str>,
    status: &'static str,
    correlation: Option<f64>,
    width: Vec<Vec<f64>>,
    satisfied: Option<bool>,
}

impl Combination {
    fn of(gap: &GapReport, c: &CombinationGap) -> Self {
        let widths = c.records.iter();
        let widths = widths.map(|levels| levels.iter().map(|l| l.width).collect());
        Self {
            rule: c.rule.name(),
            title: c.rule.title(c.effective.map(|e| e.name())),
            effective_properties: c.effective.map(|e| e.name()),
            status: c.status.name(),
            correlation: c.correlation,
            width: widths.collect(),
            satisfied: c.satisfied_by(&gap.levels),
        }
    }
}

/// A provision, with what it asks for under each record.
#[derive(Serialize)]
struct Provision<'c> {
    #[serde(flatten)]
    descriptor: Descriptor,
    refusal: Option<String>,
    caution: Option<&'c str>,
    satisfied: Option<bool>,
    records: Vec<OfRecord<'c>>,
}

/// What a provision asks for under one record.
#[derive(Serialize)]
struct OfRecord<'c> {
    /// The maximum over the levels.
    width: Option<f64>,
    /// The least over the levels of the width there to the demand there.
    ratio_to_demand: Option<f64>,
    levels: Vec<OfLevel<'c>>,
}

/// What a provision asks for at one level.
#[derive(Serialize)]
#[serde(untagged)]
enum OfLevel<'c> {
    Required {
        /// `null` for a disputed provision, whose readings stand beside it.
        width: Option<f64>,
        #[serde(skip_serializing_if = "Vec::is_empty")]
        readings: Vec<Reading<'c>>,
        explanation: &'c str,
        caution: Option<&'c str>,
    },
    Refused {
        refusal: String,
    },
}

impl<'c> Provision<'c> {
    fn of(gap: &GapReport, c: &'c CodeGap) -> Self {
        let level = |result: &'c Result<Requirement, _>| match result {
            Ok(r) => OfLevel::Required {
                width: decided(r),
                readings: Reading::of_all(r),
                explanation: &r.explanation,
                caution: r.caution.as_deref(),
            },
            Err(e) => OfLevel::Refused {
                refusal: ToString::to_string(e),
            },
        };
        let records = c.records.iter().enumerate().map(|(r, levels)| {
            let decides = !c.is_disputed();
            let at = |level| c.width_at(r, level).filter(|_| decides);
            OfRecord {
                width: c.width(r).filter(|_| decides),
                // What closes a gap says nothing of a seat.
                ratio_to_demand: (gap.ratio_to_demand(r, at)).filter(|_| !c.is_of_seat()),
                levels: levels.iter().map(level).collect(),
            }
        });
        Self {
            descriptor: Descriptor::of(&c.provision),
            refusal: c.refusal().map(ToString::to_string),
            caution: c.caution(),
            satisfied: c.satisfied_by(&gap.levels, gap.seat),
            records: records.collect(),
        }
    }
}

/// Runs of a sweep of widths, by width and record.
#[derive(Serialize)]
struct Sweep<'c> {
    gap: Option<&'c str>,
    widths: &'c [f64],
    runs: Vec<Vec<Run<'c>>>,
}

/// One run of a sweep.
#[derive(Serialize)]
#[serde(untagged)]
enum Run<'c> {
    Made {
        amplification: Vec<Vec<Amplification>>,
        /// In the gap whose width varies, or in all of them.
        #[serde(flatten)]
        contact: Contact,
        /// In each gap of the case.
        gaps: Vec<Contact>,
    },
    Failed {
        failure: &'c str,
        /// The building that collapsed, if that is why.
        #[serde(skip_serializing_if = "Option::is_none")]
        collapsed: Option<&'c str>,
    },
}

/// What happened in one gap of a run, or in several.
#[derive(Serialize)]
struct Contact {
    impacts: usize,
    peak_force: f64,
    impact_energy: f64,
}

impl Contact {
    fn of(run: GapRun) -> Self {
        Self {
            impacts: run.impacts,
            peak_force: run.peak_force,
            impact_energy: run.impact_energy,
        }
    }
}

impl<'c> Sweep<'c> {
    fn of(sweep: &'c GapSweep) -> Self {
        let run = |run: &'c Result<gap_check::SweepRun, String>| match run {
            Ok(run) => Run::Made {
                amplification: Amplification::of_all(&run.amplification),
                contact: Contact::of(sweep.contact(run)),
                gaps: run.gaps.iter().copied().map(Contact::of).collect(),
            },
            Err(failure) => Run::Failed {
                failure,
                collapsed: gap_check::collapsed_building(failure),
            },
        };
        let runs = sweep.runs.iter();
        Self {
            gap: sweep.gap.as_deref(),
            widths: &sweep.widths,
            runs: runs
                .map(|records| records.iter().map(run).collect())
                .collect(),
        }
    }
}
