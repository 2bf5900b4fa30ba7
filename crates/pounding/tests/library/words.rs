//! What is said of mistakes in code is in words of the library: neither keys of case files nor options
//! of the program.

use pounding::ground_motion::{GroundMotionError, ReadOptions};
use pounding::prelude::*;
use pounding::time_history::{System, TimeHistoryError};

use crate::{building, el_centro, gap, lead_rubber, pair, refused};

/// What stands in helps of the program and of case files alone.
const OF_PROGRAM: [&str; 9] = [
    "[analysis]",
    "[ground_motion]",
    "[[",
    " --",
    "`--",
    " -o",
    "method = ",
    "`pounding ",
    "case",
];

fn in_our_words(error: &Error) -> String {
    let help = error.help().unwrap_or_default();
    let foreign = OF_PROGRAM.iter().find(|word| help.contains(**word));
    assert_eq!(foreign, None, "{error}\n{help}");
    assert!(!help.is_empty(), "{error}");
    help
}

#[test]
fn errors_of_records_are_in_our_words() {
    let folder = tempfile::tempdir().unwrap();
    let written = |text: &str| {
        let path = folder.path().join("r.txt");
        std::fs::write(&path, text).unwrap();
        GroundMotion::read(&path).unwrap_err()
    };
    let numbers: String = (0..40).map(|i| format!("{}.5\n", i % 7)).collect();
    assert!(in_our_words(&written(&numbers)).contains("ReadOptions"));
    in_our_words(&written("nothing that is a record\n"));
    let times: String = (0..40)
        .map(|i| format!("{:.2} 0.{}\n", 0.02 * f64::from(i), i % 7))
        .collect();
    assert!(in_our_words(&written(&times)).contains("`unit` of `ReadOptions`"));
    in_our_words(&GroundMotion::read(folder.path().join("none.csv")).unwrap_err());
    let file = || "r".to_owned();
    for error in [
        GroundMotionError::MissingTimeStep {
            file: file(),
            line: 1,
        },
        GroundMotionError::AmbiguousSeries {
            file: file(),
            line: None,
            available: vec!["NS".to_owned(), "EW".to_owned()],
        },
        GroundMotionError::MissingSensitivity {
            file: file(),
            searched: String::new(),
        },
        GroundMotionError::Uneven {
            file: file(),
            count: 9,
            mean: 0.02,
            smallest: 0.01,
            largest: 0.03,
        },
    ] {
        assert!(in_our_words(&error.into()).contains("`ReadOptions`"));
    }
    for (remedy, ours) in [
        (
            "skip it: `skip_lines = 2` in [ground_motion] of a case, `--skip-lines 2` with `pounding motion`",
            "skip it: `skip_lines = 2` of `ReadOptions`",
        ),
        (
            "leave `prepend_zero` out (`--prepend-zero` with `pounding motion`): it is not needed",
            "leave `prepend_zero` out of `ReadOptions`: it is not needed",
        ),
        ("get the record again", "get the record again"),
    ] {
        let error = GroundMotionError::Parse {
            file: file(),
            line: 1,
            column: 1,
            message: String::new(),
            remedy: remedy.to_owned(),
        };
        assert_eq!(in_our_words(&error.into()), ours);
    }
    // What the help names is there.
    let _ = ReadOptions {
        lenient: true,
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
}

#[test]
fn errors_of_runs_are_in_our_words() {
    let help = |simulation: Simulation| in_our_words(&simulation.build().unwrap_err());
    let long = help(pair().duration(Time::seconds(1e12)));
    assert!(long.contains(".duration("), "{long}");
    let fine = help(pair().method(MethodChoice::RungeKutta4 { step: 1e-20 }));
    assert!(fine.contains("`MethodChoice`"), "{fine}");
    let moreau = MethodChoice::MoreauJean {
        step: 1e-4,
        theta: 0.5,
    };
    assert!(help(pair().method(moreau)).contains("stereomechanical"));
    help(pair().duration(Time::seconds(-1.0)));
    help(pair().energy_tolerance(-1.0));
    let yielding =
        building("light", 25.0, 3.46).law("elastic_perfectly_plastic", [("yield_force", 1e5)]);
    let stereo = gap().model("stereomechanical", [("restitution", 0.6)]);
    let curved = Simulation::of([yielding, building("heavy", 1000.0, 2215.0)]).gap(stereo);
    help(curved.ground_motion(el_centro()).method(moreau));
    let place = String::new;
    for error in [
        TimeHistoryError::StepTooSmall {
            time: 1.0,
            step: 1e-16,
            method: "m",
            place: place(),
        },
        TimeHistoryError::NotFinite {
            time: 1.0,
            method: "m",
            place: place(),
        },
        TimeHistoryError::Collapse {
            time: 1.0,
            building: place(),
            storey: 1,
            height: 3.0,
        },
        TimeHistoryError::InitialState { reason: place() },
        TimeHistoryError::ContactGivesEnergy {
            time: 1.0,
            place: place(),
            model: "m",
            given: 1e9,
            input: 1.0,
        },
    ] {
        in_our_words(&error.into());
    }
    in_our_words(&ForceHistory::new(&[], false).unwrap_err().into());
}

#[test]
fn errors_of_models_and_isolators_are_in_our_words() {
    let refuse = |gap: Gap| {
        let buildings = [
            building("light", 25.0, 3.46),
            building("heavy", 1000.0, 2215.0),
        ];
        let simulation = Simulation::of(buildings)
            .gap(gap)
            .ground_motion(el_centro());
        in_our_words(&simulation.build().unwrap_err())
    };
    for name in ["no such model at all", "jankowsky_2005"] {
        let all = refuse(gap().model(name, []));
        assert!(all.contains("registry::descriptors()"), "{all}");
    }
    let rule = gap()
        .model(
            "jankowski_2005",
            [("stiffness", 2.75e9), ("damping_ratio", 0.35)],
        )
        .separation(SeparationRule::GapShift);
    let rules = refuse(rule);
    assert!(
        rules.contains("`SeparationRule::ZeroPenetration`"),
        "{rules}"
    );
    refuse(gap().model("hertz_1882", []));
    for width in [-0.01, f64::NAN] {
        assert!(refuse(gap().width(Length::metres(width))).contains("`.width(...)`"));
    }
    let slab = Floor {
        mass: Mass::tonnes(50.0),
        height: Length::metres(1.0),
    };
    let rubber = |post_yield, stiffness_ratio| Isolator {
        kind: IsolatorKind::LeadRubber {
            post_yield,
            strength: Some(Strength::OfWeight(0.05)),
            stiffness_ratio,
        },
        ..lead_rubber()
    };
    let refused_isolator = |isolator| {
        let alone = Simulation::of([Building::isolated("i", slab, isolator)]);
        let error = alone.ground_motion(el_centro()).build().unwrap_err();
        (error.to_string(), in_our_words(&error))
    };
    refused_isolator(rubber(PostYield::Period(2.5), 0.5));
    refused_isolator(rubber(PostYield::Period(2.5), 1.0));
    for period in [-2.0, 0.0, f64::INFINITY, f64::NAN] {
        let (said, _) = refused_isolator(rubber(PostYield::Period(period), 10.0));
        assert!(said.contains("post_yield_period"), "{said}");
    }
}

/// Masses, stiffnesses, heights and every kind of damping.
#[test]
fn errors_of_buildings_are_in_our_words() {
    let refuse = |building: Building| {
        let simulation = Simulation::of([building]).ground_motion(el_centro());
        in_our_words(&simulation.build().unwrap_err())
    };
    let sound = crate::storey(25.0, 3.46);
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mass = Mass::tonnes(wrong);
        let stiffness = Stiffness::meganewtons_per_metre(wrong);
        let height = Length::metres(wrong);
        for storey in [
            Storey { mass, ..sound },
            Storey { stiffness, ..sound },
            Storey { height, ..sound },
        ] {
            let help = refuse(Building::shear("b").storeys(2, storey).undamped());
            assert!(help.contains("`Mass::tonnes(25.0)`"), "{help}");
        }
    }
    let (alpha, beta, ratio) = (0.1, -1.0, 5.0);
    for damping in [
        Damping::Rayleigh { alpha, beta },
        Damping::RayleighRatio {
            ratio,
            modes: [1, 2],
        },
        Damping::RayleighRatio {
            ratio: 0.05,
            modes: [1, 3],
        },
        Damping::StiffnessProportional { ratio },
        Damping::MassProportional { ratio },
        Damping::Modal {
            ratios: vec![ratio],
        },
        Damping::Modal {
            ratios: vec![0.05; 3],
        },
        Damping::Dashpots {
            coefficients: vec![1e5],
        },
        Damping::Dashpots {
            coefficients: vec![1e5, -1e5],
        },
        Damping::from_rows(&[vec![1e5]]).unwrap(),
    ] {
        let help = refuse(Building::shear("b").storeys(2, sound).damping(damping));
        assert!(help.contains("0.02 to 0.05"), "{help}");
    }
    let isolated = Damping::Isolated {
        superstructure: Box::new(Damping::Modal { ratios: vec![0.05] }),
        isolators: 0.0,
    };
    let help = refuse(Building::shear("b").storeys(2, sound).damping(isolated));
    assert!(help.contains("`Building::isolated(...)`"), "{help}");
    let walls = [
        LateralStiffness::cantilever(&[3.0; 2], &[6e9], None),
        LateralStiffness::cantilever(&[3.0; 2], &[6e9, 0.0], None),
        LateralStiffness::from_rows(&[]),
        LateralStiffness::from_rows(&[vec![1.0, -1.0], vec![-1.0, 1.0]]),
    ];
    for wall in walls {
        in_our_words(&wall.unwrap_err().into());
    }
    let wall = LateralStiffness::cantilever(&[3.0; 2], &[6e9; 2], None).unwrap();
    let floor = Floor {
        mass: Mass::tonnes(40.0),
        height: Length::metres(3.0),
    };
    let help = refuse(
        Building::stiffness_matrix("w", wall)
            .floor(floor)
            .undamped(),
    );
    assert!(help.contains("one row for each floor"), "{help}");
}

#[test]
fn results_that_cannot_be_written_are_in_our_words() {
    let model = pair().duration(Time::seconds(1.0)).build().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let nowhere = folder.path().join("none").join("r.h5");
    let help = in_our_words(&model.run_to_file(nowhere).unwrap_err());
    assert!(help.contains("another path"), "{help}");
    let path = folder.path().join("r.h5");
    let small = model.clone().output_step(Time::seconds(1e-12));
    assert!(in_our_words(&small.run_to_file(&path).unwrap_err()).contains(".output_step("));
    for step in [f64::NAN, 0.0, -0.01, f64::INFINITY] {
        let error = model
            .clone()
            .output_step(Time::seconds(step))
            .run_to_file(&path);
        let error = error.unwrap_err();
        assert!(error.to_string().contains("output_step"), "{error}");
        in_our_words(&error);
    }
    assert!(!path.exists());
}

#[test]
fn warnings_are_in_our_words() {
    let still = GroundMotion::of(vec![Acceleration::gravities(0.0); 100], Time::seconds(0.02));
    let model = Simulation::of([building("light", 25.0, 3.46)]).ground_motion(still.unwrap());
    let model = model.build().unwrap();
    let said = model.warnings(&model.run().unwrap()).join("\n");
    assert!(
        said.contains("`Simulation::force`") && !said.contains("[["),
        "{said}"
    );
}

/// Keys of case files stand in no warning of a model that was built by code.
#[test]
fn warnings_of_short_runs_name_no_keys() {
    let low = || building("low", 25.0, 3.46);
    let run_of = |simulation: Simulation, motion: GroundMotion| {
        let model = simulation.ground_motion(motion).build().unwrap();
        model.warnings(&model.run().unwrap())
    };
    let run = |simulation: Simulation, seconds: f64| {
        run_of(simulation.duration(Time::seconds(seconds)), el_centro())
    };
    let samples = vec![Acceleration::gravities(0.1); 20];
    let push_at_once = GroundMotion::of(samples, Time::seconds(0.02)).unwrap();
    let push = ForceHistory::new(&[(0.0, 0.0), (5.0, 1e3), (9.0, 0.0)], false).unwrap();
    for (said, start, remedy) in [
        (
            run_of(Simulation::of([low()]), push_at_once),
            "low, floor above storey",
            "and may grow on: take a longer `.duration(...)`, beyond the end of the record where that is too short",
        ),
        (
            run(Simulation::of([low()]).force("low", 1, push), 3.0),
            "the run ends at 3 s, before the force on storey 1",
            "take a longer `.duration(...)`, or an earlier force",
        ),
    ] {
        let found = said.iter().find(|w| w.starts_with(start));
        let found = found.unwrap_or_else(|| panic!("{start}: {said:?}"));
        assert!(found.ends_with(remedy), "{found}");
        let keys = ["`duration`", "`delay`", "process"];
        assert!(keys.iter().all(|key| !found.contains(key)), "{found}");
    }
}

#[test]
fn a_soft_contact_is_told_in_our_words() {
    let gap = Gap::between("a", "b").width(Length::millimetres(20.0));
    let gap = gap.model("linear_elastic", [("stiffness", 93.5)]);
    let pair = Simulation::of([building("a", 25.0, 3.46), building("b", 25.0, 3.46)]);
    let model = pair.gap(gap).ground_motion(el_centro()).build().unwrap();
    let said = model.warnings(&model.run().unwrap()).join("\n");
    assert!(said.contains("the contact is softer"), "{said}");
    assert!(said.contains("`gap_element::contact_stiffness`"), "{said}");
    assert!(!said.contains("pounding stiffness"), "{said}");
}

/// Each mistake has its place and its own remedy.
#[test]
fn sides_and_storeys_that_cannot_be() {
    let three = || ["a", "b", "c"].map(|name| building(name, 25.0, 3.46));
    let between = |left: &str, right: &str| {
        let gap = Gap::between(left, right).width(Length::millimetres(20.0));
        let gap = gap.model("hertz_1882", [("stiffness", 1e9)]);
        refused(&Simulation::of(three()).gap(gap).ground_motion(el_centro()))
    };
    for (left, right, said, help) in [
        ("a", "a", "\"a\" is on both sides", "two buildings"),
        ("wall", "wall", "a wall on both sides", "a building"),
        ("a", "c", "do not stand next to each other", "neighbours"),
        ("b", "a", "stands on the right of", "left building first"),
        ("a", "wall", "beside \"c\"", "\"wall\" first"),
        ("wall", "b", "beside \"a\"", "\"wall\" last"),
    ] {
        let found = between(left, right);
        assert!(
            found.0.contains(said) && found.1.contains(help),
            "{found:?}"
        );
    }
    let push = |name: &str, storey| {
        let history = ForceHistory::new(&[(0.0, 1e4), (1.0, 0.0)], false).unwrap();
        refused(
            &Simulation::of(three())
                .force(name, storey, history)
                .ground_motion(el_centro()),
        )
    };
    for storey in [4, usize::MAX - 1, usize::MAX] {
        let (said, help) = push("b", storey);
        assert!(
            said.contains(&format!("b has no storey {storey}")),
            "{said}"
        );
        assert!(help.contains("to 3"), "{help}");
        for pair in [(1, storey), (storey, 1)] {
            let gap = Gap::between("a", "b").width(Length::millimetres(20.0));
            let gap = gap.model("hertz_1882", [("stiffness", 1e9)]).levels([pair]);
            let link = Link::between("a", "b")
                .levels([pair])
                .law("viscous_damper", [("damping", 5e4)]);
            let of = Simulation::of(three()).ground_motion(el_centro());
            for (said, _) in [refused(&of.clone().gap(gap)), refused(&of.link(link))] {
                assert!(said.contains(&format!("has no storey {storey}")), "{said}");
            }
        }
    }
    let (said, help) = push("wall", 1);
    assert!(
        said.contains("does not move") && help.contains("building"),
        "{said} {help}"
    );
    let (said, help) = refused(&Simulation::of([]).ground_motion(el_centro()));
    assert!(
        said.contains("no buildings") && help.contains("Simulation::of("),
        "{said}"
    );
    for count in [4_001, usize::MAX / 16, usize::MAX] {
        let floor = Floor {
            mass: Mass::tonnes(25.0),
            height: Length::metres(3.0),
        };
        let tall = Building::shear("tall")
            .storeys(count, crate::storey(25.0, 3.46))
            .undamped();
        let twice = tall.clone().floors(count, floor);
        for tall in [tall, twice] {
            let (said, _) = refused(&Simulation::of([tall]).ground_motion(el_centro()));
            assert!(said.contains("4000 at most"), "{said}");
        }
    }
}

/// A law that no storey follows is to be one all the same.
#[test]
fn a_law_of_no_storeys_is_looked_at() {
    let slab = Floor {
        mass: Mass::tonnes(50.0),
        height: Length::metres(1.0),
    };
    let isolated = || Building::isolated("i", slab, lead_rubber());
    let of = |building| Simulation::of([building]).ground_motion(el_centro());
    let (said, _) = refused(&of(isolated().law("no such law", [("stiffness", 1e6)])));
    assert!(said.contains("no such law"), "{said}");
    let (said, _) = refused(&of(isolated().law("bilinear", [("yield", 1e6)])));
    assert!(said.contains("yield"), "{said}");
    assert!(
        of(isolated().law("bilinear", [("yield_force", 1e6)]))
            .build()
            .is_ok()
    );
}

/// Systems that know no names of a facade refuse the same.
#[test]
fn systems_count_from_zero_without_overflow() {
    use pounding::time_history::FloorForce;
    let model = pair().build().unwrap();
    let system = || -> System { model.system().clone() };
    for (building, storey) in [(0, usize::MAX), (1, 3), (2, 0), (usize::MAX, 0)] {
        let history = ForceHistory::new(&[(0.0, 1.0)], true).unwrap();
        let force = FloorForce {
            building,
            storey,
            history,
            origin: String::new(),
        };
        let error = system().with_forces(vec![force]).unwrap_err();
        assert!(matches!(error, TimeHistoryError::Force { .. }), "{error}");
    }
    use pounding::time_history::Floor::{Storey, Wall};
    let contact = system().levels()[0].model.clone();
    for floor in [Storey(1, usize::MAX), Storey(usize::MAX, 0), Storey(2, 0)] {
        let between = ["heavy".to_owned(), "wall".to_owned()];
        let level = (floor, Wall, 0.1, contact.clone());
        let error = system().add_gap("g", between, vec![level]).unwrap_err();
        assert!(
            matches!(error, TimeHistoryError::GapDefinition { .. }),
            "{error}"
        );
    }
}
