//! The library by itself: what is built by code is what a case file says, to the last bit;
//! what is wrong is said with its place.
#![allow(clippy::unwrap_used)]

mod builders;
mod changed_cases;
mod own_models;
mod recorders;
mod systems_by_hand;
mod words;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pounding::gap_element::{ModelParameters, registry};
use pounding::prelude::*;
use pounding::time_history::TimeHistoryError;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn storey(mass: f64, stiffness: f64) -> Storey {
    Storey {
        mass: Mass::tonnes(mass),
        stiffness: Stiffness::meganewtons_per_metre(stiffness),
        height: Length::metres(3.0),
    }
}

fn building(name: &str, mass: f64, stiffness: f64) -> Building {
    Building::shear(name)
        .storeys(3, storey(mass, stiffness))
        .damping(Damping::StiffnessProportional { ratio: 0.05 })
}

fn gap() -> Gap {
    Gap::between("light", "heavy")
        .width(Length::millimetres(20.0))
        .model(
            "jankowski_2005",
            [("stiffness", 2.75e9), ("damping_ratio", 0.35)],
        )
}

fn el_centro() -> GroundMotion {
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    let motion = GroundMotion::read(record).unwrap();
    let peak = motion.accelerogram().peak().value.abs();
    motion
        .scaled_to(Acceleration::metres_per_second_squared(peak))
        .unwrap()
}

fn pair() -> Simulation {
    let buildings = [
        building("light", 25.0, 3.46),
        building("heavy", 1000.0, 2215.0),
    ];
    Simulation::of(buildings)
        .gap(gap())
        .ground_motion(el_centro())
}

fn yielding(name: &str, mass: f64, stiffness: f64, yield_force: f64) -> Building {
    building(name, mass, stiffness).law("elastic_perfectly_plastic", [("yield_force", yield_force)])
}

#[test]
fn a_link_by_code_is_that_of_the_case_file() {
    let file = root().join("examples/linked_pair/case.toml");
    let from_file = Model::read(file).unwrap().run().unwrap();
    let joint = Link::between("light", "heavy").named("joint").law(
        "iwan_six_parameter",
        [
            ("density", 4e8),
            ("exponent", -0.3),
            ("phi_2", 0.005),
            ("slider_stiffness", 2e6),
            ("residual_stiffness", 1e5),
        ],
    );
    let outcome = Simulation::of([
        yielding("light", 25.0, 3.46, 136.9e3),
        yielding("heavy", 1000.0, 2215.0, 14.42e6),
    ])
    .gap(gap())
    .link(joint)
    .ground_motion(el_centro())
    .method(MethodChoice::Adaptive {
        relative_tolerance: 1e-10,
    })
    .duration(Time::seconds(31.0))
    .run()
    .unwrap();
    assert_eq!(outcome.links.len(), 1);
    assert!(outcome == from_file);
}

/// Widths of levels, laws of single storeys, floors let go at time zero, a level order and a
/// name of one's own: each says what the key of the case file says.
#[test]
fn every_part_by_code_is_that_of_the_case_file() {
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    let case = format!(
        r#"
[[building]]
name = "light"
storeys = 3
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = {{ stiffness_proportional = 0.05 }}
initial_displacement = ["5 mm", "9 mm", "11 mm"]
initial_velocity = ["1 cm/s", "2 cm/s", "3 cm/s"]
law = [
  {{ storeys = [1], model = "bilinear", yield_force = "90 kN", hardening_ratio = 0.05 }},
  {{ storeys = [3], model = "elastic_perfectly_plastic", yield_force = "80 kN" }},
]
[[building]]
name = "heavy"
storeys = 3
mass = "1000 t"
stiffness = "2215 MN/m"
height = "3 m"
damping = {{ stiffness_proportional = 0.05 }}
[[gap]]
name = "seam"
between = ["light", "heavy"]
width = ["30 mm", "25 mm", "20 mm"]
model = "jankowski_2005"
stiffness = "2.75e9 N/m^1.5"
damping_ratio = 0.35
[ground_motion]
file = {record:?}
[analysis]
method = "adaptive"
energy_tolerance = 1e-5
duration = "8 s"
"#
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    std::fs::write(&file, case).unwrap();
    let from_file = Model::read(&file).unwrap().run().unwrap();
    let light = building("light", 25.0, 3.46)
        .law_of_storeys(
            [1],
            "bilinear",
            [("yield_force", 90e3), ("hardening_ratio", 0.05)],
        )
        .law_of_storeys([3], "elastic_perfectly_plastic", [("yield_force", 80e3)])
        .initial_displacement([5.0, 9.0, 11.0].map(Length::millimetres))
        .initial_velocity([1.0, 2.0, 3.0].map(Velocity::centimetres_per_second));
    let seam = gap()
        .named("seam")
        .levels([(3, 3), (1, 1), (2, 2)])
        .widths([20.0, 30.0, 25.0].map(Length::millimetres));
    let outcome = Simulation::of([light, building("heavy", 1000.0, 2215.0)])
        .gap(seam)
        .ground_motion(el_centro())
        .method(MethodChoice::Adaptive {
            relative_tolerance: 1e-10,
        })
        .energy_tolerance(1e-5)
        .duration(Time::seconds(8.0))
        .run()
        .unwrap();
    let impacts = |o: &Outcome| o.gaps[0].levels.iter().map(|l| l.impacts).sum::<usize>();
    assert!(impacts(&outcome) > 0);
    assert!(outcome == from_file);
}

#[test]
fn what_a_part_cannot_be_is_said_with_its_place() {
    let light = || building("light", 25.0, 3.46);
    let heavy = || building("heavy", 1000.0, 2215.0);
    let refused = |simulation: Simulation| {
        let simulation = simulation.ground_motion(el_centro());
        format!("{:?}", simulation.build().unwrap_err())
    };
    let linear = [("yield_force", 1e5)];
    let law = |b: Building, storeys: &[usize]| {
        b.law_of_storeys(storeys.to_vec(), "elastic_perfectly_plastic", linear)
    };
    for (simulation, wanted) in [
        (
            Simulation::of([law(light(), &[4]), heavy()]),
            "building light, law of storey 4: there is no such storey",
        ),
        (
            Simulation::of([law(light(), &[0]), heavy()]),
            "building light, law of storey 0",
        ),
        (
            Simulation::of([law(law(light(), &[1, 2]), &[2]), heavy()]),
            "building light, law of storey 2: it has a law already",
        ),
        (
            Simulation::of([light().initial_velocity([Velocity::metres_per_second(1.0)])]),
            "building light: 1 values at time zero for 3 floors",
        ),
        (
            Simulation::of([light(), heavy()]).gap(gap().widths([Length::metres(0.1); 2])),
            "gap light-heavy: 2 widths for 3 contact levels",
        ),
        (
            Simulation::of([light(), heavy()]).link(Link::between("light", "heavy")),
            "link light-heavy has no law",
        ),
        (
            Simulation::of([light(), heavy()])
                .link(Link::between("light", "hevy").law("linear", [("stiffness", 1e6)])),
            "did you mean \"heavy\"?",
        ),
        (
            Simulation::of([light(), heavy()])
                .link(Link::between("light", "heavy").law("linear", [("stifness", 1e6)])),
            "link light-heavy:",
        ),
        (
            Simulation::of([light(), heavy()])
                .gap(gap())
                .gap(gap().levels([(1, 1)])),
            "gap light-heavy is between the same two as gap light-heavy",
        ),
        (
            Simulation::of([light(), heavy()]).gap(gap().levels([(0, 1)])),
            "gap light-heavy: there is no storey 0",
        ),
    ] {
        let text = refused(simulation);
        assert!(text.contains(wanted), "{text}");
    }
}

#[test]
fn code_and_case_file_say_the_same() {
    let file = root().join("examples/three_storey_pair/case.toml");
    let from_file = Model::read(file).unwrap().run().unwrap();
    let outcome = pair().duration(Time::seconds(31.0)).run().unwrap();
    assert!(outcome == from_file);
    // A model that is handed over is the one of that name.
    let parameters = ModelParameters::from_pairs(&[("stiffness", 2.75e9), ("damping_ratio", 0.35)]);
    let model = registry::build("jankowski_2005", &parameters).unwrap();
    let own = Gap::between("light", "heavy")
        .width(Length::metres(0.02))
        .impact_model(Arc::from(model))
        .levels([(1, 1), (2, 2), (3, 3)]);
    let buildings = [
        building("light", 25.0, 3.46),
        building("heavy", 1000.0, 2215.0),
    ];
    let simulation = Simulation::of(buildings)
        .gap(own)
        .ground_motion(el_centro());
    let outcome = simulation.duration(Time::seconds(31.0)).run().unwrap();
    assert!(outcome == from_file);
}

#[test]
fn outcomes_serialize_with_all_their_numbers() {
    let outcome = pair().duration(Time::seconds(4.0)).run().unwrap();
    assert!(outcome.end_time == 4.0 && !outcome.impacts.is_empty());
    let value = serde_json::to_value(&outcome).unwrap();
    let level = &value["gaps"][0]["levels"][2];
    assert_eq!(level["impacts"], outcome.gaps[0].levels[2].impacts);
    let force = outcome.gaps[0].levels[2].peak_force;
    assert_eq!(level["peak_force"]["peak"].as_f64(), Some(force.value));
    assert_eq!(level["peak_force"]["time"].as_f64(), Some(force.time));
    assert_eq!(value["method"]["name"], "event_driven");
    assert_eq!(
        value["impacts"].as_array().unwrap().len(),
        outcome.impacts.len()
    );
}

fn refused(simulation: &Simulation) -> (String, String) {
    let error = simulation.build().unwrap_err();
    (error.to_string(), error.help().unwrap_or_default())
}

#[test]
fn what_is_wrong_is_said_with_its_place_and_a_remedy() {
    let lower = |height: f64| {
        let storey = Storey {
            height: Length::metres(height),
            ..storey(1000.0, 2215.0)
        };
        Building::shear("heavy").storeys(3, storey).undamped()
    };
    let light = || building("light", 25.0, 3.46);
    let of = |buildings: Vec<Building>, gap: Gap| {
        Simulation::of(buildings)
            .gap(gap)
            .ground_motion(el_centro())
    };
    let (said, help) = refused(&of(vec![light(), lower(3.4)], gap()));
    assert!(
        said.contains("light-heavy") && said.contains("at 3 m"),
        "{said}"
    );
    assert!(help.contains(".levels("), "{help}");
    let heavy = || building("heavy", 1000.0, 2215.0);
    let misspelt = Gap::between("light", "havy");
    let (said, help) = refused(&of(vec![light(), heavy()], misspelt));
    assert!(
        said.contains("havy") && help.contains("\"heavy\""),
        "{said} {help}"
    );
    let (said, help) = refused(&of(vec![heavy(), light()], gap()));
    assert!(
        said.contains("light-heavy") && help.contains("left"),
        "{said} {help}"
    );
    let bare = Gap::between("light", "heavy").width(Length::metres(0.1));
    let (said, help) = refused(&of(vec![light(), heavy()], bare));
    assert!(
        said.contains("no model") && help.contains(".model("),
        "{said} {help}"
    );
    let unknown = gap().model("jankowsky_2005", []);
    let (said, help) = refused(&of(vec![light(), heavy()], unknown));
    assert!(said.contains("jankowsky"), "{said}");
    assert!(help.contains("jankowski_2005"), "{help}");
    let (said, _) = refused(&of(vec![light(), heavy()], gap().levels([(4, 3)])));
    assert!(said.contains("storey 4"), "{said}");
    let (said, _) = refused(&of(vec![light(), heavy()], gap().levels([(0, 3)])));
    assert!(said.contains("storey 0"), "{said}");
    let still = Simulation::of([light(), heavy()]).gap(gap());
    let (said, help) = refused(&still);
    assert!(said.contains("no ground motion") && help.contains(".ground_motion("));
    let (said, _) = refused(&of(vec![Building::shear("light"), heavy()], gap()));
    assert!(said.contains("light"), "{said}");
}

/// What a case file refuses, the library refuses too.
#[test]
fn what_a_case_file_refuses_is_refused() {
    let light = || building("light", 25.0, 3.46);
    let heavy = || building("heavy", 1000.0, 2215.0);
    let of = |buildings: Vec<Building>, gaps: Vec<Gap>| {
        let simulation = Simulation::of(buildings).ground_motion(el_centro());
        refused(&gaps.into_iter().fold(simulation, Simulation::gap))
    };
    let (said, _) = of(vec![light(), heavy()], vec![gap(), gap()]);
    assert!(said.contains("is between the same two"), "{said}");
    let (said, help) = of(vec![light(), heavy()], vec![gap(), gap().named("second")]);
    assert!(
        said.contains("gap second is between the same two"),
        "{said}"
    );
    assert!(help.contains(".levels("), "{help}");
    let (said, _) = of(vec![light(), heavy()], vec![gap().levels([(2, 2), (2, 2)])]);
    assert!(said.contains("storeys 2 and 2 is given twice"), "{said}");
    // Beside a wall its number says nothing.
    let mut wall = Gap::between("heavy", "wall").width(Length::millimetres(20.0));
    wall = wall.model("linear_elastic", [("stiffness", 1e8)]);
    let (said, _) = of(vec![light(), heavy()], vec![wall.levels([(2, 1), (2, 2)])]);
    assert!(said.contains("storeys 2 and wall is given twice"), "{said}");
    let nowhere = light().law_of_storeys([], "no such law", []);
    let (said, _) = of(vec![nowhere, heavy()], vec![]);
    assert!(said.contains("no such law"), "{said}");
    let (said, help) = of(vec![light(), heavy()], vec![gap().levels([])]);
    assert!(said.contains("no contact level") && help.contains(".levels("));
    let high = Building::shear("heavy")
        .storeys(
            3,
            Storey {
                height: Length::metres(3.4),
                ..storey(1000.0, 2215.0)
            },
        )
        .undamped();
    let none = gap().matching_floors_only();
    let (said, _) = of(vec![light(), high.clone()], vec![none]);
    assert!(said.contains("no contact level"), "{said}");
    let pair = || gap().levels([(3, 3)]);
    let (said, help) = of(vec![light(), high.clone()], vec![pair()]);
    assert!(said.contains("differ in elevation"), "{said}");
    assert!(help.contains(".floor_to_floor()"), "{help}");
    let meant = Simulation::of([light(), high])
        .gap(pair().floor_to_floor())
        .ground_motion(el_centro());
    assert!(!meant.run().unwrap().warnings.is_empty());
    let bare = Building::shear("light").storeys(3, storey(25.0, 3.46));
    let (said, help) = of(vec![bare, heavy()], vec![gap()]);
    assert!(said.contains("no damping") && help.contains(".undamped()"));
    for name in ["wall", "a/b", "", ".", "light "] {
        let (said, _) = of(vec![building(name, 25.0, 3.46), heavy()], vec![]);
        assert!(said.contains("cannot name a building"), "{name:?}: {said}");
    }
    let (said, _) = of(vec![light(), light()], vec![]);
    assert!(said.contains("another building"), "{said}");
    let twice = gap().model("hertz_1882", [("stiffness", 1e9), ("stiffness", 2e9)]);
    let (said, _) = of(vec![light(), heavy()], vec![twice]);
    assert!(said.contains("`stiffness` is given twice"), "{said}");
    let (said, _) = of(vec![light(), heavy()], vec![gap().levels([(4, 3)])]);
    assert!(said.contains("light has no storey 4"), "{said}");
}

/// What a case file gives and nothing uses is said of its run as by the command.
#[test]
fn what_nothing_uses_is_said() {
    let case = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&case).unwrap();
    let unused = format!("{text}\nbeta = 0.3\n");
    let folder = tempfile::tempdir().unwrap();
    let motions = root().join("ground_motions");
    let unused = unused.replace("../../ground_motions", motions.to_str().unwrap());
    std::fs::write(folder.path().join("case.toml"), unused).unwrap();
    let model = Model::read(folder.path().join("case.toml")).unwrap();
    let said = model.warnings(&model.run().unwrap()).join("\n");
    assert!(said.contains("`beta`"), "{said}");
}

/// A result never takes the place of what it was made of.
#[test]
fn no_result_replaces_an_input() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    std::fs::copy(record, file("r.csv")).unwrap();
    let case = root().join("examples/three_storey_pair/case.toml");
    let case = std::fs::read_to_string(case).unwrap();
    let case = case.replace("../../ground_motions/el_centro_1940_ns.csv", "r.csv");
    std::fs::write(file("case.toml"), &case).unwrap();
    let model = Model::read(file("case.toml")).unwrap();
    for name in ["case.toml", "r.csv", "./case.toml"] {
        let error = model.run_to_file(file(name)).unwrap_err();
        assert!(matches!(error, Error::FileUse(_)), "{name}: {error}");
    }
    assert_eq!(std::fs::read_to_string(file("case.toml")).unwrap(), case);
    let motion = GroundMotion::read(file("r.csv")).unwrap();
    let simulation = Simulation::of([building("light", 25.0, 3.46)]).ground_motion(motion);
    let simulation = simulation.duration(Time::seconds(1.0));
    let built = simulation.build().unwrap();
    assert!(built.run_to_file(file("r.csv")).is_err());
    built.run_to_file(file("r.h5")).unwrap();
    // However it was read.
    let read = pounding::ground_motion::read(&file("r.csv"), &Default::default()).unwrap();
    let built = simulation.ground_motion(read).build().unwrap();
    let error = built.run_to_file(file("r.csv")).unwrap_err();
    assert!(matches!(error, Error::FileUse(_)), "{error}");
}

/// Where the buildings have no end without their neighbours, the run keeps its result.
#[test]
fn a_run_is_not_lost_with_its_comparison() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.h5");
    let weak = Building::shear("s")
        .storey(Storey {
            mass: Mass::tonnes(25.0),
            stiffness: Stiffness::meganewtons_per_metre(0.4),
            height: Length::metres(3.0),
        })
        .damping(Damping::StiffnessProportional { ratio: 0.02 })
        .law(
            "bilinear",
            [("yield_force", 2.0e3), ("hardening_ratio", 0.0)],
        )
        .p_delta();
    let wall = |left: &str, right: &str| {
        Gap::between(left, right)
            .width(Length::millimetres(10.0))
            .model("hertz_1882", [("stiffness", 1.0e9)])
    };
    let model = Simulation::of([weak])
        .gap(wall("wall", "s"))
        .gap(wall("s", "wall"))
        .ground_motion(el_centro())
        .build()
        .unwrap();
    let error = model.isolated().run().unwrap_err();
    assert!(error.to_string().contains("collapsed"), "{error}");
    let outcome = model.run_to_file(&path).unwrap();
    assert!(outcome.gaps[0].levels[0].impacts > 0);
    assert!(path.exists());
}

/// A wall on either side has all floors, and a gap that is wide enough leaves the buildings
/// as if they were isolated.
#[test]
fn walls_and_wide_gaps() {
    let buildings = || [building("light", 25.0, 3.46)];
    let wall = |left: &str, right: &str, width: f64| {
        Gap::between(left, right)
            .width(Length::metres(width))
            .model("hertz_1882", [("stiffness", 2.75e9)])
    };
    let walled = Simulation::of(buildings())
        .gap(wall("wall", "light", 0.02))
        .gap(wall("light", "wall", 0.02))
        .ground_motion(el_centro())
        .build()
        .unwrap();
    let outcome = walled.run().unwrap();
    assert!(outcome.gaps.iter().all(|g| g.levels.len() == 3));
    assert!(outcome.gaps.iter().all(|g| g.levels[2].impacts > 0));
    let isolated = walled.isolated().run().unwrap();
    let wide = Simulation::of(buildings())
        .gap(wall("light", "wall", 2.0))
        .ground_motion(el_centro());
    assert_eq!(wide.run().unwrap().buildings, isolated.buildings);
}

#[test]
fn storeys_follow_laws() {
    let yielding = building("light", 25.0, 3.46).law(
        "bilinear",
        [("yield_force", 20.0e3), ("hardening_ratio", 0.05)],
    );
    let buildings = [yielding, building("heavy", 1000.0, 2215.0)];
    let simulation = Simulation::of(buildings)
        .gap(gap())
        .ground_motion(el_centro());
    let outcome = simulation.duration(Time::seconds(8.0)).run().unwrap();
    let storeys = outcome.buildings[0].inelastic_storeys();
    assert!(!storeys.is_empty());
    assert!(outcome.energy.end.hysteretic > 0.0);
}

/// A wall beside a frame: the outcome of the core, and base moments in the answer for machines
/// and in the result file.
#[test]
fn buildings_with_a_stiffness_matrix() {
    use pounding::shear_building::ShearBuilding;
    use pounding::time_history as core;
    let wall = || LateralStiffness::cantilever(&[3.0; 4], &[6.0e9; 4], None).unwrap();
    let rows = [
        vec![1.8e8, -1.0e8, 0.2e8],
        vec![-1.0e8, 1.4e8, -0.6e8],
        vec![0.2e8, -0.6e8, 0.5e8],
    ];
    let frame = || LateralStiffness::from_rows(&rows).unwrap();
    let damping = Damping::Modal { ratios: vec![0.03] };
    let floor = |tonnes: f64| Floor {
        mass: Mass::tonnes(tonnes),
        height: Length::metres(3.0),
    };
    let described = [
        Building::stiffness_matrix("core", wall())
            .floors(4, floor(40.0))
            .damping(damping.clone()),
        Building::stiffness_matrix("frame", frame())
            .floors(2, floor(60.0))
            .floor(floor(50.0))
            .damping(damping.clone())
            .p_delta(),
    ];
    let gap = Gap::between("core", "frame")
        .width(Length::millimetres(12.0))
        .model(
            "anagnostopoulos_2004",
            [("stiffness", 2.0e8), ("restitution", 0.65)],
        );
    let simulation = Simulation::of(described)
        .gap(gap)
        .ground_motion(el_centro())
        .duration(Time::seconds(8.0));
    let model = simulation.build().unwrap();
    let outcome = model.run().unwrap();
    assert!(!outcome.impacts.is_empty());

    let made = |name: &str, mass: Vec<f64>, matrix, gravity| {
        let height = vec![3.0; mass.len()];
        let damping = damping.clone();
        let name = name.to_owned();
        let made =
            ShearBuilding::with_stiffness_matrix(name, mass, matrix, height, damping, gravity);
        Arc::new(made.unwrap())
    };
    let wall = made("core", vec![40e3; 4], wall(), 0.0);
    let frame = made("frame", vec![60e3, 60e3, 50e3], frame(), 9.80665);
    let record = el_centro();
    let mut system = core::System::new(
        vec![wall, frame],
        core::GroundAcceleration {
            samples: record.accelerogram().shared_samples(),
            time_step: record.accelerogram().time_step(),
        },
    );
    let parameters = ModelParameters::from_pairs(&[("stiffness", 2.0e8), ("restitution", 0.65)]);
    let law = registry::build("anagnostopoulos_2004", &parameters).unwrap();
    let law: Arc<dyn pounding::gap_element::ImpactModel> = law.into();
    let level = |i| {
        let floors = [0, 1].map(|b| core::Floor::Storey(b, i));
        (floors[0], floors[1], 0.012, Arc::clone(&law))
    };
    let names = ["core", "frame"].map(str::to_owned);
    system
        .add_gap("core-frame", names, (0..3).map(level).collect())
        .unwrap();
    let options = RunOptions {
        duration: Some(8.0),
        ..RunOptions::default()
    };
    let expected = core::run(&system, &options, &mut [], &mut |_| {}).unwrap();
    assert_eq!(outcome.buildings, expected.buildings);
    assert_eq!(outcome.impacts, expected.impacts);
    assert!(outcome.buildings.iter().all(|b| b.base_moment.is_some()));

    let isolated = model.isolated().run().unwrap();
    let summary = Summary::of(&system, (&outcome, &isolated), &[]);
    let summary = serde_json::to_value(&summary).unwrap();
    let pair = pair().run().unwrap();
    let chains = serde_json::to_value(&pair.buildings).unwrap();
    for b in 0..2 {
        for (key, outcome) in [
            ("base_moment", &outcome),
            ("isolated_base_moment", &isolated),
        ] {
            let told = &summary["buildings"][b][key];
            let moment = outcome.buildings[b].base_moment.unwrap();
            assert_eq!(told["peak"].as_f64(), Some(moment.value));
            assert_eq!(told["time"].as_f64(), Some(moment.time));
        }
        assert!(chains[b].get("base_moment").is_none(), "of a chain");
    }
}

/// Storeys and floors, matrices and laws that do not go together.
#[test]
fn what_a_stiffness_matrix_cannot_have() {
    let matrix = || LateralStiffness::cantilever(&[3.0; 2], &[6.0e9; 2], None).unwrap();
    let floor = Floor {
        mass: Mass::tonnes(40.0),
        height: Length::metres(3.0),
    };
    let refused = |building: Building, words: [&str; 2]| {
        let building = building.undamped();
        let error = Simulation::of([building]).ground_motion(el_centro()).run();
        let error = format!("{:?}", error.unwrap_err());
        for word in words {
            assert!(error.contains(word), "{error}");
        }
    };
    let wall = || Building::stiffness_matrix("core", matrix());
    // A wall of 6 m is none of 6.5 m; a unit alone changes nothing.
    let high = Floor {
        height: Length::metres(3.5),
        ..floor
    };
    refused(
        wall().floor(floor).floor(high),
        [
            "building core, storey 2: its height is 3.5 m, and the stiffness matrix is that of a storey of 3 m",
            "the same heights",
        ],
    );
    let odd = LateralStiffness::cantilever(&[3.3; 2], &[6.0e9; 2], None).unwrap();
    let millimetres = Floor {
        height: Length::millimetres(3300.0),
        ..floor
    };
    let same = Building::stiffness_matrix("core", odd).floors(2, millimetres);
    let simulation = Simulation::of([same.undamped()]).ground_motion(el_centro());
    simulation.run().unwrap();
    refused(
        wall().floor(floor).storey(storey(40.0, 3.0)),
        [
            "building core, storey 2: it has a stiffness",
            "takes storeys",
        ],
    );
    refused(
        Building::shear("chain")
            .storey(storey(40.0, 3.0))
            .floor(floor),
        [
            "building chain, storey 2: it has no stiffness",
            "takes storeys",
        ],
    );
    refused(wall().floor(floor), ["core", "stiffness matrix"]);
    let law = wall().floors(2, floor);
    refused(
        law.law("bilinear", [("yield_force", 1e5), ("hardening_ratio", 0.1)]),
        ["law of storey 1", "a stiffness matrix has no storeys"],
    );
    let mechanism = [vec![1.0, -1.0], vec![-1.0, 1.0]];
    let error = LateralStiffness::from_rows(&mechanism).map_err(Error::from);
    assert!(format!("{:?}", error.unwrap_err()).contains("mechanism"));
}

#[cfg(feature = "toml")]
fn lead_rubber() -> Isolator {
    Isolator {
        kind: IsolatorKind::LeadRubber {
            post_yield: PostYield::Stiffness(5.053e6),
            strength: Some(Strength::YieldForce(4.71e5)),
            stiffness_ratio: 10.0,
        },
        dashpot: 2.0e5,
    }
}

/// The example of an isolated building, built by code: its case file, to the last bit.
#[cfg(feature = "toml")]
#[test]
fn an_isolated_building_is_that_of_its_case_file() {
    let slab = Floor {
        mass: Mass::tonnes(200.0),
        height: Length::metres(0.6),
    };
    let office = Building::isolated("office", slab, lead_rubber())
        .storey(storey(200.0, 400.0))
        .storey(storey(200.0, 350.0))
        .storey(storey(200.0, 300.0))
        .damping(Damping::Dashpots {
            coefficients: vec![1.2e6, 1.0e6, 8.0e5],
        });
    let file = root().join("examples/isolated_building/case.toml");
    let case = pounding::case::Case::read(&file).unwrap();
    let assembled = pounding::assembly::assemble(&case).unwrap();
    let read = &assembled.system.buildings()[0];
    let simulation = Simulation::of([office.clone()]).ground_motion(el_centro());
    let system = simulation.build().unwrap().system().clone();
    let built = &system.buildings()[0];
    assert_eq!(built.stiffness(), read.stiffness());
    assert_eq!(built.damping_matrix(), read.damping_matrix());
    assert_eq!(built.isolator(), read.isolator());
    assert_eq!(built.modes().period, read.modes().period);
    let refused = |building: Building, words: [&str; 2]| {
        let error = Simulation::of([building]).ground_motion(el_centro()).run();
        let error = format!("{:?}", error.unwrap_err());
        for word in words {
            assert!(error.contains(word), "{error}");
        }
    };
    let gravity = office.clone().p_delta();
    refused(gravity, ["P-Delta does not go with isolators", "leave"]);
    let law = office.law_of_storeys([1], "bouc_wen", [("yield_force", 1.0e6)]);
    refused(law, ["the isolators have their own", "numbered from 1"]);
    let mut strong = lead_rubber();
    if let IsolatorKind::LeadRubber { strength, .. } = &mut strong.kind {
        *strength = Some(Strength::OfWeight(1.5));
    }
    let slab = Building::isolated("slab", slab, strong);
    refused(slab, ["building slab: the isolators have", "usual are"]);
}

/// Forces by code are those of the case file; one on no building or no storey is refused.
#[test]
fn forces_by_code_are_those_of_the_case_file() {
    let file = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let force = "\n[[building.force]]\nstorey = 3\npoints = [[1, 0], [1, \"90 kN\"], [\"1.2 s\", 0]]\n[[gap]]";
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("case.toml");
    let motions = root().join("ground_motions");
    let text = text.replacen("[[gap]]", force, 1);
    let text = text.replace("../../ground_motions", motions.to_str().unwrap());
    std::fs::write(&place, text).unwrap();
    let model = Model::read(&place).unwrap();
    let history = ForceHistory::new(&[(1.0, 0.0), (1.0, 9e4), (1.2, 0.0)], false).unwrap();
    let push = |building: &str, storey| pair().force(building, storey, history.clone());
    let by_code = push("heavy", 3).build().unwrap();
    let read = &model.system().forces()[0];
    let made = &by_code.system().forces()[0];
    assert_eq!((read.building, read.storey), (made.building, made.storey));
    assert_eq!(read.history, made.history);
    let error = push("heavi", 3).build().unwrap_err();
    assert!(
        error.help().unwrap().contains("did you mean \"heavy\"?"),
        "{error}"
    );
    assert!(push("heavy", 0).build().is_err());
    assert!(push("heavy", 4).build().is_err());
    assert!(ForceHistory::new(&[(1.0, 0.0), (0.5, 1.0)], false).is_err());
}

/// Who is asked whether to go on changes nothing by saying yes, and ends the run by saying no: what recorders hold then
/// is the beginning of what they hold of the whole run.
#[test]
fn a_run_is_ended_by_who_is_asked() {
    let model = pair().build().unwrap();
    let mut told = Vec::new();
    let mut whole = GridRecorder::new(0.01).unwrap();
    let outcome = model.run_while(&mut [&mut whole], |done| {
        told.push(done);
        ControlFlow::Continue(())
    });
    assert_eq!(outcome.unwrap(), model.run().unwrap());
    assert!(told.len() > 10 && told.is_sorted(), "{told:?}");
    assert_eq!(told.last(), Some(&1.0));
    let mut recorder = GridRecorder::new(0.01).unwrap();
    let ended = model.run_while(&mut [&mut recorder], |done| match done < 0.25 {
        true => ControlFlow::Continue(()),
        false => ControlFlow::Break(()),
    });
    let Err(Error::Stopped { done }) = ended else {
        panic!("{ended:?}");
    };
    assert_eq!(told.iter().find(|d| **d >= 0.25), Some(&done));
    let (part, whole) = (recorder.responses, whole.responses);
    let duration = model
        .options()
        .duration
        .unwrap_or(whole.time[whole.len() - 1]);
    let end = part.time[part.len() - 1];
    assert!((end - done * duration).abs() < 0.2, "{end}");
    let n = part.displacement.len();
    assert!(n > 0 && part.displacement[..] == whole.displacement[..n]);
    // At the end there is nothing left to be ended.
    let late = |done: f64| match done < 1.0 {
        true => ControlFlow::Continue(()),
        false => ControlFlow::Break(()),
    };
    assert!(model.run_while(&mut [], late).is_ok());
}

/// Another method than the one that the model was built with, checked like that one.
#[test]
fn a_model_takes_other_options() {
    let model = pair().build().unwrap();
    let method = MethodChoice::RungeKutta4 { step: 1e-4 };
    let options = RunOptions {
        method,
        duration: Some(4.0),
        ..*model.options()
    };
    let by_options = model.clone().with_options(options).unwrap();
    assert_eq!(by_options.options().duration, Some(4.0));
    let by_code = pair().method(method).duration(Time::seconds(4.0));
    assert_eq!(by_options.run().unwrap(), by_code.run().unwrap());
    let options = RunOptions {
        duration: Some(-1.0),
        ..*model.options()
    };
    let error = model.with_options(options).unwrap_err();
    assert!(error.to_string().contains("duration"), "{error}");
}

/// What there is not, the force of a jump and the opening of a contact that outlasts the run, does not make equal
/// outcomes unequal.
#[test]
fn equal_outcomes_are_equal_with_rigid_impacts() {
    let gap = gap().model("stereomechanical", [("restitution", 0.6)]);
    let buildings = [
        building("light", 25.0, 3.46),
        building("heavy", 1000.0, 2215.0),
    ];
    let rigid = Simulation::of(buildings)
        .gap(gap)
        .ground_motion(el_centro());
    let outcome = rigid.run().unwrap();
    assert!(outcome.impacts.iter().any(|i| i.peak_force.value.is_nan()));
    assert_eq!(outcome, rigid.run().unwrap());
    let mut other = outcome.clone();
    other.impacts[0].impulse *= 1.0 + 1e-15;
    assert_ne!(outcome, other);
}

/// Buildings that cannot be come with a remedy in words of the library.
#[test]
fn buildings_that_cannot_be_come_with_a_remedy() {
    let soft = building("soft", 1000.0, 0.5).p_delta();
    for (building, remedy) in [
        (Building::shear("none").undamped(), ".storeys("),
        (soft, ".p_delta()"),
    ] {
        let of = Simulation::of([building]).ground_motion(el_centro());
        let (said, help) = refused(&of);
        assert!(help.contains(remedy), "{said}: {help}");
    }
}

/// A motion by code says what one from a file says of itself.
#[test]
fn a_motion_by_code_has_an_origin() {
    let samples = || [0.0, 1.0, -1.0, 0.0].map(Acceleration::metres_per_second_squared);
    for (step, warned) in [(20.0, true), (1e-8, true), (0.01, false)] {
        let motion = GroundMotion::of(samples(), Time::seconds(step)).unwrap();
        let origin = motion.accelerogram().origin().unwrap();
        let said = origin.warnings.join("\n");
        assert_eq!(said.contains("the time step is"), warned, "{step}: {said}");
    }
    let motion = GroundMotion::of(samples(), Time::seconds(20.0)).unwrap();
    let simulation = Simulation::of([building("light", 25.0, 3.46)]).ground_motion(motion);
    let model = simulation.build().unwrap();
    let said = model.warnings(&model.run().unwrap()).join("\n");
    assert!(said.contains("the time step is 20 s"), "{said}");
}

/// Without gaps links stay; isolated buildings have neither.
#[test]
fn links_stay_without_gaps() {
    let spring = Link::between("light", "heavy").law("linear", [("stiffness", 5e7)]);
    let linked = pair().link(spring).build().unwrap();
    let roof = |model: Model| {
        model.run().unwrap().buildings[0].storeys[2]
            .displacement
            .value
    };
    let without_gaps = linked.without_gaps();
    assert!(without_gaps.system().gaps().is_empty());
    assert_eq!(without_gaps.system().links().len(), 1);
    assert!(linked.isolated().system().links().is_empty());
    assert!(roof(without_gaps) < 0.5 * roof(linked.isolated()));
}

/// Storeys whose law falls have an end, and it is said as what it is, without gravity too.
#[test]
fn a_falling_backbone_is_a_collapse() {
    let falling = building("light", 25.0, 3.46).law(
        "bilinear",
        [("yield_force", 1e4), ("hardening_ratio", -0.1)],
    );
    let relative_tolerance = 1e-10;
    for method in [
        MethodChoice::EventDriven { relative_tolerance },
        MethodChoice::Adaptive { relative_tolerance },
        MethodChoice::Newmark {
            step: 1e-3,
            beta: 0.25,
            gamma: 0.5,
        },
    ] {
        let simulation = Simulation::of([falling.clone()]).ground_motion(el_centro());
        let error = simulation.method(method).run().unwrap_err();
        let Error::Run(TimeHistoryError::Collapse {
            building,
            storey,
            time,
            ..
        }) = &error
        else {
            panic!("{method:?}: {error}");
        };
        assert!(building == "light" && (1..=3).contains(storey));
        assert!((1.0..10.0).contains(time), "{time}");
    }
}

/// What is made of a system is what was made of its parts.
#[test]
fn a_system_is_a_model() {
    let built = pair().title("A pair").build().unwrap();
    assert_eq!(built.title(), "A pair");
    let model = Model::of_system(built.system().clone(), *built.options()).unwrap();
    let model = model.with_title("A system");
    let outcome = model.run().unwrap();
    assert_eq!(outcome, built.run().unwrap());
    assert!(model.warnings(&outcome).len() >= outcome.warnings.len());
    let asked = model.run_while(&mut [], |_| ControlFlow::Continue(()));
    assert_eq!(asked.unwrap(), outcome);
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        model.run_to_file(folder.path().join("r.h5")).unwrap(),
        outcome
    );
    let duration = Some(-1.0);
    let options = RunOptions {
        duration,
        ..*built.options()
    };
    assert!(Model::of_system(built.system().clone(), options).is_err());
}

/// Without contacts a run is shown and ended as with them.
#[test]
fn a_run_without_contacts_is_shown_and_ended() {
    let stiff = |damping| {
        let building = Building::shear("light").storeys(3, storey(25.0, 3.46));
        Simulation::of([building.damping(damping)]).ground_motion(el_centro())
    };
    let dashpots = Damping::Dashpots {
        coefficients: vec![1e5, 5e4, 2e4],
    };
    for damping in [Damping::Modal { ratios: vec![0.05] }, dashpots] {
        let model = stiff(damping).build().unwrap();
        let mut told = Vec::new();
        let outcome = model.run_while(&mut [], |done| {
            told.push(done);
            ControlFlow::Continue(())
        });
        assert_eq!(outcome.unwrap(), model.run().unwrap());
        assert!(told.len() > 50 && told.is_sorted(), "{}", told.len());
        assert_eq!(told.iter().filter(|d| **d == 1.0).count(), 1);
        let ended = model.run_while(&mut [], |done| match done < 0.5 {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        });
        let Err(Error::Stopped { done }) = ended else {
            panic!("{ended:?}");
        };
        assert!((0.5..0.6).contains(&done), "{done}");
    }
}

/// A damping matrix typed in is the one that dashpots make.
#[test]
fn a_damping_matrix_from_rows() {
    let of = |damping| {
        let building = Building::shear("light").storeys(2, storey(25.0, 3.46));
        let simulation = Simulation::of([building.damping(damping)]).ground_motion(el_centro());
        simulation.duration(Time::seconds(6.0)).run().unwrap()
    };
    let rows = [vec![1.5e5, -5e4], vec![-5e4, 5e4]];
    let typed = of(Damping::from_rows(&rows).unwrap());
    let matrix = pounding::nalgebra::DMatrix::from_row_slice(2, 2, &rows.concat());
    assert_eq!(of(Damping::Matrix { matrix }), typed);
    let dashpots = of(Damping::Dashpots {
        coefficients: vec![1e5, 5e4],
    });
    let roof = |outcome: &Outcome| outcome.buildings[0].storeys[1].displacement.value;
    assert!((roof(&typed) / roof(&dashpots) - 1.0).abs() < 1e-9);
    for wrong in [
        vec![],
        vec![vec![1.0, 2.0], vec![2.0]],
        vec![vec![1.0, 2.0], vec![3.0, 1.0]],
        vec![vec![f64::NAN]],
    ] {
        assert!(Damping::from_rows(&wrong).is_err());
    }
}

/// What errors and descriptors hold can be named.
#[test]
fn parts_of_public_types_have_names() {
    use pounding::FileUseError;
    use pounding::catalogue::{
        DefinitionError, ParameterUnit, Parameters, optional_positive, positive,
    };
    let taken = FileUseError::SameOutput {
        role: "a".to_owned(),
        output: PathBuf::from("r.h5"),
        other_role: "b".to_owned(),
        other: PathBuf::from("r.h5"),
    };
    assert!(Error::from(taken).help().is_some());
    assert!(positive("stiffness", ParameterUnit::NewtonPerMetre, "Stiffness").required);
    assert!(!optional_positive("stiffness", ParameterUnit::NewtonPerMetre, "Stiffness").required);
    assert_eq!(
        Parameters::from_pairs(&[("stiffness", 1.0)]).given("stiffness"),
        Some(1.0)
    );
    let error = registry::find("nothing").unwrap_err();
    let pounding::gap_element::GapElementError::Definition(error) = error else {
        panic!("{error}");
    };
    assert!(matches!(error, DefinitionError::UnknownName { .. }));
}
