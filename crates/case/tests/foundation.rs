//! Foundations that sway and rock, and links between them.
use std::path::Path;

use pounding_case::{
    Case, CaseError, Foundation, FoundationMotion, Soil, SpringDashpot, Support, schema,
};

/// Two buildings, the first with this after its keys.
fn text(foundation: &str, more: &str) -> String {
    let building = |name: &str, more: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 2\nmass = \"40 t\"\nstiffness = 1e8\nheight = 3\ndamping = {{ modal = 0.05 }}\n{more}\n"
        )
    };
    let (a, b) = (building("a", foundation), building("b", ""));
    format!("{a}{b}{more}[ground_motion]\nfile = \"r.csv\"\n")
}

fn parse(foundation: &str, more: &str) -> Result<Case, CaseError> {
    Case::parse(&text(foundation, more), Path::new("case.toml"))
}

fn foundation(keys: &str) -> Foundation {
    let case = parse(&format!("[building.foundation]\n{keys}"), "").unwrap();
    assert_eq!(case.buildings[1].foundation, None);
    case.buildings[0].foundation.clone().unwrap().value
}

const SOIL: &str = "soil = { shear_wave_speed = \"180 m/s\", density = \"1.8 t/m3\", poisson = 0.33, length = \"12 m\", width = 11 }";

#[test]
fn soil_and_springs_are_read_in_si_units() {
    let soil = foundation(&format!(
        "mass = \"150 t\"\nrotational_inertia = \"5400 t m2\"\n{SOIL}"
    ));
    let expected = Foundation {
        mass: 1.5e5,
        rotational_inertia: 5.4e6,
        support: Support::Soil(Soil {
            shear_wave_speed: 180.0,
            density: 1800.0,
            poisson: 0.33,
            length: 12.0,
            width: 11.0,
        }),
        length: Some(12.0),
    };
    assert_eq!(soil, expected);

    let springs = foundation(
        "mass = 1.5e5\nrotational_inertia = 5.4e6\nlength = \"10 m\"\nsway = { stiffness = \"1.9 GN/m\", dashpot = \"47 MN s/m\" }\nrocking = { stiffness = \"75 GN m/rad\", dashpot = \"1.1 GN m s/rad\" }",
    );
    assert_eq!(springs.length, Some(10.0));
    let spring = |stiffness, dashpot| Some(SpringDashpot { stiffness, dashpot });
    let expected = Support::Springs {
        sway: spring(1.9e9, 4.7e7),
        rocking: spring(7.5e10, 1.1e9),
    };
    assert_eq!(springs.support, expected);
    assert!(springs.support.sways() && springs.support.rocks());
}

#[test]
fn a_spring_left_out_is_rigid_and_a_dashpot_none() {
    let rocks = foundation("rotational_inertia = 5e6\nrocking = { stiffness = 7e10 }");
    let rocking = SpringDashpot {
        stiffness: 7e10,
        dashpot: 0.0,
    };
    let expected = Support::Springs {
        sway: None,
        rocking: Some(rocking),
    };
    assert_eq!(rocks.support, expected);
    assert!(!rocks.support.sways() && rocks.mass == 0.0);
    // In one line as well.
    let inline = "foundation = { mass = 1e5, sway = { stiffness = 2e9 } }";
    let case = parse(inline, "").unwrap();
    let sways = case.buildings[0].foundation.clone().unwrap();
    assert!(sways.value.support.sways() && !sways.value.support.rocks());
}

/// Each with what its one error says, and where.
#[test]
fn what_cannot_be_is_refused_once_at_its_place() {
    for (keys, place, says) in [
        (
            "mass = 1e5",
            "[building.foundation]\nmass = 1e5",
            "neither `soil` nor `sway` nor `rocking`",
        ),
        (
            "mass = 1e5\nrocking = { stiffness = 1e9 }",
            "[building.foundation]\nmass = 1e5\nrocking = { stiffness = 1e9 }",
            "rocks needs `rotational_inertia`",
        ),
        (
            "rotational_inertia = 1e5\nsway = { stiffness = 1e9 }",
            "[building.foundation]\nrotational_inertia = 1e5\nsway = { stiffness = 1e9 }",
            "sways needs `mass`",
        ),
        (
            "mass = 1e5\nrotational_inertia = 5e6\nsway = { stiffness = 1e9 }",
            "5e6",
            "`rotational_inertia` has no meaning beside `sway` alone",
        ),
        (
            "mass = 2e5\nrotational_inertia = 5e6\nrocking = { stiffness = 1e9 }",
            "2e5",
            "`mass` has no meaning beside `rocking` alone",
        ),
        (
            "mass = 1e5\nrotational_inertia = 0\nrocking = { stiffness = 1e9 }",
            "0",
            "`rotational_inertia` = 0 must be greater than zero",
        ),
        (
            "mass = 1e5\nrotational_inertia = 1e5\nsoil = { shear_wave_speed = 180, density = 1800, poisson = 0.5, length = 9, width = 9 }",
            "0.5",
            "`poisson` = 0.5 must be a Poisson's ratio from 0 to below 0.5",
        ),
        (
            "mass = 1e5\nrotational_inertia = 1e5\nsoil = { shear_wave_speed = 180, density = \"1.8 t\", poisson = 0.3, length = 9, width = 9 }",
            "\"1.8 t\"",
            "`density` must be a density (kg/m3), but \"1.8 t\" is a mass (kg)",
        ),
        (
            "mass = 1e5\nrotational_inertia = 1e5\nsoil = { shear_wave_speed = 180, density = 1800, poisson = 0.3, length = 9 }",
            "{ shear_wave_speed = 180, density = 1800, poisson = 0.3, length = 9 }",
            "has no `width`",
        ),
        (
            "mass = 1e5\nrotational_inertia = \"5 t m\"\nrocking = { stiffness = 1e9 }",
            "\"5 t m\"",
            "must be a rotational inertia (kg m2)",
        ),
        (
            "rotational_inertia = 1e5\nrocking = { stiffness = \"1 MN/m\" }",
            "\"1 MN/m\"",
            "must be a moment, an energy or a rotational stiffness (N m), but \"1 MN/m\" is a stiffness (N/m)",
        ),
        (
            "mass = 1e5\nsway = { stiffness = 1e9, dashpot = -1 }",
            "-1",
            "`dashpot` = -1 must be zero or more",
        ),
        (
            "mass = 1e5\nsway = { stifness = 1e9 }",
            "stifness",
            "unknown key `stifness`",
        ),
        (
            "mass = 1e5\nrotational_inertia = 1e5\nsway = { stiffness = 1e9 }\nsoil = { shear_wave_speed = 180, density = 1800, poisson = 0.3, length = 9, width = 9 }",
            "{ shear_wave_speed = 180, density = 1800, poisson = 0.3, length = 9, width = 9 }",
            "either `soil` or `sway`, not both",
        ),
        (
            "mass = 1e5\nrotational_inertia = 1e5\nlength = 5\nsoil = { shear_wave_speed = 180, density = 1800, poisson = 0.3, length = 9, width = 9 }",
            "5",
            "`length` stands in `soil`",
        ),
    ] {
        let given = format!("[building.foundation]\n{keys}");
        let error = parse(&given, "").unwrap_err();
        assert!(error.message.contains(says), "{keys}: {}", error.message);
        assert!(error.others.is_empty(), "{keys}: {:?}", error.others);
        let whole = text(&given, "");
        let found = whole[error.span.clone()].trim_end();
        assert!(
            place.starts_with(found) && !found.is_empty(),
            "{keys}: {found}"
        );
        assert!(error.help.is_some());
    }
}

const LINK: &str = "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"linear\"\nstiffness = 1e8\n";

#[test]
fn a_link_joins_foundations() {
    let soft = "[building.foundation]\nmass = 1e5\nsway = { stiffness = 1e9 }\n";
    let both = |link: &str| {
        let whole = text(soft, link);
        let (before, after) = whole.split_once("[[link]]").unwrap();
        Case::parse(
            &format!("{before}{soft}[[link]]{after}"),
            Path::new("case.toml"),
        )
    };
    let case = both(&format!("{LINK}foundations = \"sway\"\n")).unwrap();
    let link = &case.links[0];
    let motion = link.foundations.clone().unwrap();
    assert_eq!(motion.value, FoundationMotion::Sway);
    assert_eq!(link.levels, [(None, None)]);

    for (keys, says) in [
        (
            "foundations = \"rocking\"",
            "\"a\" has no foundation that rocks",
        ),
        (
            "foundations = \"swaying\"",
            "`foundations` cannot be \"swaying\"",
        ),
        (
            "foundations = \"sway\"\nlevels = [[1, 1]]",
            "`levels` has no meaning beside `foundations`",
        ),
        ("levels = [[1, { storey = 2 }]]", "a link joins floors"),
        ("levels = \"all_floors\"", "must be a list of storeys"),
    ] {
        let error = both(&format!("{LINK}{keys}\n")).unwrap_err();
        assert!(error.message.contains(says), "{keys}: {}", error.message);
        assert!(error.others.is_empty(), "{keys}: {:?}", error.others);
    }
    // One side has a fixed base.
    let error = parse(soft, &format!("{LINK}foundations = \"sway\"\n")).unwrap_err();
    assert!(
        error.message.contains("\"b\" has no foundation"),
        "{}",
        error.message
    );
    // What is wrong in a foundation is not said twice.
    let wrong = soft.replace("1e9", "-1");
    let whole = text(&wrong, &format!("{LINK}foundations = \"sway\"\n"));
    let (before, after) = whole.split_once("[[link]]").unwrap();
    let whole = format!("{before}{soft}[[link]]{after}");
    let error = Case::parse(&whole, Path::new("case.toml")).unwrap_err();
    assert!(error.others.is_empty(), "{:?}", error.others);
}

#[test]
fn the_schema_knows_foundations_and_columns() {
    let schema = schema();
    let building = &schema["properties"]["building"]["items"]["properties"];
    let soil = &building["foundation"]["properties"]["soil"]["properties"];
    assert_eq!(soil["poisson"]["exclusiveMaximum"], 0.5);
    let gap = &schema["properties"]["gap"]["items"]["properties"];
    let column = gap["column"]["anyOf"][0]["properties"].as_object().unwrap();
    assert_eq!(column.len(), 6, "{column:?}");
    let words = &gap["levels"]["anyOf"][0]["enum"];
    assert_eq!(words[1], "all_floors");
    let link = &schema["properties"]["link"]["items"]["properties"];
    assert_eq!(link["levels"]["anyOf"][0]["const"], "matching");
    assert_eq!(link["foundations"]["enum"][1], "rocking");
}
