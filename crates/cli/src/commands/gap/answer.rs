//! The answer for a gap, before everything else.

use pounding_catalogue::numbers::{missing, rounded_up, rounded_up_beside, width_in_millimetres};
use pounding_catalogue::wording::{agreeing, counted};
use pounding_study::gap_check::{
    CodeAnswer, GapCheck, GapReport, LevelAnswer, LevelDemand, OwnershipAnswer, SuiteSpectrum,
};

use super::rules::widest;
use crate::tables::{decimal, new_table};

/// Bounds (m) from which on their digits say nothing: few records at a high confidence have them.
const NO_GAP: f64 = 1e4;

/// Whether the gap is wide enough, by the code that is asked for or by the demand, and what
/// decides.
pub fn answer(check: &GapCheck, gap: &GapReport) -> String {
    match &gap.code {
        Some(code) => by_code(check, gap, code),
        None => by_demand(check, gap),
    }
}

fn by_demand(check: &GapCheck, gap: &GapReport) -> String {
    let (low, high) = gap.contact_bounds;
    format!(
        "\nGap {}: {} - {} it, {} allowed (probability of contact {low:.3} to {high:.3} at {} % confidence)\n{}{}{}{}{}{}",
        gap.name,
        verdict(Some(gap.adequate)),
        records_that_close(gap),
        gap.required.allowed_contacts,
        100.0 * check.options.confidence,
        what_fails(gap),
        driven(gap),
        governing(check, gap),
        required(check, gap),
        provided(gap),
        widest(gap),
    )
}

/// What fails at the width of a gap whatever the answer is: decks that fall, and columns that are hit beyond their
/// capacity.
fn what_fails(gap: &GapReport) -> String {
    let mut fails = String::new();
    let most = |of: &[LevelDemand]| {
        let all = of.iter().map(|found| found.response.peak.value);
        all.fold(0.0, f64::max)
    };
    let opening = most(&gap.openings);
    if let Some(seat) = gap.seat.filter(|seat| opening > *seat) {
        fails.push_str(&format!(
            "  THE DECK FALLS at this width: the joint opens by {:.1} mm, more than its seat of {:.1} mm\n",
            1e3 * opening,
            1e3 * seat
        ));
    }
    let ratios = gap.columns.iter().filter_map(|c| c.response.demand_ratio());
    let ratio = ratios.fold(0.0, f64::max);
    if ratio > 1.0 {
        fails.push_str(&format!(
            "  COLUMNS FAIL at this width: those that floors of the neighbour face bear {} times their shear capacity\n",
            decimal(ratio, 2)
        ));
    }
    fails
}

fn verdict(enough: Option<bool>) -> &'static str {
    match enough {
        Some(true) => "WIDE ENOUGH",
        Some(false) => "TOO SMALL",
        None => "NO ANSWER",
    }
}

/// `7 of 7 records close`.
fn records_that_close(gap: &GapReport) -> String {
    format!(
        "{} of {} {}",
        gap.records_in_contact,
        counted(gap.records(), "record"),
        agreeing(&gap.records(), "closes", "close")
    )
}

/// Records that close the gap without a demand beyond its width, and why.
fn driven(gap: &GapReport) -> String {
    let mut text = String::new();
    if gap.records_driven > 0 {
        text.push_str(&format!(
            "  under {} of them only because another gap of the row closes: no width by demand or rule sees that, make the other gap wide enough first\n",
            gap.records_driven
        ));
    }
    if gap.records_at_demand > 0 {
        text.push_str(&format!(
            "  under {} of them the width is the demand to the last digits, and round-off of the run closes it: a millionth more suffices\n",
            gap.records_at_demand
        ));
    }
    text
}

/// What is left of a width that is provided (m), or short of the one that is required.
pub fn left_or_short(provided: f64, required: f64) -> String {
    match provided - required {
        left if left < 0.0 => {
            let provided = width_in_millimetres(provided);
            format!("{} mm short", missing(required * 1e3, &provided, 2))
        }
        left => format!("{:.2} mm left", left * 1e3),
    }
}

/// The level that decides where levels have different widths, and by how much.
fn governing(check: &GapCheck, gap: &GapReport) -> String {
    if gap.of_one_width() || gap.required.by_count.is_none() {
        return String::new();
    }
    let governing = &gap.governing;
    format!(
        "  level {} governs: required {} mm (the demand of {}), provided {} mm, {}\n",
        gap.levels[governing.level].place.label(),
        rounded_up_beside(governing.required * 1e3, governing.provided * 1e3, 2),
        check.records[governing.record].name,
        width_in_millimetres(governing.provided),
        left_or_short(governing.provided, governing.required),
    )
}

/// The width that the records ask for.
fn required(check: &GapCheck, gap: &GapReport) -> String {
    let p = check.options.target_probability;
    let confidence = 100.0 * check.options.confidence;
    let required = &gap.required;
    let Some(by_count) = required.by_count else {
        return format!(
            "  no width is required by count: {} of {} may touch, and under {} a building collapses without contact\n",
            required.allowed_contacts,
            counted(gap.records(), "record"),
            gap.records_collapsed,
        );
    };
    let mut text = format!(
        "  {} {} mm by count ({} of {} may touch)",
        match gap.of_one_width() {
            true => "required",
            false => "one width at all levels would have to be",
        },
        match gap.of_one_width() {
            true => rounded_up_beside(by_count * 1e3, gap.governing.provided * 1e3, 2),
            false => rounded_up(by_count * 1e3, 2),
        },
        required.allowed_contacts,
        counted(gap.records(), "record"),
    );
    let decides = gap.demand.iter().position(|d| *d == by_count);
    if let Some(record) = decides.filter(|_| by_count > 0.0) {
        text.push_str(&format!(
            ": the demand of {}",
            check.records[record].name.as_str()
        ));
    }
    text.push('\n');
    match &required.lognormal {
        Ok(fit) => text.push_str(&format!(
            "  lognormal demand (median {:.2} mm, dispersion {:.3}): {} mm is exceeded with probability {p}; {confidence} % bounds {:.2} {}\n",
            fit.median * 1e3,
            fit.dispersion,
            rounded_up(fit.width * 1e3, 2),
            fit.bounds.0 * 1e3,
            match fit.bounds.1 < NO_GAP {
                true => format!("to {:.2} mm", fit.bounds.1 * 1e3),
                false => "mm to more than 10 km".to_owned(),
            },
        )),
        Err(reason) if p > 0.0 => text.push_str(&format!("  no lognormal fit: {reason}\n")),
        Err(_) => {}
    }
    text
}

/// Where the demand is the maximum, and what is provided there, if it is the same at all levels.
fn provided(gap: &GapReport) -> String {
    if !gap.of_one_width() {
        return String::new();
    }
    let level = &gap.levels[gap.governing.level];
    format!(
        "  provided {} mm at level {}, where the demand is the maximum\n",
        width_in_millimetres(level.width),
        level.place.label()
    )
}

fn by_code(check: &GapCheck, gap: &GapReport, answer: &CodeAnswer) -> String {
    let code = &answer.code;
    let mut text = format!(
        "\nGap {} by {} ({}): {}\n{}{}",
        gap.name,
        code.name,
        code.edition,
        verdict(answer.satisfied()),
        what_fails(gap),
        edition(answer)
    );
    let records = (gap.records(), check.repeated.distinct);
    let times = check.spectra.target.as_ref().map_or(1.0, |t| t.times);
    text.push_str(&statistic(answer, records, times));
    text.push_str(&cases(gap, answer));
    for case in &answer.cases {
        text.push_str(&short_anyway(gap, case));
        text.push_str(&explained(case));
    }
    if answer.cases.len() > 1 {
        text.push_str(&match answer.ownership {
            Some(stated) => format!("  the case states who owns the ground: {} decides\n", stated.name()),
            None => "  nothing says who owns the ground: both must be wide enough; --set same_owner=true or =false decides\n".to_owned(),
        });
    }
    text.push_str(&format!(
        "  the records themselves: {} demand {:.1} mm, {} the provided width\n{}{}",
        answer.statistic.name(),
        answer.demand * 1e3,
        records_that_close(gap),
        match check.options.target_probability {
            allowed if allowed > 0.0 => format!("  the probability of contact that is allowed, {allowed}, decides nothing here: the code does\n"),
            _ => String::new(),
        },
        driven(gap)
    ));
    let width = gap
        .levels
        .iter()
        .map(|l| l.width)
        .fold(f64::INFINITY, f64::min);
    if answer.satisfied() == Some(true) && answer.demand > width {
        text.push_str(&format!(
            "  warning: that is a width that the code accepts and the {} of the records does not: the buildings touch\n",
            answer.statistic.name()
        ));
    }
    text
}

/// By which day the edition was chosen, and from when to when it is in force.
fn edition(answer: &CodeAnswer) -> String {
    let code = &answer.code;
    let mut text = match answer.date {
        Some(date) => format!("  the edition in force on {date}; --date chooses another day\n"),
        None => String::new(),
    };
    if let Some(in_force) = &code.in_force {
        let next = code.superseded_by;
        let next = next.map_or_else(String::new, |next| format!("; superseded by {next}"));
        text.push_str(&format!("  in force {in_force}{next}\n"));
    }
    text
}

/// What decides: which number of the responses, and whether there are records enough.
fn statistic(answer: &CodeAnswer, (records, distinct): (usize, usize), times: f64) -> String {
    let suite = &answer.code.suite;
    let collapsed = match answer.collapsed {
        0 => String::new(),
        count => format!(
            "  warning: a building collapses without contact under {}: {}displacements and widths are those of the others\n",
            counted(count, "record"),
            match answer.satisfied() {
                None => "the code gives no answer, and ",
                Some(_) => "",
            }
        ),
    };
    if !answer.has_widths() {
        return collapsed;
    }
    if !answer.takes_records() {
        return format!(
            "  decided without the records: no displacement counts in the widths of the code here\n{collapsed}"
        );
    }
    let clause = match suite.clause {
        "" => String::new(),
        clause => format!(" ({clause}, {})", suite.status.name()),
    };
    let few = if answer.enough_records {
        String::new()
    } else {
        format!(
            "  warning: the code asks for {} records at least: with {distinct} the maximum is no answer by the code\n",
            suite.least
        )
    };
    format!(
        "  decided by the {} of the displacements under {}: {}{clause}\n{few}{}{collapsed}",
        answer.statistic.name(),
        records_of(records, distinct),
        suite.explanation(),
        spectrum(&answer.spectrum, times),
    )
}

/// How the mean spectrum of the records stands to what the code asks of it; `times` is the further
/// factor that their scale has.
fn spectrum(found: &SuiteSpectrum, times: f64) -> String {
    let mean = match found {
        SuiteSpectrum::NotKnown => return String::new(),
        SuiteSpectrum::NotCompared {
            condition,
            scaled_to,
        } => {
            let to = scaled_to.map_or_else(String::new, |other| {
                format!(", as they are scaled to that of {other}")
            });
            return format!(
                "  warning: the code asks for records whose mean spectrum is nowhere below {} of its own ({}), and they are not compared with it{to}: `scale = {{ code = \"{}\", ... }}` does\n",
                condition.at_least, condition.clause, condition.spectrum
            );
        }
        SuiteSpectrum::Compared(mean) => mean,
    };
    let condition = &mean.condition;
    let (ratio, period) = mean.least;
    let at_zero = mean.zero_period.map_or_else(String::new, |ratio| {
        format!(
            "; their mean peak acceleration is {ratio:.3} of that of the code, which asks for 1"
        )
    });
    let stands = format!(
        "from {:.3} to {:.3} s the mean spectrum of the records is nowhere below {ratio:.3} (at {period:.3} s) of that of the code, which asks for {}{at_zero} ({})",
        mean.band.0, mean.band.1, condition.at_least, condition.clause
    );
    if mean.is_reached() {
        return format!("  {stands}\n");
    }
    // Up, so that it is enough.
    let raised = (1.0e4 * times * mean.factor()).ceil() * 1.0e-4;
    format!(
        "  warning: {stands}: that is no answer by the code; `times = {raised:.4}` beside `code` in `scale` brings all records to it\n"
    )
}

/// `7 records`, `7 records, 6 of them distinct`.
fn records_of(records: usize, distinct: usize) -> String {
    let all = counted(records, "record");
    match records == distinct {
        true => all,
        false => format!("{all}, {distinct} of them distinct"),
    }
}

fn cases(gap: &GapReport, answer: &CodeAnswer) -> String {
    let name = answer.statistic.name();
    let mut table = new_table(&[
        "ownership".to_owned(),
        "level".to_owned(),
        format!("{name} displacement {} (mm)", gap.between[0]),
        format!("{name} displacement {} (mm)", gap.between[1]),
        "required (mm)".to_owned(),
        "provided (mm)".to_owned(),
        "verdict".to_owned(),
        "rule".to_owned(),
        "status".to_owned(),
    ]);
    for case in &answer.cases {
        let ownership = case.ownership.map_or("any", |o| o.name()).to_owned();
        let Some((level, governing)) = case.governing() else {
            let mut row = vec![ownership];
            row.extend(["-", "-", "-", "-", "-", "no answer", "-", "-"].map(str::to_owned));
            table.add_row(row);
            continue;
        };
        let LevelAnswer {
            displacement,
            width,
            provided,
            ..
        } = governing;
        let shown = |u: Option<f64>| u.map_or("-".to_owned(), |u| format!("{:.1}", u * 1e3));
        let reached = match case.satisfied() {
            Some(true) => "wide enough",
            Some(false) => "too small",
            None => "no answer",
        };
        let mut statuses: Vec<_> = width.provisions().map(|p| p.status().name()).collect();
        statuses.dedup();
        table.add_row([
            ownership,
            gap.levels[level].place.label(),
            shown(displacement[0]),
            shown(displacement[1]),
            widths(governing),
            width_in_millimetres(*provided),
            reached.to_owned(),
            width
                .provisions()
                .map(|p| p.name())
                .collect::<Vec<_>>()
                .join(" and "),
            statuses.join(" and "),
        ]);
    }
    format!("{table}\n")
}

/// By which rule the gap is too small under any records, where the widths that take them are no answer.
fn short_anyway(gap: &GapReport, case: &OwnershipAnswer) -> String {
    match case.falls_short_anyway() {
        Some((level, least)) => format!(
            "  {}too small under any records: {} asks for {} mm at level {}, whatever the displacements are\n",
            case.ownership
                .map_or(String::new(), |o| format!("{}: ", o.name())),
            least.provision.name(),
            rounded_up(least.width * 1e3, 1),
            gap.levels[level].place.label()
        ),
        None => String::new(),
    }
}

/// Why a code gives no answer, or its formula with what is not verified.
fn explained(case: &OwnershipAnswer) -> String {
    let ownership = case
        .ownership
        .map_or(String::new(), |o| format!("{}: ", o.name()));
    if let Some(refusal) = case.refusal() {
        let help = refusal.help().map_or(String::new(), |h| format!("; {h}"));
        return format!("  {ownership}{refusal}{help}\n");
    }
    let Some((_, governing)) = case.governing() else {
        return String::new();
    };
    let provision = &governing.width.provision;
    let requirement = &governing.width.requirement;
    let clause = match provision.clause() {
        "" => String::new(),
        clause => format!("clause {clause}: "),
    };
    let mut text = format!("  {ownership}{clause}{}\n", requirement.explanation);
    let mut add = |what: &str, said: &str| text.push_str(&format!("    {what}: {said}\n"));
    for rule in governing.width.provisions() {
        if governing.width.beside.is_some() {
            add("by", rule.name());
        }
        add(rule.status().name(), &rule.source());
        for (what, said) in rule.assumptions().list() {
            add(what, said);
        }
        for remark in rule.remarks() {
            add("to know", remark);
        }
    }
    if let Some(undecided) = requirement.undecided() {
        // Where every reading asks for more than is provided, none need be chosen.
        match governing.has_answer() {
            true => add("every reading", "asks for more than is provided"),
            false => add("no verdict", &undecided),
        }
    }
    text
}

/// The width (mm), or that of each reading of a disputed rule, beside the width that is provided.
fn widths(answer: &LevelAnswer) -> String {
    let requirement = &answer.width.requirement;
    let shown = |width: f64| {
        let judged = answer.as_judged(width);
        rounded_up_beside(judged * 1e3, answer.provided * 1e3, 1)
    };
    let readings = requirement.readings.iter();
    let readings: Vec<_> = readings.map(|r| shown(r.width)).collect();
    match readings.is_empty() {
        true => shown(requirement.width),
        false => readings.join(" or "),
    }
}
