//! Runs at several widths.

use pounding_study::gap_check::{GapRun, GapSweep, SweepRun, at_width, collapsed_building};
use pounding_time_history::{BuildingOutcome, Recorder, isolated_demand};
use serde_json::json;

use super::deadline::Deadline;
use crate::answer::Answer;
use crate::explorer::{Explorer, Swept};
use crate::fault::Refused;
use crate::limits::MOST_WIDTHS;
use crate::request::Changed;

/// Runs at as many of the widths as there is time for; of the others another request may ask.
pub(crate) fn answer(
    explorer: &mut Explorer,
    changes: &[Changed],
    gap: Option<usize>,
    widths: &[f64],
) -> Result<Answer, Refused> {
    if widths.len() > MOST_WIDTHS {
        return Err(Refused::new(
            format!("{} widths in one request", widths.len()),
            Some(format!("ask for {MOST_WIDTHS} at most")),
        ));
    }
    let text = explorer.text(changes)?;
    let swept = match explorer.swept.take().filter(|swept| swept.text == text) {
        Some(swept) => swept,
        None => {
            let assembly = explorer.prepared(changes)?.assembly;
            let (isolated, _) = isolated_demand(&assembly.system, &assembly.options)?;
            Swept {
                text,
                assembly,
                isolated: isolated.buildings,
            }
        }
    };
    let gaps = swept.assembly.system.gaps().len();
    if let Some(gap) = gap.filter(|gap| *gap >= gaps) {
        return Err(Refused::new(format!("the case has no gap {gap}"), None));
    }
    let swept = explorer.swept.insert(swept);
    let system = (&swept.assembly.system, &swept.assembly.options);
    let mut deadline = Deadline::from_now();
    let mut runs = Vec::new();
    for width in widths {
        if !runs.is_empty() && deadline.is_over() {
            break;
        }
        let run = (*width, gap);
        let recorders: &mut [&mut dyn Recorder] = &mut [&mut deadline];
        runs.push(at_width(system, &swept.isolated, run, recorders));
    }
    let widths = &widths[..runs.len()];
    Ok(of_runs((widths, gap), &runs, &swept.isolated))
}

fn of_runs(
    (widths, gap): (&[f64], Option<usize>),
    runs: &[Result<SweepRun, String>],
    buildings: &[BuildingOutcome],
) -> Answer {
    let mut answer = Answer::default();
    let value = |of: fn(&GapRun) -> f64| {
        let values = runs.iter();
        values.map(move |run| run.as_ref().map_or(f64::NAN, |run| of(&run.contact(gap))))
    };
    answer.add_column("width", widths.iter().copied());
    answer.add_column("impacts", value(|run| run.impacts as f64));
    answer.add_column("peak_force", value(|run| run.peak_force));
    answer.add_column("impact_energy", value(|run| run.impact_energy));
    for building in 0..buildings.len() {
        let most = |run: &Result<SweepRun, String>| {
            let run = run.as_ref().ok()?;
            Some(GapSweep::of_building(run, building, |a| a.displacement)?.1)
        };
        let column = runs.iter().map(|run| most(run).unwrap_or(f64::NAN));
        answer.add_column(&format!("displacement_{building}"), column);
    }
    let failed = runs.iter().zip(widths);
    let failed = failed.filter_map(|(run, width)| {
        let message = run.as_ref().err()?;
        Some(json!({
            "width": width,
            "message": message,
            "collapsed": collapsed_building(message),
        }))
    });
    answer.say("failed", failed.collect::<Vec<_>>());
    let names = buildings.iter().map(|building| building.name.as_str());
    answer.say("buildings", names.collect::<Vec<_>>());
    answer
}
