//! Columns that floors of the neighbour hit.
use std::path::Path;

use pounding_case::{Case, CaseError, ColumnEnds, Facing};

/// Floors at 4.4 and 8 m beside floors at 3, 6 and 9 m.
fn text(gap: &str) -> String {
    let building = |name: &str, heights: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = \"40 t\"\nstiffness = 1e8\nheight = {heights}\ndamping = {{ modal = 0.05 }}\n"
        )
    };
    let (a, b) = (building("A", "[4.4, 3.6]"), building("B", "[3, 3, 3]"));
    let rest = "width = 0.02\nmodel = \"linear_elastic\"\nstiffness = 3.74e8\n";
    format!(
        "{a}{b}[[gap]]\nbetween = [\"A\", \"B\"]\n{rest}{gap}\n[ground_motion]\nfile = \"r.csv\"\n"
    )
}

fn parse(gap: &str) -> Result<Case, CaseError> {
    Case::parse(&text(gap), Path::new("case.toml"))
}

fn levels(gap: &str) -> Vec<[Facing; 2]> {
    let case = parse(gap).unwrap_or_else(|e| panic!("{gap}: {}", e.message));
    let levels = case.gaps[0].levels.iter();
    levels.map(|l| [l.left, l.right]).collect()
}

fn column(storey: usize, above_floor: f64) -> Facing {
    Facing::Column {
        storey,
        above_floor,
    }
}

const COLUMN: &str = "column = { of = \"B\", flexural_rigidity = \"256 MN m2\" }";

/// What two levels say, but for round-off of the heights.
fn same(found: &[[Facing; 2]], expected: &[[Facing; 2]]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    let facing = |a: &Facing, b: &Facing| match (a, b) {
        (
            Facing::Column {
                storey,
                above_floor,
            },
            Facing::Column {
                storey: other,
                above_floor: z,
            },
        ) => storey == other && (above_floor - z).abs() < 1e-12,
        _ => a == b,
    };
    for (a, b) in found.iter().zip(expected) {
        assert!(facing(&a[0], &b[0]) && facing(&a[1], &b[1]), "{a:?} {b:?}");
    }
}

#[test]
fn all_floors_meet_the_floor_or_the_columns_at_their_elevation() {
    let expected = [
        [Facing::Floor(0), column(1, 1.4)],
        [Facing::Floor(1), column(2, 2.0)],
    ];
    let all = format!("levels = \"all_floors\"\n{COLUMN}");
    same(&levels(&all), &expected);
    // Also without a word about levels, and with pairs.
    same(&levels(COLUMN), &expected);
    let pairs = format!("levels = [[2, {{ storey = 3 }}], [1, {{ storey = 2 }}]]\n{COLUMN}");
    same(&levels(&pairs), &expected);
    // Columns of the other building: floors of B at 3 and 6 m, that at 9 m is above the roof.
    let other = COLUMN.replace("\"B\"", "\"A\"");
    let expected_other = [
        [column(0, 3.0), Facing::Floor(0)],
        [column(1, 1.6), Facing::Floor(1)],
    ];
    same(&levels(&other), &expected_other);
    let both = "column = [{ of = \"A\", flexural_rigidity = 1e8 }, { of = \"B\", flexural_rigidity = 2.56e8 }]";
    let expected_both = [
        expected_other[0],
        expected[0],
        expected_other[1],
        expected[1],
    ];
    same(&levels(both), &expected_both);
    // Floors within the tolerance of a floor hit this.
    let near = format!("elevation_tolerance = 1.45\n{COLUMN}");
    let expected_near = [
        [Facing::Floor(0), Facing::Floor(0)],
        [Facing::Floor(1), Facing::Floor(2)],
    ];
    same(&levels(&near), &expected_near);
}

#[test]
fn columns_are_read_in_si_units() {
    let all = "column = { of = \"B\", flexural_rigidity = \"256 MN m2\", shear_rigidity = \"2 GN\", ends = \"pinned\", contact_mass = \"2.4 t\", shear_capacity = \"400 kN\" }";
    let case = parse(all).unwrap();
    let [None, Some(columns)] = &case.gaps[0].columns else {
        panic!("{:?}", case.gaps[0].columns);
    };
    let columns = &columns.value;
    assert_eq!(columns.flexural_rigidity, 2.56e8);
    assert_eq!(columns.shear_rigidity, Some(2e9));
    assert_eq!(columns.ends, ColumnEnds::Pinned);
    assert_eq!(columns.contact_mass, Some(2400.0));
    assert_eq!(columns.shear_capacity, Some(4e5));
    let case = parse(COLUMN).unwrap();
    let columns = case.gaps[0].columns[1].clone().unwrap().value;
    assert_eq!(columns.ends, ColumnEnds::Fixed);
    assert_eq!(columns.contact_mass, None);
}

/// Each with what its one error says, and where.
#[test]
fn what_cannot_be_is_refused_once_at_its_place() {
    let with = |levels: &str| format!("levels = {levels}\n{COLUMN}");
    for (gap, place, says) in [
        (
            "levels = \"all_floors\"".to_owned(),
            "\"all_floors\"",
            "the gap has no `column`",
        ),
        (
            "levels = [[1, { storey = 2 }]]".to_owned(),
            "{ storey = 2 }",
            "the gap has no `column` of \"B\"",
        ),
        (
            with("[[1, { storey = 3 }]]"),
            "{ storey = 3 }",
            "floor 1 of \"A\" at 4.4 m does not meet storey 3 of \"B\" from 6 m to 9 m",
        ),
        (with("[[1, { storey = 4 }]]"), "4", "\"B\" has no storey 4"),
        (
            with("[[{ storey = 1 }, { storey = 2 }]]"),
            "[{ storey = 1 }, { storey = 2 }]",
            "columns do not hit columns",
        ),
        (
            with("[[{ storey = 1 }, 1]]"),
            "{ storey = 1 }",
            "the gap has no `column` of \"A\"",
        ),
        (
            with("[[1, { story = 2 }]]"),
            "story",
            "unknown key `story`",
        ),
        (
            with("[[1, 1], [2, 2]]\nfloor_to_floor = true"),
            "{ of = \"B\", flexural_rigidity = \"256 MN m2\" }",
            "no level of this gap lets the columns of \"B\" be hit",
        ),
        (
            with("\"matching\""),
            "{ of = \"B\", flexural_rigidity = \"256 MN m2\" }",
            "no level of this gap lets the columns of \"B\" be hit",
        ),
        (
            COLUMN.replace("\"B\"", "\"C\""),
            "\"C\"",
            "\"C\" is not one of the neighbours",
        ),
        (
            COLUMN.replace("of = \"B\", ", ""),
            "{ flexural_rigidity = \"256 MN m2\" }",
            "has no `of`",
        ),
        (
            COLUMN.replace(" m2", ""),
            "\"256 MN\"",
            "must be a flexural rigidity (N m2)",
        ),
        (
            COLUMN.replace(" }", ", ends = \"free\" }"),
            "\"free\"",
            "`ends` cannot be \"free\"",
        ),
        (
            COLUMN.replace(" }", ", contact_mass = 0 }"),
            "0",
            "`contact_mass` = 0 must be greater than zero",
        ),
        (
            COLUMN.replace(" }", ", shear_capacity = \"4 t\" }"),
            "\"4 t\"",
            "must be a force (N)",
        ),
        (
            "column = [{ of = \"B\", flexural_rigidity = 1e8 }, { of = \"B\", flexural_rigidity = 2e8 }]".to_owned(),
            "{ of = \"B\", flexural_rigidity = 2e8 }",
            "the columns of \"B\" are given twice",
        ),
        ("column = 3".to_owned(), "3", "must be a table"),
        ("column = []".to_owned(), "[]", "empty list"),
    ] {
        let error = parse(&gap).unwrap_err();
        assert!(error.message.contains(says), "{gap}: {}", error.message);
        assert!(error.others.is_empty(), "{gap}: {:?}", error.others);
        assert_eq!(&text(&gap)[error.span.clone()], place, "{gap}");
        assert!(error.help.is_some(), "{gap}");
    }
    // A floor above the roof.
    let high = text(&with("[[{ storey = 2 }, 3]]").replace("\"B\"", "\"A\""));
    let error = Case::parse(&high, Path::new("case.toml")).unwrap_err();
    assert!(
        error
            .help
            .unwrap()
            .contains("above the roof of \"A\" at 8 m")
    );
    // A wall.
    let wall = text(COLUMN).replace("[\"A\", \"B\"]", "[\"wall\", \"A\"]");
    let error = Case::parse(&wall, Path::new("case.toml")).unwrap_err();
    assert!(error.message.contains("beside a wall"), "{}", error.message);
    // Without columns the remedy names them.
    let error = parse("").unwrap_err();
    assert!(error.help.unwrap().contains("`column = {...}`"));
}
