//! Failures as the user sees them, with exit codes.

use std::io::Write as _;
use std::path::Path;

use miette::{MietteDiagnostic, Report};
use pounding_assembly::{AssemblyError, place_of};
use pounding_case::{Case, CaseError, MORE_FILES, is_short_of_files};
use pounding_catalogue::DefinitionError;
use pounding_files::{FileUseError, PlaceTaken};
use pounding_gap_element::GapElementError;
use pounding_gap_element::calibration::CalibrationError;
use pounding_gap_element::contact_stiffness::ContactStiffnessError;
use pounding_gap_element::laboratory::MeasuredForceError;
use pounding_ground_motion::GroundMotionError;
use pounding_hysteresis::laboratory::LaboratoryError;
use pounding_hysteresis::{HysteresisError, help_among_gaps};
use pounding_report::documentation::DocumentationError;
use pounding_results::{ResponsesTooLarge, WriteError};
use pounding_time_history::TimeHistoryError;
use pounding_verification::VerificationError;

use crate::{excerpt, exit_code, terminal};

/// Errors of one input that are shown: more help nobody.
const MOST_SHOWN: usize = 20;

/// Why a command did not succeed.
#[derive(Debug)]
pub enum Failure {
    /// The command ran and its answer, already printed, is "no": exit code 1.
    No,
    /// Bad input: exit code 2.
    Input(Report),
    /// Several things wrong with the input: exit code 2.
    Inputs(Vec<Report>),
    /// The computation failed: exit code 3.
    Computation(Report),
    /// Output could not be written: exit code 4.
    Output(Report),
    /// Interrupted by a signal: exit code 5.
    Interrupted(Report),
    /// A child process has reported the reason, and ended with this code.
    Reported(u8),
}

impl Failure {
    /// Prints the failure and returns the exit code.
    pub(crate) fn report(self) -> u8 {
        let (reports, code) = match self {
            Self::No => return exit_code::NO,
            Self::Reported(code) => return code,
            Self::Input(report) => (vec![report], exit_code::INPUT),
            Self::Inputs(reports) => (reports, exit_code::INPUT),
            Self::Computation(report) => (vec![report], exit_code::COMPUTATION),
            Self::Output(report) => (vec![report], exit_code::OUTPUT),
            Self::Interrupted(report) => (vec![report], exit_code::INTERRUPTED),
        };
        let mut text = String::new();
        for report in reports.iter().take(MOST_SHOWN) {
            text.push_str(&format!("{report:?}\n"));
        }
        if reports.len() > MOST_SHOWN {
            text.push_str(&format!(
                "{} errors, the first {MOST_SHOWN} shown\n",
                reports.len()
            ));
        } else if reports.len() > 1 {
            text.push_str(&format!("{} errors\n", reports.len()));
        }
        // Where nobody can read it any more, the exit code still says it.
        let text = terminal::rendered(&text);
        let _ = std::io::stderr().lock().write_all(text.as_bytes());
        code
    }

    /// Why, without what to do about it, for a message that goes on.
    pub fn reason(&self) -> String {
        match self {
            Self::Input(report)
            | Self::Computation(report)
            | Self::Output(report)
            | Self::Interrupted(report) => report.to_string(),
            Self::Inputs(reports) => {
                let reasons: Vec<String> = reports.iter().map(ToString::to_string).collect();
                reasons.join("; ")
            }
            Self::No | Self::Reported(_) => String::new(),
        }
    }

    /// What is wrong with several inputs, each for itself.
    pub fn inputs(mut reports: Vec<Report>) -> Self {
        match reports.pop() {
            Some(only) if reports.is_empty() => Self::Input(only),
            last => {
                reports.extend(last);
                Self::Inputs(reports)
            }
        }
    }

    /// Failures of one kind, such as bad inputs, as one: that of the first where they differ.
    pub fn together(failures: Vec<Self>) -> Self {
        let mut reports = Vec::new();
        for failure in failures {
            match failure {
                Self::Input(report) => reports.push(report),
                Self::Inputs(more) => reports.extend(more),
                other => return other,
            }
        }
        Self::inputs(reports)
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
        let diagnostic =
            MietteDiagnostic::new(terminal::shown(&message)).with_help(terminal::shown(help));
        Self::Input(excerpt::report(diagnostic, file, source, place))
    }

    /// Output that could not be written; a closed pipe is the reader's choice.
    pub fn output(error: &std::io::Error, what: &str) -> Self {
        let help = PlaceTaken::of(error).map_or_else(
            || "check that the folder exists, may be written to and has room".to_owned(),
            PlaceTaken::help,
        );
        Self::Output(plain(format!("cannot write {what}: {error}"), Some(help)))
    }

    /// A picture that could not be drawn.
    pub(crate) fn not_drawn(error: &impl std::error::Error) -> Self {
        Self::output(&std::io::Error::other(error.to_string()), "the picture")
    }

    /// A computation that came to no result.
    pub fn computation(message: String, help: Option<String>) -> Self {
        Self::Computation(plain(message, help))
    }

    /// A computation that was stopped.
    pub fn interrupted(message: String, help: Option<String>) -> Self {
        Self::Interrupted(plain(message, help))
    }

    /// Output that could not be written, in the words of who tried.
    pub fn unwritten(message: String, help: Option<String>) -> Self {
        Self::Output(plain(message, help))
    }

    /// The errors of a file, each with the line it stands in.
    pub fn case(error: CaseError, source: &str) -> Self {
        if error.is_short_of_files() {
            return Self::Computation(located(error, source));
        }
        Self::inputs(error.each().map(|e| located(e, source)).collect())
    }

    /// An error of assembly or run of a case: with its line where it stands in one, else with
    /// the name of the file.
    pub fn of_case(error: impl Into<AssemblyError>, case: &Case) -> Self {
        match error.into() {
            AssemblyError::System(error) => match place_of(&error, case) {
                Some(place) => {
                    let help = error.help();
                    Self::case(case.error(place, error.to_string(), help), &case.source)
                }
                None => Self::from(error).about(&case.file),
            },
            error => Self::assembly(error, &case.source),
        }
    }

    /// The same, said of a file; several inputs name theirs.
    pub fn about(self, file: &Path) -> Self {
        match self {
            several @ Self::Inputs(_) => several,
            one => one.within(&file.display().to_string()),
        }
    }

    /// The same, said of a file or of a part of one.
    pub fn within(self, what: &str) -> Self {
        let say = |report: Report| report.wrap_err(terminal::shown(what).into_owned());
        match self {
            Self::Input(report) => Self::Input(say(report)),
            Self::Inputs(reports) => Self::Inputs(reports.into_iter().map(say).collect()),
            Self::Computation(report) => Self::Computation(say(report)),
            other => other,
        }
    }

    /// An error of assembly, in the text of a case where it has a place there.
    pub fn assembly(error: AssemblyError, source: &str) -> Self {
        match error {
            AssemblyError::Case(error) => Self::case(error, source),
            AssemblyError::System(error) => Self::from(error),
            error => {
                let help = error.help();
                Self::input(error.to_string(), help)
            }
        }
    }
}

impl From<TimeHistoryError> for Failure {
    fn from(error: TimeHistoryError) -> Self {
        let help = error.help();
        match error {
            error @ (TimeHistoryError::Motions { .. }
            | TimeHistoryError::GapDefinition { .. }
            | TimeHistoryError::LinkDefinition { .. }
            | TimeHistoryError::NotLinear { .. }
            | TimeHistoryError::InitialState { .. }
            | TimeHistoryError::Force { .. }
            | TimeHistoryError::JumpsAtPoints { .. }
            | TimeHistoryError::FrictionAtPoints { .. }
            | TimeHistoryError::CompliantModel { .. }
            | TimeHistoryError::NoClearance { .. }
            | TimeHistoryError::ContactTooShort { .. }
            | TimeHistoryError::ClosureTooShort { .. }
            | TimeHistoryError::TooManySteps { .. }
            | TimeHistoryError::UnstableStep { .. }
            | TimeHistoryError::Option { .. }) => Self::input(error.to_string(), help),
            error => Self::Computation(plain(error.to_string(), help)),
        }
    }
}

impl From<ResponsesTooLarge> for Failure {
    fn from(error: ResponsesTooLarge) -> Self {
        Self::input(error.to_string(), Some(error.help()))
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::unwritten(error.to_string(), Some(error.help()))
    }
}

impl From<FileUseError> for Failure {
    fn from(error: FileUseError) -> Self {
        Self::input(error.to_string(), Some(error.help()))
    }
}

impl From<VerificationError> for Failure {
    fn from(error: VerificationError) -> Self {
        match error {
            VerificationError::Collision(error) => error.into(),
            VerificationError::Stiffness(error) => error.into(),
            VerificationError::Calibration(error) => error.into(),
            VerificationError::Law(error) => error.into(),
            VerificationError::Entered(error) => {
                let help = error.help.clone();
                Self::input(error.to_string(), Some(help))
            }
            VerificationError::Case { error, text } => match *error {
                AssemblyError::System(error) => error.into(),
                error => Self::assembly(error, &text),
            },
            VerificationError::GroundMotion(error) => error.into(),
            error => Self::input(error.to_string(), None),
        }
    }
}

impl From<ContactStiffnessError> for Failure {
    fn from(error: ContactStiffnessError) -> Self {
        Self::input(error.to_string(), Some(error.help()))
    }
}

impl From<MeasuredForceError> for Failure {
    fn from(error: MeasuredForceError) -> Self {
        Self::input(error.to_string(), Some(error.help().to_owned()))
    }
}

impl From<LaboratoryError> for Failure {
    fn from(error: LaboratoryError) -> Self {
        Self::input(error.to_string(), Some(error.help()))
    }
}

impl From<DocumentationError> for Failure {
    fn from(error: DocumentationError) -> Self {
        match error {
            DocumentationError::Model(error) => error.into(),
            DocumentationError::Law(error) => error.into(),
            error => Self::not_drawn(&error),
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
            GroundMotionError::Io { ref source, .. } if is_short_of_files(source) => {
                Self::computation(error.to_string(), Some(MORE_FILES.to_owned()))
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
            GapElementError::Definition(DefinitionError::UnknownName { ref name, .. }) => {
                let help = help_among_gaps(name).or(error.help());
                Self::input(error.to_string(), help)
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

/// An error with the line it stands in, where the text is known.
fn located(error: CaseError, source: &str) -> Report {
    let mut diagnostic = MietteDiagnostic::new(terminal::shown(&error.to_string()));
    diagnostic.help = error.help.map(|help| terminal::shown(&help).into_owned());
    if source.is_empty() {
        return Report::new(diagnostic);
    }
    excerpt::report(diagnostic, &error.file, source, error.span)
}

fn plain(message: String, help: Option<String>) -> Report {
    let mut diagnostic = MietteDiagnostic::new(terminal::shown(&message));
    diagnostic.help = help.map(|help| terminal::shown(&help).into_owned());
    Report::new(diagnostic)
}
