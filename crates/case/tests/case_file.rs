//! The example of the design, units against their definitions, hostile input.
use std::path::Path;

use pounding_case::{Case, CaseTree, Damping, Dimension, Facing, Side, parse_quantity, schema};
use pounding_ground_motion::processing::Scale;
use proptest::prelude::*;
use toml::de::DeTable;

const EXAMPLE: &str = r#"
title = "Three-storey pair, El Centro 1940 NS"
[[building]]
name = "light"
storeys = 3
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[building]]
name = "heavy"
storeys = 3
mass = "1000 t"
stiffness = "2215 MN/m"
height = "3 m"
damping = { stiffness_proportional = "5 %" }
[[gap]]
between = ["light", "heavy"]
width = "20 mm"
model = "jankowski_2005"
stiffness = "2.75e9 N/m^1.5"
restitution = 0.65
[ground_motion]
file = "../../ground_motions/el_centro_1940_ns.csv"
scale = { pga = "0.35 g" }
[analysis]
method = "adaptive"
duration = "40 s"
output_step = "10 ms"
"#;

fn parse(text: &str) -> Result<Case, pounding_case::CaseError> {
    Case::parse(text, Path::new("folder/case.toml"))
}

#[test]
fn the_example_means_what_it_says() {
    let case = parse(EXAMPLE).unwrap();
    assert_eq!(case.buildings[0].mass, [25e3; 3]);
    assert_eq!(case.buildings[1].stiffness, [2.215e9; 3]);
    assert_eq!(
        case.buildings[1].damping.value,
        Damping::StiffnessProportional { ratio: 0.05 }
    );
    let gap = &case.gaps[0];
    assert_eq!(gap.between, [Side::Building(0), Side::Building(1)]);
    assert_eq!(gap.name, "light-heavy");
    assert_eq!(gap.levels.len(), 3);
    assert!(
        gap.levels
            .iter()
            .all(|l| l.width == 0.02 && l.left == l.right)
    );
    let stiffness = &gap.parameters[0];
    assert_eq!(
        (
            stiffness.key.value.as_str(),
            stiffness.values[0].value.value
        ),
        ("stiffness", 2.75e9)
    );
    assert_eq!(
        stiffness.values[0].value.dimension,
        Some(Dimension::stiffness_with_exponent(1.5))
    );
    let scale = case.ground_motion.scale.as_ref().map(|scale| &scale.value);
    let Some(Scale::PeakAcceleration(peak)) = scale else {
        panic!("{scale:?}");
    };
    assert!((peak - 0.35 * 9.80665).abs() < 1e-15);
    assert_eq!(
        (case.analysis.duration, case.analysis.output_step),
        (Some(40.0), 0.01)
    );
    assert_eq!(case.resolve(Path::new("a.csv")), Path::new("folder/a.csv"));
}

/// Definitions: pound 0.45359237 kg and inch 0.0254 m (1959), standard gravity
/// 9.80665 m/s2 (1901); 25000 kip/in^1.5 = 2.747108735e10 N/m^1.5.
/// Of a case that differs in a table, that table is read, and what depends on it.
#[test]
fn a_table_is_read_again() {
    let file = Path::new("folder/case.toml");
    let tree = CaseTree::parse(EXAMPLE, file).unwrap();
    let with = |edited: &str| {
        let edited = DeTable::parse(edited).unwrap().into_inner();
        let (key, _) = edited.iter().next().unwrap();
        let changed = [(key.clone(), edited[key.get_ref().as_ref()].clone())];
        tree.with(&changed.into_iter().collect())
    };
    let base = parse(EXAMPLE).unwrap();
    assert_eq!(tree.with(&DeTable::new()).unwrap(), base);
    let wider = EXAMPLE.replace("20 mm", "30 mm");
    let gap = &wider[wider.find("[[gap]]").unwrap()..wider.find("[ground").unwrap()];
    let made = with(gap).unwrap();
    assert_eq!(made.gaps[0].levels[2].width, 0.03);
    assert_eq!(
        (&made.buildings, &made.analysis),
        (&base.buildings, &base.analysis)
    );
    // Gaps and buildings are held against one another, whichever of them is new.
    assert_eq!(with(&gap.replace("light", "lihgt")), None);
    let buildings =
        &EXAMPLE[EXAMPLE.find("[[building]]").unwrap()..EXAMPLE.find("[[gap]]").unwrap()];
    let lower = with(&buildings.replace("\"3 m\"", "2.5")).unwrap();
    assert_eq!(lower.buildings[1].height, [2.5; 3]);
    assert_eq!(lower.gaps[0].levels, base.gaps[0].levels);
    assert_eq!(with(&buildings.replacen("\"3 m\"", "2.5", 1)), None);
    assert!(CaseTree::parse(&EXAMPLE.replace("width", "widht"), file).is_err());
}

#[test]
fn units_by_definition() {
    for (text, value, dimension) in [
        ("1 kip", 4_448.221_615_260_5, Dimension::FORCE),
        ("1 in", 0.0254, Dimension::LENGTH),
        ("25000 kip/in", 4.378_170_881e9, Dimension::STIFFNESS),
        (
            "25000 kip/in^1.5",
            2.747_108_735e10,
            Dimension::stiffness_with_exponent(1.5),
        ),
        ("3.5 kN s/m", 3500.0, Dimension::DASHPOT),
        ("3.5 kN*s/m", 3500.0, Dimension::DASHPOT),
        ("0.3 1/s", 0.3, Dimension::FREQUENCY),
        ("981 cm/s2", 9.81, Dimension::ACCELERATION),
        ("9.81 m/s²", 9.81, Dimension::ACCELERATION),
        ("0.5 m/s", 0.5, Dimension::VELOCITY),
        ("10 ms", 0.01, Dimension::TIME),
        ("5 %", 0.05, Dimension::NUMBER),
    ] {
        let quantity = parse_quantity(text).unwrap();
        assert!(
            (quantity.value / value - 1.0).abs() < 2e-10,
            "{text}: {}",
            quantity.value
        );
        assert_eq!(quantity.dimension, Some(dimension), "{text}");
    }
    for text in ["", "t", "25 tons", "1e999 m", "1 m^x", "nan m", "inf"] {
        assert!(parse_quantity(text).is_err(), "{text}");
    }
}

#[test]
fn a_wall_and_named_levels() {
    let wall = EXAMPLE.replace(
        "between = [\"light\", \"heavy\"]",
        "between = [\"heavy\", \"wall\"]\nlevels = [2, 3]\n",
    );
    let case = parse(&wall).unwrap();
    assert_eq!(case.gaps[0].between, [Side::Building(1), Side::Wall]);
    let levels: Vec<_> = case.gaps[0]
        .levels
        .iter()
        .map(|l| (l.left, l.right))
        .collect();
    assert_eq!(
        levels,
        [
            (Facing::Floor(1), Facing::Wall),
            (Facing::Floor(2), Facing::Wall)
        ]
    );
    let inside = EXAMPLE.replace("[\"light\", \"heavy\"]", "[\"light\", \"wall\"]");
    assert!(parse(&inside).is_err());
}

/// Every property of the schema is a key that the parser knows, and the other way
/// round: the parser's complaint about an unknown key lists them.
/// What a list gives stands where `levels` names the floors, whatever their order.
#[test]
fn lists_stand_in_the_order_of_the_levels() {
    let levels = "between = [\"light\", \"heavy\"]\nlevels = [[3, 3], [1, 1], [2, 2]]\n";
    let link = format!(
        "[[link]]\n{levels}model = \"linear\"\nstiffness = [\"333 N/m\", \"111 N/m\", \"222 N/m\"]\n[ground_motion]"
    );
    let text = EXAMPLE.replace("[ground_motion]", &link).replace(
        "between = [\"light\", \"heavy\"]\nwidth = \"20 mm\"",
        &format!("{levels}width = [\"30 mm\", \"10 mm\", \"20 mm\"]"),
    );
    let case = parse(&text).unwrap();
    let widths: Vec<f64> = case.gaps[0].levels.iter().map(|l| l.width).collect();
    assert_eq!(widths, [0.01, 0.02, 0.03]);
    let link = &case.links[0];
    assert_eq!(link.levels, [0, 1, 2].map(|s| (Some(s), Some(s))));
    let values = link.parameters[0].values.iter();
    let values: Vec<f64> = values.map(|v| v.value.value).collect();
    assert_eq!(values, [111.0, 222.0, 333.0]);
}

#[test]
fn schema_and_parser_know_the_same_keys() {
    let schema = schema();
    let keys = |value: &serde_json::Value| -> Vec<String> {
        value["properties"]
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect()
    };
    let building = &schema["properties"]["building"]["items"];
    let motion = &schema["properties"]["ground_motion"];
    let analysis = &schema["properties"]["analysis"];
    for (place, listed) in [
        ("title = ", keys(&schema)),
        ("name = \"light\"", keys(building)),
        ("file = ", keys(motion)),
        ("method = ", keys(analysis)),
    ] {
        let text = EXAMPLE.replace(place, &format!("zzzz = 1\n{place}"));
        let help = parse(&text).unwrap_err().help.unwrap();
        let known = help.split("known keys: ").nth(1).unwrap();
        let mut known: Vec<String> = known.split(", ").map(str::to_owned).collect();
        let mut listed = listed;
        known.sort();
        listed.sort();
        assert_eq!(known, listed);
    }
}

/// Every key stands once, in its table, with what is known of it from its type.
#[test]
fn the_schema_stands_by_itself() {
    let schema = schema();
    let text = schema.to_string();
    assert!(!text.contains("$ref") && !text.contains("null"), "{text}");
    assert_eq!(schema["$id"], "pounding/case.schema.json");
    let building = &schema["properties"]["building"]["items"];
    let required = ["name", "mass"];
    assert_eq!(building["required"], serde_json::json!(required));
    // A slab alone on isolators has no storeys to damp.
    let damping = serde_json::json!([{"required": ["damping"]}, {"required": ["isolator"]}]);
    assert_eq!(building["allOf"][1]["anyOf"], damping);
    let one_of = |number: usize| -> Vec<&str> {
        let choices = building["allOf"][number]["oneOf"].as_array().unwrap();
        choices
            .iter()
            .map(|choice| choice["required"][0].as_str().unwrap())
            .collect()
    };
    let matrices = ["stiffness_matrix", "flexibility_matrix"];
    let helpers = ["cantilever", "fishbone"];
    let resist = [
        &["stiffness"][..],
        &matrices,
        &helpers,
        &["plan", "isolator"],
    ]
    .concat();
    assert_eq!(one_of(0), resist);
    assert_eq!(one_of(2), ["height", "elevations"]);
    assert_eq!(building["additionalProperties"], false);
    let mass = &building["properties"]["mass"];
    assert_eq!(mass["anyOf"][0]["exclusiveMinimum"], 0.0);
    assert_eq!(mass["anyOf"][1]["minItems"], 1);
    let damping = &building["properties"]["damping"]["oneOf"];
    assert_eq!(damping.as_array().unwrap().len(), 6);
    assert_eq!(
        damping[0]["required"],
        serde_json::json!(["ratio", "modes"])
    );
    let free = &schema["properties"]["link"]["items"]["additionalProperties"];
    assert!(
        free["description"]
            .as_str()
            .unwrap()
            .starts_with("Parameters of the law")
    );
}

#[test]
fn hostile_texts_are_refused_with_a_place() {
    for text in [
        "",
        "[[building]]",
        "building = 3",
        "title = \"\\",
        "[[gap]]\nbetween = []",
    ] {
        let error = parse(text).unwrap_err();
        assert!(error.line >= 1 && error.column >= 1 && !error.message.is_empty());
        assert!(error.help.is_some(), "{error}");
    }
    assert!(parse(&EXAMPLE.replace('\n', "\r\n")).is_ok());
    assert!(parse(&EXAMPLE.replace("\"25 t\"", "1e400")).is_err());
}

proptest! {
    #[test]
    fn arbitrary_text_never_panics(text in ".{0,200}") {
        let _ = parse(&text);
        let _ = parse_quantity(&text);
    }

    #[test]
    fn damaged_examples_never_panic(at in 0usize..900, with in ".{0,3}") {
        let cut = EXAMPLE.char_indices().map(|(i, _)| i).rfind(|i| *i <= at).unwrap();
        let _ = parse(&format!("{}{with}{}", &EXAMPLE[..cut], &EXAMPLE[cut..]));
        let _ = parse(&EXAMPLE[..cut]);
    }
}
