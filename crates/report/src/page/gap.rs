//! The page of a gap check.

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::wording::{agreeing, counted};
use pounding_time_history::VELOCITY_JUMPS;
use serde_json::Value;

use super::answer::Answer;
use super::html::{named, note, section, section_of, sentences, warnings};
use super::studies::{collapsed, pictures, rows};
use super::table::Column;
use crate::answer_file::{Inputs, Picture};

/// Name of the picture of the widths that were tried; all others are of the records.
const WIDTHS: &str = "widths";

/// The page of what `gap --json` prints.
#[must_use]
pub fn gap(answer: &Value, drawn: &[Picture], inputs: &Inputs) -> String {
    let answer = Answer(answer);
    let gaps = answer.list("/gaps").len();
    let mut points: Vec<String> = (0..gaps).flat_map(|g| verdict(answer, g)).collect();
    points.extend(collapsed(
        answer,
        "No gap is wide enough for that: the record counts as one that brings the buildings into contact, and all \
         else here is of the other records.",
    ));
    points.extend(failures(answer));
    let warned: Vec<String> = answer
        .list("/warnings")
        .iter()
        .filter_map(|w| Some(w.as_str()?.to_owned()))
        .collect();
    let mut body = section(
        "Is the gap wide enough?",
        &(sentences(&points) + &warnings(&warned)),
    );
    for g in 0..gaps {
        let title = ["Gap ", answer.text(&format!("/gaps/{g}/name")), ""];
        body.push_str(&section_of(title, &demand(answer, g)));
    }
    body.push_str(&section(
        "With pounding at the provided gap",
        &provided(answer),
    ));
    if !answer.at("/sweep").is_null() {
        let varied = match answer.text("/sweep/gap") {
            "" if gaps > 1 => "of all gaps, all of the same width".to_owned(),
            "" => "of the gap".to_owned(),
            gap => format!("of gap {gap}, the others as provided"),
        };
        let inside = note(&format!(
            "Peaks with pounding over those of the isolated buildings at many widths {varied}, the maximum over \
             storeys{}: a gap a little too small can be worse than none.",
            over_records(answer)
        ));
        let widths = pictures(drawn.iter().filter(|p| p.name == WIDTHS));
        let inside = inside + &without_ratio(answer) + &widths + &swept(answer);
        body.push_str(&section("Other widths", &inside));
    }
    let spectra = pictures(drawn.iter().filter(|p| p.name != WIDTHS));
    body.push_str(&section(
        "Records",
        &(records(answer) + &scaled(answer) + &spectra),
    ));
    for g in 0..gaps {
        let name = answer.text(&format!("/gaps/{g}/name"));
        let title = ["Gap ", name, " by every rule"];
        body.push_str(&section_of(title, &rules(answer, g)));
    }
    inputs.page(&body)
}

/// The answer in words.
fn judged(adequate: bool) -> &'static str {
    match adequate {
        true => "is wide enough",
        false => "is too small",
    }
}

/// What is answered for a gap: the answer, why, and what would be wide enough.
fn verdict(answer: Answer<'_>, g: usize) -> Vec<String> {
    let at = |path: &str| format!("/gaps/{g}/{path}");
    let name = answer.quote(&at("name"));
    let mut points = Vec::new();
    if answer.at(&at("code")).is_object() {
        points.extend(by_code(answer, g));
    } else {
        let adequate = answer.at(&at("adequate")).as_bool() == Some(true);
        points.push(format!("<strong>Gap {name} {}.</strong>", judged(adequate)));
    }
    for c in 0..answer.list(&at("columns")).len() {
        let column = |key: &str| at(&format!("columns/{c}/{key}"));
        let ratio = answer.at(&column("demand_over_capacity")).as_f64();
        if !ratio.is_some_and(|ratio| ratio > 1.0) {
            continue;
        }
        let level = answer.at(&column("level")).as_u64();
        let level = level.map_or(0, |level| level.saturating_sub(1));
        points.push(format!(
            "At level {} the columns that floors of the neighbour face bear {} times their shear capacity under {}: <strong>they fail</strong>.",
            answer.quote(&at(&format!("levels/{level}/level"))),
            answer.say(&column("demand_over_capacity"), 1.0),
            answer.quote(&column("record")),
        ));
    }
    for o in 0..answer.list(&at("openings")).len() {
        let opening = |key: &str| at(&format!("openings/{o}/{key}"));
        let (peak, seat) = (
            answer.at(&opening("peak")).as_f64(),
            answer.at(&at("seat")).as_f64(),
        );
        let level = answer.at(&opening("level")).as_u64();
        let level = level.map_or(0, |level| level.saturating_sub(1));
        points.push(format!(
            "At level {} the joint opens by {} mm under {}: {} its seat of {} mm.",
            answer.quote(&at(&format!("levels/{level}/level"))),
            answer.say(&opening("peak"), 1.0e3),
            answer.quote(&opening("record")),
            match peak > seat {
                true => "<strong>the deck falls</strong>, as that is more than",
                false => "within",
            },
            answer.say(&at("seat"), 1.0e3),
        ));
    }
    let collapsed = answer.list("/collapsed").len();
    let records = answer.list("/records").len() + collapsed;
    let allowed = answer.number(&at("required/allowed_contacts"), "") as usize;
    let governing = answer.at(&at("governing/level")).as_u64();
    let governing = governing.map_or(0, |level| level.saturating_sub(1));
    let known = !answer.at(&at("required/by_count")).is_null();
    let governs = match known {
        false => String::new(),
        true => format!(
            " Level {} governs: {} mm are required there and {} mm are provided.",
            answer.quote(&at(&format!("levels/{governing}/level"))),
            answer.say(&at("governing/required"), 1.0e3),
            answer.say(&at("governing/provided"), 1.0e3),
        ),
    };
    // Answers of early versions have none.
    let probability = match answer.at(&at("contact_probability_bounds")).is_array() {
        false => String::new(),
        true => format!(
            " (probability of contact {} to {} at {} confidence)",
            answer.say(&at("contact_probability_bounds/0"), 1.0),
            answer.say(&at("contact_probability_bounds/1"), 1.0),
            answer.say_percent("/confidence"),
        ),
    };
    let fallen = match collapsed {
        0 => String::new(),
        some => format!(
            ", of which {some} {} because a building collapses without contact",
            agreeing(&some, "counts as such", "count as such")
        ),
    };
    points.push(format!(
        "{} of {} {} it{fallen}; {} may{probability}.{governs}",
        answer.at(&at("records_in_contact")),
        counted(records, "record"),
        agreeing(&records, "closes", "close"),
        match allowed {
            0 => "none".to_owned(),
            some => some.to_string(),
        },
    ));
    let driven = answer.at(&at("records_driven_by_neighbours")).as_u64();
    let driven = driven.filter(|count| *count > 0);
    if let Some(count) = driven {
        points.push(format!(
            "Under {count} of them only because another gap of the row closes: the widths here do not see that, make \
             the other gap wide enough first."
        ));
    }
    let at_demand = answer.at(&at("records_at_demand")).as_u64();
    if let Some(count) = at_demand.filter(|count| *count > 0) {
        points.push(format!(
            "Under {count} of them the width is the demand to the last digits, and round-off of the run closes it: a \
             millionth more suffices."
        ));
    }
    if !known {
        points.push(format!(
            "No width is enough: under {} a building collapses without contact.",
            counted(collapsed, "record")
        ));
        return points;
    }
    let widths: Vec<_> = (answer.list(&at("levels")).iter())
        .map(|level| &level["width"])
        .collect();
    let levels = match widths.iter().all(|width| *width == widths[0]) {
        true => "",
        false => " at all levels",
    };
    let alone = match driven {
        Some(_) => " while the other gaps stay open",
        None => "",
    };
    let mut required = format!(
        "A width of {} mm{levels} is needed so that {} closes it{alone}.",
        answer.say(&at("required/by_count"), 1.0e3),
        match allowed {
            0 => "no record".to_owned(),
            some => format!("no more than {}", counted(some, "record")),
        },
    );
    if answer.at(&at("required/lognormal")).is_object() {
        required.push_str(&format!(
            " By a lognormal demand (median {} mm, dispersion {}) {} mm are needed, between {} and {} mm at \
             {} confidence.",
            answer.say(&at("required/lognormal/median"), 1.0e3),
            answer.say(&at("required/lognormal/dispersion"), 1.0),
            answer.say(&at("required/lognormal/width"), 1.0e3),
            answer.say(&at("required/lognormal/bounds/0"), 1.0e3),
            answer.say(&at("required/lognormal/bounds/1"), 1.0e3),
            answer.say_percent("/confidence"),
        ));
    }
    points.push(required);
    points
}

/// What a code says of a gap.
fn by_code(answer: Answer<'_>, g: usize) -> Vec<String> {
    let at = |path: &str| format!("/gaps/{g}/{path}");
    let name = answer.quote(&at("name"));
    let mut points = Vec::new();
    // Its own answer: what the records say without it stands below.
    let satisfied = answer.at(&at("code/satisfied")).as_bool();
    let edition = answer.quote(&at("code/edition"));
    let said = match satisfied {
        Some(yes) => format!("By {edition} gap {name} {}.", judged(yes)),
        None => format!("{edition} gives no answer for gap {name}."),
    };
    points.push(format!(
        "<strong>{said}</strong> Demand of the suite by its rule ({}): {} mm.",
        answer.quote(&at("code/statistic")),
        answer.say(&at("code/demand"), 1.0e3),
    ));
    points.push(statistic(answer, &at("code")));
    for c in 0..answer.list(&at("code/cases")).len() {
        points.extend(by_ownership(answer, g, &at(&format!("code/cases/{c}"))));
    }
    let in_force = answer.quote(&at("code/in_force"));
    if !in_force.is_empty() {
        let chosen = match answer.text("/date") {
            "" => String::new(),
            date => format!(" It is the edition in force on {}.", named(date)),
        };
        let next = match answer.text(&at("code/superseded_by")) {
            "" => String::new(),
            next => format!(" Superseded by {}.", named(next)),
        };
        points.push(format!("The edition is in force {in_force}.{chosen}{next}"));
    }
    let stated = answer.quote(&at("code/ownership"));
    if !stated.is_empty() {
        points.push(format!(
            "The case states who owns the ground: {stated} decides."
        ));
    }
    let satisfied = answer.at(&at("code/satisfied")).as_bool();
    let contacts = answer.at(&at("records_in_contact")).as_u64();
    if satisfied == Some(true) && contacts.is_some_and(|count| count > 0) {
        points.push(
            "<strong>The code accepts a width that records close.</strong> What pounding does there is said \
             below."
                .to_owned(),
        );
    }
    points
}

/// What a code says of a gap for one kind of ownership of the ground.
fn by_ownership(answer: Answer<'_>, g: usize, case: &str) -> Vec<String> {
    let mut points = Vec::new();
    let ownership = match answer.text(&format!("{case}/ownership")) {
        "" => String::new(),
        ownership => format!("{}: ", named(ownership)),
    };
    let refusal = answer.quote(&format!("{case}/refusal"));
    if !refusal.is_empty() {
        return vec![format!("{ownership}{refusal}.")];
    }
    let governing = answer.at(&format!("{case}/governing_level")).as_u64();
    let level = governing.map_or(0, |level| level.saturating_sub(1));
    let of_level = format!("{case}/levels/{level}");
    // Across a property line either building may go by a rule of its own.
    let rules: Vec<String> = ["provision", "other_provision"]
        .map(|key| format!("{of_level}/{key}"))
        .into_iter()
        .filter(|rule| answer.at(rule).is_object())
        .collect();
    let place = answer.quote(&format!("/gaps/{g}/levels/{level}/level"));
    let by = rules.iter().map(|rule| {
        let clause = match answer.text(&format!("{rule}/clause")) {
            "" => String::new(),
            clause => format!(", clause {}", named(clause)),
        };
        format!(
            "{}{clause}, <strong>{}</strong>: {}",
            answer.quote(&format!("{rule}/name")),
            answer.quote(&format!("{rule}/status")),
            answer.quote(&format!("{rule}/source")),
        )
    });
    let by = by.collect::<Vec<_>>().join("; and ");
    let provided = answer.say(&format!("{case}/provided"), 1.0e3);
    let readings = answer.list(&format!("{of_level}/readings")).len();
    let required = if readings == 0 {
        let required = answer.say(&format!("{case}/required"), 1.0e3);
        format!("{required} mm are required and {provided} mm are provided")
    } else {
        let reading = |r: usize| {
            let of = format!("{of_level}/readings/{r}");
            format!(
                "{} mm by {}",
                answer.say(&format!("{of}/width"), 1.0e3),
                answer.quote(&format!("{of}/text"))
            )
        };
        let all: Vec<_> = (0..readings).map(reading).collect();
        let chosen = match answer.at(&format!("{of_level}/satisfied")).as_bool() {
            Some(_) => "",
            None => ", and none is chosen",
        };
        format!(
            "the texts differ{chosen}: {}; {provided} mm are provided",
            all.join(", ")
        )
    };
    let short = format!("{case}/short_anyway");
    if answer.at(&short).is_object() {
        let level = answer.at(&format!("{short}/level")).as_u64();
        let level = level.map_or(0, |level| level.saturating_sub(1));
        points.push(format!(
            "{ownership}<strong>too small under any records</strong>: {} asks for {} mm at level {}, whatever the displacements are.",
            answer.quote(&format!("{short}/provision")),
            answer.say(&format!("{short}/required"), 1.0e3),
            answer.quote(&format!("/gaps/{g}/levels/{level}/level")),
        ));
    }
    points.push(format!("{ownership}{required}, at level {place} ({by})."));
    for rule in &rules {
        let which = match rules.len() {
            1 => "the rule".to_owned(),
            _ => answer.quote(&format!("{rule}/name")),
        };
        points.push(format!(
            "{ownership}what {which} takes for granted &ndash; {}.",
            taken(answer, &format!("{rule}/assumptions"))
        ));
    }
    let remarks = 0..answer.list(&format!("{case}/remarks")).len();
    let remarks: Vec<String> = remarks
        .map(|r| answer.quote(&format!("{case}/remarks/{r}")))
        .collect();
    if !remarks.is_empty() {
        points.push(format!(
            "{ownership}to know &ndash; {}.",
            remarks.join(" ").trim_end_matches('.')
        ));
    }
    points
}

/// Which statistic of the suite decides by a code, and whether there are records enough.
fn statistic(answer: Answer<'_>, code: &str) -> String {
    if answer.at(&format!("{code}/takes_records")).as_bool() == Some(false) {
        return "No displacement counts in the widths of the code here: it decides without the records.".to_owned();
    }
    let rule = answer.quote(&format!("{code}/statistic_rule"));
    let rule = match answer.text(&format!("{code}/statistic_clause")) {
        "" => format!("Many records: {rule}."),
        clause => format!(
            "The code takes {rule} ({}, {}).",
            named(clause),
            answer.quote(&format!("{code}/statistic_status")),
        ),
    };
    let few = match answer.at(&format!("{code}/enough_records")).as_bool() {
        Some(false) => {
            " There are fewer records than it asks for: widths by displacements are no answer by the code."
        }
        _ => "",
    };
    format!(
        "{rule}{few}{}",
        spectrum(answer, &format!("{code}/spectrum"))
    )
}

/// How the mean spectrum of the suite stands to what a code asks of it; nothing where that is not
/// known.
fn spectrum(answer: Answer<'_>, of: &str) -> String {
    let at = |key: &str| format!("{of}/{key}");
    if answer.at(of).is_null() {
        return String::new();
    }
    let asks = format!(
        "the code asks for at least {} of its spectrum ({})",
        answer.say_percent(&at("at_least")),
        answer.quote(&at("clause"))
    );
    let Some(reached) = answer.at(&at("is_reached")).as_bool() else {
        return format!(
            " The mean spectrum of the records is not compared with that of the code, as the case does not scale them to it; {asks}."
        );
    };
    let peaks = match answer.at(&at("ratio_of_peaks")).is_null() {
        true => String::new(),
        false => format!(
            " Their mean peak acceleration is {} of that of the code, which asks for all of it.",
            answer.say_percent(&at("ratio_of_peaks"))
        ),
    };
    let told = format!(
        " The mean spectrum of the records is nowhere below {} of that of the code (at {} s); {asks}.{peaks}",
        answer.say_percent(&at("least_ratio")),
        answer.say(&at("period_of_least_ratio"), 1.0),
    );
    match reached {
        true => told,
        false => format!(
            "{told} <strong>The widths are no answer by the code</strong>: records times {} would be one.",
            answer.say(&at("factor"), 1.0)
        ),
    }
}

/// What a rule takes for granted, in a sentence.
fn taken(answer: Answer<'_>, of: &str) -> String {
    let mut parts: Vec<String> = ["displacement", "height", "ownership", "alignment"]
        .iter()
        .map(|what| format!("{what}: {}", answer.quote(&format!("{of}/{what}"))))
        .collect();
    let others = answer.list(&format!("{of}/others")).len();
    parts.extend((0..others).map(|i| answer.quote(&format!("{of}/others/{i}"))));
    parts.join("; ")
}

fn failures(answer: Answer<'_>) -> Vec<String> {
    let failed = answer.list("/records").iter().filter_map(|record| {
        let failure = record["failure"].as_str()?;
        let name = record["name"].as_str().unwrap_or_default();
        let (name, failure) = (named(name), named(failure));
        Some(match record["collapsed"].as_str() {
            Some(building) => format!(
                "<strong>Pounding brings {} to collapse</strong> under {name}: {failure}.",
                named(building)
            ),
            None => format!("The run with pounding under {name} failed: {failure}."),
        })
    });
    failed.collect()
}

/// Statistics of a suite in the order in which people read them.
const STATISTICS: [&str; 7] = [
    "minimum",
    "p16",
    "median",
    "p84",
    "maximum",
    "mean",
    "standard_deviation",
];

/// Demand by level and by record.
fn demand(answer: Answer<'_>, g: usize) -> String {
    let of = format!("/gaps/{g}/levels");
    let levels = answer.list(&of);
    let columns = [
        Column::new("level"),
        Column::of("left", format!("{of}/*/left_elevation"), 1.0).below("elevation (m)"),
        Column::of("right", format!("{of}/*/right_elevation"), 1.0).below("elevation (m)"),
        Column::of("provided (mm)", format!("{of}/*/width"), 1.0e3),
        Column::of(
            match answer.list("/records").len() {
                1 => "demand (mm)",
                _ => "maximum demand (mm)",
            },
            format!("maximum {of}/*/demand/+/peak"),
            1.0e3,
        ),
        Column::of(
            "provided / demand",
            format!("{of}/*/width / maximum {of}/*/demand/+/peak"),
            1.0,
        ),
    ];
    let statistics = format!("/gaps/{g}/suite");
    let mut suite = String::new();
    // Of a single record all are the same.
    let several = answer.list("/records").len() > 1;
    if let Some(known) = answer.at(&statistics).as_object().filter(|_| several) {
        let columns = [
            Column::new("over the records"),
            Column::of("demand (mm)", format!("{statistics}/*"), 1.0e3),
        ];
        let word = |key: &str| match key.strip_prefix('p') {
            Some(percent) if percent.parse::<u8>().is_ok() => format!("{percent} % fractile"),
            _ => key.replace('_', " "),
        };
        let ordered = STATISTICS.iter().filter(|key| known.contains_key(**key));
        let rows = ordered.map(|key| ((*key).to_owned(), word(key)));
        suite = answer.table("Demand over the records", &columns, rows);
    }
    let heads = levels
        .iter()
        .map(|l| l["level"].as_str().unwrap_or_default());
    let mut by_level = rows(heads);
    by_level.reverse();
    note(
        "Demand: the maximum approach of the isolated buildings, found inside the steps; the width that a \
         record would just not close.",
    ) + &answer.table("Demand by level", &columns, by_level)
        + &suite
}

/// Columns of widths from the least to the greatest over what there is more than one of; of one
/// alone a single column.
fn widths(from: &str, over: &[(&str, usize)]) -> Vec<Column> {
    let over = over.iter().filter(|(_, count)| *count != 1);
    let over: Vec<&str> = over.map(|(name, _)| *name).collect();
    if over.is_empty() {
        return vec![Column::of("width (mm)", format!("maximum {from}"), 1.0e3)];
    }
    let heading = format!("width over {} (mm)", over.join(" and "));
    let ends = [("from", "minimum"), ("to", "maximum")];
    let column = |(end, word): (&str, &str)| {
        Column::of(end, format!("{word} {from}"), 1.0e3).below(&heading)
    };
    ends.map(column).into()
}

/// What maxima are taken over beside the storeys.
fn over_records(answer: Answer<'_>) -> &'static str {
    match answer.list("/records").len() {
        1 => "",
        _ => " and records",
    }
}

/// Widths by rule, those that the provided gap does not reach first.
fn rules(answer: Answer<'_>, g: usize) -> String {
    let of = format!("/gaps/{g}/provisions");
    let mut columns = vec![
        Column::new("rule"),
        Column::words_of("text", format!("{of}/*/edition")),
        Column::words_of("place", format!("{of}/*/place")),
    ];
    let records = ("records", answer.list("/records").len());
    let levels = ("levels", answer.list(&format!("/gaps/{g}/levels")).len());
    // That of a record is the maximum over the levels.
    columns.extend(widths(&format!("{of}/*/records/+/width"), &[records]));
    columns.extend([
        Column::of(
            match records.1 * levels.1 {
                1 => "width / demand",
                _ => "minimum of width / demand",
            },
            format!("minimum {of}/*/records/+/ratio_to_demand"),
            1.0,
        ),
        Column::words_of("provided reaches it", format!("{of}/*/satisfied")),
        Column::words_of("status", format!("{of}/*/status")),
        Column::words_of(
            "what was seen, or is not verified",
            format!("{of}/*/source"),
        ),
    ]);
    let all = answer.list(&of);
    let speaks = |i: &usize| all[*i]["refusal"].is_null();
    let row = |i: usize| {
        let name = all[i]["name"].as_str().unwrap_or_default();
        (i.to_string(), name.to_owned())
    };
    let mut spoken: Vec<usize> = (0..all.len()).filter(speaks).collect();
    let order = |i: &usize| match all[*i]["satisfied"].as_bool() {
        Some(false) => 0,
        Some(true) => 1,
        None => 2,
    };
    spoken.sort_by_key(order);
    let silent: Vec<usize> = (0..all.len()).filter(|i| !speaks(i)).collect();
    let mut out = String::new();
    let combined = format!("/gaps/{g}/combinations");
    let rules = answer.list(&combined);
    if !rules.is_empty() {
        let mut columns = vec![Column::new("combination")];
        let from = format!("{combined}/*/width/+/+");
        columns.extend(widths(&from, &[records, levels]));
        columns.extend([
            Column::of("correlation", format!("{combined}/*/correlation"), 1.0),
            Column::words_of("provided reaches it", format!("{combined}/*/satisfied")),
            Column::words_of("status", format!("{combined}/*/status")),
        ]);
        let heads = rules
            .iter()
            .map(|r| r["title"].as_str().unwrap_or_default());
        out.push_str("<h3>Combinations of the isolated peaks</h3>\n");
        out.push_str(&answer.table("Combinations", &columns, rows(heads)));
    }
    out.push_str("<h3>Widths by code</h3>\n");
    if levels.1 > 1 {
        out.push_str(&note(
            "The width of a record is that of the level that asks for most.",
        ));
    }
    out.push_str(&answer.table("Widths by code", &columns, spoken.into_iter().map(row)));
    out.push_str(&note(
        "Unverified: the formula was not compared with any text of the code; seen in a secondary text: not with \
         the code itself. Check it there before it enters a design report. A rule without yes or no holds for \
         elastic displacements, and a building yields here, or texts on it differ.",
    ));
    out.push_str(&disputed(answer, &of));
    if !silent.is_empty() {
        let columns = [
            Column::new("rule"),
            Column::words_of("why it says nothing here", format!("{of}/*/refusal")),
        ];
        out.push_str("<h3>Codes that say nothing here</h3>\n<div class=\"words\">\n");
        out.push_str(&answer.table(
            "Codes that say nothing here",
            &columns,
            silent.into_iter().map(row),
        ));
        out.push_str("</div>\n");
    }
    out
}

/// The widths by each reading of disputed rules, at the level and under the record that ask for
/// most.
fn disputed(answer: Answer<'_>, of: &str) -> String {
    let mut lines = Vec::new();
    for (i, rule) in answer.list(of).iter().enumerate() {
        let readings = rule["records"][0]["levels"].as_array();
        let readings =
            readings.and_then(|levels| levels.iter().find_map(|l| l["readings"].as_array()));
        let count = readings.map_or(0, Vec::len);
        let widths: Vec<String> = (0..count)
            .map(|r| {
                let text = readings.map_or("", |all| all[r]["text"].as_str().unwrap_or_default());
                let path = format!("maximum {of}/{i}/records/+/levels/+/readings/{r}/width");
                format!("{} mm by {}", answer.say(&path, 1.0e3), named(text))
            })
            .collect();
        if !widths.is_empty() {
            let name = rule["name"].as_str().unwrap_or_default();
            lines.push(format!("{}: up to {}", named(name), widths.join(", ")));
        }
    }
    match lines.is_empty() {
        true => String::new(),
        false => format!(
            "<h3>Disputed rules</h3>\n{}{}",
            note("Texts on these rules differ: the width of each is shown, and none decides."),
            sentences(&lines)
        ),
    }
}

/// What is said above ratios of peaks.
const RATIO: &str = "with pounding / isolated (-)";

/// Name and key of what is amplified.
const AMPLIFIED: [(&str, &str); 3] = [
    ("displacement", "displacement"),
    ("storey shear", "storey_shear"),
    ("absolute acceleration", "acceleration_absolute"),
];

/// Which figures there are none of, and why; nothing where no width was tried, which is said by
/// itself.
fn without_ratio(answer: Answer<'_>) -> String {
    if answer.list("/sweep/widths").is_empty() {
        return String::new();
    }
    let has = |(_, key): &(&str, &str)| {
        let path = format!("maximum /sweep/runs/+/+/amplification/+/+/{key}");
        answer.number(&path, "").is_finite()
    };
    let missing = AMPLIFIED.iter().filter(|q| !has(q)).map(|(name, _)| *name);
    let missing: Vec<&str> = missing.collect();
    match missing.is_empty() {
        true => String::new(),
        false => note(&format!(
            "There is no figure of {}: no isolated building has any, and so no ratio is known.",
            missing.join(", ")
        )),
    }
}

/// Maximum amplifications at the provided gap, by building.
fn provided(answer: Answer<'_>) -> String {
    let buildings = answer.list("/records/0/isolated");
    let mut columns = vec![Column::new("building")];
    columns.extend(AMPLIFIED.map(|(name, key)| {
        let from = format!("maximum /records/+/amplification/*/+/{key}");
        Column::of(name, from, 1.0).below(RATIO)
    }));
    let heads = buildings
        .iter()
        .map(|b| b["name"].as_str().unwrap_or_default());
    let jumps = match answer.at("/rigid_impacts").as_bool() {
        Some(true) => note(VELOCITY_JUMPS),
        _ => String::new(),
    };
    jumps
        + &note(&format!(
            "Peak of a storey with pounding over its peak in the isolated building, the maximum over storeys{}; a \
             dash where the isolated building has none.",
            over_records(answer)
        ))
        + &answer.table("Amplification at the provided gap", &columns, rows(heads))
}

/// Rows of the sweep in the table.
const ROWS: usize = 20;

fn swept(answer: Answer<'_>) -> String {
    let widths = answer.list("/sweep/widths").len();
    if widths == 0 {
        return note(
            "Under no record do the buildings approach each other: there is no width to try.",
        );
    }
    let buildings = answer.list("/records/0/isolated");
    let mut columns = vec![
        Column::new("number"),
        Column::of("width (mm)", "/sweep/widths/*", 1.0e3),
    ];
    for (b, building) in buildings.iter().enumerate() {
        let name = building["name"].as_str().unwrap_or_default();
        for (heading, quantity) in [
            ("displacement", "displacement"),
            ("shear", "storey_shear"),
            ("acceleration", "acceleration_absolute"),
        ] {
            let from = format!("maximum /sweep/runs/*/+/amplification/{b}/+/{quantity}");
            columns.push(Column::of(heading, from, 1.0).below(format!("{name}, {RATIO}")));
        }
    }
    // Of the gap whose width varies: what happens in the others of a row is not of this width.
    let over = match answer.list("/records").len() {
        1 => None,
        _ => Some("maximum over records"),
    };
    let gap = Some(answer.text("/sweep/gap")).filter(|gap| !gap.is_empty());
    let of_records: Vec<&str> = gap.into_iter().chain(over).collect();
    let of_records = of_records.join(", ");
    columns.extend([
        Column::of("impacts", "maximum /sweep/runs/*/+/impacts", 1.0).below(of_records.clone()),
        Column::of("force (kN)", "maximum /sweep/runs/*/+/peak_force", 1.0e-3).below(of_records),
    ]);
    let every = widths.div_ceil(ROWS);
    let shown = (0..widths).step_by(every);
    let shown = shown.map(|i| (i.to_string(), (i + 1).to_string()));
    let table = collapses(answer, buildings) + &answer.table("Sweep over widths", &columns, shown);
    match every {
        1 => table,
        every => {
            table
                + &note(&format!(
                    "One width in every {every} is shown; --csv writes all."
                ))
        }
    }
}

/// What is said of a building that pounding brings to collapse at some widths, here and in the page that computes:
/// the words that stand out, and those behind them. In braces is what each page writes as its own.
pub const COLLAPSE_AT_WIDTHS: [&str; 2] = [
    "Pounding brings {building} to collapse",
    " at {count} of {widths}, between {first} and {last} mm: no ratio of peaks is worse.",
];

/// The widths at which pounding brings a building to collapse, a sentence for each.
fn collapses(answer: Answer<'_>, buildings: &[Value]) -> String {
    let runs = answer.list("/sweep/runs");
    let sentence = |building: &Value| {
        let falls = |runs: &Value| {
            let mut runs = runs.as_array().into_iter().flatten();
            runs.any(|run| run["collapsed"].is_string() && run["collapsed"] == building["name"])
        };
        let widths = runs.iter().enumerate().filter(|(_, runs)| falls(runs));
        let widths: Vec<_> = widths.map(|(i, _)| i).collect();
        let (first, last) = (widths.first()?, widths.last()?);
        let say = |i: &usize| answer.say(&format!("/sweep/widths/{i}"), 1.0e3);
        let [head, rest] = COLLAPSE_AT_WIDTHS;
        let name = named(building["name"].as_str().unwrap_or_default());
        let rest = rest
            .replace("{count}", &widths.len().to_string())
            .replace("{widths}", &counted(runs.len(), "width"))
            .replace("{first}", &say(first))
            .replace("{last}", &say(last));
        let head = head.replace("{building}", &name);
        Some(format!("<strong>{head}</strong>{rest}"))
    };
    let found: Vec<_> = buildings.iter().filter_map(sentence).collect();
    match found.is_empty() {
        true => String::new(),
        false => sentences(&found),
    }
}

/// To which spectrum the records are scaled, over which periods, and how near they come.
fn scaled(answer: Answer<'_>) -> String {
    let target = "/spectra/target";
    if !answer.at(target).is_object() {
        return String::new();
    }
    let say = |path: &str| answer.say(&format!("{target}/{path}"), 1.0);
    let reason = match answer.text(&format!("{target}/band_reason")) {
        "" => String::new(),
        reason => format!(" ({})", named(reason)),
    };
    let text = format!(
        "The records are scaled to {} from {} to {} s{reason}, by least squares of the logarithm: their mean \
         spectrum is {} (at {} s) to {} (at {} s) of it.",
        answer.quote(&format!("{target}/name")),
        say("from"),
        say("to"),
        say("least_ratio_of_mean"),
        say("period_of_least_ratio"),
        say("greatest_ratio_of_mean"),
        say("period_of_greatest_ratio"),
    );
    format!("<p>{text}</p>\n")
}

fn records(answer: Answer<'_>) -> String {
    let mut columns = vec![
        Column::new("record"),
        Column::of(
            "peak ground acceleration (g)",
            "/records/*/peak_ground_acceleration",
            1.0 / STANDARD_GRAVITY,
        ),
    ];
    if !answer.at("/records/0/factor").is_null() {
        columns.push(Column::of("factor", "/records/*/factor", 1.0));
    }
    for (g, gap) in answer.list("/gaps").iter().enumerate() {
        let name = gap["name"].as_str().unwrap_or_default();
        let above = format!("demand of {name}");
        columns.push(Column::of("(mm)", format!("/gaps/{g}/demand/*"), 1.0e3).below(&above));
        let governing = answer.at(&format!("/gaps/{g}/governing_level")).as_u64();
        let level = governing.map_or(0, |level| level.saturating_sub(1));
        let of_level = format!("/gaps/{g}/levels/{level}");
        let place = answer.text(&format!("{of_level}/level"));
        let time = format!("time at level {place} (s)");
        columns.push(Column::of(time, format!("{of_level}/demand/*/time"), 1.0).below(&above));
    }
    columns.push(Column::of("impacts", "sum /records/*/impacts/+/+", 1.0));
    let list = answer.list("/records");
    let heads = list.iter().map(|r| r["name"].as_str().unwrap_or_default());
    answer.table("Records", &columns, rows(heads))
}
