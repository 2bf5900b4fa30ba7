//! The answer of one code for a suite of records.

use pounding_separation::{
    Code, CodeWidth, Date, LeastWidth, Ownership, Rules, SeparationError, Sides, Situation,
    Statistic,
};

use super::SAME;
use super::codes::{GapPlace, Inputs};
use super::demand::RecordDemand;
use super::suite_spectrum::SuiteSpectrum;

/// What one code says of a gap under a suite of records.
#[derive(Debug, Clone)]
pub struct CodeAnswer {
    /// The code, or the rule of the user.
    pub code: Code,
    /// The day on which its edition is in force, where that decided between editions.
    pub date: Option<Date>,
    /// Which number of the responses under the records it takes.
    pub statistic: Statistic,
    /// Whether there are as many records as it asks for.
    pub enough_records: bool,
    /// Their mean spectrum beside that of the code.
    pub spectrum: SuiteSpectrum,
    /// Records under which a building collapses without contact: no statistic holds their
    /// displacements, and the code gives no answer.
    pub collapsed: usize,
    /// That statistic of the demand (m), the maximum approach of the buildings without contact:
    /// what the records say themselves, beside any rule.
    pub demand: f64,
    /// Who owns the ground, if the case says it and the code asks.
    pub ownership: Option<Ownership>,
    /// A width for each kind of ownership that the code tells apart.
    pub cases: Vec<OwnershipAnswer>,
}

/// What a code says for one kind of ownership.
#[derive(Debug, Clone)]
pub struct OwnershipAnswer {
    /// The ownership; `None` where the code does not ask.
    pub ownership: Option<Ownership>,
    /// Widths at the levels from the bottom, or why there is none.
    pub levels: Vec<Result<LevelAnswer, SeparationError>>,
}

/// The width of a code at a level.
#[derive(Debug, Clone)]
pub struct LevelAnswer {
    /// Statistic of the peak displacements of the left and the right building without contact
    /// (m); `None` for a wall.
    pub displacement: [Option<f64>; 2],
    /// The width with the provision that gives it.
    pub width: CodeWidth,
    /// Provided width (m).
    pub provided: f64,
    /// Whether displacements under the records count in the width.
    pub takes_records: bool,
    /// Whether the records are what the code asks for, or count for nothing in the width; else it
    /// does not decide.
    pub records_suffice: bool,
}

impl LevelAnswer {
    /// Provided over required width (-); infinite where nothing is required, also of no width.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        match self.width.requirement.width {
            0.0 => f64::INFINITY,
            required => self.provided / required,
        }
    }

    /// Whether the provided width is no less; `None` for a rule that does not hold for
    /// displacements of buildings that yield, for a disputed one whose least reading it reaches, and under records
    /// that are not what the code asks for. A width that takes no displacements is asked for under
    /// any records.
    #[must_use]
    pub fn satisfied(&self) -> Option<bool> {
        if self.falls_short_anyway().is_some() {
            return Some(false);
        }
        self.by_width()
    }

    /// Whether its width itself decides, not only what of it takes no displacements.
    #[must_use]
    pub fn has_answer(&self) -> bool {
        self.by_width().is_some()
    }

    /// Of a disputed width it cannot be known which reading is that of the code: none is chosen, but a gap
    /// that reaches none is too small.
    fn by_width(&self) -> Option<bool> {
        let requirement = &self.width.requirement;
        if !self.records_suffice || requirement.caution.is_some() {
            return None;
        }
        match requirement.readings.is_empty() {
            true => Some(self.reaches(requirement.width)),
            false => (!self.reaches(requirement.least())).then_some(false),
        }
    }

    /// What the code asks for whatever the displacements are, where the provided width is less.
    #[must_use]
    pub fn falls_short_anyway(&self) -> Option<&LeastWidth> {
        let least = self.width.without_displacements.as_ref();
        least.filter(|least| !self.reaches(least.width))
    }

    /// A width that is asked for (m) as it is judged: the provided one, where that falls short of it by less than two
    /// computations of one number differ.
    #[must_use]
    pub fn as_judged(&self, required: f64) -> f64 {
        match self.reaches(required) {
            true => required.min(self.provided),
            false => required,
        }
    }

    fn reaches(&self, required: f64) -> bool {
        self.provided >= required * (1.0 - SAME)
    }
}

impl OwnershipAnswer {
    /// The level with the least ratio of provided to required width (from zero), of equals the
    /// highest, with its answer: one that needs nothing only where none needs anything. `None`
    /// where the code says nothing.
    #[must_use]
    pub fn governing(&self) -> Option<(usize, &LevelAnswer)> {
        let levels = self.levels.iter().enumerate().rev();
        let known = levels.filter_map(|(l, answer)| Some((l, answer.as_ref().ok()?)));
        known.min_by(|a, b| a.1.ratio().total_cmp(&b.1.ratio()))
    }

    /// Why the code says nothing at some level for want of an input, or nothing at all.
    #[must_use]
    pub fn refusal(&self) -> Option<&SeparationError> {
        let errors = || self.levels.iter().filter_map(|l| l.as_ref().err());
        let missing = errors().find(|e| !matches!(e, SeparationError::NotApplicable { .. }));
        let none = self.levels.iter().all(Result::is_err);
        missing.or_else(|| errors().next().filter(|_| none))
    }

    /// Whether the provided width reaches the required one at every level of which the code
    /// speaks; `None` if it gives no answer.
    #[must_use]
    pub fn satisfied(&self) -> Option<bool> {
        if self.refusal().is_some() {
            return None;
        }
        all_of(self.levels.iter().flatten().map(LevelAnswer::satisfied))
    }

    /// Where widths that take displacements are no answer and the gap is too small by one that takes
    /// none: the level at which it is by most, and what is asked for there.
    #[must_use]
    pub fn falls_short_anyway(&self) -> Option<(usize, &LeastWidth)> {
        let all_decide = self.levels.iter().flatten().all(LevelAnswer::has_answer);
        if all_decide || self.refusal().is_some() {
            return None;
        }
        // Of equals the highest level, as where its own widths decide.
        let levels = self.levels.iter().enumerate().rev();
        let short = levels.filter_map(|(l, answer)| {
            let answer = answer.as_ref().ok()?;
            let least = answer.falls_short_anyway()?;
            Some((answer.provided / least.width, (l, least)))
        });
        let worst = short.min_by(|a, b| a.0.total_cmp(&b.0));
        worst.map(|(_, found)| found)
    }
}

impl CodeAnswer {
    /// The answers that decide: that of the ownership that the case states, else all.
    pub fn deciding(&self) -> impl Iterator<Item = &OwnershipAnswer> {
        let stated = self.ownership;
        self.cases
            .iter()
            .filter(move |c| stated.is_none() || c.ownership.is_none() || c.ownership == stated)
    }

    /// Whether it has a width at any level, by any ownership.
    #[must_use]
    pub fn has_widths(&self) -> bool {
        self.cases
            .iter()
            .any(|case| case.levels.iter().any(Result::is_ok))
    }

    /// Whether displacements under the records count in any of its widths; of rules that ask for
    /// heights alone they do not.
    #[must_use]
    pub fn takes_records(&self) -> bool {
        let mut levels = self
            .cases
            .iter()
            .flat_map(|case| case.levels.iter().flatten());
        levels.any(|level| level.takes_records)
    }

    /// Whether the gap is wide enough by the code; `None` if it gives no answer, as where
    /// buildings collapse without contact, or where displacements count and there are fewer records
    /// than it asks for, or their mean spectrum is below what it asks for, unless the gap is less than
    /// it asks for without displacements. Where the case does not say who owns the ground, it must be
    /// for both.
    #[must_use]
    pub fn satisfied(&self) -> Option<bool> {
        all_of(self.deciding().map(OwnershipAnswer::satisfied))
    }
}

/// Whether all are true: one that is not settles it, whatever those are that are not known.
fn all_of(answers: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    let mut all = Some(true);
    for answer in answers {
        match answer {
            Some(true) => {}
            Some(false) => return Some(false),
            None => all = None,
        }
    }
    all
}

/// Whether records are what a code asks for.
#[derive(Debug, Clone, Copy)]
struct Suffice {
    /// Enough of them, with a mean spectrum that reaches its own as far as that is compared.
    records: bool,
    /// None under which buildings collapse without contact.
    standing: bool,
}

/// The answer of a code at one gap: its rules take the code's statistic of the displacements
/// under all records, of which so many are distinct: a motion that is there twice is no second
/// record.
pub(super) fn code_answer(
    (code, date): (Code, Option<Date>),
    place: &GapPlace<'_>,
    inputs: &Inputs<'_>,
    (records, distinct, collapsed): (&[RecordDemand], usize, usize),
    (demand, spectrum): (&[f64], SuiteSpectrum),
) -> CodeAnswer {
    let statistic = code.suite.statistic(distinct);
    let enough_records = distinct >= code.suite.least;
    let suffice = Suffice {
        records: enough_records && !spectrum.is_below(),
        standing: collapsed == 0,
    };
    let levels = place.levels();
    let at = |level: usize, sides: &[Option<(usize, usize)>; 2], rule: (_, &Rules)| {
        let of_suite = (records, statistic, suffice);
        answer_at(place, inputs, of_suite, (level, *sides), rule)
    };
    let beside_wall = levels.iter().any(|sides| sides.contains(&None));
    let rules: Vec<(Option<Ownership>, &Rules)> = if beside_wall {
        code.beside_a_wall()
            .map(|rules| (None, rules))
            .into_iter()
            .collect()
    } else {
        code.rules
            .iter()
            .map(|(owner, rules)| (*owner, rules))
            .collect()
    };
    let cases = rules.iter().map(|&(ownership, rules)| OwnershipAnswer {
        ownership,
        levels: levels
            .iter()
            .enumerate()
            .map(|(level, sides)| at(level, sides, (ownership, rules)))
            .collect(),
    });
    let cases: Vec<OwnershipAnswer> = cases.collect();
    let asks = cases.iter().any(|case| case.ownership.is_some());
    CodeAnswer {
        statistic,
        enough_records,
        spectrum,
        collapsed,
        demand: statistic.of(demand),
        ownership: inputs.ownership().filter(|_| asks),
        cases,
        code,
        date,
    }
}

fn answer_at(
    place: &GapPlace<'_>,
    inputs: &Inputs<'_>,
    (records, statistic, suffice): (&[RecordDemand], Statistic, Suffice),
    (level, sides): (usize, [Option<(usize, usize)>; 2]),
    (ownership, rules): (Option<Ownership>, &Rules),
) -> Result<LevelAnswer, SeparationError> {
    let structures = [0, 1].map(|side| {
        sides[side].map(|at| {
            let peaks = records.iter();
            let peaks: Vec<f64> = peaks
                .map(|r| place.displacement((level, side), at, &r.isolated[at.0]))
                .collect();
            let mut yields = records.iter().map(|r| &r.isolated[at.0]);
            let inelastic = yields.any(|b| !b.inelastic_storeys().is_empty());
            let peak = (statistic.of(&peaks), inelastic);
            inputs.structure(place, (level, side), at.0, peak)
        })
    });
    let displacement = [0, 1].map(|i: usize| structures[i].as_ref().and_then(|s| s.displacement));
    let moves = records.iter().map(|r| r.ground_moves(place.gap, level));
    let moves: Vec<f64> = moves.collect();
    let ground_moves = moves.iter().any(|moves| *moves != 0.0);
    let site = inputs.site(place, statistic.of(&moves));
    let sides = match structures {
        [Some(left), Some(right)] => Sides::Between(Box::new(Situation { left, right, site })),
        [Some(one), None] | [None, Some(one)] => Sides::Wall {
            structure: Box::new(one),
            site,
        },
        [None, None] => {
            return Err(SeparationError::NotApplicable {
                provision: "the code".to_owned(),
                reason: "the level lies between two walls".to_owned(),
                remedy: "no width is asked for there".to_owned(),
            });
        }
    };
    let width = rules.width(&sides.owned(ownership))?;
    let takes_records = width.takes_displacements || ground_moves;
    Ok(LevelAnswer {
        displacement,
        width,
        provided: place.width(level),
        takes_records,
        records_suffice: suffice.standing && (suffice.records || !takes_records),
    })
}
