//! Floors that hit columns of the neighbour, from case files: converged references of two
//! independent codes, and limits.

use std::path::Path;
use std::sync::Arc;

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_gap_element::{ImpactModel, in_series};
use pounding_time_history::{
    BuildingPoint, Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, run,
};

use super::reference::{Found, Reference, Within, found};

const MASS: &str = include_str!("../../data/structures/floor_to_column_mass.json");
const MASSLESS: &str = include_str!("../../data/structures/floor_to_column_massless.json");

const A: &str = "[[building]]
name = \"A\"
mass = [100000.0, 90000.0]
stiffness = [45000000.0, 40000000.0]
height = [4.4, 3.6]
damping = { rayleigh = { alpha = 0.9558832490949376, beta = 0.0021374199235296445 } }
";
const B: &str = "[[building]]
name = \"B\"
mass = [120000.0, 120000.0, 100000.0]
stiffness = [400000000.0, 350000000.0, 300000000.0]
height = [3.0, 3.0, 3.0]
damping = { rayleigh = { alpha = 1.8774407153240775, beta = 0.0010627677065550782 } }
";
const WITH_MASS: &str = "model = \"anagnostopoulos_2004\"
stiffness = 374000000.0
restitution = 0.65
column = { of = \"B\", flexural_rigidity = 2.56e8, ends = \"fixed\", contact_mass = 2400 }
";
const WITHOUT_MASS: &str = "model = \"linear_elastic\"
stiffness = 374000000.0
column = { of = \"B\", flexural_rigidity = 2.56e8 }
";

/// A case with its buildings in this order and with this gap between them.
fn case([left, right]: [&str; 2], gap: &str) -> String {
    let between = match left == A {
        true => "[\"A\", \"B\"]",
        false => "[\"B\", \"A\"]",
    };
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../ground_motions/el_centro_1940_ns.csv"
    );
    format!(
        "{left}{right}[[gap]]\nbetween = {between}\nwidth = 0.02\nlevels = \"all_floors\"\n{gap}[ground_motion]\nfile = \"{record}\"\n[analysis]\nduration = 20\n"
    )
}

fn system(text: &str) -> System {
    let case = Case::parse(text, Path::new("case.toml")).unwrap();
    assemble(&case).unwrap().system
}

fn go(system: &System, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(20.0),
        ..RunOptions::default()
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

const EVENT_DRIVEN: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: 1e-11,
};
const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-11,
};

/// Drifts by their storey, and responses of columns by their level.
fn of_columns(outcome: &Outcome, name: &str) -> Found {
    let (what, place) = name.rsplit_once('_')?;
    let level = place.parse::<usize>();
    if let Ok(level) = level {
        let mut all = outcome.gaps[0].levels[level - 1].responses.iter();
        return found(all.find(|r| r.name == what)?.peak, 1.0);
    }
    let (building, storey) = place.split_at(1);
    let heights: &[f64] = if building == "A" {
        &[4.4, 3.6]
    } else {
        &[3.0; 3]
    };
    let building = outcome.buildings.iter().find(|b| b.name == building)?;
    let storey = storey.parse::<usize>().ok()? - 1;
    assert_eq!(what, "drift");
    found(building.storeys[storey].drift_ratio, heights[storey])
}

/// The case is what the reference says, by two methods.
fn agrees(gap: &str, reference: &str) {
    let system = system(&case([A, B], gap));
    for method in [EVENT_DRIVEN, ADAPTIVE] {
        let outcome = go(&system, method);
        let further = |name: &str| of_columns(&outcome, name);
        Reference::read(reference).agrees_within(&outcome, Within::all(1e-8), &further);
    }
}

#[test]
fn a_case_with_contact_mass_is_as_two_independent_codes_say() {
    agrees(WITH_MASS, MASS);
}

#[test]
fn a_case_without_contact_mass_is_as_two_independent_codes_say() {
    agrees(WITHOUT_MASS, MASSLESS);
    // Forces in the column belong to the drift and to the contact force alike.
    let outcome = go(&system(&case([A, B], WITHOUT_MASS)), EVENT_DRIVEN);
    let level = &outcome.gaps[0].levels[1];
    let of = |name: &str| {
        let mut all = level.responses.iter();
        all.find(|r| r.name == name).unwrap().peak.value
    };
    let bow = level.peak_force.value / 2.592e9;
    assert!((of("column_bow") / bow - 1.0).abs() < 1e-9);
    assert!(of("column_shear_above") > of("column_shear_below"));
}

/// Fixed steps converge to it, the column forces too.
#[test]
fn newmark_converges() {
    for (gap, reference) in [(WITH_MASS, MASS), (WITHOUT_MASS, MASSLESS)] {
        let system = system(&case([A, B], gap));
        let off = [8e-5, 4e-5].map(|step| {
            let method = MethodChoice::Newmark {
                step,
                beta: 0.25,
                gamma: 0.5,
            };
            let outcome = go(&system, method);
            Reference::read(reference).largest_error(&outcome, &|name| of_columns(&outcome, name))
        });
        assert!(off[1] < 1e-2 && off[1] < 0.6 * off[0], "{off:?}");
    }
}

/// The mirror image of pair and ground motion has the same peaks.
#[test]
fn left_and_right_are_alike() {
    for gap in [WITH_MASS, WITHOUT_MASS] {
        let plain = go(&system(&case([A, B], gap)), EVENT_DRIVEN);
        let mirrored = system(&case([B, A], gap));
        let ground = mirrored.ground();
        let mirrored = mirrored.under(GroundAcceleration {
            samples: Arc::new(ground.samples.iter().map(|a| -a).collect()),
            time_step: ground.time_step,
        });
        let mirrored = go(&mirrored, EVENT_DRIVEN);
        let pairs = plain.gaps[0].levels.iter().zip(&mirrored.gaps[0].levels);
        for (a, b) in pairs {
            assert_eq!(a.impacts, b.impacts);
            assert_eq!(a.responses.len(), 5);
            for (a, b) in a.responses.iter().zip(&b.responses) {
                assert_eq!(a.name, b.name);
                let off = (a.peak.value / b.peak.value - 1.0).abs();
                assert!(off < 1e-9, "{}: {off:e}", a.name);
            }
        }
    }
}

/// Without a contact both shears are those of the storey, and the column does not bow.
#[test]
fn a_column_that_nothing_hits_bears_the_drift_alone() {
    let wide = case([A, B], WITHOUT_MASS).replace("width = 0.02", "width = 0.5");
    let outcome = go(&system(&wide), EVENT_DRIVEN);
    for (level, storey) in [(0, 1), (1, 2)] {
        let drift = 3.0 * outcome.buildings[1].storeys[storey].drift_ratio.value;
        let shear = 12.0 * 2.56e8 / 27.0 * drift;
        let responses = &outcome.gaps[0].levels[level].responses;
        for (response, expected) in
            responses
                .iter()
                .zip([shear, shear, 1.5 * shear, 1.5 * shear, 0.0])
        {
            let error = (response.peak.value - expected).abs();
            assert!(error <= 1e-12 * shear, "{}: {error:e}", response.name);
        }
    }
}

/// A point that moves with a floor alone, behind which the column is rigid, is that floor.
#[test]
fn a_rigid_column_hit_at_a_floor_is_the_floor() {
    let text = case([A, B], WITHOUT_MASS).replace("height = [4.4, 3.6]", "height = [3.0, 3.0]");
    let text = text.replace("column = { of = \"B\", flexural_rigidity = 2.56e8 }\n", "");
    let text = text.replace("levels = \"all_floors\"\n", "");
    let floors = system(&text);
    let mut points = floors.without_gaps();
    let pairs = floors.levels().iter().enumerate().map(|(storey, level)| {
        let mut weights = vec![(storey, 1.0)];
        if storey > 0 {
            weights.insert(0, (storey - 1, 0.0));
        }
        let point = points.add_point(BuildingPoint {
            building: 1,
            storey,
            elevation: 3.0 * (storey as f64 + 1.0),
            weights,
        });
        let behind: Arc<dyn ImpactModel> = in_series(Arc::clone(&level.model), 1e24).unwrap();
        (Floor::Storey(0, storey), point, level.width, behind)
    });
    let pairs = pairs.collect();
    let names = ["A".to_owned(), "B".to_owned()];
    points.add_gap("A-B", names, pairs).unwrap();
    for method in [EVENT_DRIVEN, ADAPTIVE] {
        let [floors, points] = [&floors, &points].map(|system| go(system, method));
        assert!(floors.impacts.len() > 5);
        assert_eq!(floors.impacts.len(), points.impacts.len());
        for (a, b) in floors.gaps[0].levels.iter().zip(&points.gaps[0].levels) {
            let off = (a.peak_force.value / b.peak_force.value - 1.0).abs();
            assert!(off < 1e-8, "{off:e}");
        }
        for (a, b) in floors.buildings.iter().zip(&points.buildings) {
            for (a, b) in a.storeys.iter().zip(&b.storeys) {
                let off = (a.displacement.value / b.displacement.value - 1.0).abs();
                assert!(off < 1e-8, "{off:e}");
            }
        }
    }
}

/// A light point approaches the massless one.
#[test]
fn a_light_contact_mass_is_like_none() {
    let undamped = |text: String| {
        let text = text.replace(
            "{ rayleigh = { alpha = 1.8774407153240775, beta = 0.0010627677065550782 } }",
            "{ mass_proportional = 0.05 }",
        );
        text.replace("duration = 20", "duration = 4")
    };
    let light = WITHOUT_MASS.replace("2.56e8 }", "2.56e8, contact_mass = 20 }");
    let [none, light] = [WITHOUT_MASS, &light].map(|gap| {
        let system = system(&undamped(case([A, B], gap)));
        let options = RunOptions {
            method: EVENT_DRIVEN,
            duration: Some(4.0),
            ..RunOptions::default()
        };
        run(&system, &options, &mut [], &mut |_| {}).unwrap()
    });
    for (a, b) in none.buildings.iter().zip(&light.buildings) {
        for (a, b) in a.storeys.iter().zip(&b.storeys) {
            let off = (a.displacement.value / b.displacement.value - 1.0).abs();
            assert!(off < 0.02, "{off:e}");
        }
    }
    assert!(none.impacts.len() > 3);
}

/// Hertz's law behind which the column gives way: the two methods agree, and energy stays.
#[test]
fn an_elastic_law_that_is_not_linear_stands_before_a_column() {
    let hertz = WITHOUT_MASS
        .replace("linear_elastic", "hertz_1882")
        .replace("374000000.0", "2.75e9");
    let system = system(&case([A, B], &hertz));
    let [exact, adaptive] = [EVENT_DRIVEN, ADAPTIVE].map(|method| go(&system, method));
    assert!(exact.impacts.len() > 5);
    assert_eq!(exact.impacts.len(), adaptive.impacts.len());
    for (a, b) in exact.gaps[0].levels.iter().zip(&adaptive.gaps[0].levels) {
        assert!((a.peak_force.value / b.peak_force.value - 1.0).abs() < 1e-7);
        let most = exact.energy.largest_input;
        assert!(a.energy_dissipated.abs() < 1e-9 * most);
    }
    assert!(exact.energy.residual_ratio < 1e-9);
}

/// Two floors hit the columns of one storey of twice the height.
const TALL: &str = "[[building]]
name = \"B\"
mass = [120000.0, 100000.0]
stiffness = [1.2e8, 300000000.0]
height = [6.4, 3.0]
damping = DAMPING
initial_displacement = [\"3 mm\", \"5 mm\"]
";

/// Whatever the damping, both methods agree on columns with several points, and the ledger
/// closes; points start where the floors carry them.
#[test]
fn columns_with_several_points_and_all_kinds_of_damping_agree() {
    for damping in [
        "{ rayleigh = { alpha = 1.2, beta = 0.001 } }",
        "{ ratio = 0.05, modes = [1, 2] }",
        "{ stiffness_proportional = 0.02 }",
        "{ mass_proportional = 0.05 }",
        "{ modal = 0.05 }",
        "{ modal = [0.03, 0.05] }",
        "{ dashpots = \"800 kN s/m\" }",
    ] {
        let hit = TALL.replace("DAMPING", damping);
        let low = A.replace("height = [4.4, 3.6]", "height = [2.4, 2.4]");
        let text = case([A, B], WITH_MASS).replace(A, &low).replace(B, &hit);
        let text = text.replace("width = 0.02", "width = 0.008");
        let system = system(&text);
        let start = system.initial_state();
        assert!(start[4] > 0.0 && start[4] < start[5] && start[5] < start[2]);
        assert_eq!(system.buildings()[1].coordinates(), 4);
        let [exact, adaptive] = [EVENT_DRIVEN, ADAPTIVE].map(|method| {
            let options = RunOptions {
                method,
                duration: Some(6.0),
                ..RunOptions::default()
            };
            run(&system, &options, &mut [], &mut |_| {}).unwrap()
        });
        assert!(exact.impacts.len() > 2, "{damping}");
        assert_eq!(exact.impacts.len(), adaptive.impacts.len(), "{damping}");
        let levels = exact.gaps[0].levels.iter().zip(&adaptive.gaps[0].levels);
        for (a, b) in levels.flat_map(|(a, b)| a.responses.iter().zip(&b.responses)) {
            let off = (a.peak.value / b.peak.value - 1.0).abs();
            assert!(off < 1e-6, "{damping} {}: {off:e}", a.name);
        }
        assert!(exact.energy.residual_ratio < 1e-9, "{damping}");
    }
}

/// The foot of a column in the first storey moves with the ground: two motions that are the same take both sides of
/// the gap along, and of two that are not, the gap opens and closes by their difference. Rigid buildings tell the
/// ground alone, held against points that are floors.
#[test]
fn the_ground_carries_a_column_of_the_first_storey_along() {
    let storey = |name: &str, height: f64, ground: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = 1e5\nstiffness = 1e12\nstoreys = 2\nheight = {height}\ndamping = {{ ratio = 0.05, modes = [1, 2] }}\n{ground}\n"
        )
    };
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../ground_motions/el_centro_1940_ns.csv"
    );
    let openings = |grounds: [&str; 2]| {
        let grounds = grounds.map(|g| g.replace("FILE", &format!("file = \"{file}\"")));
        let low = storey("low", 2.0, &grounds[0]);
        let tall = storey("tall", 3.0, &grounds[1]);
        let of = |level: &str| {
            let text = format!(
                "{low}{tall}[[gap]]\nbetween = [\"low\", \"tall\"]\nwidth = 1.0\nseat = 5.0\nmodel = \"linear_elastic\"\nstiffness = 1e8\n{level}\n[ground_motion]\nfile = \"{file}\"\n"
            );
            let options = RunOptions::default();
            let outcome = run(&system(&text), &options, &mut [], &mut |_| {}).unwrap();
            assert_eq!(outcome.impacts.len(), 0);
            let level = &outcome.gaps[0].levels[0];
            let opening = level.responses.iter().find(|r| r.name == "opening");
            opening.map(|r| r.peak.value)
        };
        let column = "levels = [[1, { storey = 1 }]]\ncolumn = { of = \"tall\", flexural_rigidity = 2.56e8 }";
        let floors = "levels = [[1, 1]]\nfloor_to_floor = true";
        [of(column), of(floors)].map(Option::unwrap)
    };
    let [column, floors] = openings(["ground = { FILE }"; 2]);
    assert!(
        column.abs() < 1e-6 && floors.abs() < 1e-6,
        "{column:e} {floors:e}"
    );
    for grounds in [
        ["", "ground = { delay = 0.5 }"],
        ["ground = { delay = 0.5 }", ""],
        ["ground = { FILE, scale = 0.5 }", "ground = { FILE }"],
    ] {
        let [column, floors] = openings(grounds);
        assert!(floors > 0.01, "{floors}");
        // Rigid floors still move by a = k u: some 1e-6 m.
        assert!((column - floors).abs() < 1e-5, "{column} {floors}");
    }
}

/// The same numbers with one record for all and with one of its own under each building.
#[test]
fn a_record_twice_is_one_record_for_columns() {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../ground_motions/el_centro_1940_ns.csv"
    );
    let one = case([A, B], WITHOUT_MASS)
        .replace("[4.4, 3.6]", "[2.0, 5.0]")
        .replace("width = 0.02", "width = 0.005");
    let own = |name: &str| format!("name = \"{name}\"\nground = {{ file = \"{record}\" }}\n");
    let twice = one
        .replace("name = \"A\"\n", &own("A"))
        .replace("name = \"B\"\n", &own("B"));
    let [one, twice] = [one, twice].map(|text| go(&system(&text), ADAPTIVE));
    assert!(one.impacts.iter().filter(|i| i.level == 0).count() > 3);
    assert_eq!(one.impacts.len(), twice.impacts.len());
    for (a, b) in one.impacts.iter().zip(&twice.impacts) {
        assert_eq!((a.gap, a.level), (b.gap, b.level));
        assert!((a.time_closed - b.time_closed).abs() < 1e-8);
        let off = a.peak_force.value / b.peak_force.value - 1.0;
        assert!(off.abs() < 1e-6, "{off:e}");
    }
}
