//! The gap check on the three-storey pair of the examples.
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use pounding_assembly::assemble;
use pounding_case::{Case, Separation};
use pounding_separation::{Oscillator, correlation_coefficient};
use pounding_study::gap_check::{
    CheckError, GapCheck, GapCheckOptions, SweepOptions, UNWATCHED, gap_check, under_records,
};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn pair(width: &str) -> Case {
    let file = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    Case::parse(&text.replace("\"20 mm\"", width), &file).unwrap()
}

fn options() -> GapCheckOptions {
    GapCheckOptions {
        target_probability: 0.0,
        confidence: 0.9,
        sweep: None,
        threads: 2,
    }
}

fn check(case: &Case, records: &[PathBuf], options: &GapCheckOptions) -> GapCheck {
    let records = under_records(case, records).unwrap();
    gap_check(case, &case.separation, &records, options, UNWATCHED).unwrap()
}

fn both() -> [PathBuf; 2] {
    ["el_centro_1940_ns.csv", "kobe_1995_jma_ns.csv"].map(|n| root().join("ground_motions").join(n))
}

/// Demand and square root of an independent solution (0.117207 m and 0.116112 m with g =
/// 9.81 m/s2), times 9.80665 / 9.81; the first value of the record at time zero changes
/// the fifth digit.
#[test]
fn the_square_root_is_unsafe_under_el_centro() {
    let check = check(&pair("\"20 mm\""), &[], &options());
    let gap = &check.gaps[0];
    let scale = 9.80665 / 9.81;
    assert!((gap.demand[0] / (0.117_207 * scale) - 1.0).abs() < 2.0e-4);
    assert_eq!(gap.governing.level, 2);
    let nbcc = gap
        .codes
        .iter()
        .find(|c| c.provision.name() == "nbcc_2015_between");
    let root = nbcc.unwrap().width(0).unwrap();
    assert!((root / (0.116_112 * scale) - 1.0).abs() < 2.0e-4);
    assert!(root < gap.demand[0], "the square root is on the safe side");
    let difference = gap.combinations.last().unwrap();
    assert!((difference.correlation.unwrap() - 0.003_540).abs() < 5.0e-6);
    assert!((difference.records[0][2].width / (0.116_040 * scale) - 1.0).abs() < 2.0e-4);
    assert!(!check.adequate());
    assert_eq!(gap.records_in_contact, 1);
}

/// The verdict turns where contact begins, and so do the impacts of the run.
#[test]
fn the_verdict_turns_at_the_demand() {
    let demand = check(&pair("\"20 mm\""), &[], &options()).gaps[0].demand[0];
    for (factor, adequate) in [(1.0 + 1.0e-7, true), (1.0 - 1.0e-7, false)] {
        let check = check(&pair(&format!("{}", demand * factor)), &[], &options());
        assert_eq!(check.adequate(), adequate);
        let (_, gaps) = check.records[0].pounding.as_ref().unwrap();
        let touched = gaps[0].levels.iter().any(|l| l.impacts > 0);
        assert_eq!(touched, !adequate);
    }
}

/// Half of the records may touch: the gap of the lesser demand is then enough.
#[test]
fn target_probability() {
    let asked = GapCheckOptions {
        target_probability: 0.5,
        ..options()
    };
    let first = check(&pair("\"20 mm\""), &both(), &asked);
    let gap = &first.gaps[0];
    assert_eq!(gap.demand.len(), 2);
    let lesser = gap.demand[0].min(gap.demand[1]);
    assert_eq!(gap.required.by_count, Some(lesser));
    let fit = gap.required.lognormal.as_ref().unwrap();
    let mean = (gap.demand[0] * gap.demand[1]).sqrt();
    assert!((fit.width / mean - 1.0).abs() < 1.0e-9, "median of two");
    let wide = check(&pair(&format!("{}", lesser * 1.001)), &both(), &asked);
    assert!(wide.adequate() && wide.gaps[0].records_in_contact == 1);
}

/// Values of a fixed-step solution at 20 and 60 mm: the wider gap is the worse one.
/// Results are the same on one thread and on three.
#[test]
fn a_wider_gap_can_be_worse() {
    let mut asked = GapCheckOptions {
        sweep: Some(SweepOptions {
            gap: None,
            from: Some(0.02),
            to: Some(0.12),
            points: 6,
        }),
        ..options()
    };
    let told = Mutex::new(vec![0]);
    let case = pair("\"20 mm\"");
    let records = under_records(&case, &[]).unwrap();
    let tell = |done: usize, total: usize| {
        assert!(done <= total && total == 7);
        told.lock().unwrap().push(done);
        ControlFlow::Continue(())
    };
    let three = gap_check(&case, &case.separation, &records, &asked, &tell).unwrap();
    // Each once when it is done, and as often as one likes while the next ones last.
    let mut told = told.into_inner().unwrap();
    assert!(told.is_sorted());
    told.dedup();
    assert_eq!(told, (0..=7).collect::<Vec<_>>());
    asked.threads = 1;
    let one = check(&case, &[], &asked).sweep.unwrap();
    let sweep = three.sweep.unwrap();
    assert_eq!(sweep, one);
    let alone = three.records[0].isolated[0].storeys[2].displacement.value;
    let roof = |i: usize| sweep.runs[i][0].as_ref().unwrap().amplification[0][2].displacement;
    assert!((roof(0) * alone / 0.105_3 - 1.0).abs() < 3.0e-3);
    assert!((roof(2) * alone / 0.132_3 - 1.0).abs() < 3.0e-3);
    let last = sweep.runs[5][0].as_ref().unwrap();
    assert!(last.contact(None).impacts == 0 && last.amplification[0][2].displacement == 1.0);
    let worst = sweep.worst(0, |a| a.displacement).unwrap();
    assert!(worst.width > 0.02, "the narrowest gap is not the worst");
}

/// A light building that a heavy one drives through a gap of 60 mm, of which it demands 13 mm by
/// itself: the sweep of that gap covers what is provided, and what closes it.
#[test]
fn the_sweep_of_one_gap_in_a_row_covers_its_width() {
    let building = |name: &str, mass: f64, stiffness: f64| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 1\nmass = \"{mass} t\"\nstiffness = \"{stiffness} MN/m\"\n\
             height = \"3 m\"\ndamping = {{ stiffness_proportional = 0.03 }}\n"
        )
    };
    let gap = |between: &str, width: &str| {
        format!(
            "[[gap]]\nbetween = {between}\nwidth = \"{width}\"\nmodel = \"anagnostopoulos_2004\"\n\
             stiffness = \"500 MN/m\"\nrestitution = 0.65\n"
        )
    };
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    let text = building("A", 500.0, 20.0)
        + &building("B", 50.0, 30.0)
        + &building("C", 5000.0, 20_000.0)
        + &gap("[\"A\", \"B\"]", "10 mm")
        + &gap("[\"B\", \"C\"]", "60 mm")
        + &format!("[ground_motion]\nfile = '{}'\n", record.display());
    let case = Case::parse(&text, &root().join("case.toml")).unwrap();
    let swept = |gap: Option<&str>| {
        let sweep = SweepOptions {
            gap: gap.map(str::to_owned),
            from: None,
            to: None,
            points: 21,
        };
        let asked = GapCheckOptions {
            sweep: Some(sweep),
            ..options()
        };
        check(&case, &[], &asked)
    };
    let one = swept(Some("B-C"));
    let gap = &one.gaps[1];
    assert!(gap.demand[0] < 0.02 && gap.records_driven == 1 && !gap.adequate);
    let sweep = one.sweep.unwrap();
    let last = sweep.widths[20];
    assert!(last > 1.05 * 0.06, "{last}");
    // There the gap stays open, and the building moves as far as its neighbour drives it; a tenth
    // less stops it.
    let moved = |i: usize| sweep.runs[i][0].as_ref().unwrap().amplification[1][0].displacement;
    assert!((moved(20) / moved(19) - 1.0).abs() < 1e-6);
    assert!(moved(18) < 0.99 * moved(20), "{} {}", moved(18), moved(20));
    let worst = sweep.worst(1, |a| a.displacement).unwrap();
    assert!(worst.width > 0.03, "{worst:?}");
    // All alike: beyond the maximum demand nothing is touched.
    let all = swept(None);
    let maximum = all.gaps.iter().map(|g| g.demand[0]).fold(0.0, f64::max);
    assert_eq!(all.sweep.unwrap().widths[20], 1.05 * maximum);
}

/// Levels where floors lie level with floors.
const MATCHING: &str = "levels = \"matching\"";

/// Two buildings of so many storeys of these heights (m), in this order, with what the gap says of its
/// levels.
fn of_storeys(left: (usize, &str), right: (usize, &str), levels: &str, more: &str) -> Case {
    let building = |name: &str, (storeys, height): (usize, &str)| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = {storeys}\nmass = \"100 t\"\nstiffness = \"300 MN/m\"\nheight = {height}\ndamping = {{ ratio = 0.05, modes = [1, 2] }}\n"
        )
    };
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    let text = building("A", left)
        + &building("B", right)
        + "[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = \"200 mm\"\nmodel = \"anagnostopoulos_2004\"\nstiffness = \"93.5 MN/m\"\nrestitution = 0.65\n"
        + &format!(
            "{levels}\n[ground_motion]\nfile = '{}'\n[analysis]\nduration = \"2 s\"\n{more}",
            record.display()
        );
    Case::parse(&text, &root().join("case.toml")).unwrap()
}

/// EN 1998-1, 4.4.2.7(3): 0.7 where floors face floors, of both buildings up to the lower roof and
/// whichever stands on the left.
#[test]
fn floors_are_aligned_where_those_of_both_buildings_face_one_another() {
    for (one, other, reduction) in [
        ((3, "3.0"), (6, "1.5"), 1.0),
        ((3, "3.0"), (8, "1.5"), 1.0),
        ((3, "3.0"), (6, "3.0"), 0.7),
        ((3, "3.0"), (3, "3.0"), 0.7),
    ] {
        for (left, right) in [(one, other), (other, one)] {
            let case = of_storeys(left, right, MATCHING, "[separation]\nsame_owner = true\n");
            let check = check(&case, &[], &options());
            let mut codes = check.gaps[0].codes.iter();
            let rule = codes.find(|c| c.provision.name() == "en_1998_1_2004_between");
            let found = rule.unwrap().records[0][0].as_ref().unwrap();
            let factor = found.factors.iter().find(|f| f.name == "reduction");
            assert_eq!(factor.unwrap().value, reduction, "{left:?} {right:?}");
        }
    }
}

/// Roofs at 6 and 10 m that act on each other, whichever stands on the left: 5 mm a metre on either
/// side is 80 mm, and 1/100 of the higher one 100 mm.
#[test]
fn floors_at_different_elevations_have_their_own_heights() {
    let (low, high) = ((2, "3.0"), (2, "5.0"));
    for (left, right) in [(low, high), (high, low)] {
        let case = of_storeys(left, right, "levels = [[2, 2]]\nfloor_to_floor = true", "");
        let check = check(&case, &[], &options());
        for (name, width) in [
            ("iran_2800_boundary_by_height", 0.08),
            ("japan_practice", 0.1),
        ] {
            let mut codes = check.gaps[0].codes.iter();
            let found = codes
                .find(|c| c.provision.name() == name)
                .unwrap()
                .width(0)
                .unwrap();
            assert!((found - width).abs() < 1.0e-12, "{name} {left:?}: {found}");
        }
    }
}

/// Storeys of 3 m beside two of 3 and 4 m: the roof at 7 m has no floor opposite, and the check says
/// so, from either side, unless it acts on one. So it does of levels that leave out roofs that face one
/// another.
#[test]
fn a_lower_roof_that_lies_at_no_level_is_said() {
    let (low, high) = ((2, "[3, 4]"), (3, "3"));
    let warned = |left, right, levels: &str| {
        let case = of_storeys(left, right, levels, "");
        let told = check(&case, &[], &options()).warnings;
        told.into_iter().find(|w| w.contains("lies at no level"))
    };
    for (left, right, own, other) in [(low, high, "A", "B"), (high, low, "B", "A")] {
        let said = warned(left, right, MATCHING).unwrap();
        for part in [
            &format!("the roof of \"{own}\" at 7 m, storey 2, lies"),
            "levels up to 3 m",
            &format!("columns of \"{other}\""),
        ] {
            assert!(said.contains(part), "{part}: {said}");
        }
        let acts = "levels = [[1, 1], [2, 2]]\nfloor_to_floor = true";
        assert_eq!(warned(left, right, acts), None);
    }
    assert_eq!(warned(high, (2, "3"), MATCHING), None);
    let said = warned(high, (3, "3"), "levels = [[1, 1], [2, 2]]").unwrap();
    assert!(
        said.contains("at 9 m, storey 3, lies") && said.contains("levels up to 6 m"),
        "{said}"
    );
    // The roof of one acts on a low floor of the other, whose own roof is left out.
    let acts = "levels = [[3, 1]]\nfloor_to_floor = true";
    let said = warned(high, (3, "3"), acts).unwrap();
    assert!(
        said.contains("the roof of \"B\" at 9 m, storey 3, lies")
            && said.contains("levels up to 3 m"),
        "{said}"
    );
}

/// A rule that asks for nothing at the lowest level, by rounding up or by a limit, and for 10 and 20 mm,
/// or 30 and 60 mm, above: the roof governs, also beside a lowest level without any width. Where
/// nothing is asked of any level, the highest is shown.
#[test]
fn a_level_that_needs_nothing_does_not_govern() {
    let steps = ", step = \"3 m\", w = \"10 mm\"";
    for (expression, more, width, required) in [
        ("ceil((height - base) / step) * w", steps, "\"30 mm\"", 0.02),
        ("max(0, (height - base) / 100)", "", "\"30 mm\"", 0.06),
        ("max(0, (height - base) / 100)", "", "[0, 0.05, 0.05]", 0.06),
        ("0 * (height - base)", "", "[0, 0.05, 0.05]", 0.0),
    ] {
        let more = format!(
            "[separation]\ncode = \"mine\"\n[[separation.rule]]\nname = \"mine\"\nkind = \"between\"\nexpression = \"{expression}\"\ninputs = {{ base = \"3 m\"{more} }}\n"
        );
        let case = of_storeys((3, "3.0"), (3, "3.0"), MATCHING, &more);
        let text = case.source.replace("\"200 mm\"", width);
        let case = Case::parse(&text, &root().join("case.toml")).unwrap();
        let check = check(&case, &[], &options());
        let answer = check.gaps[0].code.as_ref().unwrap();
        let (level, governing) = answer.cases[0].governing().unwrap();
        let found = governing.width.requirement.width;
        assert_eq!(level, 2, "{expression}");
        assert!((found - required).abs() < 1e-12, "{expression}: {found}");
    }
}

/// Every provision either computes or says what is missing; with all inputs only those
/// that do not apply are left.
#[test]
fn inputs_from_the_case() {
    let case = pair("\"20 mm\"");
    let records = under_records(&case, &[]).unwrap();
    let refused = |separation: &Separation| -> Vec<(String, String)> {
        let check = gap_check(&case, separation, &records, &options(), UNWATCHED).unwrap();
        let codes = check.gaps[0].codes.iter();
        codes
            .filter_map(|c| Some((c.provision.name().to_owned(), c.refusal()?.to_string())))
            .collect()
    };
    let without = refused(&Separation::default());
    let missing = |name: &str| &without.iter().find(|r| r.0 == name).unwrap().1;
    assert!(missing("asce_7_10_between").contains("displacement_amplification"));
    assert!(missing("gb_50011_2010_between").contains("fortification_intensity"));
    let text = format!("{INPUTS}\nductility = [4, 1]");
    let all = Separation::parse(&text, 2).unwrap();
    let names: Vec<_> = refused(&all).into_iter().map(|r| r.0).collect();
    assert_eq!(
        names,
        ["as_1170_4_boundary", "tehran_between"],
        "9 m is too low"
    );
}

/// All inputs that provisions may need, for a pair.
const INPUTS: &str = "response_modification = [8, 5]\ndisplacement_amplification = 5.5\n\
    importance = 1\nyield_amplification = 1\nstructural_system = \"frame\"\n\
    same_owner = true\nfortification_intensity = 8\nsoil_zone = \"II\"\n\
    design_ground_acceleration = 2.5\nseismic_coefficient = 0.12\n\
    neighbour_has_gap = false";

/// The pair of the examples that yields, changed.
fn yielding(change: impl Fn(&str) -> String) -> Case {
    let file = root().join("examples/yielding_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    Case::parse(&change(&text), &file).unwrap()
}

/// Names of the provisions with a caution; none of them judges the provided widths.
fn cautioned(case: &Case) -> Vec<String> {
    let records = under_records(case, &[]).unwrap();
    let inputs = Separation::parse(INPUTS, 2).unwrap();
    let check = gap_check(case, &inputs, &records, &options(), UNWATCHED).unwrap();
    let gap = &check.gaps[0];
    for code in &gap.codes {
        let silent = code.caution().is_some() || code.refusal().is_some() || code.is_disputed();
        let judged = code.satisfied_by(&gap.levels, gap.seat);
        assert_eq!(judged.is_none(), silent, "{}", code.provision.name());
    }
    let marked = gap.codes.iter().filter(|c| c.caution().is_some());
    marked.map(|c| c.provision.name().to_owned()).collect()
}

/// Alone the light building reaches 1.3 times its yield drift: all codes that multiply
/// elastic displacements are marked, and no other. With strong storeys none is, although
/// the storeys have laws; one weak building is enough.
#[test]
fn codes_for_elastic_displacements_do_not_judge_buildings_that_yield() {
    let multiply = pounding_separation::descriptors().iter();
    let multiply = multiply.filter(|p| p.elastic_displacement_factor.is_some());
    // Seats of bridges are applied where they are named only.
    let multiply = multiply.filter(|p| p.place() != pounding_separation::Place::Seat);
    let names: Vec<_> = multiply.map(|p| p.name).collect();
    assert_eq!(names.len(), 37);
    assert_eq!(cautioned(&yielding(str::to_owned)), names);
    let strong = |text: &str| text.replace("14.42 MN", "14420 MN");
    assert_eq!(cautioned(&yielding(strong)), names);
    let strong = |text: &str| strong(text).replace("136.9 kN", "136.9 MN");
    assert_eq!(cautioned(&yielding(strong)), [""; 0]);
}

/// A link that yields leaves the storeys elastic: nothing is marked.
#[test]
fn a_link_that_yields_makes_no_displacement_inelastic() {
    let file = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let link = "[[link]]\nbetween = [\"light\", \"heavy\"]\nmodel = \"elastic_perfectly_plastic\"\n\
        stiffness = \"1 MN/m\"\nyield_force = \"1 kN\"\n[ground_motion]";
    let case = Case::parse(&text.replace("[ground_motion]", link), &file).unwrap();
    let records = under_records(&case, &[]).unwrap();
    let assembly = &records[0].assembly;
    let alone = assembly.system.without_gaps();
    let run = pounding_time_history::run(&alone, &assembly.options, &mut [], &mut |_| {});
    let link = run.unwrap().links[0].levels[0].ductility.unwrap();
    assert!(link.value > 2.0, "the link yields: {link:?}");
    assert_eq!(cautioned(&case), [""; 0]);
}

/// Two buildings under a pulse of the ground, the right one 0.6 s later, and a wall fixed in
/// space on the left.
fn on_moving_ground(folder: &Path, ground: &str) -> Case {
    let record = "time (s),a (m/s2)\n0,0\n0.5,1\n1,0\n1.5,-1\n2,0\n";
    std::fs::write(folder.join("pulse.csv"), record).unwrap();
    let building = |name: &str, stiffness: &str, ground: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = \"10 t\"\nstiffness = \"{stiffness}\"\n\
             storeys = 1\nheight = \"3 m\"\ndamping = {{ modal = 0.05 }}\n{ground}\n"
        )
    };
    let gap = |between: &str, more: &str| {
        format!(
            "[[gap]]\nbetween = {between}\nwidth = \"0.6 m\"\nmodel = \"linear_elastic\"\n\
             stiffness = \"100 MN/m\"\n{more}\n"
        )
    };
    let text = [
        building("left", "40 MN/m", ""),
        building("right", "60 MN/m", ground),
        gap("[\"left\", \"right\"]", ""),
        gap("[\"wall\", \"left\"]", "wall = \"fixed\""),
        "[ground_motion]\nfile = \"pulse.csv\"\n[analysis]\nduration = \"4 s\"\n".to_owned(),
    ];
    Case::parse(&text.concat(), &folder.join("case.toml")).unwrap()
}

/// By hand: the pulse has the velocity `0.5 - (t - 1)^2` within half a second of its middle,
/// and leaves the ground 0.5 m from where it was. A ground that does the same 0.6 s later is behind
/// it by the integral of the velocity over 0.6 s, which is a maximum about the middle:
/// `2 (0.5 0.3 - 0.3^3 / 3) = 0.282 m`, at 1.3 s. A wall fixed in space is behind by 0.5 m.
#[test]
fn ground_that_moves_differently_widens_what_rules_ask_for() {
    let folder = tempfile::tempdir().unwrap();
    let case = on_moving_ground(folder.path(), "ground = { delay = \"0.6 s\" }");
    let delayed = check(&case, &[], &options());
    let same = check(&on_moving_ground(folder.path(), ""), &[], &options());
    let ground = delayed.records[0].relative_ground_displacement[0][0].unwrap();
    assert!((ground.value - 0.282).abs() < 1.0e-14, "{ground:?}");
    assert!((ground.time - 1.3).abs() < 1.0e-12, "{ground:?}");
    // The run finds it too, along its own steps.
    let (_, gaps) = delayed.records[0].pounding.as_ref().unwrap();
    let found = &gaps[0].levels[0].responses[0];
    assert_eq!(found.name, "relative_ground_displacement");
    assert!((found.peak.value - 0.282).abs() < 1.0e-12, "{found:?}");
    assert!(same.records[0].relative_ground_displacement[0][0].is_none());
    let widths = |check: &GapCheck| -> Vec<(String, f64)> {
        let gap = &check.gaps[0];
        let rules = gap.combinations.iter();
        let rules = rules.map(|c| (c.rule.name().to_owned(), c.records[0][0].width));
        let codes = gap.codes.iter();
        let codes = codes.filter_map(|c| Some((c.provision.name().to_owned(), c.width(0)?)));
        rules.chain(codes).collect()
    };
    let (delayed_widths, same_widths) = (widths(&delayed), widths(&same));
    assert!(same_widths.len() > 10, "{same_widths:?}");
    // The right building does 0.6 s later what it does without delay.
    for ((name, with), (_, without)) in delayed_widths.iter().zip(&same_widths) {
        assert!(
            (with - without - 0.282).abs() < 1.0e-9,
            "{name}: {with} {without}"
        );
    }
    // The demand has it by itself, and the sum of absolute values is never below that.
    let (demand, least) = (delayed.gaps[0].demand[0], same.gaps[0].demand[0]);
    assert!(demand > 0.28 && least < 0.01, "{demand} {least}");
    assert!(delayed_widths[0].1 >= demand, "{delayed_widths:?} {demand}");
    let fixed = delayed.records[0].relative_ground_displacement[1][0].unwrap();
    assert!((fixed.value - 0.5).abs() < 1.0e-14, "{fixed:?}");
    // The pulse ends after two seconds; the ground stays where it then is, in the run too.
    assert!((fixed.time - 2.0).abs() < 1.0e-12, "{fixed:?}");
    let found = &gaps[1].levels[0].responses[0];
    assert_eq!(found.peak.time, fixed.time);
    let explained = delayed.gaps[1].codes.iter().find_map(|c| {
        let required = c.records[0][0].as_ref().ok()?;
        Some(required.explanation.contains("u_g = 0.500000 m"))
    });
    assert_eq!(explained, Some(true));
}

/// Rules take the displacement of a floor that turns where it touches. The displacements at both
/// edges, 7.4461 and 65.9336 mm, are those of a solution of its own of the two equations of motion;
/// at the mass centre there are 35.6325 mm.
#[test]
fn floors_that_turn_count_where_they_touch() {
    let text = "[[building]]
name = \"A\"
mass = [\"100 t\"]
height = \"3 m\"
damping = { stiffness_proportional = 0.05 }
[building.plan]
length = \"10 m\"
width = \"20 m\"
frames_along = [{ at = \"-10 m\", stiffness = \"40 MN/m\" }, { at = \"2 m\", stiffness = \"10 MN/m\" }]
frames_across = [{ at = \"-5 m\", stiffness = \"25 MN/m\" }, { at = \"5 m\", stiffness = \"25 MN/m\" }]
[[building]]
name = \"B\"
mass = [\"100 t\"]
stiffness = \"40 GN/m\"
height = \"3 m\"
damping = { stiffness_proportional = 0.05 }
[[gap]]
between = [\"A\", \"B\"]
width = \"45 mm\"
model = \"linear_elastic\"
stiffness = \"100 MN/m\"
points = [\"-10 m\", \"0 m\", \"10 m\"]
[ground_motion]
file = \"ground_motions/el_centro_1940_ns.csv\"
";
    let case = Case::parse(text, &root().join("case.toml")).unwrap();
    let check = check(&case, &[], &options());
    let gap = &check.gaps[0];
    let rule = gap.combinations.iter();
    let sum = rule.clone().find(|c| c.rule.name() == "absolute_sum");
    let at = |level: usize| sum.unwrap().records[0][level].left;
    for (level, expected) in [(0, 0.007_446_1), (2, 0.065_933_6)] {
        assert!(
            (at(level) - expected).abs() < 1e-7,
            "{level}: {}",
            at(level)
        );
    }
    // Between the edges no less than it is.
    assert!((0.035_632_5..0.037).contains(&at(1)), "{}", at(1));
    for level in 0..3 {
        let (width, demand) = (
            sum.unwrap().records[0][level].width,
            check.records[0].demand[0][level].value,
        );
        assert!(width >= demand, "{level}: {width} {demand}");
    }
}

/// Two single storeys (MN/m along the row), each as it is and as a floor whose frames across the row
/// are softer, which motion along the row does not see.
fn along_the_row(in_plan: bool, scale: &str) -> Case {
    let building = |name: &str, stiffness: f64| {
        let holds = match in_plan {
            false => format!("stiffness = \"{stiffness} MN/m\"\n"),
            true => format!(
                "[building.plan]\nlength = \"10 m\"\nwidth = \"10 m\"\nframes_along = [{{ at = \"-5 m\", stiffness = \"{half} MN/m\" }}, {{ at = \"5 m\", stiffness = \"{half} MN/m\" }}]\nframes_across = [{{ at = \"-5 m\", stiffness = \"1.2 MN/m\" }}, {{ at = \"5 m\", stiffness = \"1.2 MN/m\" }}]\n",
                half = 0.5 * stiffness
            ),
        };
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [\"100 t\"]\nheight = \"3 m\"\ndamping = {{ modal = 0.05 }}\n{holds}"
        )
    };
    let text = format!(
        "{}{}[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = \"20 mm\"\nmodel = \"linear_elastic\"\nstiffness = \"100 MN/m\"\n[ground_motion]\nfile = \"ground_motions/el_centro_1940_ns.csv\"\n{scale}",
        building("a", 16.0),
        building("b", 4.0)
    );
    Case::parse(&text, &root().join("case.toml")).unwrap()
}

/// Combination rules and the band of a code take the period along the row: softer frames across it
/// change nothing. Correlation by hand (Der Kiureghian 1981) for periods whose ratio is 2, both damped by 5 %.
#[test]
fn periods_across_the_row_do_not_count() {
    let scale = "scale = { code = \"eurocode_8_2004\", ag = \"0.25 g\", ground_type = \"C\" }\n";
    for scale in ["", scale] {
        let [chains, plans] = [false, true].map(|in_plan| {
            let check = check(&along_the_row(in_plan, scale), &[], &options());
            let difference = check.gaps[0].combinations.last().unwrap();
            let width = difference.records[0][0].width;
            let factor = check.records[0].factor;
            [difference.correlation.unwrap(), width, factor]
        });
        assert!((chains[0] - 0.018_486).abs() < 1e-6, "{chains:?}");
        for (one, other) in chains.iter().zip(&plans) {
            assert!((one / other - 1.0).abs() < 1e-9, "{chains:?} {plans:?}");
        }
    }
}

/// On soil the mass of a foundation can be most of all: its overdamped sway (0.05 s) is no period of the building, whose
/// first one (0.41 s) is that of its neighbour, with which it moves almost as one.
#[test]
fn a_heavy_foundation_is_not_the_fundamental_mode() {
    let building = |name: &str, stiffness: &str, foundation: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [\"40 t\", \"40 t\"]\nheight = \"3 m\"\nstiffness = \"{stiffness}\"\ndamping = {{ stiffness_proportional = 0.03 }}\n{foundation}\n"
        )
    };
    let soil = "[building.foundation]\nmass = \"120 t\"\nrotational_inertia = \"2500 t m2\"\nsoil = { shear_wave_speed = \"180 m/s\", density = \"1.8 t/m3\", poisson = 0.33, length = \"12 m\", width = \"10 m\" }";
    let gap = "[[gap]]\nbetween = [\"soil\", \"fixed\"]\nwidth = \"100 mm\"\nmodel = \"linear_elastic\"\nstiffness = \"100 MN/m\"\n[ground_motion]\nfile = \"ground_motions/el_centro_1940_ns.csv\"\n";
    let text = format!(
        "{}{}{gap}",
        building("soil", "25 MN/m", soil),
        building("fixed", "24 MN/m", "")
    );
    let case = Case::parse(&text, &root().join("case.toml")).unwrap();
    let system = assemble(&case).unwrap().system;
    let [on_soil, fixed] = [0, 1].map(|b| system.buildings()[b].modes());
    // What made the defect: the effective mass of a mode of the foundation is the largest.
    let largest = on_soil.effective_mass.iter().copied().fold(0.0, f64::max);
    assert!(largest > 1.2 * on_soil.effective_mass[0], "{on_soil:?}");
    let soil = system.buildings()[0].foundation().unwrap();
    let damped = soil.first_mode().unwrap();
    let first = Oscillator {
        period: damped.period,
        damping_ratio: damped.damping_ratio,
    };
    let beside = Oscillator {
        period: fixed.period[0],
        damping_ratio: fixed.damping_ratio[0],
    };
    let expected = correlation_coefficient(first, beside).unwrap();
    let check = check(&case, &[], &options());
    let difference = check.gaps[0].combinations.last().unwrap();
    assert_eq!(difference.correlation.unwrap(), expected);
    assert!(expected > 0.9, "{expected}");
}

/// Isolators give their period and damping at the displacement of the record, not those before they yield,
/// with which both buildings would move almost as one (0.992).
#[test]
fn isolators_that_yield_have_a_period_of_their_own() {
    let text = "[[building]]
name = \"isolated\"
mass = [\"200 t\", \"200 t\"]
height = \"3 m\"
stiffness = \"800 MN/m\"
damping = { modal = [0.05] }
isolator = { model = \"lead_rubber\", post_yield_period = \"2.5 s\", strength = 0.05, stiffness_ratio = 10, damping = \"400 kN s/m\" }
[[building]]
name = \"fixed\"
mass = [\"200 t\", \"200 t\"]
height = \"3 m\"
stiffness = [\"25.3 MN/m\", \"800 MN/m\"]
damping = { modal = 0.08 }
[[gap]]
between = [\"isolated\", \"fixed\"]
width = \"100 mm\"
model = \"linear_elastic\"
stiffness = \"100 MN/m\"
[ground_motion]
file = \"ground_motions/el_centro_1940_ns.csv\"
";
    let case = Case::parse(text, &root().join("case.toml")).unwrap();
    let check = check(&case, &[], &options());
    let isolator = check.records[0].isolated[0].isolator.unwrap();
    let fixed = assemble(&case).unwrap().system;
    let modes = fixed.buildings()[1].modes();
    let expected = correlation_coefficient(
        Oscillator {
            period: isolator.effective_period,
            damping_ratio: isolator.effective_damping_ratio,
        },
        Oscillator {
            period: modes.period[0],
            damping_ratio: modes.damping_ratio[0],
        },
    );
    assert!(isolator.effective_period > 1.5 * modes.period[0]);
    let gap = &check.gaps[0];
    let difference = gap.combinations.last().unwrap();
    assert_eq!(difference.correlation.unwrap(), expected.unwrap());
    // 9.7 mm with the period before yield.
    let width = difference.records[0][1].width;
    let demand = check.records[0].demand[0][1].value;
    assert!(width >= demand, "{width} {demand}");
}

#[test]
fn mistakes() {
    let case = pair("\"20 mm\"");
    let records = under_records(&case, &[]).unwrap();
    let refuse = |options: GapCheckOptions| {
        gap_check(&case, &case.separation, &records, &options, UNWATCHED).unwrap_err()
    };
    let error = refuse(GapCheckOptions {
        target_probability: 1.0,
        ..options()
    });
    assert!(matches!(error, CheckError::Option { .. }) && error.help().is_some());
    let sweep = |gap: Option<&str>, from, to, points| GapCheckOptions {
        sweep: Some(SweepOptions {
            gap: gap.map(str::to_owned),
            from: Some(from),
            to,
            points,
        }),
        ..options()
    };
    let error = refuse(sweep(Some("light"), 0.0, None, 5));
    assert!(error.help().unwrap().contains("light-heavy"));
    assert!(matches!(
        refuse(sweep(None, 0.0, None, 1)),
        CheckError::Option { .. }
    ));
    assert!(matches!(
        refuse(sweep(None, 0.5, None, 5)),
        CheckError::Option { .. }
    ));
    let nowhere = under_records(&case, &[root().join("nowhere.csv")]).unwrap_err();
    assert!(nowhere.to_string().contains("nowhere.csv"), "{nowhere}");
    let named = Separation::parse("provisions = \"nbcc\"", 2).unwrap();
    let error = gap_check(&case, &named, &records, &options(), UNWATCHED).unwrap_err();
    assert!(
        error.help().unwrap().contains("nbcc_2015_between"),
        "{error}"
    );
}

/// Where the width is the demand to the last bit, round-off of steps that are not exact may close the gap: by itself,
/// since there is no other one.
#[test]
fn a_gap_of_the_width_of_its_demand_has_no_neighbour() {
    let file = root().join("examples/soil_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let (mut closed, methods) = (0, ["adaptive", "newmark", "hht_alpha"]);
    for method in methods {
        let step = if method == "adaptive" {
            ""
        } else {
            "step = \"1 ms\"\n"
        };
        let by = text.replace(
            "[analysis]",
            &format!("[analysis]\nmethod = \"{method}\"\n{step}"),
        );
        let case = Case::parse(&by, &file).unwrap();
        let demand = check(&case, &[], &options()).gaps[0].demand[0];
        let case = Case::parse(&by.replace("\"25 mm\"", &demand.to_string()), &file).unwrap();
        let again = check(&case, &[], &options());
        let gap = &again.gaps[0];
        assert_eq!(gap.demand[0], demand);
        assert_eq!(gap.records_driven, 0, "{method}");
        assert_eq!(gap.records_at_demand, gap.records_in_contact, "{method}");
        assert_eq!(gap.adequate, gap.records_in_contact == 0);
        closed += gap.records_in_contact;
        let wider = demand * (1.0 + 1e-6);
        let case = Case::parse(&by.replace("\"25 mm\"", &wider.to_string()), &file).unwrap();
        assert!(check(&case, &[], &options()).gaps[0].adequate, "{method}");
    }
    assert!(closed > 0, "none of {methods:?} closes it by round-off");
}

/// A building whose isolators are given by their period alone stands on isolators as well as one with a table of them:
/// the rules for isolated buildings speak unasked.
#[test]
fn isolators_by_their_period_have_the_rules_of_isolated_buildings() {
    let of = |separation: &str| {
        let file = root().join("examples/three_storey_pair/case.toml");
        let text = std::fs::read_to_string(&file).unwrap() + separation;
        let case = Case::parse(&text, &file).unwrap();
        let gap = check(&case, &[], &options()).gaps.swap_remove(0);
        let names = gap.codes.iter();
        let chapter_17 = names.filter(|c| c.provision.name().contains("isolation_boundary"));
        chapter_17.map(|c| c.width(0)).collect::<Vec<_>>()
    };
    assert_eq!(of(""), Vec::new());
    let found = of(
        "\n[separation]\nspectral_acceleration_1s = \"0.9 g\"\nisolation_period = 3\n\
         isolation_damping_coefficient = 1.5\nplan_length = 40\nplan_width = 20\nplan_eccentricity = 2\n",
    );
    assert_eq!(found.len(), 3);
    for width in found {
        assert!(width.unwrap() > 0.9, "{width:?}");
    }
}
