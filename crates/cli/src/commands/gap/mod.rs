//! `pounding gap`: is the gap wide enough?

mod answer;
mod files;
pub mod numbers;
mod provisions;
mod rules;
mod suite;
mod text;

use std::path::Path;

use pounding_case::{Case, Dimension, Separation, bare_gap_width};
use pounding_files::FileUse;
use pounding_report::page::Picture;
use pounding_report::pictures::gap::{amplifications, no_amplification, spectra};
use pounding_report::{Answered, AnsweredCommand};
use pounding_study::Deal;
use pounding_study::gap_check::{
    GapCheck, GapCheckOptions, SweepOptions, gap_check_dealt, unknown_names,
};

use crate::arguments::{GapArguments, OutputPath, is_bare, optional};
use crate::asked_separation::{Asked, overridden};
use crate::deal::{deal, print_shard};
use crate::failure::Failure;
use crate::faults::{of_check, read_case, recorded};
use crate::files::{an_answer_has_a_place, have_a_place};
use crate::output::{pretty, print, warn};
use crate::progress::{Progress, Unit, threads};
use crate::{page, plot};

/// Checks the gaps of a case; the answer "too small" is exit code 1.
pub fn gap(arguments: &GapArguments, mut files: FileUse) -> Result<(), Failure> {
    let Some(path) = arguments.case.as_deref().filter(|_| !arguments.list) else {
        return match &arguments.pages {
            Some(folder) => provisions::write_page(folder),
            None => provisions::list(arguments.json),
        };
    };
    let case = read_case(path, arguments.records.is_empty())?;
    let separation = separation(&case, arguments)?;
    let options = options(arguments)?;
    let failed = |e| of_check(e, &case);
    let records = recorded(&case, &arguments.records, &mut files)?;
    let answers = [
        ("--csv", arguments.csv.is_some()),
        ("--codes-csv", arguments.codes_csv.is_some()),
        ("--plot", arguments.plot.is_some()),
        ("--spectra", arguments.spectra.is_some()),
        ("--report", arguments.report.is_some()),
        ("--output", arguments.output.is_some()),
        ("--json", arguments.json),
    ];
    let deal = deal(&arguments.dealing, ("gap", path), &answers, &mut files)?;
    if arguments.points == 0 && deal != Deal::All {
        let help = "leave --points 0 away, or --shard and --merge".to_owned();
        let message = "without a sweep there are no runs to share";
        return Err(Failure::input(message, Some(help)));
    }
    have_a_place([
        arguments.csv.as_deref(),
        arguments.codes_csv.as_deref(),
        arguments.plot.as_deref(),
        arguments.spectra.as_deref(),
        arguments.report.as_deref(),
    ])?;
    an_answer_has_a_place(arguments.output.as_deref())?;
    if (arguments.csv.is_some() || arguments.plot.is_some()) && arguments.points == 0 {
        let help = "leave --points 0 away".to_owned();
        let message = "without a sweep there is nothing to write or draw";
        return Err(Failure::input(message, Some(help)));
    }
    let progress = Progress::begin(Unit::Runs)?;
    let tell = |done: usize, total: usize| {
        progress.show(done, total, "");
        std::ops::ControlFlow::Continue(())
    };
    let check = gap_check_dealt(&case, &separation, &records, &options, (&tell, &deal));
    let check = check.map_err(failed)?;
    drop(progress);
    if print_shard(&deal, "gap")? {
        return Ok(());
    }
    write_files(arguments, &check)?;
    let answered = || {
        let words = "Amplification of peaks by pounding over the width of the gap";
        let widths = amplifications(&check).map(|drawn| Picture::of("widths", words, drawn));
        let words = "Spectra of the records, their mean and the target";
        let spectra = Picture::of("spectra", words, spectra(&check));
        Ok(Answered {
            command: AnsweredCommand::Gap,
            inputs: page::of_gap(&case, path, &records, &separation),
            answer: page::answer(&numbers::Check::of(&check))?,
            figures: widths.into_iter().chain([spectra]).collect(),
        })
    };
    page::write_answered(
        answered,
        arguments.output.as_deref(),
        arguments.report.as_deref(),
    )?;
    if arguments.json {
        print(&pretty(&numbers::Check::of(&check))?)?;
    } else {
        print(&text::report(&case, &check, arguments.all))?;
    }
    if check.adequate() {
        Ok(())
    } else {
        Err(Failure::No)
    }
}

/// What provisions need to know: of the case, of arguments in its place, and rules of a file.
fn separation(case: &Case, arguments: &GapArguments) -> Result<Separation, Failure> {
    let mut separation = case.separation.clone();
    let key = |text: &String| text.split('=').next().unwrap_or_default().trim().to_owned();
    let keys: Vec<String> = arguments.set.iter().map(key).collect();
    let (mut failures, mut set) = (Vec::new(), Vec::new());
    for (place, text) in arguments.set.iter().enumerate() {
        let key_here = &keys[place];
        if keys[..place].contains(key_here) {
            failures.push(Failure::input(
                format!("--set {text}: {key_here} is given twice"),
                Some("leave one out".to_owned()),
            ));
            continue;
        }
        match Separation::parse(text, case.buildings.len()) {
            Ok(one) => match unknown_names(&one, ("--set", text)) {
                Some(error) => failures.push(Failure::case(error, text)),
                None => set.push(one),
            },
            Err(error) => failures.push(Failure::case(error, text)),
        }
    }
    if failures.is_empty() {
        // Together, so that a key is found to stand twice however it is written.
        let all = arguments.set.join("\n");
        let together = Separation::parse(&all, case.buildings.len()).err();
        failures.extend(decided_twice(arguments, &set));
        failures.extend(
            together
                .filter(|_| failures.is_empty())
                .map(|error| Failure::case(error, &all)),
        );
    }
    separation = set.into_iter().fold(separation, Separation::overridden_by);
    if !failures.is_empty() {
        return Err(Failure::together(failures));
    }
    overridden(
        separation,
        &Asked {
            code: arguments.code.as_deref(),
            country: arguments.country.as_deref(),
            date: arguments.date.as_deref(),
            provisions: &arguments.provisions,
            rules: arguments.rules.as_deref(),
        },
    )
}

/// Whether `--set` and options give the same words for the provisions or the verdict, of which one would go unheard.
fn decided_twice(arguments: &GapArguments, set: &[Separation]) -> Option<Failure> {
    let is_set = |has: fn(&Separation) -> bool| set.iter().any(has);
    // Key, whether it is an option, and whether it is set.
    let words = [
        (
            "code",
            arguments.code.is_some(),
            is_set(|s| s.code.is_some()),
        ),
        (
            "country",
            arguments.country.is_some(),
            is_set(|s| s.country.is_some()),
        ),
        (
            "date",
            arguments.date.is_some(),
            is_set(|s| s.date.is_some()),
        ),
        (
            "provisions",
            !arguments.provisions.is_empty(),
            is_set(|s| s.provisions.is_some()),
        ),
    ];
    let one_of_them = |words: String| {
        let help = "leave one of them out".to_owned();
        Some(Failure::input(
            format!("{words} are both given"),
            Some(help),
        ))
    };
    let twice = words.iter().find(|(_, given, set)| *given && *set);
    if let Some((key, ..)) = twice {
        return one_of_them(format!("--set {key} and --{key}"));
    }
    let [(_, code, code_set), (_, country, country_set), ..] = words;
    // Both by options are refused where they are put together.
    match (code || code_set) && (country || country_set) && !(code && country) {
        true => one_of_them("`code` and `country`".to_owned()),
        false => None,
    }
}

fn options(arguments: &GapArguments) -> Result<GapCheckOptions, Failure> {
    let width = |text: &Option<String>, name| optional(text.as_deref(), name, Dimension::LENGTH);
    let (from, to) = (width(&arguments.from, "from")?, width(&arguments.to, "to")?);
    // Of two ends the greater says what was meant.
    let ends = [
        ("--to", to, &arguments.to),
        ("--from", from, &arguments.from),
    ];
    let bare = ends.into_iter().find_map(|(name, width, text)| {
        let is_bare = text.as_deref().is_some_and(is_bare);
        bare_gap_width(&format!("{name} is"), width.filter(|_| is_bare)?)
    });
    if let Some(question) = bare {
        warn(&question);
    }
    let of_sweep = [
        ("--from", &arguments.from),
        ("--to", &arguments.to),
        ("--gap", &arguments.gap),
    ];
    if let Some((name, _)) = of_sweep.iter().find(|(_, given)| given.is_some())
        && arguments.points == 0
    {
        let help = format!("leave --points 0 away, or {name}");
        let message = format!("without a sweep there is nothing that {name} could say");
        return Err(Failure::input(message, Some(help)));
    }
    let sweep = (arguments.points > 0).then(|| SweepOptions {
        gap: arguments.gap.clone(),
        from,
        to,
        points: arguments.points,
    });
    Ok(GapCheckOptions {
        target_probability: arguments.probability,
        confidence: arguments.confidence,
        sweep,
        threads: threads(arguments.threads),
    })
}

fn write_files(arguments: &GapArguments, check: &GapCheck) -> Result<(), Failure> {
    let write = |path: &Option<OutputPath>, text: &dyn Fn() -> Result<String, Failure>| {
        let write = |path: &Path| plot::write(path, &text()?);
        path.as_deref().map_or(Ok(()), write)
    };
    write(&arguments.codes_csv, &|| files::codes(check))?;
    write(&arguments.csv, &|| files::sweep(check))?;
    if let Some(path) = arguments.spectra.as_deref() {
        plot::write_drawn(path, spectra(check), &arguments.figure)?;
    }
    let Some(path) = arguments.plot.as_deref() else {
        return Ok(());
    };
    // Who asks for a file has one.
    let picture = amplifications(check).unwrap_or_else(no_amplification);
    plot::write_drawn(path, picture, &arguments.figure)
}
