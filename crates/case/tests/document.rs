//! Reading tables as types: what they hold, where it stands, and all that is wrong.
use pounding_case::document::{
    Count, Entry, Field, FreeKeys, Kinds, Length, List, NotNegative, OneOrEach, Optional, Positive,
    Reader, Scalar, Table, TableOr, Tables, Time, schema_of,
};
use pounding_case::{CaseError, Errors, Quantity};
use schemars::JsonSchema;
use serde::Deserialize;

/// Some variables
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "the list")]
struct File {
    /// Title of it
    title: Optional<String>,
    /// What is varied
    #[schemars(required)]
    variable: Optional<Tables<Variable>>,
    /// How
    design: Optional<Table<Design>>,
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "[[variable]]")]
struct Variable {
    /// Path in the
    /// case
    path: Field<String>,
    values: Optional<OneOrEach<Positive<Length>>>,
    range: Optional<Kinds<Range>>,
    #[serde(rename = "*")]
    others: FreeKeys<Quantity>,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(untagged)]
enum Range {
    From {
        from: NotNegative<Length>,
        to: Positive<Length>,
        count: Option<Count<2>>,
    },
    Around {
        around: Positive<Length>,
    },
}

#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "[design]")]
struct Design {
    kind: Optional<Kind>,
    runs: Optional<TableOr<Runs, Count<1, 1_000_000>>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum Kind {
    Grid,
    LatinHypercube,
}

/// A table in which the keys mean something together.
#[derive(Debug, Deserialize, JsonSchema)]
struct Runs {
    least: Count<1>,
    within: Option<Positive<Time>>,
}

const TEXT: &str = r#"title = "widths"
[[variable]]
path = "gap.width"
values = ["1 cm", 0.02]
first = "3 kN"
second = 4
[[variable]]
path = "gap.width"
range = { from = 0, to = "10 cm", count = 11 }
[design]
kind = "latin_hypercube"
runs = { least = 5, within = "2 s" }
"#;

fn read(text: &str) -> (Option<File>, Vec<CaseError>) {
    let errors = Errors::default();
    let reader = Reader {
        file: "list.toml",
        source: text,
        errors: &errors,
    };
    let file = reader.read("write a list");
    let error = errors.finish(Ok(())).err();
    (file, error.map_or_else(Vec::new, |e| e.each().collect()))
}

#[test]
fn values_come_with_their_places() {
    let (file, errors) = read(TEXT);
    assert!(errors.is_empty(), "{errors:?}");
    let file = file.unwrap();
    let title = file.title.located().unwrap();
    assert_eq!(
        (title.value.as_str(), &TEXT[title.span]),
        ("widths", "\"widths\"")
    );
    let variables = file.variable.value().unwrap().0;
    let mut variables = variables.into_iter().map(|v| v.value().unwrap());
    let first = variables.next().unwrap();
    assert_eq!(first.values.value().unwrap().spread::<f64>(2), [0.01, 0.02]);
    let free = first.others.0.into_iter();
    let free: Vec<_> = free
        .map(|(k, v)| (k.value, v.value().unwrap().value))
        .collect();
    assert_eq!(
        free,
        [("first".to_owned(), 3000.0), ("second".to_owned(), 4.0)]
    );
    let Some(Kinds(Range::From { from, to, count })) = variables.next().unwrap().range.value()
    else {
        panic!("a range from one value to another");
    };
    assert_eq!((f64::from(from), f64::from(to)), (0.0, 0.1));
    assert_eq!(count, Some(Count(11)));
    let design = file.design.value().unwrap();
    assert!(design.whole);
    assert_eq!(&TEXT[design.places["kind"].clone()], "\"latin_hypercube\"");
    assert_eq!(design.value.kind.value(), Some(Kind::LatinHypercube));
    let Some(TableOr::Table(runs)) = design.value.runs.value() else {
        panic!("a table");
    };
    assert_eq!(
        (runs.least, runs.within.map(f64::from)),
        (Count(5), Some(2.0))
    );
}

/// Replaced text, its replacement, and every error: line, column, and what it says.
type Row = (
    &'static str,
    &'static str,
    &'static [(usize, usize, &'static str)],
);

const ROWS: &[Row] = &[
    (
        "title =",
        "titel =",
        &[(
            1,
            1,
            "did you mean `title`? known keys: title, variable, design",
        )],
    ),
    (
        "title = \"widths\"",
        "title = 1",
        &[(1, 9, "`title` must be a text in quotes, not a number")],
    ),
    // A missing key, and one that is only misspelt.
    (
        "path = \"gap.width\"\nvalues",
        "values",
        &[(2, 1, "[[variable]] has no `path`")],
    ),
    (
        "path",
        "pat",
        &[(
            3,
            1,
            "unknown key `pat` in [[variable]] did you mean `path`?",
        )],
    ),
    // Every value of a list, and free keys.
    (
        "[\"1 cm\", 0.02]\nfirst = \"3 kN\"",
        "[\"1 s\", -2, 1]\nfirst = \"3 x\"",
        &[
            (
                4,
                11,
                "`values` must be a length (m), but \"1 s\" is a time (s)",
            ),
            (4, 18, "`values` = -2 must be greater than zero"),
            (5, 9, "`first`: \"x\" in \"3 x\" is not a known unit"),
        ],
    ),
    (
        "[\"1 cm\", 0.02]",
        "[]",
        &[(4, 10, "`values` is an empty list")],
    ),
    // Kinds: none, two, a key of another one, one that is none, and one that is missing.
    (
        "from = 0, to = \"10 cm\", count = 11",
        "",
        &[(
            9,
            9,
            "`range` needs one of `from` with `to` (and `count`) or `around` give one of them: none is there",
        )],
    ),
    (
        "from = 0",
        "around = 1, from = 0",
        &[(9, 9, "`range` must be of one kind, not 2")],
    ),
    (
        "from = 0, to",
        "around = 1, to",
        &[(9, 23, "`to` has no meaning beside `around` remove `to`")],
    ),
    (
        "count = 11",
        "cuont = 11",
        &[(
            9,
            35,
            "did you mean `count`? known keys: from, to, count, around",
        )],
    ),
    (
        ", to = \"10 cm\"",
        "",
        &[(
            9,
            9,
            "range has no `to` add `to = ...`; known are `from` with `to`",
        )],
    ),
    (
        "count = 11",
        "count = 1",
        &[(9, 43, "`count` must be a whole number from 2 to 100000")],
    ),
    // Words.
    (
        "latin_hypercube",
        "grd",
        &[(
            11,
            8,
            "`kind` cannot be \"grd\" write \"grid\" or \"latin_hypercube\"",
        )],
    ),
    (
        "\"latin_hypercube\"",
        "3",
        &[(11, 8, "`kind` must be a text in quotes, not a number")],
    ),
    // A table that is wrong as a whole.
    (
        "within",
        "wihtin",
        &[(12, 21, "unknown key `wihtin` in runs")],
    ),
    ("least = 5, ", "", &[(12, 8, "runs has no `least`")]),
    (
        "{ least = 5, within = \"2 s\" }",
        "0",
        &[(12, 8, "whole number from 1 to 1000000")],
    ),
    (
        "[design]",
        "[[design]]",
        &[(10, 1, "`[design]` must be a table, not a list")],
    ),
    (
        "kind = \"latin_hypercube\"",
        "knd = 1\nzz = 2",
        &[
            (11, 1, "unknown key `knd` in [design] did you mean `kind`?"),
            (12, 1, "unknown key `zz` in [design] known keys: kind, runs"),
        ],
    ),
];

#[test]
fn every_error_is_at_its_place() {
    for (from, to, expected) in ROWS {
        assert!(TEXT.contains(from), "{from}");
        let (_, errors) = read(&TEXT.replacen(from, to, 1));
        let found: Vec<_> = errors
            .iter()
            .map(|e| {
                let text = format!("{} {}", e.message, e.help.clone().unwrap_or_default());
                (e.line, e.column, text)
            })
            .collect();
        assert_eq!(found.len(), expected.len(), "{to}: {found:#?}");
        for ((line, column, text), (l, c, says)) in found.iter().zip(*expected) {
            assert_eq!((line, column), (l, c), "{to}: {text}");
            assert!(text.contains(says), "{to}: {text} | {says}");
        }
    }
}

/// A value that is wrong keeps no other from being read.
#[test]
fn the_rest_of_a_table_is_read() {
    let text = TEXT.replacen("\"latin_hypercube\"", "3", 1);
    let text = text.replacen("path = \"gap.width\"", "path = false", 1);
    let (file, errors) = read(&text);
    assert_eq!(errors.len(), 2);
    let file = file.unwrap();
    let design = file.design.value().unwrap();
    assert!(!design.whole && design.value.kind.is_wrong());
    assert!(!design.value.runs.is_wrong());
    let variables = file.variable.value().unwrap().0;
    let first = variables.into_iter().next().unwrap().value().unwrap();
    assert!(first.path.is_wrong() && first.others.0.len() == 2);
}

/// A list within a list of another type has its own schema.
#[test]
fn schemas_of_lists_are_those_of_their_entries() {
    #[derive(Debug, Deserialize, JsonSchema)]
    struct Entries {
        #[allow(dead_code)]
        texts: Option<Field<List<String>>>,
        #[allow(dead_code)]
        counts: Option<Field<Tables<Count<1>>>>,
        #[allow(dead_code)]
        values: Option<Field<List<Scalar>>>,
    }
    #[derive(Debug, Deserialize, JsonSchema)]
    struct Outer {
        #[allow(dead_code)]
        list: Field<List<Entries>>,
        #[allow(dead_code)]
        tables: Field<Tables<Entries>>,
    }
    let schema = schema_of::<Outer>("lists.schema.json");
    assert!(!schema.to_string().contains("$ref"), "{schema:#}");
    for list in ["list", "tables"] {
        let of = &schema["properties"][list]["items"]["properties"];
        assert_eq!(of["texts"]["items"]["type"], "string");
        assert_eq!(of["texts"]["minItems"], 1);
        assert_eq!(of["counts"]["items"]["type"], "integer");
        let scalar = serde_json::json!(["number", "string", "boolean"]);
        assert_eq!(of["values"]["items"]["type"], scalar);
    }
}

#[test]
fn the_schema_says_what_is_read() {
    let schema = schema_of::<File>("list.schema.json");
    assert_eq!(schema["$id"], "list.schema.json");
    assert_eq!(schema["required"], serde_json::json!(["variable"]));
    assert_eq!(schema["additionalProperties"], false);
    let variable = &schema["properties"]["variable"]["items"];
    assert_eq!(
        variable["properties"]["path"]["description"],
        "Path in the case"
    );
    assert_eq!(variable["required"], serde_json::json!(["path"]));
    assert_eq!(
        variable["additionalProperties"]["type"],
        serde_json::json!(["number", "string"])
    );
    let kinds = variable["properties"]["range"]["oneOf"].as_array().unwrap();
    assert_eq!(kinds[0]["required"], serde_json::json!(["from", "to"]));
    assert_eq!(kinds[1]["additionalProperties"], false);
    assert_eq!(kinds[0]["properties"]["count"]["minimum"], 2);
    let kind = &schema["properties"]["design"]["properties"]["kind"];
    assert_eq!(kind["enum"], serde_json::json!(["grid", "latin_hypercube"]));
    let values = &variable["properties"]["values"]["anyOf"];
    assert_eq!(
        (&values[0]["exclusiveMinimum"], &values[1]["minItems"]),
        (&0.0.into(), &1.into())
    );
    let text = schema.to_string();
    assert!(
        !text.contains("null") && !text.contains("$ref"),
        "{schema:#}"
    );
}
