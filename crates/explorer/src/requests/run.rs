//! A run with and without gaps: what `pounding run --json` prints, and the motion.

use pounding_elevation::{Neighbour, Row, RowGap, Scene};
use pounding_study::gap_check::amplification;
use pounding_time_history::{
    ContactLevel, Energy, GridRecorder, History, Impact, IsolatedRun, Outcome, Peak, Recorder,
    RelativeDisplacement, Summary, System, TimeHistoryError, VELOCITY_JUMPS, run, run_isolated,
};
use serde_json::{Value, json};

use super::deadline::Deadline;
use crate::answer::Answer;
use crate::explorer::Prepared;
use crate::fault::Refused;
use crate::limits::MOST_NUMBERS;

/// Runs a case; at most so many times of its motion are in the answer.
pub(crate) fn answer(prepared: &Prepared, frames: usize) -> Result<Answer, Refused> {
    let Prepared { case, assembly } = prepared;
    let (system, options) = (&assembly.system, &assembly.options);
    let duration = options.duration.unwrap_or(system.record_duration());
    let frames = frames.min(MOST_NUMBERS / (system.floors() + 2 * system.levels().len() + 9));
    let step = || assembly.output_step.max(duration / (frames - 1) as f64);
    let mut responses = match frames {
        0 | 1 => None,
        _ => Some(GridRecorder::new(step())?),
    };
    let mut deadline = Deadline::from_now();
    let mut recorders: Vec<&mut dyn Recorder> = vec![&mut deadline];
    recorders.extend(responses.as_mut().map(|r| r as &mut dyn Recorder));
    let outcome = run(system, options, &mut recorders, &mut |_| {})?;
    let mut warnings = assembly.with_those_of_the_record(&outcome.warnings);
    let mut demand = RelativeDisplacement::of_levels(system);
    let (isolated, is_demanded) = isolated(prepared, &mut demand);
    let (isolated, told) = IsolatedRun::beside(&outcome, isolated);
    warnings.extend(told);
    let mut answer = Answer::default();
    let summary = Summary::of(system, (&outcome, &isolated), &warnings);
    answer.say("summary", json!(summary));
    answer.say("scene", scene(system, &outcome));
    answer.say("demand", demands(system, demand.peaks(), is_demanded));
    answer.say("levels", levels(system));
    answer.say("jumps", jumps(system, &outcome));
    answer.say("amplification", amplifications(&outcome, &isolated));
    answer.say("case", case.source.as_str());
    answer.say("excitation", json!(assembly.excitation()));
    impacts(&mut answer, system, &outcome.impacts);
    if let Some(recorder) = responses {
        motion(&mut answer, &recorder.responses);
    }
    Ok(answer)
}

/// Where the buildings stand in a picture, with a contact for every level.
fn scene(system: &System, outcome: &Outcome) -> Value {
    let buildings = system.buildings().iter();
    let gaps = system.gaps().iter().map(|gap| {
        let levels = system.levels_of(gap);
        let side = |side: usize| {
            let name = &gap.between[side];
            let building = system.buildings().iter().position(|b| b.name() == name);
            building.map_or(Neighbour::Wall, Neighbour::Building)
        };
        let elevations = |level: &ContactLevel| {
            let elevations = level.place.elevations.map(|z| z.unwrap_or(f64::NAN));
            (elevations, level.width)
        };
        RowGap {
            between: [side(0), side(1)],
            levels: levels.iter().map(elevations).collect(),
        }
    });
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    let reach = storeys.map(|s| s.displacement.value.abs());
    let scene = Scene::of(&Row {
        buildings: buildings
            .map(|b| (b.name().to_owned(), b.elevations().to_vec()))
            .collect(),
        gaps: gaps.collect(),
        reach: reach.filter(|u| u.is_finite()).fold(0.0, f64::max),
    });
    let several = system.gaps().len() > 1;
    let name = |(number, contact): (usize, &pounding_elevation::Contact)| {
        let (gap, level) = contact.place;
        let gap = &system.gaps()[gap];
        let label = system.levels_of(gap)[level].place.label();
        let name = match several {
            true => format!("{}, level {label}", gap.name),
            false => format!("level {label}"),
        };
        (number, name)
    };
    scene.json(scene.contacts.iter().enumerate().map(name))
}

/// The run without gaps and links, and whether what the buildings without gaps demand is known: not
/// where one of them collapses.
fn isolated(
    prepared: &Prepared,
    demand: &mut RelativeDisplacement,
) -> (Result<IsolatedRun, TimeHistoryError>, bool) {
    let (system, options) = (&prepared.assembly.system, &prepared.assembly.options);
    let mut deadline = Deadline::from_now();
    let recorders: &mut [&mut dyn Recorder] = &mut [&mut deadline, demand];
    let without_gaps = run(&system.without_gaps(), options, recorders, &mut |_| {});
    match without_gaps {
        Ok(outcome) if system.links().is_empty() => {
            let collapses = Vec::new();
            (Ok(IsolatedRun { outcome, collapses }), true)
        }
        without_gaps => {
            let mut deadline = Deadline::from_now();
            let alone = run_isolated(system, options, &mut [&mut deadline], &mut |_| {});
            (alone, without_gaps.is_ok())
        }
    }
}

/// What every gap demands at each of its levels; not numbers where that is not known.
fn demands(system: &System, peaks: &[Peak], is_known: bool) -> Value {
    let told = |peak: &Peak| match is_known {
        true => *peak,
        false => Peak {
            value: f64::NAN,
            time: f64::NAN,
        },
    };
    let gaps = system.gaps().iter();
    let levels = gaps.map(|g| {
        peaks[g.first_level..g.first_level + g.levels]
            .iter()
            .map(told)
    });
    json!(levels.map(Iterator::collect::<Vec<_>>).collect::<Vec<_>>())
}

/// What the levels of every gap are called.
fn levels(system: &System) -> Value {
    let gaps = system.gaps().iter();
    let labels = gaps.map(|gap| {
        let levels = system.levels_of(gap).iter();
        levels.map(|level| level.place.label()).collect::<Value>()
    });
    labels.collect()
}

/// For each gap in which velocities jumped at impacts what that means; `null` for the others.
fn jumps(system: &System, outcome: &Outcome) -> Value {
    let gaps = system.gaps().iter().zip(&outcome.gaps);
    let words = gaps.map(|(gap, outcome)| {
        let levels = system.levels_of(gap).iter().zip(&outcome.levels);
        let mut hit = levels.filter(|(_, outcome)| outcome.impacts > 0);
        let jumped = hit.any(|(level, _)| level.model.rigid_restitution().is_some());
        jumped.then_some(VELOCITY_JUMPS)
    });
    json!(words.collect::<Vec<_>>())
}

/// Peaks with contact over those without, of each building and storey.
fn amplifications(outcome: &Outcome, isolated: &Outcome) -> Value {
    let storeys = amplification(&outcome.buildings, &isolated.buildings);
    let storey = |a: &pounding_study::gap_check::Amplification| {
        json!({
            "displacement": a.displacement,
            "storey_shear": a.storey_shear,
            "acceleration_absolute": a.acceleration_absolute,
        })
    };
    let building = |b: &Vec<_>| b.iter().map(storey).collect::<Value>();
    storeys.iter().map(building).collect()
}

/// Impacts in order of closure; levels are counted through all gaps, from zero.
fn impacts(answer: &mut Answer, system: &System, impacts: &[Impact]) {
    type Pick = fn(&Impact) -> f64;
    let parts: [(&str, Pick); 6] = [
        ("t_close", |i| i.time_closed),
        ("t_open", |i| i.time_opened),
        ("approach_velocity", |i| i.approach_velocity),
        ("peak_force", |i| i.peak_force.value),
        ("impulse", |i| i.impulse),
        ("energy_dissipated", |i| i.energy_dissipated),
    ];
    let level = |i: &Impact| (system.gaps()[i.gap].first_level + i.level) as f64;
    answer.add_column("impact_level", impacts.iter().map(level));
    for (name, part) in parts {
        answer.add_column(&format!("impact_{name}"), impacts.iter().map(part));
    }
}

/// Responses on a grid of times, row after row.
fn motion(answer: &mut Answer, history: &History) {
    let columns = [
        ("time", &history.time),
        ("ground_acceleration", &history.ground_acceleration),
        ("displacement", &history.displacement),
        ("penetration", &history.penetration),
        ("force", &history.force),
    ];
    for (name, values) in columns {
        answer.add_column(name, values.iter().copied());
    }
    for part in Energy::PARTS.iter().filter(|p| p.name != "residual") {
        let values = history.energy.iter().map(part.value);
        answer.add_column(&format!("energy_{}", part.name), values);
    }
}
