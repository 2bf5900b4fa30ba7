//! Buildings that yield on foundations that sway and rock, against an integrator of the equations as they
//! are written out in `docs/theory/soil.md`, against the same building on a fixed base and against elastic
//! storeys.

use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_hysteresis::LawParameters;
use pounding_shear_building::{Damping, Foundation, ShearBuilding, SpringDashpot, StoreyLaw};
use pounding_time_history::{
    BuildingOutcome, Floor, GridRecorder, GroundAcceleration, History, MethodChoice, Outcome, Peak,
    Recorder, RunOptions, System, run,
};

use super::setup::{ADAPTIVE, EVENT_DRIVEN, TIGHT, difference, el_centro, go, law, newmark};

const MASS: [f64; 2] = [1.0e5, 8.0e4];
const STIFFNESS: [f64; 2] = [6.0e7, 5.0e7];
const HEIGHT: [f64; 2] = [3.5, 3.0];
const DASHPOT: [f64; 2] = [4.0e5, 3.0e5];
const HARDENING: f64 = 0.05;
const SWAY: SpringDashpot = SpringDashpot {
    stiffness: 3.0e8,
    dashpot: 4.0e6,
};
const ROCKING: SpringDashpot = SpringDashpot {
    stiffness: 6.0e9,
    dashpot: 5.0e7,
};
const FOUNDATION_MASS: f64 = 5.0e4;
const ROTATIONAL_INERTIA: f64 = 1.0e6;
const LENGTH: f64 = 8.0;
const GRAVITY: f64 = 9.80665;
const DURATION: f64 = 8.0;
/// Stiffness (N/m) of a wall that both floors may meet.
const WALL: f64 = 1.0e8;

/// A building of two storeys.
#[derive(Clone, Copy)]
struct Example {
    /// Yield force of each storey (N); infinite for an elastic one.
    yields: [f64; 2],
    sway: Option<SpringDashpot>,
    rocking: Option<SpringDashpot>,
    p_delta: bool,
    /// Clear distance to the wall (m).
    gap: Option<f64>,
}

const BOTH: Example = Example {
    yields: [4.5e5, 2.5e5],
    sway: Some(SWAY),
    rocking: Some(ROCKING),
    p_delta: false,
    gap: None,
};

fn bilinear(stiffness: f64, yield_force: f64) -> StoreyLaw {
    law(
        "bilinear",
        &LawParameters::from_pairs(&[
            ("stiffness", stiffness),
            ("yield_force", yield_force),
            ("hardening_ratio", HARDENING),
        ]),
    )
}

fn linear_elastic(stiffness: f64) -> Arc<dyn ImpactModel> {
    let parameters = ModelParameters::from_pairs(&[("stiffness", stiffness)]);
    registry::build("linear_elastic", &parameters)
        .unwrap()
        .into()
}

impl Example {
    fn fixed_base(&self) -> ShearBuilding {
        let damping = Damping::Dashpots {
            coefficients: DASHPOT.to_vec(),
        };
        let gravity = if self.p_delta { GRAVITY } else { 0.0 };
        let storeys = STIFFNESS.into_iter().zip(self.yields);
        let laws = storeys.map(|(k, y)| y.is_finite().then(|| bilinear(k, y)));
        ShearBuilding::under_gravity(
            "a".to_owned(),
            MASS.to_vec(),
            STIFFNESS.to_vec(),
            HEIGHT.to_vec(),
            damping,
            gravity,
        )
        .unwrap()
        .with_laws(laws.collect())
        .unwrap()
    }

    fn building(&self) -> ShearBuilding {
        let building = self.fixed_base();
        let inertia = match self.rocking {
            Some(_) => ROTATIONAL_INERTIA,
            None => 0.0,
        };
        let foundation =
            Foundation::new(FOUNDATION_MASS, inertia, self.sway, self.rocking).unwrap();
        building
            .on_foundation(foundation, Some(LENGTH), GRAVITY)
            .unwrap()
    }

    fn beside_its_wall(&self, building: ShearBuilding) -> System {
        let mut system = System::new(vec![Arc::new(building)], ground());
        if let Some(gap) = self.gap {
            let pair = |s| (Floor::Storey(0, s), Floor::Wall, gap, linear_elastic(WALL));
            let names = ["a".to_owned(), "wall".to_owned()];
            system
                .add_gap("a-wall", names, vec![pair(0), pair(1)])
                .unwrap();
        }
        system
    }

    fn system(&self) -> System {
        self.beside_its_wall(self.building())
    }
}

/// Twice El Centro.
fn ground() -> GroundAcceleration {
    let once = el_centro();
    GroundAcceleration {
        samples: Arc::new(once.samples.iter().map(|a| 2.0 * a).collect()),
        ..once
    }
}

/// Displacements of both floors and of the foundation and its rotation, their velocities, elastic part of
/// the deformation of both storeys and what they have dissipated.
type State = [f64; 12];

/// An integration by the classical fourth-order method in short steps, which end where a storey yields or
/// turns and where the wall is met or left.
struct Reference {
    example: Example,
    state: State,
    /// Which way a storey yields: 1, -1 or 0, and whether a floor is at the wall.
    flow: [f64; 2],
    touches: [bool; 2],
    /// Displacements, drifts, storey shears, base moment, sway, rotation.
    peaks: [f64; 9],
    impacts: usize,
}

impl Reference {
    fn drifts(&self, y: &State) -> [[f64; 2]; 2] {
        let of = |at: usize| {
            let first = y[at] - y[at + 2] - HEIGHT[0] * y[at + 3];
            [first, y[at + 1] - y[at] - HEIGHT[1] * y[at + 3]]
        };
        [of(0), of(4)]
    }

    fn shears(&self, y: &State) -> [f64; 2] {
        let [drift, _] = self.drifts(y);
        std::array::from_fn(|i| match self.example.yields[i].is_finite() {
            true => STIFFNESS[i] * (HARDENING * drift[i] + (1.0 - HARDENING) * y[8 + i]),
            false => STIFFNESS[i] * drift[i],
        })
    }

    fn rate(&self, y: &State, acceleration: f64) -> State {
        let Example {
            sway,
            rocking,
            p_delta,
            gap,
            ..
        } = self.example;
        let [_, rates] = self.drifts(y);
        let shears = self.shears(y);
        let resisted: [f64; 2] = std::array::from_fn(|i| shears[i] + DASHPOT[i] * rates[i]);
        let of_floors = [resisted[0] - resisted[1], resisted[1]];
        let mut force = [-of_floors[0], -of_floors[1], resisted[0], 0.0];
        force[3] = HEIGHT[0] * of_floors[0] + (HEIGHT[0] + HEIGHT[1]) * of_floors[1];
        if p_delta {
            let above = [
                GRAVITY * (MASS[0] + MASS[1]) / HEIGHT[0],
                GRAVITY * MASS[1] / HEIGHT[1],
            ];
            let pushed = [above[0] * (y[0] - y[2]), above[1] * (y[1] - y[0])];
            force[0] += pushed[0] - pushed[1];
            force[1] += pushed[1];
            force[2] -= pushed[0];
        }
        for i in 0..2 {
            if self.touches[i] {
                force[i] -= WALL * (y[i] - gap.unwrap());
            }
        }
        let mut out = [0.0; 12];
        for i in 0..2 {
            out[i] = y[4 + i];
            out[4 + i] = force[i] / MASS[i] - acceleration;
            if self.flow[i] == 0.0 {
                out[8 + i] = rates[i];
            } else {
                out[10 + i] = (1.0 - HARDENING) * STIFFNESS[i] * y[8 + i] * rates[i];
            }
        }
        if let Some(sway) = sway {
            let soil = sway.stiffness * y[2] + sway.dashpot * y[6];
            out[2] = y[6];
            out[6] = (force[2] - soil) / FOUNDATION_MASS - acceleration;
        }
        if let Some(rocking) = rocking {
            let soil = rocking.stiffness * y[3] + rocking.dashpot * y[7];
            out[3] = y[7];
            out[7] = (force[3] - soil) / ROTATIONAL_INERTIA;
        }
        out
    }

    fn after(&self, h: f64, [start, end]: [f64; 2]) -> State {
        let middle = 0.5 * (start + end);
        let along = |rate: &State, h: f64| -> State {
            std::array::from_fn(|i| self.state[i] + h * rate[i])
        };
        let k1 = self.rate(&self.state, start);
        let k2 = self.rate(&along(&k1, 0.5 * h), middle);
        let k3 = self.rate(&along(&k2, 0.5 * h), middle);
        let k4 = self.rate(&along(&k3, h), end);
        std::array::from_fn(|i| self.state[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    }

    /// What becomes positive where a storey yields or turns, or where a floor meets or leaves the wall.
    fn events(&self, y: &State) -> [f64; 4] {
        let [_, rates] = self.drifts(y);
        std::array::from_fn(|k| match (k / 2, k % 2) {
            (0, i) if self.flow[i] == 0.0 => {
                let limit = self.example.yields[i] / STIFFNESS[i];
                match limit.is_finite() {
                    true => y[8 + i].abs() - limit,
                    false => -1.0,
                }
            }
            (0, i) => -self.flow[i] * rates[i],
            (_, i) => match (self.example.gap, self.touches[i]) {
                (None, _) => -1.0,
                (Some(gap), false) => y[i] - gap,
                (Some(gap), true) => gap - y[i],
            },
        })
    }

    fn take(&mut self, y: State) {
        let [drift, _] = self.drifts(&y);
        let shears = self.shears(&y);
        let moment = HEIGHT[0] * shears[0] + HEIGHT[1] * shears[1];
        let now = [
            y[0], y[1], drift[0], drift[1], shears[0], shears[1], moment, y[2], y[3],
        ];
        for (peak, now) in self.peaks.iter_mut().zip(now) {
            *peak = peak.max(now.abs());
        }
        self.state = y;
    }

    fn of(example: Example) -> Self {
        let mut this = Self {
            example,
            state: [0.0; 12],
            flow: [0.0; 2],
            touches: [false; 2],
            peaks: [0.0; 9],
            impacts: 0,
        };
        let ground = ground();
        let parts = 1000;
        let h = ground.time_step / f64::from(parts);
        let samples = (DURATION / ground.time_step).round() as usize;
        for sample in 0..samples {
            let ends = [ground.samples[sample], ground.samples[sample + 1]];
            let at = |part: f64| ends[0] + (ends[1] - ends[0]) * part / f64::from(parts);
            for part in 0..parts {
                this.step(h, |share| at(f64::from(part) + share));
            }
        }
        this
    }

    fn step(&mut self, h: f64, ground: impl Fn(f64) -> f64) {
        let mut done = 0.0;
        while done < 1.0 {
            let before = self.events(&self.state);
            let part = |to: f64| self.after((to - done) * h, [ground(done), ground(to)]);
            let whole = part(1.0);
            let after = self.events(&whole);
            let mut first: Option<(f64, usize)> = None;
            for k in (0..4).filter(|k| after[*k] > 0.0 && before[*k] <= 0.0) {
                let (mut low, mut high) = (done, 1.0);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    match self.events(&part(middle))[k] > 0.0 {
                        true => high = middle,
                        false => low = middle,
                    }
                }
                if first.is_none_or(|(at, _)| high < at) {
                    first = Some((high, k));
                }
            }
            let Some((at, k)) = first else {
                self.take(whole);
                return;
            };
            self.take(part(at));
            let i = k % 2;
            match (k / 2, self.flow[i] == 0.0) {
                (0, true) => {
                    let limit = self.example.yields[i] / STIFFNESS[i];
                    self.flow[i] = self.state[8 + i].signum();
                    self.state[8 + i] = self.flow[i] * limit;
                }
                (0, false) => {
                    self.flow[i] = 0.0;
                    // Round-off of its size leaves it inside.
                    self.state[8 + i] *= 1.0 - 1e-15;
                }
                _ => {
                    self.touches[i] = !self.touches[i];
                    self.impacts += usize::from(self.touches[i]);
                }
            }
            done = at;
        }
    }

    /// The largest relative difference of all peaks, and of dissipated energies.
    fn difference(&self, outcome: &Outcome) -> f64 {
        let found = &outcome.buildings[0];
        let mut worst = 0.0_f64;
        let mut near = |found: f64, expected: f64| {
            worst = worst.max((found - expected).abs() / expected);
        };
        for i in 0..2 {
            near(found.storeys[i].displacement.value, self.peaks[i]);
            let drift = found.storeys[i].drift_ratio.value * HEIGHT[i];
            near(drift, self.peaks[2 + i]);
            near(found.storeys[i].storey_shear.value, self.peaks[4 + i]);
            if let Some(yielding) = &found.yielding[i] {
                near(yielding.hysteretic_energy, self.state[10 + i]);
            }
        }
        near(found.base_moment.unwrap().value, self.peaks[6]);
        let springs = [
            (self.example.sway, "sway", "shear", 7),
            (self.example.rocking, "rotation", "moment", 8),
        ];
        let uplift = 0.5 * LENGTH * GRAVITY * (MASS[0] + MASS[1] + FOUNDATION_MASS);
        for (spring, motion, force, at) in springs {
            let Some(spring) = spring else { continue };
            near(response(found, motion), self.peaks[at]);
            near(response(found, force), spring.stiffness * self.peaks[at]);
        }
        let moment = match self.example.rocking {
            Some(spring) => spring.stiffness * self.peaks[8],
            None => self.peaks[6],
        };
        near(response(found, "overturning_ratio"), moment / uplift);
        worst
    }
}

/// The peak of a response whose name ends with this.
fn response(found: &BuildingOutcome, name: &str) -> f64 {
    let mut all = found.responses.iter();
    all.find(|r| r.name.ends_with(name)).unwrap().peak.value
}

fn examples() -> [(&'static str, Example); 6] {
    [
        ("both", BOTH),
        (
            "one elastic storey",
            Example {
                yields: [4.5e5, f64::INFINITY],
                ..BOTH
            },
        ),
        (
            "sway alone",
            Example {
                rocking: None,
                ..BOTH
            },
        ),
        (
            "rocking alone, the upper storey yields",
            Example {
                yields: [f64::INFINITY, 2.5e5],
                sway: None,
                ..BOTH
            },
        ),
        (
            "gravity",
            Example {
                p_delta: true,
                ..BOTH
            },
        ),
        (
            "gravity beside a wall",
            Example {
                p_delta: true,
                gap: Some(0.02),
                ..BOTH
            },
        ),
    ]
}

#[test]
fn an_integration_of_the_equations_finds_the_same() {
    for (name, example) in examples() {
        let reference = Reference::of(example);
        let system = example.system();
        for method in [EVENT_DRIVEN, ADAPTIVE] {
            let outcome = go(&system, method, DURATION);
            let impacts: usize = outcome.impacts.len();
            let (worst, residual) = (
                reference.difference(&outcome),
                outcome.energy.residual_ratio,
            );
            println!("{name} {method:?}: {worst:.1e}, {impacts} impacts, residual {residual:.1e}");
            assert_eq!(impacts, reference.impacts, "{name}");
            assert!(impacts > 2 || example.gap.is_none());
            assert!(worst < 1.0e-7, "{name} {method:?}: {worst:e}");
            assert!(residual < 1.0e-9, "{name} {method:?}: {residual:e}");
            for (yielding, limit) in outcome.buildings[0].yielding.iter().zip(example.yields) {
                let ductility = yielding.as_ref().map(|y| y.ductility.unwrap().value);
                assert_eq!(ductility.is_some(), limit.is_finite());
                assert!(ductility.is_none_or(|d| d > 1.5), "{name}: {ductility:?}");
            }
        }
    }
}

fn hht_alpha(step: f64) -> MethodChoice {
    MethodChoice::HhtAlpha { step, alpha: -0.1 }
}

fn runge_kutta_4(step: f64) -> MethodChoice {
    MethodChoice::RungeKutta4 { step }
}

/// A quarter of the step leaves a sixteenth of the error, or thereabouts where peaks stand in other branches.
#[test]
fn fixed_steps_converge_to_the_same() {
    let methods: [fn(f64) -> MethodChoice; 3] = [newmark, hht_alpha, runge_kutta_4];
    for (name, example) in examples() {
        let reference = Reference::of(example);
        let system = example.system();
        for method in methods {
            let outcomes = [1.0e-3, 2.5e-4].map(|step| go(&system, method(step), DURATION));
            let errors = outcomes.each_ref().map(|o| reference.difference(o));
            let residual = outcomes[1].energy.residual_ratio;
            let method = outcomes[1].method.name;
            println!("{name} {method}: {errors:?}, residual {residual:.1e}");
            let converges = errors[1] < errors[0] / 6.0 || errors[1] < 1.0e-7;
            assert!(converges, "{name} {method}: {errors:?}");
            assert!(errors[1] < 2.0e-5, "{name} {method}: {errors:?}");
            assert!(residual < 1.0e-5, "{name} {method}: {residual:e}");
        }
    }
}

/// Soil that is stiffer and stiffer comes to a fixed base, ten times as near where it is ten times as stiff.
#[test]
fn a_stiff_soil_is_a_fixed_base() {
    let on = |times: f64| {
        let held = |stiffness: f64| {
            Some(SpringDashpot {
                stiffness: times * stiffness,
                dashpot: 0.0,
            })
        };
        Example {
            sway: held(6.0e7),
            rocking: held(3.0e9),
            gap: Some(0.02),
            ..BOTH
        }
    };
    let fixed = BOTH.fixed_base();
    let fixed = go(&on(1.0).beside_its_wall(fixed), EVENT_DRIVEN, 4.0);
    let dissipated = |o: &Outcome| -> f64 {
        let all = o.buildings[0].yielding.iter().flatten();
        all.map(|y| y.hysteretic_energy).sum()
    };
    let errors = [1.0e4, 1.0e5].map(|times| {
        let founded = go(&on(times).system(), EVENT_DRIVEN, 4.0);
        assert_eq!(founded.impacts.len(), fixed.impacts.len());
        let part = dissipated(&founded) / dissipated(&fixed) - 1.0;
        [difference(&founded, &fixed), part.abs()]
    });
    println!("{errors:?}");
    for k in 0..2 {
        assert!(errors[1][k] < 3.0e-5, "{errors:?}");
        assert!(errors[1][k] < 0.2 * errors[0][k], "{errors:?}");
    }
}

/// Storeys with laws that never yield are the elastic ones.
#[test]
fn a_law_that_never_yields_is_elastic() {
    for (name, example) in examples() {
        let with = |limit: f64| Example {
            yields: [limit; 2],
            ..example
        };
        let [laws, elastic] = [1.0e9, f64::INFINITY].map(|limit| with(limit).system());
        for method in [EVENT_DRIVEN, TIGHT, newmark(1.0e-3)] {
            let [laws, elastic] = [&laws, &elastic].map(|system| {
                let options = RunOptions {
                    method,
                    duration: Some(DURATION),
                    energy_tolerance: Some(1.0),
                };
                run(system, &options, &mut [], &mut |_| {}).unwrap()
            });
            let mut worst = difference(&laws, &elastic);
            let [a, b] = [&laws, &elastic].map(|o| o.energy.end.input);
            worst = worst.max((a - b).abs() / b);
            let strain = laws.energy.end.strain - elastic.energy.end.strain;
            assert!(strain.abs() < 1.0e-9 * elastic.energy.largest_input);
            println!("{name} {method:?}: {worst:.1e}");
            assert!(worst < 1.0e-9, "{name} {method:?}: {worst:e}");
        }
    }
}

/// The largest part by which a history exceeds its peaks, and by which it falls short of them.
fn beyond(peaks: &[Peak], history: &History, values: &[f64]) -> [f64; 2] {
    let mut all = [-1.0_f64; 2];
    for (index, peak) in peaks.iter().enumerate() {
        let column = history.column(values, index);
        let largest = column.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let part = largest / peak.value - 1.0;
        all = [all[0].max(part), all[1].max(-part)];
    }
    all
}

/// Beside an elastic neighbour with storeys of its own and no foundation, which comes first.
fn pair(example: &Example) -> System {
    let neighbour = super::setup::building("b", (3, 1.0e5, 8.0e7), None);
    let own = example.building();
    let third = example.building();
    let buildings = [neighbour, own, third].map(Arc::new).to_vec();
    let mut system = System::new(buildings, ground());
    let parameters = ModelParameters::from_pairs(&[("stiffness", 9.35e7), ("restitution", 0.65)]);
    for (left, names) in [(0, ["b", "a"]), (1, ["a", "c"])] {
        let model: Arc<dyn ImpactModel> =
            registry::build("kelvin_voigt", &parameters).unwrap().into();
        let floors = |s| {
            let (left, right) = (Floor::Storey(left, s), Floor::Storey(left + 1, s));
            (left, right, 0.01, Arc::clone(&model))
        };
        let name = names.join("-");
        let names = names.map(str::to_owned);
        system
            .add_gap_with_tolerance(&name, names, vec![floors(0), floors(1)], 1.0)
            .unwrap();
    }
    system
}

/// Peaks of shears, moments, drifts and responses lie in no history, and recorders change no bit.
#[test]
fn no_history_exceeds_its_peak_and_recorders_change_nothing() {
    let sways = Example {
        rocking: None,
        p_delta: true,
        ..BOTH
    };
    for (name, example) in [("both", BOTH), ("sway alone", sways)] {
        let system = pair(&example);
        let [exact, pairs] = [EVENT_DRIVEN, TIGHT].map(|method| go(&system, method, DURATION));
        let worst = difference(&exact, &pairs);
        println!("{name}: {worst:.1e}, {} impacts", exact.impacts.len());
        assert_eq!(exact.impacts.len(), pairs.impacts.len());
        assert!(worst < 1.0e-7, "{name}: {worst:e}");
        for method in [
            EVENT_DRIVEN,
            ADAPTIVE,
            newmark(2.0e-3),
            hht_alpha(2.0e-3),
            runge_kutta_4(1.0e-3),
        ] {
            let options = RunOptions {
                method,
                duration: Some(DURATION),
                energy_tolerance: Some(1.0),
            };
            let mut recorder = GridRecorder::new(3.7e-4).unwrap();
            let recorders: &mut [&mut dyn Recorder] = &mut [&mut recorder];
            let outcome = run(&system, &options, recorders, &mut |_| {}).unwrap();
            let silent = run(&system, &options, &mut [], &mut |_| {}).unwrap();
            assert_eq!(outcome.buildings, silent.buildings, "{name} {method:?}");
            assert_eq!(outcome.impacts, silent.impacts, "{name} {method:?}");
            assert!(outcome.impacts.len() > 5);
            let h = recorder.responses;
            let buildings = &outcome.buildings;
            let storeys = || buildings.iter().flat_map(|b| &b.storeys);
            let shears: Vec<Peak> = storeys().map(|s| s.storey_shear).collect();
            let moments: Vec<Peak> = buildings.iter().filter_map(|b| b.base_moment).collect();
            let responses = buildings.iter().flat_map(|b| &b.responses);
            let responses: Vec<Peak> = responses.map(|r| r.peak).collect();
            assert_eq!(moments.len(), 2);
            for (what, peaks, values) in [
                ("shears", &shears, &h.storey_shear),
                ("moments", &moments, &h.base_moment),
                ("responses", &responses, &h.response),
            ] {
                let [above, below] = beyond(peaks, &h, values);
                println!("{name} {method:?} {what}: {above:.1e}, {below:.1e}");
                assert!(above < 1.0e-9, "{name} {method:?} {what}: {above:e}");
                assert!(below < 1.0e-2, "{name} {method:?} {what}: {below:e}");
            }
        }
    }
}

/// Moreau and Jean's method takes no laws of storeys.
#[test]
fn velocity_jumps_alone_are_refused() {
    let system = BOTH.system();
    let options = RunOptions {
        method: MethodChoice::MoreauJean {
            step: 1.0e-3,
            theta: 0.5,
        },
        duration: Some(1.0),
        energy_tolerance: None,
    };
    let error = run(&system, &options, &mut [], &mut |_| {}).unwrap_err();
    assert!(error.to_string().contains("a storey 1"), "{error}");
}
