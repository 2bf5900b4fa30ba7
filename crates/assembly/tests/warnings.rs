//! What a case gives and nothing feels is told before a run.
use std::path::Path;

use pounding_assembly::assemble;
use pounding_case::Case;

fn warnings(building: &str, gap: &str) -> Vec<String> {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let common = "mass = [1e5, 1e5]\nheight = 3\nstiffness = 1e8\ndamping = { modal = 0.05 }";
    let text = format!(
        "[[building]]\nname = \"a\"\n{common}\n{building}\n[[building]]\nname = \"b\"\n{common}\n[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = 0.02\nmodel = \"linear_elastic\"\nstiffness = 1e8\n{gap}\n[ground_motion]\nfile = \"{record}\"\nscale = 2\n"
    );
    let case = Case::parse(&text, Path::new("case.toml")).unwrap();
    assemble(&case).unwrap().warnings()
}

#[test]
fn soil_as_stiff_as_a_fixed_base_is_told() {
    let soil = |speed: &str| {
        format!(
            "foundation = {{ mass = 5e4, rotational_inertia = 3e6, soil = {{ shear_wave_speed = {speed}, density = 1800, poisson = 0.33, length = 12, width = 12 }} }}"
        )
    };
    let told = warnings(&soil("1e5"), "");
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("a: the soil makes the fundamental period longer by"),
        "{told:?}"
    );
    assert!(told[0].contains("leave the foundation out"), "{told:?}");
    assert_eq!(warnings(&soil("180"), ""), [""; 0]);
    assert_eq!(warnings(&soil("1500"), ""), [""; 0]);
}

#[test]
fn columns_that_no_floor_hits_are_told() {
    let column = "column = { of = \"b\", flexural_rigidity = 1e6 }";
    let told = warnings("", column);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("gap a-b: no floor hits columns of b"),
        "{told:?}"
    );
    assert!(told[0].contains("`levels = \"all_floors\"`"), "{told:?}");
    assert_eq!(warnings("", ""), [""; 0]);
}

/// Zeros that filters put before records: 0.75 times 4 over the corner, 30 s at 0.1 Hz and 15 s at 0.2 Hz.
#[test]
fn motions_that_filters_put_out_of_step_are_told() {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let filter = |corner: &str, more: &str| {
        format!("process = [{{ filter = {{ high_pass = \"{corner}\", order = 4{more} }} }}]")
    };
    let case = |of_case: &str, building: &str| {
        let text = format!(
            "[[building]]\nname = \"a\"\nmass = [1e5, 1e5]\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\n{building}\n[ground_motion]\nfile = \"{record}\"\n{of_case}\n"
        );
        let case = Case::parse(&text, Path::new("case.toml")).unwrap();
        let told = assemble(&case).unwrap().warnings();
        told.into_iter()
            .filter(|w| w.contains("zeros"))
            .collect::<Vec<_>>()
    };
    let own = |steps: &str| format!("ground = {{ file = \"{record}\", {steps} }}");
    let (low, high) = (filter("0.1 Hz", ""), filter("0.2 Hz", ""));
    let told = case(&low, &own(&high));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains(
            "30.00 s of zeros before the record of the case, and 15.00 s before that of a"
        ),
        "{told:?}"
    );
    assert_eq!(case(&low, &own(&low)), [""; 0]);
    let without = filter("0.1 Hz", ", keep_pads = false");
    assert_eq!(case(&without, &own("process = []")), [""; 0]);
    assert_eq!(case(&low, &own("process = []")).len(), 1);
    let force = "[[building.force]]\nstorey = 1\npoints = [[0, 0], [1, 1e3], [2, 0]]";
    let told = case(&low, force);
    assert!(
        told.len() == 1 && told[0].contains("forces on floors begin with them"),
        "{told:?}"
    );
    assert_eq!(case(&without, force), [""; 0]);
}

/// A sine whose velocity at the first sample is stated moves nowhere; displacements of the ground from rest have it drift by
/// that velocity.
#[test]
fn initial_motions_that_displacements_of_the_ground_leave_out_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let rate = 2.0 * std::f64::consts::PI;
    let write = |name: &str, head: &str, amplitude: f64| {
        let mut text = format!("{head}time_s,acceleration_m_s2\n");
        for i in 0..=1000 {
            let t = 0.01 * f64::from(i);
            text.push_str(&format!("{t:.2},{:.9}\n", -amplitude * (rate * t).sin()));
        }
        std::fs::write(folder.path().join(name), text).unwrap();
    };
    let stated = format!("# Initial velocity: {:.9} m/s\n", 1.0 / rate);
    write("moving.csv", &stated, 1.0);
    write("still.csv", "", 1.0);
    write("again.csv", &stated, 0.5);
    let told = |of_case: &str, of_building: &str| {
        let text = format!(
            "[[building]]\nname = \"a\"\nmass = 1e5\nstoreys = 1\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\nground = {{ file = \"{of_building}\" }}\n[ground_motion]\nfile = \"{of_case}\"\n"
        );
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let told = assemble(&case).unwrap().warnings();
        let of_them = told.into_iter().filter(|w| w.contains("states an initial"));
        of_them.collect::<Vec<_>>()
    };
    let said = told("moving.csv", "still.csv");
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].contains("the record of the case states"),
        "{said:?}"
    );
    assert!(
        said[0].contains("leave them out, 1.592 m at the end"),
        "{said:?}"
    );
    let said = told("still.csv", "moving.csv");
    assert!(
        said.len() == 1 && said[0].contains("the record of a states"),
        "{said:?}"
    );
    assert_eq!(told("moving.csv", "again.csv"), [""; 0]);
    assert_eq!(told("still.csv", "still.csv"), [""; 0]);
}

/// Records of two stations, the second of which begins 1.5 s later, over midnight, and of columns of times that begin 1.5 s
/// apart.
#[test]
fn delays_are_held_against_the_times_of_first_samples() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, head: &str, from: f64, rate: f64| {
        let rows: String = (0..300)
            .map(|i| {
                let t = 0.02 * f64::from(i);
                format!("{:.2},{:.6}\n", from + t, (rate * t).sin())
            })
            .collect();
        let text = format!("{head}time_s,acceleration_m_s2\n{rows}");
        std::fs::write(folder.path().join(name), text).unwrap();
    };
    write(
        "first.csv",
        "# Start: 2012/02/28 23:59:59.5 UTC\n",
        0.0,
        3.0,
    );
    write("second.csv", "# Start: 2012/02/29 00:00:01 UTC\n", 0.0, 5.0);
    write("third.csv", "", 5.0, 3.0);
    write("fourth.csv", "", 6.5, 5.0);
    let told = |of_case: &str, first: &str, second: &str| {
        let building = |name: &str, ground: &str| {
            format!(
                "[[building]]\nname = \"{name}\"\nmass = 1e5\nstoreys = 1\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\n{ground}\n"
            )
        };
        let (a, b) = (building("a", first), building("b", second));
        let text = format!("{a}{b}[ground_motion]\n{of_case}\n");
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let told = assemble(&case).unwrap().warnings();
        let of_them = told.into_iter().filter(|w| w.contains("begin together"));
        of_them.collect::<Vec<_>>()
    };
    let first = "file = \"first.csv\"";
    let own = |file: &str, more: &str| format!("ground = {{ file = \"{file}\"{more} }}");
    let padded = format!("{first}\nprocess = [{{ pad = {{ before = \"1 s\" }} }}]");
    let filtered = "file = \"third.csv\"\nprocess = [{ filter = { high_pass = \"1 Hz\" } }]";
    let after = |seconds: &str| format!(", delay = \"{seconds}\"");
    let wave = ", distance = 60, wave_speed = 460";
    let cut = ", process = [{ trim = { start = 0, end = 4 } }]";
    let cut_to_second = format!("{first}\nprocess = [{{ trim = {{ start = 1.5, end = 5 }} }}]");
    let with = |file: &str, seconds: &str| own(file, &after(seconds));

    for (of_case, under_a, under_b, wanted) in [
        (
            first,
            "",
            own("second.csv", ""),
            &[
                "1.500 s apart; cut",
                "give `delay = \"1.5 s\"` in `ground` of b",
            ][..],
        ),
        (
            first,
            "",
            with("second.csv", "1 ms"),
            &[
                "1.500 s apart",
                "comes 1.499 s too early",
                "`delay = \"1.5 s\"`",
            ],
        ),
        (
            first,
            "",
            with("second.csv", "1 s"),
            &["0.5 s too early", "`delay = \"1.5 s\"`"],
        ),
        (
            first,
            "",
            with("second.csv", "100 s"),
            &["98.5 s too late", "`delay = \"1.5 s\"`"],
        ),
        (first, "", with("second.csv", "1.5 s"), &[]),
        (first, "", with("second.csv", "1.46 s"), &[]),
        // Zeros before the record of the case.
        (
            &padded,
            "",
            with("second.csv", "1 s"),
            &[
                "with what `process` moved, are 2.500 s apart",
                "1.5 s too early",
                "`delay = \"2.5 s\"`",
            ],
        ),
        (&padded, "", with("second.csv", "2.5 s"), &[]),
        // 3 s of zeros.
        (filtered, "", with("fourth.csv", "4.5 s"), &[]),
        (
            filtered,
            "",
            with("fourth.csv", "3 s"),
            &["4.500 s apart", "1.5 s too early", "`delay = \"4.5 s\"`"],
        ),
        (
            "file = \"third.csv\"",
            "",
            with("fourth.csv", "0.2 s"),
            &["1.3 s too early"],
        ),
        ("file = \"third.csv\"", "", with("fourth.csv", "1.5 s"), &[]),
        // The record of a building begins first: the other buildings move later.
        (
            "file = \"second.csv\"",
            "",
            own("first.csv", ""),
            &[
                "1.500 s apart",
                "give `ground = { delay = \"1.5 s\" }` to the buildings",
            ],
        ),
        (
            "file = \"second.csv\"",
            "ground = { delay = 1.5 }",
            own("first.csv", ""),
            &[],
        ),
        (
            "file = \"second.csv\"",
            "",
            with("first.csv", "0.5 s"),
            &["2 s too late", "{ delay = \"2 s\" }"],
        ),
        (
            "file = \"second.csv\"",
            "ground = { delay = 1.5 }",
            with("first.csv", "0.5 s"),
            &["0.5 s too late", "leave `delay` of b out"],
        ),
        // Waves: one record under both, records that begin together, and such as are cut to do so.
        (first, "", with("first.csv", "0.13 s"), &[]),
        (first, "", "ground = { delay = 0.13 }".to_owned(), &[]),
        (first, "", own("first.csv", wave), &[]),
        (first, "", own("second.csv", wave), &[]),
        ("file = \"third.csv\"", "", with("third.csv", "7 s"), &[]),
        (
            &cut_to_second,
            "",
            own("second.csv", &format!("{cut}{}", after("0.13 s"))),
            &[],
        ),
        // Steps of the case alone put copies out of step.
        (
            &padded,
            "",
            with("first.csv", "0.13 s"),
            &[
                "`process` moves the start",
                "0.87 s too early; give both the same",
                "`delay = \"1 s\"`",
            ],
        ),
        (&padded, "", with("first.csv", "1 s"), &[]),
    ] {
        let told = told(of_case, under_a, &under_b);
        let about = format!("{of_case} {under_a} {under_b}: {told:?}");
        assert_eq!(told.len(), usize::from(!wanted.is_empty()), "{about}");
        for words in wanted {
            assert!(told[0].contains(words), "{words}: {about}");
        }
    }
}

/// Two buildings on the record of the case, of which one has a delay that fits: the one beside the building on a record of
/// its own has not.
#[test]
fn a_delay_of_a_building_far_away_makes_up_for_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for (name, start) in [("late.csv", "12:00:03"), ("early.csv", "12:00:00")] {
        let rows: String = (0..300)
            .map(|i| {
                format!(
                    "{:.2},{:.6}\n",
                    0.02 * f64::from(i),
                    (0.1 * f64::from(i)).sin()
                )
            })
            .collect();
        let text = format!("# Start: 2012/02/28 {start} UTC\ntime_s,acceleration_m_s2\n{rows}");
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let building = |name: &str, ground: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = 1e5\nstoreys = 1\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\n{ground}\n"
        )
    };
    let gap = |left: &str, right: &str| {
        format!(
            "[[gap]]\nbetween = [\"{left}\", \"{right}\"]\nwidth = 1\nmodel = \"linear_elastic\"\nstiffness = 1e9\n"
        )
    };
    let told = |of_a: &str, of_b: &str| {
        let own = building("c", "ground = { file = \"early.csv\" }");
        let text = format!(
            "{}{}{own}{}{}[ground_motion]\nfile = \"late.csv\"\n",
            building("a", of_a),
            building("b", of_b),
            gap("a", "b"),
            gap("b", "c")
        );
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let told = assemble(&case).unwrap().warnings();
        told.into_iter()
            .filter(|w| w.contains("begin together"))
            .count()
    };
    let delayed = "ground = { delay = 3 }";
    assert_eq!(told(delayed, ""), 1);
    assert_eq!(told("", delayed), 0);
    assert_eq!(told(delayed, delayed), 0);
}
