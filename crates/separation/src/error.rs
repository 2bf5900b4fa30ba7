//! Why a provision gives no gap.

use pounding_catalogue::{DefinitionError, suggestion};

use crate::edition::Date;
use crate::inputs::Input;

/// A provision that is unknown, does not apply, or lacks an input.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeparationError {
    /// No provision of this name.
    #[error(transparent)]
    UnknownProvision(#[from] DefinitionError),
    /// No code of this name; the one that is meant has a family of another name.
    #[error("{error}")]
    UnknownCode {
        /// What is wrong, with the name that is meant.
        error: DefinitionError,
        /// Family of the code that is meant.
        family: &'static str,
    },
    /// An input that the provision needs is not given.
    #[error("{provision} needs {} ({}){}", input.key(), input.explanation(), of(structure))]
    MissingInput {
        /// Provision.
        provision: String,
        /// What it needs.
        input: Input,
        /// Structure that lacks it; empty where it belongs to the site.
        structure: String,
    },
    /// The provision does not speak of this situation.
    #[error("{provision} does not apply: {reason}")]
    NotApplicable {
        /// Provision.
        provision: String,
        /// Why.
        reason: String,
        /// What can be done instead.
        remedy: String,
    },
    /// What stands in an expression of a user's rule cannot be computed here.
    #[error("{provision}: {message}, at `{part}`, character {character} of its {of}")]
    Expression {
        /// The rule.
        provision: String,
        /// What is wrong.
        message: String,
        /// The part of the expression.
        part: String,
        /// Where it starts, in characters from 1.
        character: usize,
        /// `expression`, or the definition that it stands in.
        of: String,
    },
    /// What is no date.
    #[error("\"{text}\" is no date")]
    NoDate {
        /// The text.
        text: String,
    },
    /// No edition of a code, or no code of a country, is in force on a day.
    #[error("of {what} no edition that is known here is in force on {date}")]
    NotInForce {
        /// Code or country.
        what: String,
        /// The day.
        date: Date,
        /// The editions that are known, with their dates.
        known: Vec<String>,
        /// The name of the newest.
        newest: &'static str,
        /// Editions without a formula here.
        unavailable: Vec<&'static str>,
    },
    /// An edition begins or ends in the year of a day, and its own day is not known.
    #[error("the edition of {what} in force on {date} is not known, of these only years are: {}", known.join("; "))]
    DayNotKnown {
        /// Code or country.
        what: String,
        /// The day.
        date: Date,
        /// The editions that may be in force, with their dates.
        known: Vec<String>,
        /// Their names.
        codes: Vec<&'static str>,
    },
    /// Several codes of a country are in force on a day.
    #[error("{country} has several codes in force on {date}: {}", codes.join(", "))]
    SeveralCodes {
        /// Country.
        country: String,
        /// The day.
        date: Date,
        /// Their names.
        codes: Vec<&'static str>,
    },
    /// A country without codes here.
    #[error("no code of \"{country}\" is known here")]
    UnknownCountry {
        /// The name asked for.
        country: String,
        /// The countries and cities that have one.
        known: Vec<&'static str>,
        /// What is known of it all the same: another name, or a code that it shares with others.
        hint: Option<String>,
    },
    /// An input that no structure can have.
    #[error("{quantity} = {value} is outside {range}")]
    OutOfRange {
        /// Quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: &'static str,
    },
}

impl SeparationError {
    /// Whether a provision that applies has no value here: it is neither one that does not apply nor
    /// one that lacks an input.
    #[must_use]
    pub fn is_without_value(&self) -> bool {
        matches!(self, Self::Expression { .. } | Self::OutOfRange { .. })
    }
}

fn of(structure: &str) -> String {
    if structure.is_empty() {
        String::new()
    } else {
        format!(" of {structure}")
    }
}

impl SeparationError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::UnknownProvision(error) => error.help(),
            Self::UnknownCode { error, family } => {
                let meant = error.help();
                format!("{meant} \"{family}\" is the edition in force of that family")
            }
            Self::MissingInput { input, .. } => {
                format!("add `{}` to the table [separation]", input.key())
            }
            Self::NotApplicable { remedy, .. } => remedy.clone(),
            Self::Expression { .. } => {
                "correct the rule, or the inputs that it is given".to_owned()
            }
            Self::NoDate { .. } => "write year, month and day, such as 2018-03-22".to_owned(),
            Self::NotInForce {
                known,
                newest,
                unavailable,
                ..
            } => {
                let missing = match unavailable.as_slice() {
                    [] => String::new(),
                    all => format!("; there is no formula here of {}", all.join(", ")),
                };
                format!(
                    "known are {}{missing}; an edition by its name is taken whatever the date: --code {newest}, or `code` in [separation]",
                    known.join("; ")
                )
            }
            Self::DayNotKnown { codes, .. } => format!(
                "name the edition, with --code or `code` in [separation]: {}",
                codes.join(" or ")
            ),
            Self::SeveralCodes { .. } => {
                "name one of them: --code, or `code` in [separation]".to_owned()
            }
            Self::UnknownCountry {
                hint: Some(hint), ..
            } => hint.clone(),
            Self::UnknownCountry { country, known, .. } => {
                match suggestion::misspelt(country, known) {
                    Some(meant) => format!("did you mean \"{meant}\"?"),
                    None => format!("known are {}", known.join(", ")),
                }
            }
            Self::OutOfRange { .. } => "check the value and its unit".to_owned(),
        })
    }
}
