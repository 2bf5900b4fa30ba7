//! Demand of each record, and what pounding does at the provided gap.

use pounding_time_history::{
    BuildingOutcome, Gap, GapOutcome, LevelPlace, Peak, Recorder, System, TimeHistoryError,
    isolated_demand_beside, run,
};

use super::dealt::Numbers;
use super::error::CheckError;
use super::parallel::{Progress, runs_in_parallel};
use super::records::CaseUnderRecord;

/// A contact level of a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct GapLevel {
    /// Storeys and elevations of both floors.
    pub place: LevelPlace,
    /// Provided width (m).
    pub width: f64,
    /// The building on isolators beside it, if there is one.
    pub on_isolators: Option<String>,
}

/// Peaks with pounding over peaks of the isolated building, of one storey (-); infinite
/// where only the isolated storey does not move, and NaN where neither does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplification {
    /// Of the floor displacement.
    pub displacement: f64,
    /// Of the storey shear.
    pub storey_shear: f64,
    /// Of the absolute floor acceleration. The jumps of rigid impacts have none.
    pub acceleration_absolute: f64,
}

/// What pounding amplifies: its name, and its amplification.
pub type AmplifiedQuantity = (&'static str, fn(&Amplification) -> f64);

impl Amplification {
    /// Adds the numbers of each building and storey.
    pub(crate) fn to_numbers(all: &[Vec<Self>], numbers: &mut Vec<f64>) {
        numbers.push(all.len() as f64);
        for building in all {
            numbers.push(building.len() as f64);
            for a in building {
                numbers.extend([a.displacement, a.storey_shear, a.acceleration_absolute]);
            }
        }
    }

    /// Takes them back.
    pub(crate) fn from_numbers(numbers: &mut Numbers<'_>) -> Option<Vec<Vec<Self>>> {
        let storey = |numbers: &mut Numbers<'_>| {
            Some(Self {
                displacement: numbers.take()?,
                storey_shear: numbers.take()?,
                acceleration_absolute: numbers.take()?,
            })
        };
        numbers.list(|numbers| numbers.list(storey))
    }

    /// The same with one in the place of what is not known: where nothing moves with pounding or
    /// without, pounding raises nothing.
    #[cfg(feature = "results")]
    pub(crate) fn one_where_nothing_moves(self) -> Self {
        let known = |x: f64| if x.is_nan() { 1.0 } else { x };
        Self {
            displacement: known(self.displacement),
            storey_shear: known(self.storey_shear),
            acceleration_absolute: known(self.acceleration_absolute),
        }
    }

    /// Maximum over the storeys of a building, with its storey (from zero); `None` where no storey
    /// has one.
    #[must_use]
    pub fn of_storeys(storeys: &[Self], quantity: fn(&Self) -> f64) -> Option<(usize, f64)> {
        let known = storeys.iter().map(quantity).enumerate();
        let known = known.filter(|(_, x)| !x.is_nan());
        // Of equals the lowest storey.
        known.fold(None, |best, (i, x)| match best {
            Some((_, top)) if top >= x => best,
            _ => Some((i, x)),
        })
    }

    /// The quantities, in the order of tables and pictures.
    pub const QUANTITIES: [AmplifiedQuantity; 3] = [
        ("displacement", |a| a.displacement),
        ("storey shear", |a| a.storey_shear),
        ("absolute acceleration", |a| a.acceleration_absolute),
    ];
}

/// One record.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordDemand {
    /// Name.
    pub name: String,
    /// What the recorded values were multiplied by (-).
    pub factor: f64,
    /// Peak ground acceleration as used (m/s2).
    pub peak_ground_acceleration: f64,
    /// Width that the record would just not close, for each gap and level (m).
    pub demand: Vec<Vec<Peak>>,
    /// Displacement of the ground on the left relative to that on the right, for each gap and
    /// level (m): a part of the demand, and what is added to widths by rules. `None` where one
    /// motion is under both sides.
    pub relative_ground_displacement: Vec<Vec<Option<Peak>>>,
    /// Peaks of the buildings, with their links, if no gap could close.
    pub isolated: Vec<BuildingOutcome>,
    /// Peaks of buildings and gaps at the provided widths, or why there are none.
    pub pounding: Result<(Vec<BuildingOutcome>, Vec<GapOutcome>), String>,
}

impl RecordDemand {
    /// Whether a gap closed in the run at the provided widths; false if that run failed.
    #[must_use]
    pub fn closed(&self, gap: usize) -> bool {
        self.pounding
            .as_ref()
            .is_ok_and(|(_, gaps)| closes(&gaps[gap]))
    }

    /// Whether the isolated buildings approach each other by more than the width of a level.
    #[must_use]
    pub fn demand_exceeds(&self, gap: usize, level: usize, width: f64) -> bool {
        self.demand[gap][level].value > width
    }

    /// Whether the gap closed in the run though its demand is no more than the width of any level, and no other gap did:
    /// the width is the demand to the last digits, which steps that are not exact miss by round-off.
    #[must_use]
    pub fn closed_at_demand(&self, gap: usize, levels: &[GapLevel]) -> bool {
        let mut all = levels.iter().enumerate();
        let exceeds = all.any(|(l, level)| self.demand_exceeds(gap, l, level.width));
        let Ok((_, gaps)) = &self.pounding else {
            return false;
        };
        let mut others = gaps.iter().enumerate().filter(|(other, _)| *other != gap);
        !exceeds && closes(&gaps[gap]) && !others.any(|(_, other)| closes(other))
    }

    /// Maximum displacement of the ground on one side of a level relative to that on the
    /// other (m).
    #[must_use]
    pub fn ground_moves(&self, gap: usize, level: usize) -> f64 {
        let peak = self.relative_ground_displacement[gap][level];
        peak.map_or(0.0, |peak| peak.value)
    }

    /// Peak contact force (N) at a level in the run at the provided widths; `None` if that run
    /// failed, and where impacts are jumps of the velocity.
    #[must_use]
    pub fn peak_force(&self, gap: usize, level: usize) -> Option<f64> {
        let (_, gaps) = self.pounding.as_ref().ok()?;
        let force = gaps[gap].levels[level].peak_force.value;
        force.is_finite().then_some(force)
    }

    /// Amplification of each building and storey at the provided widths; `None` if that
    /// run failed.
    #[must_use]
    pub fn amplification(&self) -> Option<Vec<Vec<Amplification>>> {
        let (with, _) = self.pounding.as_ref().ok()?;
        Some(amplification(with, &self.isolated))
    }
}

/// Whether a gap closed in a run: whether a level of it had an impact.
pub(crate) fn closes(gap: &GapOutcome) -> bool {
    gap.levels.iter().any(|l| l.impacts > 0)
}

pub(crate) fn levels(system: &System, gap: &Gap) -> Vec<GapLevel> {
    let levels = system.levels_of(gap).iter();
    levels
        .map(|l| GapLevel {
            place: l.place,
            width: l.width,
            on_isolators: system.isolated_beside(l).map(|b| b.name().to_owned()),
        })
        .collect()
}

/// Ratio of two peaks; NaN where both are zero.
fn ratio(with: Peak, isolated: Peak) -> f64 {
    with.value / isolated.value
}

/// Peaks with pounding over those without, of each building and storey.
#[must_use]
pub fn amplification(
    with: &[BuildingOutcome],
    isolated: &[BuildingOutcome],
) -> Vec<Vec<Amplification>> {
    with.iter()
        .zip(isolated)
        .map(|(a, b)| {
            let storeys = a.storeys.iter().zip(&b.storeys);
            storeys
                .map(|(a, b)| Amplification {
                    displacement: ratio(a.displacement, b.displacement),
                    storey_shear: ratio(a.storey_shear, b.storey_shear),
                    acceleration_absolute: ratio(a.acceleration_absolute, b.acceleration_absolute),
                })
                .collect()
        })
        .collect()
}

/// All records, on so many threads.
///
/// # Errors
/// Isolated buildings that cannot be integrated.
pub fn demands(
    records: &[CaseUnderRecord],
    threads: usize,
    progress: Progress<'_>,
) -> Result<Vec<RecordDemand>, CheckError> {
    by_record(records, threads, progress)?.into_iter().collect()
}

/// The same, with what keeps each record from a demand.
///
/// # Errors
/// [`CheckError::Stopped`].
pub(super) fn by_record(
    records: &[CaseUnderRecord],
    threads: usize,
    progress: Progress<'_>,
) -> Result<Vec<Result<RecordDemand, CheckError>>, CheckError> {
    runs_in_parallel(records.len(), threads, progress, |i, ending| {
        one(&records[i], ending)
    })
}

fn one(record: &CaseUnderRecord, ending: &mut dyn Recorder) -> Result<RecordDemand, CheckError> {
    let (system, options) = (&record.assembly.system, &record.assembly.options);
    let failed = |source: TimeHistoryError| CheckError::Record {
        record: record.name.clone(),
        source: Box::new(source.into()),
    };
    // Observers change nothing: where nothing touches, peaks are those of the runs with gaps to
    // the last bit, and amplifications are exactly one.
    let (isolated, peaks) =
        isolated_demand_beside(system, options, &mut [ending]).map_err(failed)?;
    let of_gap = |gap: &Gap| peaks[gap.first_level..gap.first_level + gap.levels].to_vec();
    let duration = options.duration.unwrap_or(system.record_duration());
    let ground = |gap: &Gap| {
        let levels = gap.first_level..gap.first_level + gap.levels;
        levels
            .map(|level| system.relative_ground_displacement(level, duration))
            .collect()
    };
    let pounding = run(system, options, &mut [ending], &mut |_| {});
    Ok(RecordDemand {
        name: record.name.clone(),
        factor: record.assembly.accelerogram.scale(),
        peak_ground_acceleration: record.assembly.accelerogram.peak().value.abs(),
        demand: system.gaps().iter().map(of_gap).collect(),
        relative_ground_displacement: system.gaps().iter().map(ground).collect(),
        isolated: isolated.buildings,
        pounding: pounding
            .map(|o| (o.buildings, o.gaps))
            .map_err(|e| e.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of what does not move no ratio is known, and it is the maximum of nothing.
    #[test]
    fn what_does_not_move_has_no_ratio() {
        let peak = |value| Peak { value, time: 0.0 };
        assert!(ratio(peak(0.0), peak(0.0)).is_nan());
        assert!((ratio(peak(3.0), peak(3.0)) - 1.0).abs() < f64::EPSILON);
        let storey = |displacement| Amplification {
            displacement,
            storey_shear: f64::NAN,
            acceleration_absolute: 1.0,
        };
        let storeys = [f64::NAN, 0.5, 0.5].map(storey);
        let of = Amplification::of_storeys;
        assert_eq!(of(&storeys, |a| a.displacement), Some((1, 0.5)));
        assert_eq!(of(&storeys, |a| a.storey_shear), None);
        let raised = storeys[0].one_where_nothing_moves();
        assert_eq!((raised.displacement, raised.storey_shear), (1.0, 1.0));
    }
}
