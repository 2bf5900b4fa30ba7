//! Variables of several entries, and of multiples of what the case has.

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_files::checksum::WithoutChecksum;
use pounding_study::{ResultReader, Row, Study, Value, case_of_run};
use pounding_time_history::run;

use super::studies::{rows, study, study_of_example};

/// Two gaps of a row, and buildings with a stiffness for each storey.
fn row_of_five(folder: &std::path::Path, text: &str) -> Study {
    let short = |case: String| case.replace("duration = \"30 s\"", "duration = \"8 s\"");
    study_of_example(folder, "row_of_five", short, text)
}

/// The peaks of displacement and the contact forces of a run by itself.
fn alone(folder: &std::path::Path, text: &str) -> Vec<Vec<f64>> {
    let case = Case::parse(text, &folder.join("case.toml")).unwrap();
    let assembly = assemble(&case).unwrap();
    let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {}).unwrap();
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    let levels = outcome.gaps.iter().flat_map(|gap| &gap.levels);
    vec![
        storeys.map(|s| s.displacement.value).collect(),
        levels.map(|level| level.peak_force.value).collect(),
    ]
}

/// The same of the rows of a study.
fn of_study(study: &Study, folder: &std::path::Path) -> Vec<(Vec<Vec<f64>>, Row)> {
    let rows = rows(study, folder);
    let result = folder.join("out.h5");
    let reader = ResultReader::open(&result, WithoutChecksum::Refuse).unwrap();
    let layout = &reader.description.layout;
    let names = ["peak_displacement", "peak_force"];
    let values = |row: &Row| names.map(|name| row.values[layout.range(name)].to_vec());
    rows.into_iter()
        .map(|(row, _)| (values(&row).to_vec(), row))
        .collect()
}

/// A run whose gaps, and the stiffness of every storey of two buildings, vary together is that of the
/// case in which a person writes all of them; that of the multiple 1 is the case itself.
#[test]
fn one_variable_changes_several_entries() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let study = row_of_five(
        folder,
        "[[variable]]\npath = \"gap.*.width\"\nvalues = [\"20 mm\", 0.04]\n[[variable]]\nname = \"factor\"\npath = [\"building.R3.stiffness\", \"building.0.stiffness.*\"]\nrelative = true\nvalues = [1, \"80 %\"]\n",
    );
    assert_eq!(study.variables[0].name, "gap_width");
    assert_eq!(study.variables[0].unit, "m");
    assert_eq!(study.variables[1].unit, "1");
    assert_eq!(
        study.variables[1].long_name,
        "multiple of building.R3.stiffness, building.0.stiffness.*"
    );
    let base = std::fs::read_to_string(folder.join("case.toml")).unwrap();
    let softer = |case: &str| {
        let mut case = case.to_owned();
        for mega in [
            500.0, 455.0, 410.0, 365.0, 320.0, 275.0, 420.0, 382.2, 344.4, 306.6, 268.8, 231.0,
        ] {
            // As 80 % of the number in N/m.
            let number = 0.8 * format!("{mega}e6").parse::<f64>().unwrap();
            let of = format!("\"{mega} MN/m\"");
            assert_eq!(case.matches(&of).count(), 1, "{of}");
            case = case.replace(&of, &number.to_string());
        }
        case
    };
    let wider = |case: &str| case.replace("width = \"20 mm\"", "width = \"40 mm\"");
    let expected = [
        base.clone(),
        softer(&base),
        wider(&base),
        wider(&softer(&base)),
    ];
    let found = of_study(&study, folder);
    for ((values, row), text) in found.iter().zip(&expected) {
        assert_eq!(*values, alone(folder, text), "run {}", row.run);
        let shown = case_of_run(&study, row.run).unwrap();
        assert_eq!(*values, alone(folder, &shown), "run {}", row.run);
    }
    let layout = found.iter().map(|(values, _)| &values[1]);
    assert!(layout.clone().all(|forces| forces.len() == 24));
    // All differ, and all touch.
    assert!(layout.clone().all(|f| f.iter().any(|force| *force > 0.0)));
    assert_ne!(found[0].0, found[2].0);
    assert_ne!(found[0].0, found[1].0);
    // The identity is that of the content.
    let same = row_of_five(
        folder,
        "[[variable]]\nname = \"gap\"\npath = [\"gap.0.width\", \"gap.R2-R3.width\", \"gap.2.width\", \"gap[3].width\"]\nvalues = [\"20 mm\", \"4 cm\"]\n",
    );
    let again = of_study(&same, folder);
    assert_eq!(again[0].1.id, found[0].1.id);
    assert_eq!(again[1].1.id, found[2].1.id);
    assert_eq!(again[1].0, found[2].0);
}

/// Models with all their options, and texts, take the place of those of all gaps.
#[test]
fn models_of_all_gaps_vary_together() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let study = row_of_five(
        folder,
        "[[variable]]\nname = \"model\"\npath = \"gap.*.model\"\nvalues = [{ model = \"jankowski_2005\", stiffness = \"2.75e9 N/m^1.5\", restitution = 0.6 }, { model = \"hertz_1882\", stiffness = 2.75e9 }]\n[[variable]]\nname = \"p_delta\"\npath = \"building.*.p_delta\"\nvalues = [false, true]\n",
    );
    for (values, row) in of_study(&study, folder) {
        let shown = case_of_run(&study, row.run).unwrap();
        assert_eq!(shown.matches("anagnostopoulos_2004").count(), 0);
        assert_eq!(shown.matches("stiffness = ").count(), 5 + 4);
        let name = ["jankowski_2005", "hertz_1882"][row.run / 2];
        assert_eq!(shown.matches(name).count(), 4, "{shown}");
        let p_delta = format!("p_delta = {}", row.run % 2 == 1);
        assert_eq!(shown.matches(&p_delta).count(), 5, "{shown}");
        assert_eq!(values, alone(folder, &shown), "run {}", row.run);
    }
}

/// Samples of a multiple are these times the number of the case, in every entry to the last bit.
#[test]
fn samples_are_multiples() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let study = study(
        folder,
        "[[variable]]\nname = \"factor\"\npath = \"building.*.mass\"\nrelative = true\nfrom = 0.9\nto = 1.1\n[design]\nkind = \"latin_hypercube\"\nruns = 5\n",
    )
    .unwrap();
    let case = |text: &str| Case::parse(text, &folder.join("case.toml")).unwrap();
    let base = case(&std::fs::read_to_string(folder.join("case.toml")).unwrap());
    for run in 0..5 {
        let shown = case(&case_of_run(&study, run).unwrap());
        let [Value::Number(factor)] = study.point(run)[..] else {
            panic!("one number");
        };
        assert!((0.9..1.1).contains(&factor));
        for (changed, before) in shown.buildings.iter().zip(&base.buildings) {
            let expected: Vec<f64> = before.mass.iter().map(|m| factor * m).collect();
            assert_eq!(changed.mass, expected);
        }
    }
}

/// What is wrong with such variables is said where the study names the entry, and once.
#[test]
fn wrong_paths_to_several_entries() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    for (text, place, said) in [
        (
            "path = [\"gap.0.width\", \"building.light.height\"]\nvalues = [3]",
            "study.toml:3:8",
            "a variable of several paths has no name by itself",
        ),
        (
            "name = \"x\"\npath = [\"gap.0.width\", \"gap.*.width\"]\nvalues = [0.01]",
            "study.toml:4:24",
            "`path` leads to `gap[0].width` more than once",
        ),
        (
            "path = \"building.*.heigth\"\nvalues = [3]",
            "study.toml:3:8",
            "unknown key `heigth`",
        ),
        (
            "path = \"gap.0.width.*\"\nvalues = [3]",
            "study.toml:3:8",
            "`gap.0.width` is no list in the case",
        ),
        (
            "path = \"gap.*.width\"\nvalues = [0.01, \"-3 mm\"]",
            "study.toml:4:17",
            "the case refuses this for `gap.*.width`: `width`",
        ),
        (
            "path = \"gap.*.width\"\nrelative = true\nvalues = [\"20 mm\"]",
            "study.toml:5:11",
            "`values` must be a pure number, but \"20 mm\" is a length",
        ),
        (
            "path = \"gap.*.width\"\nrelative = true\nvalues = [true]",
            "study.toml:5:11",
            "`values` must be numbers",
        ),
        (
            "path = \"gap.*.width\"\nrelative = true\nvalues = [-1]",
            "study.toml:5:11",
            "must be zero or more",
        ),
        (
            "path = \"gap.0.model\"\nrelative = true\nvalues = [{ model = \"hertz_1882\", stiffness = 1e9 }]",
            "study.toml:3:8",
            "`gap.0.model` is no number in the case",
        ),
        (
            "path = \"building.light.mass\"\nvalues = [{ model = \"hertz_1882\", stiffness = 1e9 }]",
            "study.toml:4:10",
            "tables are values of the models of gaps only",
        ),
        (
            "path = \"analysis.step\"\nrelative = true\nvalues = [0.5]",
            "study.toml:3:8",
            "the case leaves `analysis.step` out",
        ),
        (
            "records = [\"MOTIONS/el_centro_1940_ns.csv\"]\nrelative = true",
            "study.toml:4:12",
            "`relative` has no meaning for a variable of records",
        ),
        (
            "intensity = \"peak_ground_acceleration\"\nrelative = true\nvalues = [1]",
            "study.toml:4:12",
            "`relative` has no meaning for a variable of intensity",
        ),
        ("path = []\nvalues = [1]", "study.toml:3:8", "empty list"),
        (
            "path = \"gap.0.width\"\nrelative = \"yes\"\nvalues = [1]",
            "study.toml:4:12",
            "relative",
        ),
    ] {
        let wrong = study(folder, &format!("[[variable]]\n{text}\n")).unwrap_err();
        let told = wrong.to_string();
        assert!(
            told.contains(said) && told.contains(place),
            "{text}: {told}"
        );
        assert!(!told.contains("\n\n"), "{told}");
    }
    let both = "[[variable]]\nname = \"all\"\npath = \"gap.*.width\"\nvalues = [0.01]\n[[variable]]\nname = \"one\"\npath = \"gap.light-heavy.width\"\nvalues = [0.02]\n";
    let told = study(folder, both).unwrap_err().to_string();
    assert!(
        told.contains("\"all\" and \"one\" vary the same entry"),
        "{told}"
    );
}

/// What is probably mistyped is said of the values that bring it about, and of the case where a run has it.
#[test]
fn unusual_structures_are_said_of_their_values() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let told = |text: &str| {
        let study = study(folder, text).unwrap();
        rows(&study, folder);
        let reader = ResultReader::open(&folder.join("out.h5"), WithoutChecksum::Refuse).unwrap();
        reader.description.warnings.clone()
    };
    let of = |warnings: &[String], begins: &str| {
        let mut found = warnings.iter().filter(|w| w.starts_with(begins));
        found.next().is_some() && found.next().is_none()
    };
    let gap = "[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\n";
    assert_eq!(
        told(&format!("{gap}values = [0.01, 0.06]\n")),
        Vec::<String>::new()
    );
    let wide = told(&format!("{gap}values = [0.01, 20, 60]\n"));
    assert!(
        of(&wide, "with gap = 60 m: gap light-heavy: a width of 60 m"),
        "{wide:?}"
    );
    // Values between the ends too.
    let between = "with gap = 20 m: gap light-heavy: a width of 20 m";
    assert!(of(&wide, between) && wide.len() == 2, "{wide:?}");
    let many: Vec<String> = (10..22).map(|i| i.to_string()).collect();
    let many = told(&format!("{gap}values = [0.01, {}]\n", many.join(", ")));
    assert_eq!(many.len(), 4, "{many:?}");
    assert!(many[3].ends_with("; 8 more of other values"), "{many:?}");
    // Rows of a list are runs, other combinations none.
    let list = "[[variable]]\nname = \"m\"\npath = \"building.light.mass\"\nvalues = [2.5e3, 2.5e6]\n[[variable]]\nname = \"k\"\npath = \"building.light.stiffness\"\nvalues = [3.46e5, 3.46e8]\n[[variable]]\nname = \"contact\"\npath = \"gap.0.stiffness\"\nvalues = [2.75e9, 2.75e11]\n[design]\nkind = \"list\"\n";
    assert_eq!(told(list), Vec::<String>::new());
    // Of many rows those of the ends.
    let row = |i: usize| {
        if i == 77 {
            30.0
        } else {
            0.02 + 1e-5 * i as f64
        }
    };
    let widths: Vec<String> = (0..100).map(|i| row(i).to_string()).collect();
    let scales: Vec<String> = (0..100)
        .map(|i| (1.0 - 0.001 * f64::from(i)).to_string())
        .collect();
    let many = told(&format!(
        "{gap}values = [{}]\n[[variable]]\nname = \"scale\"\npath = \"ground_motion.scale\"\nvalues = [{}]\n[design]\nkind = \"list\"\n",
        widths.join(", "),
        scales.join(", ")
    ));
    assert!(
        of(
            &many,
            "with gap = 30 m, scale = 0.923: gap light-heavy: a width of 30 m"
        ),
        "{many:?}"
    );
    let model = "[[variable]]\nname = \"model\"\npath = \"gap.0.model\"\nvalues = [{ label = \"soft\", model = \"linear_elastic\", stiffness = 2e3 }, { model = \"linear_elastic\", stiffness = 1e8 }]\n";
    let soft = told(model);
    assert!(
        of(
            &soft,
            "with model = soft: gap light-heavy: the contact is softer"
        ),
        "{soft:?}"
    );
    // Of the case, as long as a run has it.
    study(folder, "").unwrap_err();
    let light = std::fs::read_to_string(folder.join("case.toml")).unwrap();
    let light = light.replace("mass = \"25 t\"", "mass = 25");
    std::fs::write(folder.join("light.toml"), light).unwrap();
    let told = |text: &str| {
        let text = format!("case = \"light.toml\"\n{text}");
        let study = Study::parse(&text, &folder.join("study.toml")).unwrap();
        rows(&study, folder);
        let reader = ResultReader::open(&folder.join("out.h5"), WithoutChecksum::Refuse).unwrap();
        reader.description.warnings.clone()
    };
    let both = told(&format!("{gap}values = [0.01, 0.02]\n"));
    assert!(
        of(&both, "light: no storey has a mass of more than 25 kg"),
        "{both:?}"
    );
    let mass = "[[variable]]\nname = \"mass\"\npath = \"building.light.mass\"\n";
    let none = told(&format!("{mass}values = [25e3, 30e3]\n"));
    assert_eq!(none, Vec::<String>::new());
    let one = told(&format!("{mass}values = [25e3, 25]\n"));
    assert!(
        of(&one, "light: no storey has a mass of more than 25 kg"),
        "{one:?}"
    );
}

/// A model with all its options takes the place of a model alone: what else belongs to the gap stays, whatever
/// key it is.
#[test]
fn models_leave_the_rest_of_their_gap() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let model = "anagnostopoulos_2004\"\nstiffness = \"93.5 MN/m\"\nrestitution = 0.65\nseparation = \"no_tension";
    let with_seat = |case: String| {
        case.replace("31 s", "4 s")
            .replace("jankowski_2005\"", &format!("{model}\"\nseat = \"20 mm\""))
            .replace("stiffness = \"2.75e9 N/m^1.5\"\n", "")
            .replace("damping_ratio = 0.35", "")
    };
    let tables = "[[variable]]\nname = \"model\"\npath = \"gap.*.model\"\nvalues = [{ model = \"anagnostopoulos_2004\", stiffness = \"93.5 MN/m\", restitution = 0.65, separation = \"no_tension\" }]\n";
    let neutral = "[[variable]]\nname = \"x\"\npath = \"ground_motion.scale\"\nvalues = [1]\n";
    // A wall that stands still in space, points of contact of floors that turn, a seat.
    let examples: [(&str, &dyn Fn(String) -> String); 3] = [
        ("rigid_wall", &|case| {
            case.replace("[[gap]]", "[[gap]]\nwall = \"fixed\"")
                .replace("30 s", "4 s")
        }),
        ("pair_that_turns", &|case| {
            case.replace("[[gap]]", "[[gap]]\npoints = [\"1 m\", \"0 m\"]")
        }),
        ("three_storey_pair", &with_seat),
    ];
    for (example, change) in examples {
        let base = std::cell::RefCell::new(String::new());
        let kept = |case: String| {
            *base.borrow_mut() = change(case);
            base.borrow().clone()
        };
        let plain = rows(&study_of_example(folder, example, kept, neutral), folder);
        let source = base.borrow().clone();
        let gap = Case::parse(&source, &folder.join("case.toml"))
            .unwrap()
            .gaps
            .remove(0);
        let parameters = gap
            .parameters
            .iter()
            .map(|p| format!(", {} = {:e}", p.key.value, p.values[0].value.value));
        let rule = gap
            .separation
            .iter()
            .map(|rule| format!(", separation = \"{}\"", rule.value));
        let own: String = parameters.chain(rule).collect();
        let own = format!(
            "[[variable]]\nname = \"model\"\npath = \"gap.*.model\"\nvalues = [{{ model = \"{}\"{own} }}]\n",
            gap.model.value
        );
        let same = rows(&study_of_example(folder, example, change, &own), folder);
        assert_eq!(plain[0].0.values.len(), same[0].0.values.len());
        let bits = |row: &Row| -> Vec<u64> { row.values.iter().map(|x| x.to_bits()).collect() };
        assert_eq!(bits(&plain[0].0), bits(&same[0].0), "{example}");
        assert!(plain[0].0.values.iter().any(|x| *x > 0.0));
    }
    let seat = rows(
        &study_of_example(folder, "three_storey_pair", with_seat, tables),
        folder,
    );
    let reader = ResultReader::open(&folder.join("out.h5"), WithoutChecksum::Refuse).unwrap();
    let opening = &seat[0].0.values[reader.description.layout.range("peak_opening")];
    assert!(opening.iter().all(|x| *x > 0.0), "{opening:?}");
}

/// Ranges over whole numbers are tried within, and refused where the study gives them.
#[test]
fn ranges_over_whole_numbers_are_refused() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    study(folder, "").unwrap_err();
    let case = std::fs::read_to_string(folder.join("case.toml")).unwrap();
    let process = "process = [{ filter = { high_pass = \"0.1 Hz\", order = 4 } }]\n\n[analysis]";
    std::fs::write(
        folder.join("case.toml"),
        case.replace("[analysis]", process),
    )
    .unwrap();
    let of = |variable: &str| {
        let text = format!(
            "case = \"case.toml\"\n[[variable]]\npath = \"ground_motion.process.0.filter.order\"\n{variable}\n"
        );
        Study::parse(&text, &folder.join("study.toml"))
    };
    for variable in [
        "relative = true\nfrom = 0.5\nto = 1\ncount = 4",
        "from = 2\nto = 4\ncount = 4",
        "from = 2\nto = 4\n[design]\nkind = \"latin_hypercube\"\nruns = 5",
    ] {
        let told = of(variable).unwrap_err().to_string();
        assert!(
            told.contains("of this range for `ground_motion.process.0"),
            "{told}"
        );
        assert!(
            told.contains("whole number") && told.contains("study.toml:"),
            "{told}"
        );
    }
    assert!(of("from = 2\nto = 4\ncount = 3").is_ok());
    assert!(of("relative = true\nfrom = 0.5\nto = 1\ncount = 2").is_ok());
    // Of many values the first after the end may be near enough to it where floors are to be level.
    let case = case.replace("[[gap]]", "[[gap]]\nlevels = \"matching\"");
    std::fs::write(folder.join("case.toml"), case).unwrap();
    for count in [301, 1001] {
        let text = format!(
            "case = \"case.toml\"\n[[variable]]\npath = \"building.0.height\"\nfrom = \"3 m\"\nto = \"9 m\"\ncount = {count}\n"
        );
        let told = Study::parse(&text, &folder.join("study.toml"));
        let told = told.unwrap_err().to_string();
        assert!(
            told.contains("of this range for `building.0.height`"),
            "{told}"
        );
    }
}
