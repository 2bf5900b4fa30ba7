//! `pounding compare`: is the answer sensitive to the impact model?

mod files;
pub mod numbers;
mod text;

use pounding_files::FileUse;
use pounding_report::page::Picture;
use pounding_report::pictures::comparison::peak_ratios;
use pounding_report::{Answered, AnsweredCommand};
use pounding_study::comparison::{
    ComparisonOptions, RestitutionRule, StiffnessRule, compare_dealt,
};

use crate::arguments::{CompareArguments, RestitutionChoice, StiffnessChoice};
use crate::deal::{deal, print_shard};
use crate::failure::Failure;
use crate::faults::{of_check, read_case, recorded};
use crate::files::{an_answer_has_a_place, have_a_place};
use crate::output::{pretty, print};
use crate::progress::{Progress, Unit, threads};
use crate::{page, plot};

/// Runs every model on every record. Models that fail are listed with their diagnosis;
/// if none is left, the computation failed.
pub fn run(arguments: &CompareArguments, mut files: FileUse) -> Result<(), Failure> {
    let case = read_case(&arguments.case, arguments.records.is_empty())?;
    let failed = |e| of_check(e, &case);
    let records = recorded(&case, &arguments.records, &mut files)?;
    let answers = [
        ("--csv", arguments.csv.is_some()),
        ("--plot", arguments.plot.is_some()),
        ("--report", arguments.report.is_some()),
        ("--output", arguments.output.is_some()),
        ("--json", arguments.json),
    ];
    let check = ("compare", &*arguments.case);
    let deal = deal(&arguments.dealing, check, &answers, &mut files)?;
    have_a_place([
        arguments.csv.as_deref(),
        arguments.plot.as_deref(),
        arguments.report.as_deref(),
    ])?;
    an_answer_has_a_place(arguments.output.as_deref())?;
    let options = ComparisonOptions {
        models: arguments.models.clone(),
        stiffness_rule: match arguments.stiffness_rule {
            StiffnessChoice::Penetration => StiffnessRule::Penetration,
            StiffnessChoice::Duration => StiffnessRule::Duration,
        },
        restitution_rule: match arguments.restitution_rule {
            RestitutionChoice::Published => RestitutionRule::AsPublished,
            RestitutionChoice::Exact => RestitutionRule::Exact,
        },
        restitution: arguments.restitution,
        approach_velocity: arguments.approach_velocity,
        threads: threads(arguments.threads),
    };
    let progress = Progress::begin(Unit::Runs)?;
    let tell = |done: usize, total: usize| {
        progress.show(done, total, "");
        std::ops::ControlFlow::Continue(())
    };
    let comparison = compare_dealt(&case, &records, &options, (&tell, &deal)).map_err(failed)?;
    drop(progress);
    if print_shard(&deal, "compare")? {
        return Ok(());
    }
    if let Some(path) = &arguments.csv {
        plot::write(path, &files::table(&comparison)?)?;
    }
    if let Some(path) = &arguments.plot {
        plot::write_drawn(path, peak_ratios(&comparison), &arguments.figure)?;
    }
    let answered = || {
        let words = "Peaks over those without pounding, by impact model";
        Ok(Answered {
            command: AnsweredCommand::Compare,
            inputs: page::of_case("compare", &case, &arguments.case, &records),
            answer: page::answer(&numbers::Compared::of(&comparison))?,
            figures: vec![Picture::of("peaks", words, peak_ratios(&comparison))],
        })
    };
    page::write_answered(
        answered,
        arguments.output.as_deref(),
        arguments.report.as_deref(),
    )?;
    if arguments.json {
        print(&pretty(&numbers::Compared::of(&comparison))?)?;
    } else {
        print(&text::report(&case, &comparison))?;
    }
    if comparison.complete().is_empty() {
        let message = "no model ran under every record".to_owned();
        return Err(Failure::computation(
            message,
            Some("the table says why".to_owned()),
        ));
    }
    Ok(())
}
