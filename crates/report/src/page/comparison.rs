//! The page of a comparison of impact models.

use pounding_catalogue::wording::{agreeing, counted};
use pounding_time_history::VELOCITY_JUMPS_HAVE_NO_FORCE;
use serde_json::Value;

use super::answer::{Answer, in_parentheses, spoken, unit_of};
use super::html::{named, note, section, sentences, warnings};
use super::studies::{collapsed, pictures, rows};
use super::table::Column;
use crate::answer_file::{Inputs, Picture};

/// Quantities side by side in a table of values.
const BESIDE: usize = 8;
/// Records whose values have a table.
const TABLES: usize = 7;

/// The page of what `compare --json` prints.
#[must_use]
pub fn comparison(answer: &Value, drawn: &[Picture], inputs: &Inputs) -> String {
    let answer = Answer(answer);
    let warned: Vec<String> = answer
        .list("/warnings")
        .iter()
        .filter_map(|w| Some(w.as_str()?.to_owned()))
        .collect();
    let mut body = section(
        "Does the answer depend on the impact model?",
        &(sentences(&points(answer)) + &warnings(&warned)),
    );
    body.push_str(&section("Conclusions", &conclusions(answer)));
    let spread = spread(answer) + &pictures(drawn);
    body.push_str(&section("Models beside records", &spread));
    body.push_str(&section("Values", &values(answer)));
    body.push_str(&section("Models", &models(answer)));
    inputs.page(&body)
}

fn name(value: &Value) -> &str {
    value["name"].as_str().unwrap_or_default()
}

fn points(answer: Answer<'_>) -> Vec<String> {
    let models = answer.list("/models");
    let failed: Vec<&str> = models
        .iter()
        .filter(|m| m["failures"].as_array().is_some_and(|f| !f.is_empty()))
        .map(name)
        .collect();
    let collapse = |model: &&Value| {
        let mut failures = model["failures"].as_array().into_iter().flatten();
        failures.any(|failure| failure["collapsed"].is_string())
    };
    let fallen: Vec<&str> = models.iter().filter(collapse).map(name).collect();
    let all = answer.list("/conclusions");
    let depends: Vec<&str> = all
        .iter()
        .filter(|c| c["holds"].as_str() == Some("depends on the model"))
        .filter_map(|c| c["statement"].as_str())
        .collect();
    let mut points = collapsed(
        answer,
        "That does not depend on the model: all else here is of the other records.",
    );
    if !fallen.is_empty() {
        points.push(format!(
            "<strong>Pounding brings a building to collapse with {}</strong>: {} of {}. What follows counts the \
             others only.",
            named(&fallen.join(", ")),
            fallen.len(),
            counted(models.len(), "model"),
        ));
    }
    let ran = models.len() - failed.len();
    let records = answer.list("/records").len();
    let impacts = answer.number("sum /gaps/+/models_in_contact/+", "");
    // Of what one model alone can say, as of accelerations beside rigid impacts, nothing is known.
    let of_one = |c: &&Value| {
        let counts = c["counts"].as_array().into_iter().flatten();
        !counts.clone().any(|count| count[1].as_u64() > Some(1))
    };
    let unanswered = all.iter().filter(of_one).count();
    if ran > 1 && records > 0 && impacts == 0.0 {
        points.push(
            "<strong>Nothing touches</strong>: no model closes a gap under any record, and what follows is of \
             buildings without contact."
                .to_owned(),
        );
    }
    points.push(match depends.len() {
        _ if ran < 2 => format!(
            "<strong>That is not answered</strong>: {} ran, and it takes two to differ.",
            counted(ran, "model")
        ),
        0 if unanswered > 0 => format!(
            "<strong>No, as far as models can say.</strong> None of {} depends on the model; of {unanswered} no \
             more than one model can say anything.",
            counted(all.len(), "conclusion")
        ),
        0 if !fallen.is_empty() => format!(
            "With the other models none of {} depends on the model.",
            counted(all.len(), "conclusion")
        ),
        0 => format!(
            "<strong>No.</strong> None of {} depends on the model.",
            counted(all.len(), "conclusion")
        ),
        some => format!(
            "<strong>{some} of {} {} on the model:</strong> {}.",
            counted(all.len(), "conclusion"),
            agreeing(&some, "depends", "depend"),
            named(&depends.join("; "))
        ),
    });
    let number =
        |q: &usize, which: &str| answer.number(&format!("/quantities/{q}/spread/{which}"), "");
    let between = |q: &usize| number(q, "between_models");
    let known = 0..answer.list("/quantities").len();
    let known = known.filter(|q| {
        between(q).is_finite() && !answer.text(&format!("/quantities/{q}/unit")).is_empty()
    });
    let largest = known.max_by(|a, b| between(a).total_cmp(&between(b)));
    if let Some(q) = largest.filter(|q| between(q) > 0.0 && impacts > 0.0) {
        let at = format!("/quantities/{q}");
        let mut sentence = format!(
            "Models lie furthest apart in {} of {}: by {} %",
            named(&spoken(answer.text(&format!("{at}/name")))),
            answer.quote(&format!("{at}/of")),
            answer.say(&format!("{at}/spread/between_models"), 1.0e2),
        );
        if number(&q, "between_records").is_finite() {
            sentence.push_str(&format!(
                ", where records lie {} % apart",
                answer.say(&format!("{at}/spread/between_records"), 1.0e2)
            ));
        }
        points.push(sentence + " (standard deviation over mean).");
    }
    points.push(format!(
        "{} ran under {}, with stiffnesses that give the same {} in the reference collision, {}.",
        counted(ran, "model"),
        counted(records, "record"),
        answer.quote("/stiffness_rule"),
        match answer.text("/restitution_rule") {
            "exact" => "and returning the restitution exactly",
            _ => "and asked for the restitution by their own relations",
        },
    ));
    let under = |m: &Value| records - m["failures"].as_array().map_or(0, Vec::len).min(records);
    for (none, said) in [(true, "Under no record"), (false, "Not under every record")] {
        let such = models.iter().filter(|m| failed.contains(&name(m)));
        let such: Vec<&str> = such.filter(|m| (under(m) == 0) == none).map(name).collect();
        if !such.is_empty() {
            points.push(format!("{said}: {}.", named(&such.join(", "))));
        }
    }
    points.extend(jumps(models));
    for (g, gap) in answer.list("/gaps").iter().enumerate() {
        let without = answer.list(&format!("/gaps/{g}/records_without_contact"));
        if !without.is_empty() && impacts > 0.0 {
            let without: Vec<&str> = without.iter().filter_map(Value::as_str).collect();
            points.push(format!(
                "No model closes {} under {} of {}, which {} left out of the spread between models and the ranking of \
                 all that is of this gap: {}.",
                named(name(gap)),
                without.len(),
                counted(records, "record"),
                agreeing(&without.len(), "is", "are"),
                without.iter().map(|record| named(record)).collect::<Vec<_>>().join(", ")
            ));
        }
    }
    points
}

/// Why models whose impacts are rigid have no accelerations and forces.
fn jumps(models: &[Value]) -> Option<String> {
    let rigid = models.iter().filter(|m| m["rigid_impacts"] == true);
    let rigid: Vec<&str> = rigid.map(name).collect();
    (!rigid.is_empty()).then(|| {
        format!(
            "{}: {VELOCITY_JUMPS_HAVE_NO_FORCE} Tables have a dash there, the figure of accelerations has an empty \
             row, and conclusions on accelerations are of the other models.",
            named(&rigid.join(", "))
        )
    })
}

fn conclusions(answer: Answer<'_>) -> String {
    let all = answer.list("/conclusions");
    let columns = [
        Column::new("statement"),
        Column::words_of("answer", "/conclusions/*/holds"),
        Column::words_of("storey by storey", "/conclusions/*/by_storey/holds"),
        Column::of("true", "sum /conclusions/*/counts/+/0", 1.0).below("models and records"),
        Column::of("of", "sum /conclusions/*/counts/+/1", 1.0).below("models and records"),
        Column::of("from", "minimum /conclusions/*/ratios/+/+", 1.0)
            .below("with pounding over without"),
        Column::of("to", "maximum /conclusions/*/ratios/+/+", 1.0)
            .below("with pounding over without"),
        Column::words_of(
            "in the minority (under how many records)",
            "tally /conclusions/*/minority/+/+",
        ),
    ];
    let heads = all
        .iter()
        .map(|c| c["statement"].as_str().unwrap_or_default());
    answer.table("Conclusions", &columns, rows(heads))
}

/// Heads of the rows of quantities, with the units that people read.
fn quantities(answer: Answer<'_>) -> Vec<(String, String)> {
    let head = |(i, q): (usize, &Value)| {
        let text = |key: &str| q[key].as_str().unwrap_or_default();
        let what = spoken(text("name"));
        let head = format!("{what}, {}{}", text("of"), in_parentheses(text("unit")));
        (i.to_string(), head)
    };
    answer
        .list("/quantities")
        .iter()
        .enumerate()
        .map(head)
        .collect()
}

fn spread(answer: Answer<'_>) -> String {
    let of = |path: &str| format!("/quantities/*/{path}");
    let columns = [
        Column::new("quantity"),
        Column::words_of("of storeys or levels", of("statistic")),
        Column::of("models (%)", of("spread/between_models"), 1.0e2).below("spread between"),
        Column::of("records (%)", of("spread/between_records"), 1.0e2).below("spread between"),
        Column::of("maximum / minimum model", of("spread/greatest_ratio"), 1.0),
        Column::count_of("records between models", of("spread/records")),
        Column::count_of("models of zero", of("spread/models_of_zero")),
        Column::of("agreement of records", of("ranking/concordance"), 1.0),
        Column::words_of("maximum by", of("ranking/maximum_by/+")),
    ];
    answer.table("Spread", &columns, quantities(answer))
        + &note(
            "Spread: standard deviation over mean, root mean square over the others; between models over the records with \
             a value that is not zero, of buildings over those under which a contact reaches them; between records without models whose values are all zero. Agreement of records on \
             the order of the models: Kendall's W, from 0 to 1, of records under which models differ.",
        )
}

fn values(answer: Answer<'_>) -> String {
    let models: Vec<&str> = answer.list("/models").iter().map(name).collect();
    let records: Vec<&str> = answer
        .list("/records")
        .iter()
        .map(|r| r.as_str().unwrap_or_default())
        .collect();
    let columns = |of: &dyn Fn(usize) -> String, head: &str, chunk: &[usize]| {
        let column = |q: &usize| {
            let text = |key: &str| answer.text(&format!("/quantities/{q}/{key}"));
            let (factor, _) = unit_of(text("unit"));
            let what = spoken(text("name")) + &in_parentheses(text("unit"));
            let column = match text("name") {
                "impacts" => Column::count_of(what, of(*q)),
                _ => Column::of(what, of(*q), factor),
            };
            column.below(text("of"))
        };
        let columns = std::iter::once(Column::new(head));
        columns
            .chain(chunk.iter().map(column))
            .collect::<Vec<Column>>()
    };
    let all: Vec<usize> = (0..answer.list("/quantities").len()).collect();
    let mut out = "<h3>Without pounding</h3>\n".to_owned();
    // Impacts have none.
    let known = |q: &&usize| {
        answer
            .number(&format!("/quantities/{q}/isolated/0"), "")
            .is_finite()
    };
    let isolated: Vec<usize> = all.iter().filter(known).copied().collect();
    for chunk in &beside(answer, &isolated) {
        let columns = columns(&|q| format!("/quantities/{q}/isolated/*"), "record", chunk);
        out.push_str(&answer.table("Without pounding", &columns, rows(records.iter().copied())));
    }
    for (r, record) in records.iter().take(TABLES).enumerate() {
        out.push_str(&format!(
            "<h3>With pounding, under {}</h3>\n",
            named(record)
        ));
        for chunk in &beside(answer, &all) {
            let columns = columns(&|q| format!("/quantities/{q}/values/*/{r}"), "model", chunk);
            out.push_str(&answer.table(record, &columns, rows(models.iter().copied())));
        }
    }
    if records.len() > TABLES {
        out.push_str(&note(&format!(
            "{} more: --json and --csv write all.",
            counted(records.len() - TABLES, "record")
        )));
    }
    out
}

/// Quantities in parts for tables beside one another: those of a building or of a gap stay
/// together as long as there is room for them.
fn beside(answer: Answer<'_>, quantities: &[usize]) -> Vec<Vec<usize>> {
    let of = |q: &usize| answer.text(&format!("/quantities/{q}/of"));
    let mut parts: Vec<Vec<usize>> = Vec::new();
    for group in quantities.chunk_by(|a, b| of(a) == of(b)) {
        for few in group.chunks(BESIDE) {
            match parts.last_mut() {
                Some(part) if part.len() + few.len() <= BESIDE => part.extend(few),
                _ => parts.push(few.to_vec()),
            }
        }
    }
    parts
}

fn models(answer: Answer<'_>) -> String {
    let columns = [
        Column::new("model"),
        Column::of(
            "restitution returned",
            "/models/*/gaps/0/free_restitution",
            1.0,
        ),
        Column::words_of("parameters (SI)", "/models/*/gaps/0/parameters"),
        Column::words_of("notes", "/models/*/gaps/0/notes"),
        Column::words_of("failures", "/models/*/failures/+/diagnosis"),
    ];
    let collision = [
        Column::new("gap"),
        Column::of("approach (m/s)", "/references/*/approach_velocity", 1.0),
        Column::of("effective mass (t)", "/references/*/effective_mass", 1.0e-3),
        Column::of("stiffness (N/m\u{207f})", "/references/*/stiffness", 1.0),
        Column::of("exponent n", "/references/*/exponent", 1.0),
        Column::of("restitution", "/references/*/restitution", 1.0),
    ];
    let gaps = answer.list("/gaps").iter().map(name);
    let heads = answer.list("/models").iter().map(name);
    let mut out = answer.table("Models", &columns, rows(heads));
    if answer.list("/gaps").len() > 1 {
        out.push_str(&note(
            "In the first gap; the others are in the output of --json.",
        ));
    }
    out.push_str("<h3>The collision in which they agree</h3>\n");
    out + &answer.table("Reference collisions", &collision, rows(gaps))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    /// What the answer says of models that ran, of which the last failed under so many of two
    /// records, with impacts under each.
    fn answer_text(models: usize, failures: usize, impacts: [usize; 2], count: usize) -> String {
        let model = |i: usize| {
            let failed = if i + 1 == models { failures } else { 0 };
            json!({ "name": format!("model_{i}"), "failures": vec![json!({}); failed] })
        };
        let without = ["a", "b"].into_iter().zip(impacts);
        let without: Vec<&str> = without.filter(|(_, n)| *n == 0).map(|(r, _)| r).collect();
        let answer = json!({
            "models": (0..models).map(model).collect::<Vec<_>>(),
            "records": ["a", "b"],
            "gaps": [{ "name": "left-right", "models_in_contact": impacts, "records_without_contact": without }],
            "conclusions": [{ "statement": "s", "holds": "holds for all models", "counts": [[0, count], [0, count]] }],
            "quantities": [{ "name": "impulse", "of": "left-right", "unit": "N s", "spread": { "between_models": 0.2 } }],
        });
        points(Answer(&answer)).join("\n")
    }

    /// No answer is drawn from one model, and none from buildings that do not touch.
    #[test]
    fn an_answer_needs_models_and_contact() {
        let one = answer_text(1, 0, [1, 1], 1);
        assert!(
            one.contains("That is not answered") && !one.contains("No."),
            "{one}"
        );
        let rest = answer_text(2, 2, [1, 1], 1);
        assert!(rest.contains("That is not answered"), "{rest}");
        assert!(rest.contains("Under no record: model_1."), "{rest}");
        let some = answer_text(3, 1, [1, 0], 2);
        assert!(some.contains("<strong>No.</strong>"), "{some}");
        assert!(some.contains("Not under every record: model_2."), "{some}");
        assert!(
            some.contains("No model closes left-right under 1 of 2 records"),
            "{some}"
        );
        assert!(some.contains("furthest apart in impulse"), "{some}");
        let none = answer_text(2, 0, [0, 0], 2);
        assert!(
            none.contains("Nothing touches") && !none.contains("furthest"),
            "{none}"
        );
        let models = [json!({ "name": "a", "rigid_impacts": false })];
        assert_eq!(jumps(&models), None);
        let models = ["b", "c"].map(|name| json!({ "name": name, "rigid_impacts": true }));
        let said = jumps(&models).unwrap_or_default();
        assert!(
            said.starts_with("b, c: Rigid impacts are jumps of the velocity"),
            "{said}"
        );
        let alone = answer_text(2, 0, [1, 1], 1);
        assert!(alone.contains("of 1 no more than one model"), "{alone}");
    }
}
