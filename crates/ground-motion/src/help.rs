//! What to do about a record that cannot be read or used.

use pounding_catalogue::DefinitionError;

use crate::error::GroundMotionError;
use crate::format::Format;

impl GroundMotionError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        Some(match self {
            Self::Io { .. } => {
                "check the path; in a case file it is relative to the folder of the case file".to_owned()
            }
            Self::Parse { remedy, .. } => remedy.clone(),
            Self::Binary { .. } => "the file is damaged or truncated: get it again".to_owned(),
            Self::Empty { .. } => {
                "get the file again: a download or a copy may have been cut off".to_owned()
            }
            Self::UnknownFormat { .. } => {
                format!(
                    "known formats: {}; for columns of numbers give `format = \"plain_columns\"`, `unit` and `time_step`, and for rows that begin with text `skip_columns`, the characters of each to pass over",
                    Format::names()
                )
            }
            Self::UnknownFormatName(error) => {
                let guess = match error {
                    DefinitionError::UnknownName { nearest: "", .. } => String::new(),
                    error => error.help() + " ",
                };
                format!("{guess}known formats are {}", Format::names())
            }
            Self::MissingUnit { .. } => {
                "give the unit: `unit = \"g\"` in [ground_motion] of a case, `--unit g` with `pounding motion` (or m/s2, cm/s2, ...); for --records, which takes files that state theirs, write them anew with `pounding motion convert FILE --unit g -o FILE.csv`; units are never guessed".to_owned()
            }
            Self::MissingTimeStep { .. } => {
                "give the step: `time_step = \"0.02 s\"` in [ground_motion] of a case, `--time-step \"0.02 s\"` with `pounding motion`; for --records, which takes files that state theirs, write them anew with `pounding motion convert FILE --time-step \"0.02 s\" -o FILE.csv`".to_owned()
            }
            Self::Contradiction { quantity, .. } => {
                format!("do not give the {quantity}, or use the right record")
            }
            Self::TooFewSamples { .. } => {
                "the file is probably truncated: get it again, or set `lenient = true` to use what is there".to_owned()
            }
            Self::NotAcceleration { .. } => {
                "use the accelerations of the same record, such as AT2 beside VT2 and DT2".to_owned()
            }
            Self::AmbiguousSeries { .. } => {
                "choose one with `component` in [ground_motion] of a case, `--component` with `pounding motion`: its name, azimuth or channel number".to_owned()
            }
            Self::NoSuchSeries { .. } => "correct `component`".to_owned(),
            Self::NoSuchQuantity { quantity, .. } => format!(
                "ask for a quantity that is there, or give the file that holds the {quantity} of this record"
            ),
            Self::Uneven { mean, .. } => format!(
                "give `time_step` (at most {mean:.6} s) to have the record resampled to even steps by linear interpolation"
            ),
            Self::MissingSensitivity { .. } => {
                "give the station's StationXML, `response = \"FILE\"` in [ground_motion] of a case, `--response FILE` with `pounding motion`; or `sensitivity` in counts per m/s2; or, of floats that are no counts, `unit`".to_owned()
            }
            Self::Unsupported { remedy, .. } => (*remedy).to_owned(),
            Self::OfOption { option, error } => match **error {
                Self::NoSuchSeries { .. } => format!("correct `{option}`"),
                ref error => return error.help(),
            },
            Self::Unit { .. } => "use g, mg, g/10, m/s2, cm/s2, mm/s2, gal, in/s2 or ft/s2".to_owned(),
            Self::OutOfRange { .. } => {
                "correct the number; check its unit (SI inside: m/s2, s, Hz)".to_owned()
            }
            Self::Mismatch(_) => {
                "use the components of one recording, resampled to one time step".to_owned()
            }
            Self::NotPossible { remedy, .. } => (*remedy).to_owned(),
            Self::NotMatched { iterations, best_at, stalled, .. } => {
                let mut remedy = "take a record whose own spectrum is nearer the target, or narrow the band".to_owned();
                // The later half brought nothing: nor would another one, nor any where the method ended by itself.
                // One or two say nothing of more.
                if !stalled && (best_at * 2 >= *iterations || *iterations < 3) {
                    remedy += ", or allow more iterations";
                }
                remedy
            }
            Self::Stopped => "compute it anew".to_owned(),
            Self::Invalid(_) => "check unit, time step and scale of the record".to_owned(),
        })
    }
}
