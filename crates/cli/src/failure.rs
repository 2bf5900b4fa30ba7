//! Failures as the user sees them, with exit codes.

use std::process::ExitCode;

use miette::{LabeledSpan, MietteDiagnostic, NamedSource, Report};
use pounding_case::CaseError;
use pounding_gap_element::GapElementError;
use pounding_gap_element::calibration::CalibrationError;
use pounding_ground_motion::GroundMotionError;
use pounding_hysteresis::HysteresisError;
use pounding_time_history::TimeHistoryError;

/// Why a command did not succeed.
#[derive(Debug)]
pub enum Failure {
    /// The command ran and its answer, already printed, is "no": exit code 1.
    No,
    /// Bad input: exit code 2.
    Input(Report),
    /// The computation failed: exit code 3.
    Computation(Report),
    /// Output could not be written: exit code 4.
    Output(Report),
    /// A child process has said why, and ended with this code.
    Told(u8),
}

impl Failure {
    /// Prints the failure and returns the exit code.
    pub fn report(self) -> ExitCode {
        let (report, code) = match self {
            Self::No => return ExitCode::from(1),
            Self::Told(code) => return ExitCode::from(code),
            Self::Input(report) => (report, 2),
            Self::Computation(report) => (report, 3),
            Self::Output(report) => (report, 4),
        };
        #[allow(clippy::print_stderr)]
        {
            eprintln!("{report:?}");
        }
        ExitCode::from(code)
    }

    /// Bad input without a place in a file.
    pub fn input(message: impl Into<String>, help: Option<String>) -> Self {
        Self::Input(plain(message.into(), help))
    }

    /// Bad input at a place (byte range) in a file.
    pub fn in_file(
        file: &str,
        source: &str,
        place: std::ops::Range<usize>,
        message: String,
        help: &str,
    ) -> Self {
        let diagnostic = MietteDiagnostic::new(message)
            .with_help(help)
            .with_label(LabeledSpan::at((place.start, place.len()), "here"));
        Self::Input(
            Report::new(diagnostic).with_source_code(NamedSource::new(file, source.to_owned())),
        )
    }

    /// Output that could not be written; a closed pipe is the reader's choice.
    pub fn output(error: &std::io::Error, what: &str) -> Self {
        Self::Output(plain(
            format!("cannot write {what}: {error}"),
            Some("check that the folder exists, may be written to and has room".to_owned()),
        ))
    }

    /// A computation that came to no result.
    pub fn computation(message: String, help: Option<String>) -> Self {
        Self::Computation(plain(message, help))
    }

    /// Output that could not be written, in the words of who tried.
    pub fn unwritten(message: String, help: Option<String>) -> Self {
        Self::Output(plain(message, help))
    }

    /// An error of the case, with the line it stands in.
    pub fn case(error: CaseError, source: &str) -> Self {
        let mut diagnostic = MietteDiagnostic::new(error.to_string());
        diagnostic.help = error.help.clone();
        if source.is_empty() {
            return Self::Input(Report::new(diagnostic));
        }
        let length = error
            .span
            .len()
            .min(source.len().saturating_sub(error.span.start));
        let diagnostic = diagnostic.with_label(LabeledSpan::at((error.span.start, length), "here"));
        Self::Input(
            Report::new(diagnostic)
                .with_source_code(NamedSource::new(error.file.clone(), source.to_owned())),
        )
    }

    /// An error of assembly, run or result file.
    pub fn time_history(error: TimeHistoryError, source: &str) -> Self {
        let help = error.help();
        match error {
            TimeHistoryError::Case(error) => Self::case(error, source),
            TimeHistoryError::GroundMotion(error) => Self::input(error.to_string(), help),
            error @ (TimeHistoryError::GapDefinition { .. }
            | TimeHistoryError::LinkDefinition { .. }
            | TimeHistoryError::NotLinear { .. }
            | TimeHistoryError::InitialState { .. }
            | TimeHistoryError::CompliantModel { .. }
            | TimeHistoryError::Option { .. }) => Self::input(error.to_string(), help),
            error @ TimeHistoryError::ResultFile { .. } => {
                Self::Output(plain(error.to_string(), help))
            }
            error => Self::Computation(plain(error.to_string(), help)),
        }
    }
}

impl From<CalibrationError> for Failure {
    fn from(error: CalibrationError) -> Self {
        let help = error.help();
        match error {
            CalibrationError::NotReached { .. } => {
                Self::Computation(plain(error.to_string(), help))
            }
            CalibrationError::Collision(error) => Self::from(error),
            error => Self::input(error.to_string(), help),
        }
    }
}

impl From<GroundMotionError> for Failure {
    fn from(error: GroundMotionError) -> Self {
        let help = error.help();
        match error {
            GroundMotionError::NotMatched { .. } => {
                Self::Computation(plain(error.to_string(), help))
            }
            error => Self::input(error.to_string(), help),
        }
    }
}

impl From<GapElementError> for Failure {
    fn from(error: GapElementError) -> Self {
        match error {
            GapElementError::Unfinished { .. } => {
                Self::Computation(plain(error.to_string(), error.help()))
            }
            _ => Self::input(error.to_string(), error.help()),
        }
    }
}

impl From<HysteresisError> for Failure {
    fn from(error: HysteresisError) -> Self {
        let help = error.help();
        match error {
            HysteresisError::Fit { .. } => Self::Computation(plain(error.to_string(), help)),
            error => Self::input(error.to_string(), help),
        }
    }
}

fn plain(message: String, help: Option<String>) -> Report {
    let mut diagnostic = MietteDiagnostic::new(message);
    diagnostic.help = help;
    Report::new(diagnostic)
}
