//! What codes take of the responses under many records.

use pounding_catalogue::Verification;

/// Which number of many responses a code takes for design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    /// Their mean.
    Mean,
    /// Their maximum.
    Maximum,
}

impl Statistic {
    /// A word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Maximum => "maximum",
        }
    }

    /// The statistic of values; NaN of none.
    #[must_use]
    pub fn of(self, values: &[f64]) -> f64 {
        match self {
            Self::Mean => values.iter().sum::<f64>() / values.len() as f64,
            Self::Maximum => values.iter().copied().reduce(f64::max).unwrap_or(f64::NAN),
        }
    }
}

/// What a code asks of the mean spectrum of many records, for a damping ratio of 5 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumCondition {
    /// Name of the spectrum, as cases give it to `scale`.
    pub spectrum: &'static str,
    /// The least part of the spectrum that the mean may be (-).
    pub at_least: f64,
    /// What the first and the last period are of the smallest and the greatest fundamental period
    /// (-).
    pub band: (f64, f64),
    /// Whether the mean peak ground acceleration must reach the spectrum at zero period.
    pub zero_period: bool,
    /// Clause.
    pub clause: &'static str,
}

/// What a code takes of the responses under many records.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SuiteRule {
    /// From this number of records on the mean counts; `None` if it never does.
    pub mean_from: Option<usize>,
    /// Least number of records that the code allows.
    pub least: usize,
    /// Clause; empty where no rule of the code is known here.
    pub clause: &'static str,
    /// How far it has been checked.
    pub status: Verification,
    /// What the code asks of their mean spectrum, where its spectrum is known here.
    pub spectrum: Option<SpectrumCondition>,
}

impl SuiteRule {
    /// The statistic of so many records: the mean from its number on, else the maximum.
    #[must_use]
    pub fn statistic(&self, records: usize) -> Statistic {
        match self.mean_from {
            Some(from) if records >= from => Statistic::Mean,
            _ => Statistic::Maximum,
        }
    }

    /// The rule in words: `the mean of 7 records or more, else the maximum; 3 records at
    /// least`.
    #[must_use]
    pub fn explanation(&self) -> String {
        let statistic = match self.mean_from {
            Some(from) if from == self.least => format!("the mean of {from} records or more"),
            Some(from) => format!("the mean of {from} records or more, else the maximum"),
            None if self.clause.is_empty() => {
                return "no rule of the code is known here: the maximum".to_owned();
            }
            None => "the maximum".to_owned(),
        };
        format!("{statistic}; {} records at least", self.least)
    }
}

const RECALLED: Verification = Verification::Unverified("numbers of records and clause");

/// Three records or more: the mean of seven or more, else the maximum.
const fn three_and_seven(clause: &'static str) -> SuiteRule {
    SuiteRule {
        mean_from: Some(7),
        least: 3,
        clause,
        status: RECALLED,
        spectrum: None,
    }
}

/// The mean of eleven records or more.
const fn eleven(clause: &'static str) -> SuiteRule {
    SuiteRule {
        mean_from: Some(11),
        least: 11,
        clause,
        status: RECALLED,
        spectrum: None,
    }
}

pub(crate) const EUROCODE_8: SuiteRule = SuiteRule {
    spectrum: Some(SpectrumCondition {
        spectrum: "eurocode_8_2004",
        at_least: 0.9,
        band: (0.2, 2.0),
        zero_period: true,
        clause: "3.2.3.1.2(4)b and c",
    }),
    ..three_and_seven("3.2.3.1.2(4) and 4.3.3.4.3(3)")
};
/// Its design spectrum, 11.4.5, has the formulas of that of ASCE 7-16.
pub(crate) const ASCE_7_2010: SuiteRule = SuiteRule {
    spectrum: Some(SpectrumCondition {
        spectrum: "asce_7_2016",
        at_least: 1.0,
        band: (0.2, 1.5),
        zero_period: false,
        clause: "16.1.3.1",
    }),
    ..three_and_seven("16.1.3 and 16.1.4")
};
pub(crate) const ASCE_7_2016: SuiteRule = eleven("16.2.2 and 16.4");
pub(crate) const ASCE_7_2022: SuiteRule = eleven("16.2.2 and 16.4");
pub(crate) const ASCE_41: SuiteRule = eleven("2.4.3 and 7.2.2");
pub(crate) const UBC_1997: SuiteRule = three_and_seven("1631.6.1");
pub(crate) const NBCC: SuiteRule = eleven("structural commentary J");
pub(crate) const NTC_2018: SuiteRule = three_and_seven("7.3.5");
pub(crate) const TBDY_2018: SuiteRule = eleven("5.7.3");
pub(crate) const TDY_2007: SuiteRule = three_and_seven("2.9.3");
pub(crate) const IRAN_2800: SuiteRule = three_and_seven("3-4");
pub(crate) const E_030: SuiteRule = three_and_seven("Art. 30");
pub(crate) const NZS_1170_5: SuiteRule = SuiteRule {
    mean_from: None,
    least: 3,
    clause: "6.4",
    status: RECALLED,
    spectrum: None,
};

/// What a rule of the user takes.
pub(crate) const OF_A_RULE: SuiteRule = SuiteRule {
    status: Verification::Unverified("a rule of the user says nothing of many records"),
    ..NOT_KNOWN
};

/// Where nothing is known of what a code takes.
pub(crate) const NOT_KNOWN: SuiteRule = SuiteRule {
    mean_from: None,
    least: 1,
    clause: "",
    status: Verification::Unverified("what the code takes of many records"),
    spectrum: None,
};

#[cfg(test)]
mod tests {
    use super::*;

    /// EN 1998-1:2004, 4.3.3.4.3(3): the mean of seven, the most unfavourable of three to six.
    #[test]
    fn seven_and_six_records() {
        for (records, statistic) in [
            (1, Statistic::Maximum),
            (3, Statistic::Maximum),
            (6, Statistic::Maximum),
            (7, Statistic::Mean),
            (40, Statistic::Mean),
        ] {
            assert_eq!(EUROCODE_8.statistic(records), statistic, "{records}");
        }
        assert_eq!(NZS_1170_5.statistic(40), Statistic::Maximum);
        let values = [1.0, 2.0, 6.0];
        assert_eq!(Statistic::Mean.of(&values), 3.0);
        assert_eq!(Statistic::Maximum.of(&values), 6.0);
        assert!(Statistic::Maximum.of(&[]).is_nan() && Statistic::Mean.of(&[]).is_nan());
        assert_eq!(
            EUROCODE_8.explanation(),
            "the mean of 7 records or more, else the maximum; 3 records at least"
        );
        assert_eq!(
            ASCE_7_2016.explanation(),
            "the mean of 11 records or more; 11 records at least"
        );
    }
}
